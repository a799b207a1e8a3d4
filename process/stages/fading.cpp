#include "process/stages/fading.h"

#include "process/scene/scene.h"
#include "process/state/state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

/// The longest way of a tool that acts, or of a support, from now to a time. [mm]
double way_until(const Run& run, const Stage& stage, double time) {
  const double now = run.state.time;
  double longest = 0.0;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    if (stage.tools[t] == 0 || !run.model.contact->acts(t, time))
      continue;
    const geometry::Motion& motion = run.tools()[t].motion;
    longest = std::max({longest, (motion.translation(time) - motion.translation(now)).norm(),
                        std::abs(motion.angle(time) - motion.angle(now)) * body_size(run.mesh())});
  }
  for (const Support& support : run.part().supports)
    longest = std::max(longest, std::abs(support.displacement(time) - support.displacement(now)));
  return longest;
}

/// Whether a function changes so much from now to a time that it counts.
bool changes(const TimeFunction& function, double now, double time) {
  constexpr double little = 1e-3; // of the largest value
  double largest = 0.0;
  for (const auto& point : function.points())
    largest = std::max(largest, std::abs(point.second));
  return std::abs(function(time) - function(now)) > little * largest;
}

/// Whether loads, on the part or on tools that act, change until a time. One that grows as the
/// forces fade is none of them.
bool loads_change(const Run& run, const Stage& stage, double time) {
  const double now = run.state.time;
  const std::vector<double>& known = run.scene.hand_overs;
  if (std::find(known.begin(), known.end(), now) != known.end())
    return false;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const geometry::Motion& motion = run.tools()[t].motion;
    if (stage.tools[t] != 0 && run.model.contact->acts(t, time) &&
        ((motion.force && changes(motion.force->load, now, time)) ||
         (motion.torque && changes(motion.torque->load, now, time))))
      return true;
  }
  return std::any_of(run.part().loads.begin(), run.part().loads.end(), [&](const LoadSpec& load) {
    const auto* const pressure = std::get_if<PressureOn>(&load);
    return changes(pressure != nullptr ? pressure->pressure : std::get<DeadForces>(load).amplitude,
                   now, time);
  });
}

} // namespace

std::optional<double> tools_leave(const Run& run, const Stage& stage) {
  if (!run.model.contact)
    return std::nullopt;
  constexpr double soon = 1e-9, rounding = 1e-12; // a tool acts up to the end of its time
  const double next = run.state.time + std::max(soon * (stage.end - run.state.time),
                                                rounding * std::abs(run.state.time));
  for (std::size_t t = 0; t < run.tools().size(); ++t)
    if (contact::leaves(*run.model.contact, t, next))
      return next;
  return std::nullopt;
}

double faded_at(const Run& run, const Stage& stage) {
  const double now = run.state.time;
  constexpr double farthest = 1e-4;  // of the part: of the order of what it springs back
  constexpr double fewest_parts = 8; // that may be cut from it
  constexpr double of_stage = 1e-3;  // whatever the shortest increment of the case
  const StageProgress& progress = run.state.progress;
  const double shortest =
      std::min({fewest_parts * progress.limits.min, of_stage * progress.length, stage.end - now});
  double length = std::min(fade_share * progress.length, stage.end - now);
  if (run.model.blows && run.model.blows->under_way())
    length = std::min(length, run.model.blows->first_step());
  constexpr double of_increment = 1e-3; // within which rate laws hardly flow at the pace they had
  if (mechanics::follows_rate(run.scene.material.flow))
    length = std::min(length, of_increment * run.state.last_dt);
  const auto moves = [&](double within) {
    constexpr std::array shares{0.3, 0.55, 0.8, 1.0}; // it may come back
    return std::any_of(shares.begin(), shares.end(), [&](double share) {
      const double time = now + share * within;
      return way_until(run, stage, time) > farthest * body_size(run.mesh()) ||
             loads_change(run, stage, time);
    });
  };
  length = std::max(length, shortest);
  while (length > shortest && moves(length))
    length = std::max(0.5 * length, shortest);
  return now + length;
}

} // namespace billet::process
