#include "process/setup/sudden_loads.h"

#include "process/control/increment_control.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace billet::process {

namespace {

/// A span of time in which a tool acts without a break [s].
struct Window {
  double from;
  double until;
};

std::vector<Window> windows(const Scene& scene, const contact::Tool& tool, std::size_t number) {
  std::vector<Window> found;
  double start = 0.0;
  for (const Stage& stage : scene.stages) {
    const Window window{std::max(start, tool.active_from), std::min(stage.end, tool.active_to)};
    if (!stage.unload && stage.tools[number] != 0 && window.from < window.until) {
      if (!found.empty() && found.back().until == window.from)
        found.back().until = window.until;
      else
        found.push_back(window);
    }
    start = stage.end;
  }
  return found;
}

/// Where what begins to act at `begin` is to be whole.
/// @param hands_over  another tool leaves then, and its forces fade
double whole_at(const Scene& scene, double begin, bool hands_over) {
  double start = 0.0;
  double end = scene.stages.back().end;
  for (const Stage& stage : scene.stages) {
    end = stage.end;
    if (begin < stage.end)
      break;
    start = stage.end;
  }
  if (hands_over)
    return std::min(begin + fade_share * (end - start), end);
  double landing = end;
  for (const double time : scene.landing_times)
    if (time > begin)
      landing = std::min(landing, time);
  const double first = scene.increments.first.value_or(
      std::max(scene.increments.share *
                   default_first(end - start, mechanics::follows_rate(scene.material.flow)),
               scene.increments.min.value_or(0.0)));
  return begin + step_towards(landing - begin, first);
}

/// Where a function is to begin with nothing, and the last time before that it has to be what it
/// is.
struct Growth {
  double held_until;
  double begin;
  double whole;
};

/// The function as it is, but growing from nothing if it is not zero at the beginning.
bool grow(TimeFunction& function, const Growth& growth) {
  if (function(growth.begin) == 0.0)
    return false;
  std::vector<std::pair<double, double>> points;
  for (const auto& [time, value] : function.points())
    if (time < growth.held_until)
      points.emplace_back(time, value);
  if (growth.held_until < growth.begin)
    points.emplace_back(growth.held_until, function(growth.held_until));
  points.emplace_back(growth.begin, 0.0);
  for (const auto& [time, value] : function.points())
    if (time > growth.begin && time < growth.whole)
      points.emplace_back(time, value * (time - growth.begin) / (growth.whole - growth.begin));
  points.emplace_back(growth.whole, function(growth.whole));
  for (const auto& [time, value] : function.points())
    if (time > growth.whole)
      points.emplace_back(time, value);
  function = TimeFunction(std::move(points));
  return true;
}

/// Increments end where a growth does, and on the way there: the work of loads is summed by
/// trapezoids, and metal that begins to flow late moves most of the way under most of the load.
void land(Scene& scene, const Growth& growth) {
  constexpr int usual_parts = 4;
  const bool too_short =
      (growth.whole - growth.begin) / usual_parts < scene.increments.min.value_or(0.0);
  const int parts = too_short ? 1 : usual_parts;
  std::vector<double>& times = scene.landing_times;
  for (int i = 1; i <= parts; ++i) {
    const double time =
        i == parts ? growth.whole : growth.begin + i * (growth.whole - growth.begin) / parts;
    const auto at = std::lower_bound(times.begin(), times.end(), time);
    if (at == times.end() || *at != time)
      times.insert(at, time);
  }
}

} // namespace

void grow_sudden_loads(Scene& scene) {
  const Growth at_start{0.0, 0.0, whole_at(scene, 0.0, false)};
  bool grows = false;
  for (LoadSpec& load : scene.part.loads) {
    auto* const pressure = std::get_if<PressureOn>(&load);
    grows |= grow(pressure != nullptr ? pressure->pressure : std::get<DeadForces>(load).amplitude,
                  at_start);
  }
  for (Support& support : scene.part.supports)
    grows |= grow(support.displacement, at_start);
  std::vector<Growth> landings;
  if (grows)
    landings.push_back(at_start);
  std::vector<std::vector<Window>> of_tools;
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    of_tools.push_back(windows(scene, scene.tools[t], t));
  const auto one_leaves = [&](double time) {
    return std::any_of(of_tools.begin(), of_tools.end(), [&](const std::vector<Window>& of_tool) {
      return std::any_of(of_tool.begin(), of_tool.end(),
                         [&](const Window& window) { return window.until == time; });
    });
  };
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    geometry::Motion& motion = scene.tools[t].motion;
    double held_until = 0.0;
    for (const Window& window : of_tools[t]) {
      const bool hands_over = one_leaves(window.from);
      const Growth growth{held_until, window.from, whole_at(scene, window.from, hands_over)};
      held_until = window.until;
      bool tool_grows = false;
      if (motion.force && !motion.force->blow)
        tool_grows |= grow(motion.force->load, growth);
      if (motion.torque)
        tool_grows |= grow(motion.torque->load, growth);
      if (tool_grows)
        landings.push_back(growth);
      if (tool_grows && hands_over)
        scene.hand_overs.push_back(window.from);
    }
  }
  for (const Growth& growth : landings)
    land(scene, growth);
}

} // namespace billet::process
