// How the run loop leads presses that strike through a stage. (P.10)-(P.12)

#include "process/run.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

std::string Process::begin_blows(const Stage& stage) {
  if (!blows_ || stage.unload)
    return "";
  std::vector<Vec3> points(surface_->n_points());
  surface_->positions(state_.x, points);
  const int dim = scene_.mesh.dimension();
  for (Index f = 0; f < surface_->n_faces(); ++f)
    for (const Index node : surface_->scatter().nodes(f)) {
      Vec3& point = points.emplace_back(Vec3::Zero());
      std::copy_n(state_.x.begin() + node * dim, dim, point.data());
    }
  return blows_->begin(stage, state_.time, points, state_.x);
}

/// (P.1), (P.11)
IncrementControl::Limits Process::limits(double length) const {
  const IncrementLimits& given = scene_.increments;
  const bool strikes = blows_ && blows_->under_way();
  const double begins = strikes ? blows_->first_step() : HUGE_VAL;
  constexpr double shortest_of_blow = 1e-3; // of its first increment
  const double smallest =
      given.min.value_or(std::min(smallest_share * length, shortest_of_blow * begins));
  const double asked = std::max(given.first.value_or(0.0), given.min.value_or(0.0));
  const double largest = given.max.value_or(std::max(default_longest(length), asked));
  const double first = given.first.value_or(
      std::min(default_first(length, mechanics::follows_rate(scene_.material.flow)), begins));
  return {std::clamp(first, std::min(smallest, largest), largest), smallest, largest};
}

double Process::longest_for_blows() const {
  return blows_ && !scene_.increments.max ? blows_->longest_step() : HUGE_VAL;
}

std::optional<double> Process::step_to_stop(double dt) const {
  return blows_ ? blows_->step_to_stop({state_.time, state_.time + dt, state_.x, trial_x_})
                : std::nullopt;
}

bool Process::rests(const Stage& stage) const {
  if (!blows_ || stage.unload || blows_->under_way() || state_.time < state_.leaving.fading_until)
    return false;
  bool struck = false;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    const geometry::Motion& motion = scene_.tools[t].motion;
    struck = struck || (stage.tools[t] != 0 && motion.force && motion.force->blow);
  }
  return struck && stands_still(stage, state_.time, stage.end);
}

bool Process::stands_still(const Stage& stage, double from, double to) const {
  std::vector<double> times{to};
  std::copy_if(scene_.landing_times.begin(), scene_.landing_times.end(), std::back_inserter(times),
               [&](double t) { return t > from && t < to; });
  const std::size_t corners = times.size();
  for (std::size_t k = 0; k < corners; ++k)
    times.push_back(from + 0.3 * (times[k] - from)); // what comes back to where it was moves too
  return std::all_of(times.begin(), times.end(), [&](double t) {
    for (std::size_t i = 0; i < scene_.tools.size(); ++i)
      if (stage.tools[i] != 0 && !stands(scene_.tools[i], from, t))
        return false;
    return std::all_of(scene_.supports.begin(), scene_.supports.end(),
                       [&](const Support& s) { return same(s.displacement, from, t); }) &&
           std::all_of(scene_.loads.begin(), scene_.loads.end(),
                       [&](const LoadSpec& load) { return constant(load, from, t); });
  });
}

} // namespace billet::process
