#include "process/stages/striking.h"

#include "geometry/base/outcome.h"
#include "process/control/increment_control.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

constexpr double smallest_share = 1e-7; ///< of a stage, when the case does not say

bool same(const TimeFunction& function, double from, double to) {
  return function(from) == function(to);
}

bool stands(const contact::Tool& tool, double from, double to) {
  const geometry::Motion& motion = tool.motion;
  const bool driven =
      (motion.force && !motion.force->blow && !same(motion.force->load, from, to)) ||
      (motion.torque && !same(motion.torque->load, from, to));
  return !driven && motion.translation(from) == motion.translation(to) &&
         motion.angle(from) == motion.angle(to) && tool.active(from) == tool.active(to);
}

bool constant(const LoadSpec& load, double from, double to) {
  if (const auto* pressure = std::get_if<PressureOn>(&load))
    return same(pressure->pressure, from, to);
  return same(std::get<DeadForces>(load).amplitude, from, to);
}

} // namespace

Outcome<Done> begin_blows(Run& run, const Stage& stage) {
  if (!run.model.blows)
    return Done{};
  if (stage.unload) { // tools that touch stay where they are
    run.model.blows->end_all();
    return Done{};
  }
  std::vector<Vec3> points(run.model.surface->n_points());
  run.model.surface->positions(run.state.x, points);
  const int dim = run.mesh().dimension();
  for (Index f = 0; f < run.model.surface->n_faces(); ++f)
    for (const Index node : run.model.surface->scatter().nodes(f)) {
      Vec3& point = points.emplace_back(Vec3::Zero());
      std::copy_n(run.state.x.begin() + node * dim, dim, point.data());
    }
  return run.model.blows->begin(stage, run.state.time, points, run.state.x);
}

/// (P.1), (P.11)
IncrementControl::Limits limits(const Run& run, double length) {
  const IncrementLimits& given = run.scene.increments;
  const bool strikes = run.model.blows && run.model.blows->under_way();
  const double begins = strikes ? run.model.blows->first_step() : HUGE_VAL;
  constexpr double shortest_of_blow = 1e-3; // of its first increment
  const double smallest =
      given.min.value_or(std::min(smallest_share * length, shortest_of_blow * begins));
  const double asked = std::max(given.first.value_or(0.0), given.min.value_or(0.0));
  const double largest = given.max.value_or(std::max(given.share * default_longest(length), asked));
  const double first = given.first.value_or(std::min(
      given.share * default_first(length, mechanics::follows_rate(run.scene.material.flow)),
      begins));
  return {std::clamp(first, std::min(smallest, largest), largest), smallest, largest};
}

double longest_for_blows(const Run& run) {
  return run.model.blows && !run.scene.increments.max ? run.model.blows->longest_step() : HUGE_VAL;
}

std::optional<double> step_to_stop(const Run& run, double dt) {
  return run.model.blows ? run.model.blows->step_to_stop(run.trial(dt)) : std::nullopt;
}

bool stands_still(const Run& run, const Stage& stage, double from, double to) {
  std::vector<double> times{to};
  std::copy_if(run.scene.landing_times.begin(), run.scene.landing_times.end(),
               std::back_inserter(times), [&](double t) { return t > from && t < to; });
  const std::size_t corners = times.size();
  for (std::size_t k = 0; k < corners; ++k)
    times.push_back(from + 0.3 * (times[k] - from)); // what comes back to where it was moves too
  return std::all_of(times.begin(), times.end(), [&](double t) {
    for (std::size_t i = 0; i < run.tools().size(); ++i)
      if (stage.tools[i] != 0 && !stands(run.tools()[i], from, t))
        return false;
    return std::all_of(run.part().supports.begin(), run.part().supports.end(),
                       [&](const Support& s) { return same(s.displacement, from, t); }) &&
           std::all_of(run.part().loads.begin(), run.part().loads.end(),
                       [&](const LoadSpec& load) { return constant(load, from, t); });
  });
}

bool rests(const Run& run, const Stage& stage) {
  if (!run.model.blows || stage.unload || run.model.blows->under_way() ||
      run.state.time < run.state.leaving.decay_until)
    return false;
  bool struck = false;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const geometry::Motion& motion = run.tools()[t].motion;
    struck = struck || (stage.tools[t] != 0 && motion.force && motion.force->blow);
  }
  return struck && stands_still(run, stage, run.state.time, stage.end);
}

} // namespace billet::process
