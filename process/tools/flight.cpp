#include "process/tools/flight.h"

#include "geometry/base/box.h"
#include "geometry/base/limits.h"
#include "geometry/collision/facet_body.h"
#include "process/scene/scene.h"
#include "process/setup/drawing.h"
#include "process/tools/part_depth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

constexpr int looks_at_span = 16;         // pieces of a span: ways need not be straight
constexpr double rounding_of_way = 1e-12; // of a way
constexpr int most_steps_in_air = 200;    // of one tool towards the part
constexpr double same_motion = 1e-3;      // of an increment's way: the part goes with its pusher

/// Until when a function keeps the value that it has at a time.
double constant_until(const TimeFunction& function, double from) {
  double until = from;
  const double value = function(from);
  for (const auto& [time, at] : function.points()) {
    if (time <= from)
      continue;
    if (at != value)
      return until;
    until = time;
  }
  return infinity;
}

/// Until when two functions change by the same amounts.
double agree_until(const TimeFunction& f, const TimeFunction& g, double from) {
  std::vector<double> times;
  for (const TimeFunction* function : {&f, &g})
    for (const auto& [time, value] : function->points())
      if (time > from)
        times.push_back(time);
  std::sort(times.begin(), times.end());
  double until = from;
  for (const double time : times) {
    const double change = f(time) - f(from);
    if (std::abs(change - (g(time) - g(from))) > rounding_of_way * std::abs(change))
      return until;
    until = time;
  }
  return infinity;
}

double steady_until(const LoadSpec& load, double from) {
  const auto* const pressure = std::get_if<PressureOn>(&load);
  return constant_until(
      pressure != nullptr ? pressure->pressure : std::get<DeadForces>(load).amplitude, from);
}

/// Takes the motion that the supports of a part share into its carrier.
/// @return until when they share it
double carried_until(const Departure& now, Carrier& carrier) {
  double until = now.stage.end;
  for (const Support& support : now.part.supports) {
    const auto d = static_cast<std::size_t>(support.component);
    std::optional<TimeFunction>& shared = carrier.supports[d];
    if (!shared)
      shared = support.displacement;
    until = std::min(until, agree_until(*shared, support.displacement, now.time));
  }
  // A ring that moves away from its axis is not rigid.
  if (now.part.analysis == mechanics::Analysis::axisymmetric && carrier.supports[0])
    until = std::min(until, constant_until(*carrier.supports[0], now.time));
  return until;
}

/// Until when no tool begins or ceases to act, and the loads on tools stay.
double tools_until(const Departure& now) {
  double until = now.stage.end;
  for (std::size_t t = 0; t < now.tools.size(); ++t) {
    const contact::Tool& tool = now.tools[t];
    if (now.stage.tools[t] == 0)
      continue;
    for (const double time : {tool.active_from, tool.active_to})
      if (time > now.time)
        until = std::min(until, time);
    for (const auto* drive : {&tool.motion.force, &tool.motion.torque})
      if (*drive)
        until = std::min(until, constant_until((*drive)->load, now.time));
  }
  return until;
}

/// A tool as a part sees it that its carrier takes along.
class Relative {
public:
  Relative(const Departure& now, std::size_t tool, const Carrier& carrier)
      : tool_(now.tools[tool]), driven_(now.contact->driven(tool, now.x)), carrier_(carrier),
        start_(now.time) {
    const Box box = box_of_nodes(now.part.mesh, now.x);
    centre_ = 0.5 * (box.low + box.high);
    radius_ = 0.5 * box.size();
    if (tool_.motion.displacement)
      for (const TimeFunction& component : *tool_.motion.displacement)
        add_corners(component);
    if (tool_.motion.rotation)
      add_corners(tool_.motion.rotation->speed);
    for (const std::optional<TimeFunction>& component : carrier.supports)
      if (component)
        add_corners(*component);
  }

  /// Tool to space in which the part rests.
  [[nodiscard]] geometry::Pose pose(double time) const {
    geometry::Pose pose = tool_.motion.pose(time, driven_);
    pose.translation -= carrier_.shift(start_, time);
    return pose;
  }

  /// Bound of the way that any point of the part makes relative to the tool [mm]. (G.31)
  [[nodiscard]] double way(double from, double to) const {
    std::vector<double> times{to};
    for (int k = 1; k < looks_at_span; ++k)
      times.push_back(from + (to - from) * k / looks_at_span);
    std::copy_if(corners_.begin(), corners_.end(), std::back_inserter(times),
                 [&](double time) { return from < time && time < to; });
    std::sort(times.begin(), times.end());
    double way = 0.0;
    double last = from;
    for (const double time : times) {
      const double turn =
          std::abs(tool_.motion.angle(time, driven_) - tool_.motion.angle(last, driven_));
      way += (shift(time) - shift(last)).norm() +
             (turn > 0.0 ? turn * std::max(arm(last), arm(time)) : 0.0);
      last = time;
    }
    return way;
  }

  /// Whether tool and part move as one.
  [[nodiscard]] bool rests(double until) const {
    const double own = (shift(until) - shift(start_)).norm() + carrier_.shift(start_, until).norm();
    return way(start_, until) <= rounding_of_way * own;
  }

  /// The time at which the way has come to a length; `until` if that is sooner.
  [[nodiscard]] double later(double from, double length, double until) const {
    constexpr double shorter = 0.9, equal = 1.0 + 1e-9;
    double span = until - from;
    double now = way(from, until);
    while (now > equal * length) {
      span *= std::min(length / now, now > 2.0 * length ? 1.0 : shorter);
      now = way(from, from + span);
    }
    return span == until - from ? until : from + span;
  }

  /// What the part may see of the tool, in the tool's frame.
  [[nodiscard]] Box window(double until) const {
    Box window;
    const auto add = [&](const Vec3& middle, double around) {
      window.add(middle - Vec3::Constant(around));
      window.add(middle + Vec3::Constant(around));
    };
    for (int k = 0; k <= looks_at_span; ++k) {
      const double time = start_ + (until - start_) * k / looks_at_span;
      const geometry::Pose at = pose(time);
      add(at.to_tool(centre_), 2.0 * radius_);
      if (!tool_.motion.axis().isZero(0.0))
        add(at.to_tool(axis_point(time)), arm(time) + radius_);
    }
    return window;
  }

  [[nodiscard]] const geometry::RigidSurface& surface() const { return *tool_.surface; }

private:
  void add_corners(const TimeFunction& function) {
    for (const auto& [time, value] : function.points())
      corners_.push_back(time);
  }
  [[nodiscard]] Vec3 shift(double time) const {
    return tool_.motion.translation(time, driven_) - carrier_.shift(start_, time);
  }
  [[nodiscard]] Vec3 axis_point(double time) const {
    return tool_.motion.axis_point() + tool_.motion.offset + shift(time);
  }
  /// Longest distance of a point of the part from the axis that the tool turns about [mm].
  [[nodiscard]] double arm(double time) const {
    return (centre_ - axis_point(time)).cross(tool_.motion.axis()).norm() + radius_;
  }

  const contact::Tool& tool_;
  geometry::Driven driven_;
  const Carrier& carrier_;
  double start_;
  Vec3 centre_ = Vec3::Zero(); ///< of a ball that holds the part [mm]
  double radius_ = 0.0;
  std::vector<double> corners_; ///< of what moves tool and part [s]
};

/// The part at rest, and the tools that come towards it.
class Approaches {
public:
  Approaches(const Departure& now, const Carrier& carrier)
      : now_(now), carrier_(carrier), size_(body_size(now.part.mesh)),
        points_(now.surface->n_points()) {
    now.surface->positions(now.x, points_);
  }

  /// Until when a tool has not touched.
  [[nodiscard]] double clear_until(std::size_t tool, double least, double until) {
    const Relative relative(now_, tool, carrier_);
    if (relative.rests(until))
      return until;
    return points_clear(relative, least) ? facets_clear(relative, until) : now_.time;
  }

private:
  /// Whether contact points stay outside: it costs little, and most tools that are near come in.
  [[nodiscard]] bool points_clear(const Relative& tool, double least) const {
    std::vector<Vec3> places(points_.size());
    std::vector<geometry::Projection> feet(points_.size());
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const geometry::Pose pose = tool.pose(now_.time + share * least);
      std::transform(points_.begin(), points_.end(), places.begin(),
                     [&](const Vec3& x) { return pose.to_tool(x); });
      tool.surface().project(places, size_, feet);
      for (const geometry::Projection& foot : feet)
        if (foot.gap <= facet_tolerance * size_)
          return false;
    }
    return true;
  }

  [[nodiscard]] double facets_clear(const Relative& tool, double until) {
    if (workpiece_.mesh.points.empty())
      workpiece_ = drawn(*now_.surface, now_.x);
    const Box window = tool.window(until);
    geometry::DisplayMesh drawing =
        tool.surface().display(window, now_.part.analysis != mechanics::Analysis::solid);
    keep_within(window, drawing);
    const double tolerance =
        facet_tolerance * size_ + excess(tool.surface(), drawing) + workpiece_.error;
    Box all = window;
    for (const Vec3& p : drawing.points)
      all.add(p);
    const geometry::FacetBody body(std::move(drawing), all.size()),
        part(workpiece_.mesh, all.size());
    double time = now_.time;
    for (int step = 0; step < most_steps_in_air && time < until; ++step) {
      const double open = geometry::clearance({body, tool.pose(time)}, {part, {}}) - tolerance;
      if (open <= tolerance)
        break;
      time = tool.later(time, open, until);
    }
    return time;
  }

  const Departure& now_;
  const Carrier& carrier_;
  double size_;
  std::vector<Vec3> points_;
  DrawnWorkpiece workpiece_;
};

/// Until when a tool that has pushed the part along by its own way goes on like that.
double pushed_until(const Departure& now, const geometry::Motion& motion) {
  const Vec3 last = motion.translation(now.time) - motion.translation(now.time - now.last_dt);
  const int dim = now.part.mesh.dimension();
  const std::size_t n = now.part.mesh.points.size() * static_cast<std::size_t>(dim);
  if (now.last_step.size() < n || last.isZero(0.0))
    return now.time;
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(now.last_step[i] - last[static_cast<Index>(i) % dim]) > same_motion * last.norm())
      return now.time;
  double until = now.time;
  for (int k = 1; k <= looks_at_span; ++k) {
    const double time = now.time + (now.stage.end - now.time) * k / looks_at_span;
    const Vec3 way = motion.translation(time) - motion.translation(until);
    const bool turns = motion.angle(time) != motion.angle(now.time);
    if (turns || way.cross(last).norm() > rounding_of_way * way.norm() * last.norm() ||
        !(way.dot(last) > 0.0))
      return until;
    until = time;
  }
  return until;
}

/// A tool that pushes the part along where no support moves it.
/// @return until when it does
double find_pusher(const Departure& now, double soon, double until, Carrier& carrier) {
  for (std::size_t t = 0; t < now.tools.size(); ++t) {
    const geometry::Motion& motion = now.tools[t].motion;
    if (!now.contact->acts(t, soon) || !contact::lies_on(*now.contact, t) || motion.force ||
        motion.torque || Relative(now, t, carrier).rests(until))
      continue;
    carrier.pusher = motion;
    carrier.pushing_tool = t;
    return std::min(until, pushed_until(now, motion));
  }
  return until;
}

} // namespace

Vec3 Carrier::shift(double from, double to) const {
  Vec3 shift = pusher ? Vec3(pusher->translation(to) - pusher->translation(from)) : Vec3::Zero();
  for (std::size_t d = 0; d < supports.size(); ++d)
    if (supports[d])
      shift[static_cast<Index>(d)] = (*supports[d])(to) - (*supports[d])(from);
  return shift;
}

std::optional<Flight> flight_from(const Departure& now, double least) {
  Flight flight;
  double& until = flight.until;
  until = std::min(carried_until(now, flight.carrier), tools_until(now));
  for (const LoadSpec& load : now.part.loads)
    until = std::min(until, steady_until(load, now.time));
  const auto is_short = [&] { return until < now.time + least; };
  if (is_short())
    return std::nullopt;
  bool moves = !flight.carrier.shift(now.time, until).isZero(0.0);
  if (now.contact != nullptr) {
    until = find_pusher(now, now.time + least, until, flight.carrier);
    Approaches approaches(now, flight.carrier);
    for (std::size_t t = 0; t < now.tools.size() && !is_short(); ++t) {
      if (!now.contact->acts(t, now.time + least))
        continue;
      const geometry::Motion& motion = now.tools[t].motion;
      if (motion.force && !motion.force->blow && !contact::lies_on(*now.contact, t))
        return std::nullopt; // it comes to touch first
      moves = moves || !Relative(now, t, flight.carrier).rests(until);
      until = std::min(until, approaches.clear_until(t, least, until));
    }
  }
  if (is_short() || !(moves || flight.carrier.pusher))
    return std::nullopt;
  return flight;
}

} // namespace billet::process
