#include "process/loop/stored_run.h"

#include "geometry/base/archive.h"
#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "process/remeshing/mesh_before.h"
#include "process/reports/observer.h"
#include "process/scene/scene.h"
#include "process/stages/unloading.h"
#include "process/state/attempt.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/state/stored_models.h"
#include "process/tools/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Figures of a solver's work, but for names.
template <class Archive, class Work> void work_fields(Archive& archive, Work& work) {
  archive(work.analysis, work.factorization, work.substitution, work.flops, work.factorizations,
          work.substitutions, work.reused, work.nearly_symmetric, work.multigrid,
          work.multigrid_failed, work.systems, work.last_flops, work.last_factor_bytes);
}

} // namespace

std::string stored(const Run& run) {
  ArchiveWriter archive;
  const bool has_new_mesh = !run.state.record.remeshings.empty();
  archive(run.state, run.attempt, has_new_mesh);
  if (has_new_mesh)
    archive(run.part());
  store_models(run, archive);
  const mechanics::SolverWork work = run.solver_work();
  work_fields(archive, work);
  archive(run.clock.times, run.clock.before + seconds_now() - run.clock.started);
  return archive.take();
}

namespace {

/// What refers to the scene is no part of the bytes.
void refer_to_scene(Run& run) {
  for (const std::size_t tool : run.state.leaving.retreating)
    put_on_retreating_surface(run, tool);
  if (std::optional<Flight>& flight = run.state.flights.now; flight && flight->carrier.pushing_tool)
    flight->carrier.pusher = run.model.tools.at(*flight->carrier.pushing_tool).motion;
}

} // namespace

void restore(Run& run, std::string_view stored) {
  ArchiveReader archive(stored);
  State state(run.tools().size());
  Attempt attempt;
  bool has_new_mesh = false;
  archive(state, attempt, has_new_mesh);
  if (has_new_mesh) {
    Part part;
    part.analysis = run.part().analysis;
    archive(part);
    take_part(run, std::move(part));
  }
  if (state.origins.size() != run.n_nodal() || state.x.size() != run.state.x.size())
    another_scene("elements or driven tools");
  if (state.progress.stage >= run.scene.stages.size() ||
      state.time > run.scene.stages[state.progress.stage].end)
    throw Error(Fault::case_file, "",
                fmt::format("the stored run is at time {:.6g}, beyond the end that the case gives "
                            "to its run or stage",
                            state.time),
                "give a later end, or go on from an earlier checkpoint");
  state.part = run.state.part;
  run.state = std::move(state);
  run.attempt = std::move(attempt);
  if (run.state.progress.begun)
    end_unloading_by(run, run.scene.stages[run.state.progress.stage].end);
  for (const LeavingTools::Forces& forces : run.state.leaving.decaying)
    add_decaying(run, forces);
  restore_models(run, archive);
  work_fields(archive, run.clock.earlier_work);
  archive(run.clock.earlier, run.clock.before);
  if (!archive.at_end())
    another_scene("contents");
  refer_to_scene(run);
  run.clock.times = run.clock.earlier;
  run.clock.started = seconds_now();
}

void write_checkpoint(Run& run, const std::vector<Observer*>& observers, CheckpointReason reason) {
  std::vector<Observer*> wanting;
  std::copy_if(observers.begin(), observers.end(), std::back_inserter(wanting),
               [&](Observer* observer) { return observer->wants_checkpoint(run, reason); });
  if (wanting.empty())
    return;
  take_times(run);
  const Stopwatch timed(run.clock.times.output);
  run.model.newton->forget();
  const std::string bytes = stored(run);
  for (Observer* observer : wanting)
    observer->checkpoint(run, bytes);
}

} // namespace billet::process
