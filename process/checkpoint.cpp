// A run stored and resumed: its state, the part on its present mesh, and what is built on it.

#include "geometry/base/archive.h"
#include "geometry/base/stopwatch.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>

namespace billet::process {

/// What a new mesh has changed of a scene.
struct StoredPart {
  mechanics::Mesh mesh;
  std::vector<Support> supports;
  std::vector<LoadSpec> loads;
  std::vector<mechanics::Face> contact_faces;

  template <class Archive> void fields(Archive& archive) {
    archive(mesh, supports, loads, contact_faces);
  }
};

namespace {

/// Figures of a solver's work, but for names.
template <class Archive, class Work> void work_fields(Archive& archive, Work& work) {
  archive(work.analysis, work.factorization, work.substitution, work.flops, work.factorizations,
          work.substitutions, work.reused, work.nearly_symmetric, work.systems, work.last_flops,
          work.last_factor_bytes);
}

/// The states of those of the models that a run has.
template <class Archive, class... Model>
void archive_present(Archive& archive, const std::unique_ptr<Model>&... models) {
  ((models ? archive(*models) : void()), ...);
}

[[noreturn]] void another_scene(const std::string& what) {
  throw Error(Fault::input_output, "", "the stored run has other " + what + " than this case",
              "resume it with the case that it was run with");
}

} // namespace

std::string Process::stored() const {
  ArchiveWriter archive;
  const bool has_new_mesh = !state_.record.remeshings.empty();
  archive(state_, trial_x_, has_new_mesh);
  if (has_new_mesh)
    archive(scene_.mesh, scene_.supports, scene_.loads, scene_.contact_faces);
  archive(static_cast<std::uint64_t>(scene_.tools.size()));
  for (const contact::Tool& tool : scene_.tools)
    archive(tool.motion.offset, tool.motion.rests_from);
  archive(*bulk_, static_cast<std::uint64_t>(loads_.size()));
  for (const auto& load : loads_)
    archive(*load);
  for (const auto& load : fading_)
    archive(*load);
  archive(stabilization_ != nullptr, contact_ != nullptr, blows_ != nullptr, wear_ != nullptr);
  archive_present(archive, stabilization_, contact_, blows_, wear_);
  const mechanics::SolverWork work = solver_work();
  work_fields(archive, work);
  archive(times_, times_before_ + seconds_now() - started_);
  return archive.take();
}

std::string Process::store() {
  newton_->forget();
  return stored();
}

void Process::take_part(StoredPart part) {
  terms_.clear();
  loads_.clear();
  stabilization_.reset();
  newton_.reset();
  narrow_.reset();
  blows_.reset();
  contact_.reset();
  surface_.reset();
  bulk_.reset();
  scene_.mesh = std::move(part.mesh);
  scene_.supports = std::move(part.supports);
  scene_.loads = std::move(part.loads);
  scene_.contact_faces = std::move(part.contact_faces);
  pattern_ = mechanics::block_pattern(scene_.mesh);
  // As where the mesh was made, before anything has moved on it.
  state_.origins = mechanics::node_positions(scene_.mesh);
  state_.x = state_.origins;
  state_.x.resize(state_.origins.size() + contact::drive_unknowns(scene_.tools).size(), 0.0);
  make_terms();
  if (wear_)
    wear_->change_surface(*surface_, {});
}

void Process::resume(std::string_view stored) {
  ArchiveReader archive(stored);
  State state(scene_.tools.size());
  std::vector<double> trial_x;
  bool has_new_mesh = false;
  archive(state, trial_x, has_new_mesh);
  if (has_new_mesh) {
    StoredPart part;
    archive(part);
    take_part(std::move(part));
  }
  if (state.origins.size() != state_.origins.size() || state.x.size() != state_.x.size())
    another_scene("elements or driven tools");
  std::uint64_t n_tools = 0;
  archive(n_tools);
  if (n_tools != scene_.tools.size())
    another_scene("tools");
  for (contact::Tool& tool : scene_.tools)
    archive(tool.motion.offset, tool.motion.rests_from);
  if (state.progress.stage >= scene_.stages.size() ||
      state.time > scene_.stages[state.progress.stage].end)
    throw Error(Fault::case_file, "",
                fmt::format("the stored run is at time {:.6g}, beyond the end that the case gives "
                            "to its run or stage",
                            state.time),
                "give a later end, or go on from an earlier checkpoint");
  state_ = std::move(state);
  trial_x_ = std::move(trial_x);
  std::uint64_t n_loads = 0;
  archive(*bulk_, n_loads);
  if (n_loads != loads_.size())
    another_scene("loads");
  for (const auto& load : loads_)
    archive(*load);
  for (const LeavingTools::Forces& forces : state_.leaving.fading)
    add_fading(forces);
  for (const auto& load : fading_)
    archive(*load);
  bool grounded = false, touches = false, strikes = false, wears = false;
  archive(grounded, touches, strikes, wears);
  if (grounded != (stabilization_ != nullptr) || touches != (contact_ != nullptr) ||
      strikes != (blows_ != nullptr) || wears != (wear_ != nullptr))
    another_scene("supports, tools, presses or laws of wear");
  archive_present(archive, stabilization_, contact_, blows_, wear_);
  work_fields(archive, earlier_work_);
  archive(earlier_times_, times_before_);
  if (!archive.at_end())
    another_scene("contents");
  for (const std::size_t tool : state_.leaving.retreating)
    put_on_retreating_surface(tool);
  if (std::optional<Flight>& flight = state_.flights.now; flight && flight->carrier.pushing_tool)
    flight->carrier.pusher = scene_.tools.at(*flight->carrier.pushing_tool).motion;
  times_ = earlier_times_;
  started_ = seconds_now();
  resumed_ = true;
}

void Process::write_checkpoint(const std::vector<Observer*>& observers, CheckpointReason reason) {
  std::vector<Observer*> wanting;
  std::copy_if(observers.begin(), observers.end(), std::back_inserter(wanting),
               [&](Observer* observer) { return observer->wants_checkpoint(*this, reason); });
  if (wanting.empty())
    return;
  take_times();
  const Stopwatch timed(times_.output);
  const std::string bytes = store();
  for (Observer* observer : wanting)
    observer->checkpoint(*this, bytes);
}

} // namespace billet::process
