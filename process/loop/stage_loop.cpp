#include "process/loop/stage_loop.h"

#include "geometry/base/outcome.h"
#include "process/control/increment_control.h"
#include "process/increment/commit.h"
#include "process/increment/fallbacks.h"
#include "process/increment/flight_increment.h"
#include "process/increment/increment_report.h"
#include "process/increment/penalty_control.h"
#include "process/increment/symmetry_walls.h"
#include "process/increment/up_to_touch.h"
#include "process/increment/work_criteria.h"
#include "process/loop/early_end.h"
#include "process/loop/stored_run.h"
#include "process/loop/verdict.h"
#include "process/remeshing/remesh.h"
#include "process/remeshing/remeshing_due.h"
#include "process/reports/energy_balance.h"
#include "process/reports/observer.h"
#include "process/reports/run_reports.h"
#include "process/scene/scene.h"
#include "process/stages/driven_tools.h"
#include "process/stages/fading.h"
#include "process/stages/stage_start.h"
#include "process/stages/striking.h"
#include "process/stages/tool_activation.h"
#include "process/stages/turning_tools.h"
#include "process/stages/unloading.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

constexpr int most_refusals = 3;   ///< for penetration: shorter increments seldom help
constexpr int most_turned = 3;     ///< tries that end with an element inside out, on one mesh
constexpr int long_to_wait = 3;    ///< tries of an increment, for a signal
constexpr int many_failures = 2;   ///< of an increment: then a driven tool is held in places (P.32)
constexpr int tries_of_a_mesh = 3; ///< that fail: then a new one may help

/// No tool may move farther than half the workpiece in one increment: it could pass it unseen.
Outcome<Done> check_leaps(const Run& run, const Stage& stage, double from, double to) {
  const double farthest = 0.5 * body_size(run.mesh());
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const contact::Tool& tool = run.tools()[t];
    const double way = (tool.motion.translation(to) - tool.motion.translation(from)).norm();
    if (!stage.unload && stage.tools[t] != 0 && tool.active(to) && way > farthest)
      return Failure{fmt::format(
          "tool '{}' moves by {:.3g}, more than half the size of the workpiece", tool.name, way)};
  }
  return Done{};
}

} // namespace

RunStatus StageLoop::go(double start) {
  if (!progress_.begun) // a run that is resumed is in the midst of it
    if (const Outcome<Done> begins = begin_stage(run_, stage_, start); !begins) {
      for (Observer* observer : observers_)
        observer->failed(run_, post_mortem(run_, 0.0, begins.error().reason, {}));
      return RunStatus::not_converged;
    }
  note_other_end();
  if (progress_.control.exhausted()) // it has failed: the shortest is tried again
    progress_.control.set_next(progress_.limits.min);
  while (run_.state.time < stage_.end) {
    if (run_.attempt.none)
      write_checkpoint(run_, observers_, CheckpointReason::due);
    if (should_stop())
      return RunStatus::stopped;
    begin_fading();
    if (goes_through_flight())
      continue;
    if (has_ended(run_) || comes_to_rest())
      break;
    const Step step = next_step();
    if (const Outcome<Done> solved = solve(step))
      follow(judge(run_, step.length, progress_.length, progress_.limits.min), step);
    else if (!goes_on_after(step, solved.error()) && !has_ended(run_))
      return RunStatus::not_converged;
  }
  if (stage_.unload)
    let_tools_go(run_);
  return RunStatus::done;
}

/// A run that is resumed may end its stage later or earlier than before.
void StageLoop::note_other_end() {
  const double length = stage_.end - progress_.start;
  if (length == progress_.length)
    return;
  progress_.length = length;
  progress_.limits = limits(run_, length);
  progress_.control.set_limits(progress_.limits);
  run_.state.longest = progress_.limits.max;
}

/// The linear solver, which forgets where the run is stored, would go another way from between the
/// tries of an increment than without a stop. One that is refused again and again takes long.
bool StageLoop::should_stop() const {
  return (run_.attempt.none || progress_.failures >= long_to_wait) &&
         std::any_of(observers_.begin(), observers_.end(),
                     [](const Observer* observer) { return observer->stop_requested(); });
}

/// The forces of tools that leave now fade in as many increments as a twentieth of a stage has.
void StageLoop::begin_fading() {
  constexpr double fewest = 5.0;
  const std::optional<double> soon = stage_.unload ? std::nullopt : tools_leave(run_, stage_);
  if (!soon)
    return;
  const double gone = faded_at(run_, stage_);
  release_tools(run_, *soon, gone);
  progress_.after_fading = std::max(progress_.control.next(), progress_.after_fading);
  progress_.control.set_next(std::max(
      progress_.limits.min, std::min(progress_.control.next(), (gone - run_.state.time) / fewest)));
}

/// The part has sprung back in next to no time: it does not go on at that pace.
void StageLoop::end_fading() {
  run_.state.last_step.clear();
  std::fill(run_.state.velocity.begin(), run_.state.velocity.end(), 0.0);
  if (progress_.after_fading > 0.0)
    progress_.control.set_next(std::exchange(progress_.after_fading, 0.0));
}

bool StageLoop::goes_through_flight() {
  if (progress_.failures > 0 || !flies(run_, stage_, progress_.length))
    return false;
  if (fly(run_, stage_, observers_) && run_.state.time < stage_.end) // as if the stage began here
    begin_increments(run_, stage_, run_.state.time);
  return true;
}

bool StageLoop::comes_to_rest() {
  if (progress_.failures > 0 || progress_.rested || !rests(run_, stage_))
    return false;
  if (&stage_ == &run_.scene.stages.back()) {
    run_.state.ended_by = EndedBy::energy_used_up;
    return true;
  }
  progress_.control.set_next(progress_.length);
  progress_.rested = true; // an increment that is refused all the same gets shorter
  return false;
}

StageLoop::Step StageLoop::next_step() {
  const IncrementControl& control = progress_.control;
  const double landing = next_landing(run_, stage_.end);
  const double left = landing - run_.state.time;
  const double asked = std::min(control.next(), longest_for_blows(run_));
  const double turning = std::max(up_to_turn(run_, asked), std::min(asked, progress_.limits.min));
  const double whole =
      control.in_parts() ? part_towards(left, control.next()) : step_towards(left, turning);
  const bool ends_before_touches =
      progress_.failures == 0 && progress_.wary > 0 && !control.in_parts();
  const double touching = ends_before_touches ? std::max(up_to_touch(run_, whole),
                                                         std::min(whole, progress_.limits.min))
                                              : whole;
  const double length = progress_.failures == 0 ? std::max(up_to_walls(run_, touching),
                                                           std::min(touching, progress_.limits.min))
                                                : touching;
  return {length, landing, length == left};
}

bool StageLoop::is_last_way(double length) const {
  constexpr int many = 6; // failures in between: it takes long
  return progress_.failures == many || 0.5 * length < progress_.limits.min;
}

Outcome<Done> StageLoop::solve(const Step& step) {
  const double time = run_.state.time;
  if (stage_.unload)
    release_tools(run_, time + step.length, stage_.end);
  activate_tools(run_, stage_, time + step.length);
  run_.attempt.too_deep = run_.attempt.inside_out = run_.attempt.moves_away = false;
  if (Outcome<Done> near = check_leaps(run_, stage_, time, time + step.length); !near)
    return near;
  const bool in_rows = progress_.in_rows > 0 && !run_.model.retreating.empty();
  const bool last_way = is_last_way(step.length);
  return solve_by_any_way(run_, step.length,
                          {.failed_before = progress_.failures > 0 || in_rows || last_way,
                           .last_way = last_way,
                           .keeps_failing = progress_.failures >= many_failures});
}

void StageLoop::follow(const Verdict& verdict, const Step& step) {
  using Action = Verdict::Action;
  if (verdict.action == Action::accept) {
    take(step);
    return;
  }
  run_.state.counters.wasted_iterations += run_.attempt.iterations;
  if (!verdict.why.empty()) {
    ++run_.state.counters.cutbacks;
    progress_.tried.push_back(fmt::format("dt = {:.4g}: {}", step.length, verdict.why));
  }
  if (verdict.action == Action::take_length)
    progress_.control.set_next(verdict.length);
  else if (verdict.action == Action::cut_back)
    progress_.control.failed(step.length);
  else if (verdict.action == Action::in_parts)
    progress_.control.split(step.length, verdict.share, run_.attempt.iterations);
  else
    remesh_for(verdict.touch.cause, verdict.touch.sizes);
}

void StageLoop::remesh_for(const std::string& cause, const std::vector<geometry::SizeAt>& sizes) {
  const Outcome<Done> meshed = remesh(run_, cause, observers_, sizes);
  progress_.unmeshed = meshed ? "" : meshed.error().reason;
  if (!meshed)
    run_.state.record.refusal_event =
        fmt::format("  no new mesh ({}): {}", cause, meshed.error().reason);
}

void StageLoop::take(const Step& step) {
  const EnergyBalance before = run_.state.energy;
  const double faded = run_.state.leaving.decay_until;
  const bool fades = !stage_.unload && run_.state.time < faded;
  accept(run_, step.length);
  if (step.lands)
    run_.state.time = step.landing;
  for (const std::string& line : progress_.tried)
    run_.state.record.events.push_back("  cut back from " + line);
  const IncrementReport said = report(run_, step.length, static_cast<int>(progress_.tried.size()));
  notify(run_, observers_, said);
  run_.state.ended_by = early_end(run_, said);
  const bool failed_before = progress_.failures > 0;
  const bool easy = !failed_before && run_.attempt.iterations <= IncrementControl::easy_iterations;
  adapt_penalty(run_, easy ? Progress::easy : Progress::laboured);
  const double gone = (run_.state.time - progress_.start) / progress_.length;
  progress_.control.accepted(step.length, run_.attempt.iterations,
                             missed_since(run_, before, gone));
  if (fades && run_.state.time >= faded)
    end_fading();
  // An increment has been refused lately: for so many more they end before touches, and in so many
  // more points may part in rows.
  constexpr int increments_wary = 20, remembered = 3;
  progress_.in_rows = failed_before ? remembered : std::max(0, progress_.in_rows - 1);
  progress_.wary = failed_before ? increments_wary : std::max(0, progress_.wary - 1);
  progress_.failures = progress_.refusals = 0;
  progress_.tried.clear();
  // While forces fade no mesh is made, so one that is due then comes before tools return.
  const bool goes_on =
      run_.state.time < stage_.end || (stage_.unload && &stage_ != &run_.scene.stages.back());
  if (const std::optional<std::string> cause = remeshing_due(run_, stage_.end - run_.state.time);
      cause && goes_on)
    remesh_for(*cause, {});
}

bool StageLoop::goes_on_with_new_mesh(const Step& step) {
  const bool in_vain = progress_.failures >= tries_of_a_mesh ||
                       progress_.refusals == most_refusals ||
                       run_.state.mesh.turned_inside_out >= most_turned;
  if (!in_vain || !may_remesh(run_))
    return false;
  const Outcome<Done> meshed = remesh(run_, "failed increments", observers_);
  progress_.unmeshed = meshed ? "" : meshed.error().reason;
  if (!meshed)
    return false;
  progress_.control.set_next(std::min(progress_.failures, tries_of_a_mesh) * step.length);
  progress_.failures = progress_.refusals = 0;
  return true;
}

void StageLoop::leave_forces_behind() {
  run_.state.record.refusal_event = "  tools leave their forces behind, which fade: drawn back "
                                    "further they do not hold the part";
  let_tools_go(run_);
  run_.state.leaving.decay_until = run_.state.time;
  progress_.control = IncrementControl(progress_.limits);
  progress_.failures = progress_.refusals = 0;
}

bool StageLoop::goes_on_after(const Step& step, const Failure& failure) {
  ++progress_.failures;
  adapt_penalty(run_, progress_.failures > 1 ? Progress::none : Progress::laboured);
  ++run_.state.counters.cutbacks;
  progress_.tried.push_back(fmt::format("dt = {:.4g}: {}", step.length, failure.reason));
  // The last step remains the better guess for a shorter one, but for a start that fails again.
  constexpr int tries_with_last_step = 3;
  if (progress_.failures >= tries_with_last_step)
    run_.state.last_step.clear();
  progress_.refusals += run_.attempt.too_deep ? 1 : 0;
  run_.state.mesh.turned_inside_out += run_.attempt.inside_out ? 1 : 0;
  progress_.control.failed(step.length);
  if (goes_on_with_new_mesh(step))
    return true;
  if (progress_.control.exhausted() && !run_.model.retreating.empty()) {
    leave_forces_behind();
    return true;
  }
  const bool in_vain = progress_.control.exhausted() || progress_.refusals == most_refusals ||
                       run_.state.mesh.turned_inside_out >= most_turned;
  if (!in_vain)
    return true;
  run_.state.ended_by = end_after_failure(run_);
  if (!has_ended(run_))
    tell_of_failure(step.length, failure.reason);
  return false;
}

void StageLoop::tell_of_failure(double length, std::string why) {
  why += initial_penetrations_now(run_);
  if (!run_.attempt.too_deep && !run_.attempt.inside_out)
    why += unbalanced_loads(run_, run_.state.time + length);
  if (!progress_.unmeshed.empty())
    why += "; the part could not be meshed anew: " + progress_.unmeshed;
  const PostMortem post = post_mortem(run_, length, why, progress_.tried);
  for (Observer* observer : observers_)
    observer->failed(run_, post);
}

} // namespace billet::process
