#include "process/presses/blows.h"

#include "geometry/collision/first_contact.h"
#include "process/setup/touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::process {

namespace {

/// A ram slower than this share of its first speed stands still: a millionth of its energy is left.
constexpr double still = 1e-3;

} // namespace

Blows::Blows(std::span<const contact::Tool> tools,
             contact::ContactTerm& contact,
             double size,
             std::size_t n_nodal)
    : tools_(tools), contact_(&contact), term_(contact, tools, n_nodal), size_(size) {
  for (std::size_t t = 0; t < tools.size(); ++t)
    if (tools[t].motion.force && tools[t].motion.force->blow)
      striking_.push_back(t);
}

Outcome<Done> Blows::begin(const Stage& stage,
                           double time,
                           std::span<const Vec3> points,
                           std::vector<double>& x) {
  std::erase_if(current_, [&](const CurrentBlow& blow) {
    if (contact_->acts(blow.tool, time))
      return false;
    term_.stop(blow.tool);
    return true;
  });
  for (const std::size_t t : striking_) {
    if (!contact_->acts(t, time) || term_.moving(t) != nullptr)
      continue;
    if (Outcome<Done> touches = bring_to_touch(t, time, points, x); !touches)
      return touches;
    term_.strike(t, time);
    const contact::Ram& ram = *term_.moving(t);
    current_.push_back({t, reports_.size(), ram});
    reports_.push_back({.tool = t,
                        .stage = stage.name,
                        .begun = time,
                        .time = time,
                        .energy = ram.energy(),
                        .left = ram.energy(),
                        .speed = ram.speed});
  }
  return Done{};
}

void Blows::end_all() {
  for (const CurrentBlow& blow : current_)
    term_.stop(blow.tool);
  current_.clear();
}

/// Nothing resists the ram on its way there, so its speed stays what it is.
Outcome<Done> Blows::bring_to_touch(std::size_t tool,
                                    double time,
                                    std::span<const Vec3> points,
                                    std::vector<double>& x) {
  if (contact::lies_on(*contact_, tool))
    return Done{};
  const auto way =
      geometry::distance_to_contact(*tools_[tool].surface, contact_->pose(tool, time, x),
                                    drive(tool).axis, points, most_sizes_to_touch * size_);
  if (!way)
    return Failure{
        fmt::format("the press '{}' strikes nothing: {}", tools_[tool].name, way.error().reason)};
  x[term_.unknown(tool)] += *way;
  contact_->start(tool, x, time);
  return Done{};
}

/// (P.11)
double Blows::longest_step() const {
  constexpr double share_of_speed = 1.0 / 50.0;
  constexpr double share_of_body = 0.01;
  double longest = std::numeric_limits<double>::infinity();
  for (const CurrentBlow& blow : current_) {
    const double first_speed = drive(blow.tool).blow->speed;
    // Towards its end a blow is short of speed, not of time.
    longest =
        std::min(longest, share_of_body * size_ / std::max(blow.ram.speed, still * first_speed));
    if (blow.ram.force != 0.0)
      longest = std::min(longest,
                         share_of_speed * first_speed * blow.ram.mass / std::abs(blow.ram.force));
  }
  return longest;
}

double Blows::first_step() const {
  constexpr double share_of_body = 1e-4;
  double first = std::numeric_limits<double>::infinity();
  for (const CurrentBlow& blow : current_)
    first = std::min(first, share_of_body * size_ / blow.ram.speed);
  return first;
}

/// (P.12) The speed as a parabola in time, through its value and slope at the beginning and its
/// value at the end.
std::optional<double> Blows::step_to_stop(const mechanics::Trial& trial) const {
  const double dt = trial.time - trial.time_old;
  std::optional<double> shortest;
  for (const CurrentBlow& blow : current_) {
    const std::size_t i = term_.unknown(blow.tool);
    const double v0 = blow.ram.speed;
    const double v1 = blow.ram.speed_after(trial.x[i] - trial.x_old[i], dt);
    if (v1 >= -still * drive(blow.tool).blow->speed)
      continue;
    // v(s dt) = v0 + b s + c s^2, with the root written so that c = 0 is no exception.
    const double b = blow.ram.force / blow.ram.mass * dt;
    const double c = v1 - v0 - b;
    const double s = 2.0 * v0 / (std::sqrt(std::max(0.0, b * b - 4.0 * c * v0)) - b);
    constexpr double least = 0.02, most = 0.98;
    const double share = std::isfinite(s) ? std::clamp(s, least, most) : v0 / (v0 - v1);
    shortest = std::min(shortest.value_or(dt), share * dt);
  }
  return shortest;
}

void Blows::take_in(const mechanics::Trial& trial, CurrentBlow& blow) {
  const std::size_t i = term_.unknown(blow.tool);
  const double way = trial.x[i] - trial.x_old[i];
  const contact::Ram& ram = *term_.moving(blow.tool);
  const TimeFunction& load = drive(blow.tool).load;
  const double driving = 0.5 * (load(trial.time_old) + load(trial.time)) * way;
  BlowReport& report = reports_[blow.report];
  report.time = trial.time;
  report.driven += driving;
  report.used += driving - 0.5 * (blow.ram.force + ram.force) * way;
  report.left = ram.energy();
  report.stroke += way;
  report.speed = ram.speed;
  blow.ram = ram;
}

std::vector<std::string> Blows::commit(const mechanics::Trial& trial) {
  std::vector<std::string> lines;
  std::erase_if(current_, [&](CurrentBlow& blow) {
    take_in(trial, blow);
    if (blow.ram.speed > still * drive(blow.tool).blow->speed)
      return false;
    BlowReport& report = reports_[blow.report];
    report.over = true;
    term_.stop(blow.tool);
    lines.push_back(fmt::format(
        "press '{}': its blow is over after {:.5g}: energy {:.6g} used up, stroke {:.6g}",
        tools_[blow.tool].name, report.time - report.begun, report.used, report.stroke));
    return true;
  });
  return lines;
}

void Blows::go_on_from(BlowRecord before, double time) {
  current_ = std::move(before.current);
  reports_ = std::move(before.reports);
  for (const std::size_t t : striking_)
    term_.stop(t);
  for (CurrentBlow& blow : current_) {
    term_.go_on(blow.tool, blow.ram.mass, blow.ram.speed, time);
    blow.ram = *term_.moving(blow.tool);
  }
}

bool Blows::under_way() const { return !current_.empty(); }

} // namespace billet::process
