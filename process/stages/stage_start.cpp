#include "process/stages/stage_start.h"

#include "geometry/base/outcome.h"
#include "process/control/increment_control.h"
#include "process/scene/scene.h"
#include "process/stages/striking.h"
#include "process/stages/unloading.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <algorithm>
#include <cstddef>

namespace billet::process {

void start_stage(Run& run, const Stage& stage) {
  run.state.last_step.clear();
  run.state.snapshots.clear();
  if (run.model.stabilization && run.model.stabilization->share() > 1.0)
    run.model.stabilization->set_share(1.0); // it held what forces that faded could turn over
  if (run.model.contact && stage.unload)
    draw_tools_back(run, stage.end);
  else if (run.model.contact) {
    set_tools_going(run);
    run.model.contact->activity().enable(stage.tools);
  }
}

Outcome<Done> begin_stage(Run& run, const Stage& stage, double start) {
  StageProgress& progress = run.state.progress;
  const std::size_t number = progress.stage;
  progress = {};
  progress.stage = number;
  progress.begun = true;
  start_stage(run, stage);
  if (Outcome<Done> strikes = begin_blows(run, stage); !strikes)
    return strikes;
  begin_increments(run, stage, start);
  return Done{};
}

void begin_increments(Run& run, const Stage& stage, double start) {
  StageProgress& progress = run.state.progress;
  progress.start = start;
  progress.length = stage.end - start;
  progress.limits = limits(run, progress.length);
  progress.control = IncrementControl(progress.limits);
  run.state.longest = progress.limits.max;
}

double next_landing(const Run& run, double stage_end) {
  // Times closer than rounding count as reached.
  const double slack = 1e-9 * stage_end;
  const double faded = run.state.leaving.decay_until;
  const double end = faded > run.state.time + slack ? std::min(faded, stage_end) : stage_end;
  for (const double t : run.scene.landing_times)
    if (t > run.state.time + slack && t < end - slack)
      return t;
  return end;
}

} // namespace billet::process
