#include "process/sudden_loads.h"

#include "process/increment_control.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace billet::process {

namespace {

/// The end of the increment that begins at `begin`, if it is as long as the case allows it to be.
double end_of_first(const Scene& scene, double begin) {
  double start = 0.0;
  double landing = scene.stages.back().end;
  for (const Stage& stage : scene.stages) {
    landing = stage.end;
    if (begin < stage.end)
      break;
    start = stage.end;
  }
  const double length = landing - start;
  for (const double time : scene.landing_times)
    if (time > begin)
      landing = std::min(landing, time);
  const double first = std::min(scene.increments.first.value_or(default_first(length)),
                                scene.increments.max.value_or(default_longest(length)));
  return begin + step_towards(landing - begin, first);
}

/// The function as it is, but growing from nothing at `begin` if it is not zero there.
TimeFunction grown(const Scene& scene, const TimeFunction& function, double begin) {
  if (function(begin) == 0.0)
    return function;
  const double whole = end_of_first(scene, begin);
  std::vector<std::pair<double, double>> points;
  for (const auto& point : function.points())
    if (point.first < begin)
      points.push_back(point);
  points.emplace_back(begin, 0.0);
  points.emplace_back(whole, function(whole));
  for (const auto& point : function.points())
    if (point.first > whole)
      points.push_back(point);
  return TimeFunction(std::move(points));
}

/// Times at which a tool begins to act.
std::vector<double> beginnings(const Scene& scene, std::size_t tool) {
  std::vector<double> times;
  double start = 0.0;
  double acted_until = -1.0;
  for (const Stage& stage : scene.stages) {
    const contact::Tool& it = scene.tools[tool];
    const double from = std::max(start, it.active_from);
    const double until = std::min(stage.end, it.active_to);
    if (!stage.unload && stage.tools[tool] != 0 && from < until) {
      if (from > acted_until)
        times.push_back(from);
      acted_until = until;
    }
    start = stage.end;
  }
  return times;
}

} // namespace

void grow_sudden_loads(Scene& scene) {
  for (LoadSpec& load : scene.loads) {
    if (auto* pressure = std::get_if<PressureOn>(&load))
      pressure->pressure = grown(scene, pressure->pressure, 0.0);
    else
      std::get<DeadForces>(load).amplitude =
          grown(scene, std::get<DeadForces>(load).amplitude, 0.0);
  }
  for (Support& support : scene.supports)
    support.displacement = grown(scene, support.displacement, 0.0);
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    for (const double begin : beginnings(scene, t)) {
      geometry::Motion& motion = scene.tools[t].motion;
      if (motion.force && !motion.force->blow)
        motion.force->load = grown(scene, motion.force->load, begin);
      if (motion.torque)
        motion.torque->load = grown(scene, motion.torque->load, begin);
    }
}

} // namespace billet::process
