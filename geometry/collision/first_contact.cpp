#include "geometry/collision/first_contact.h"

#include "geometry/base/box.h"
#include "geometry/base/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

namespace billet::geometry {

namespace {

constexpr double contact_gap = 1e-12; // share of the size at which a gap counts as closed
constexpr double near_gap = 1e-6;     // share of the size below which the root is bracketed
constexpr int most_steps_to_touch =
    100000; // grazing contact: each step closes a small part of the gap
constexpr int most_secants = 200;
constexpr double facet_gap = 1e-9; // share of the size at which facets touch
constexpr int most_retreats = 60;  // of doubled length

// The smallest gap over the points as a function of the tool's offset. The gap is 1-Lipschitz: a
// point whose gap cannot have come down to the smallest one since it was asked is not asked again.
class PointApproach {
public:
  PointApproach(const RigidSurface& surface,
                const Pose& start,
                const Vec3& direction,
                std::span<const Vec3> points,
                double reach)
      : surface_(surface), way_(start.rotation.transpose() * direction), reach_(reach) {
    for (const Vec3& x : points)
      points_.emplace_back().position = start.to_tool(x);
  }

  /// Smallest gap [mm]; +inf if no point is within reach of the tool.
  double operator()(double s) {
    least_ = infinity;
    // The likeliest point first: its gap spares most of the others.
    const auto first =
        std::min_element(points_.begin(), points_.end(), [s](const Point& p, const Point& q) {
          return p.at_least(s) < q.at_least(s);
        });
    if (first != points_.end())
      ask(*first, s);
    for (Point& point : points_)
      if (point.asked_at != s && point.at_least(s) <= least_)
        ask(point, s);
    return least_;
  }

  /// How fast the smallest gap last found closes: - d gap / d s [-].
  [[nodiscard]] double closing() const { return closing_; }

private:
  struct Point {
    Vec3 position;              // tool frame at s = 0
    double gap;                 // when last asked
    double asked_at = infinity; // never
    std::int32_t patch = -1;

    [[nodiscard]] double at_least(double s) const {
      return gap == infinity ? -infinity : gap - std::abs(s - asked_at);
    }
  };

  void ask(Point& point, double s) {
    const Vec3 x = point.position - s * way_;
    Projection p;
    p.patch = point.patch;
    surface_.project({&x, 1}, reach_, {&p, 1});
    // Not found: farther than the reach, or behind the rim of an open surface.
    point.gap = p.found() ? p.gap : infinity;
    point.asked_at = s;
    point.patch = p.patch;
    if (point.gap >= least_)
      return;
    least_ = point.gap;
    closing_ = -p.normal.dot(way_);
  }

  const RigidSurface& surface_;
  Vec3 way_;
  double reach_;
  std::vector<Point> points_;
  double least_ = infinity;
  double closing_ = 0.0;
};

// The length that rounding and tolerances are shares of.
double scene_size(const RigidSurface& surface, const Pose& start, std::span<const Vec3> points) {
  Box box;
  double largest = 0.0;
  for (const Vec3& x : points) {
    box.add(x);
    largest = std::max(largest, start.to_tool(x).cwiseAbs().maxCoeff());
  }
  const double tool = surface.bounds().size();
  return std::max({box.size(), largest, std::isfinite(tool) ? tool : 0.0});
}

// An offset and the smallest gap there.
struct State {
  double s;
  double gap;
};

// The zero between `clear` (gap >= 0) and `inside` (gap < 0), by the Illinois variant of the
// rule of false position; the end with gap >= 0 is returned.
Outcome<double> root(PointApproach& approach, State clear, State inside, double tolerance) {
  double weight_clear = 1.0, weight_inside = 1.0;
  for (int i = 0; i < most_secants && clear.gap > tolerance; ++i) {
    const double a = weight_clear * clear.gap, b = weight_inside * inside.gap;
    const double s = (clear.s * b - inside.s * a) / (b - a);
    if (s == clear.s || s == inside.s)
      break;
    const State next{s, approach(s)};
    if (next.gap >= 0.0) {
      clear = next;
      weight_clear = 1.0;
      weight_inside *= 0.5;
    } else {
      if (-next.gap <= tolerance)
        return s;
      inside = next;
      weight_inside = 1.0;
      weight_clear *= 0.5;
    }
  }
  if (clear.gap > tolerance)
    return Failure{fmt::format("the gap jumps from {:g} to {:g}: the tool meets the workpiece from "
                               "behind the rim of an open surface",
                               clear.gap, inside.gap)};
  return clear.s;
}

} // namespace

Outcome<double> distance_to_contact(const RigidSurface& surface,
                                    const Pose& start,
                                    const Vec3& direction,
                                    std::span<const Vec3> points,
                                    double reach) {
  assert(reach > 0.0);
  const double size = scene_size(surface, start, points), tolerance = contact_gap * size;
  PointApproach approach(surface, start, direction, points, reach);
  State now{0.0, approach(0.0)};
  // The sign of the gap at the start: forwards until it closes, or backwards until it opens.
  const double side = now.gap >= 0.0 ? 1.0 : -1.0;
  const auto done = [&](const State& state) { return side * state.gap <= tolerance; };
  for (int step = 0; step < most_steps_to_touch; ++step) {
    if (now.gap == infinity)
      return Failure{fmt::format("no point of the workpiece within {:g} of the tool", reach)};
    if (std::abs(now.gap) <= tolerance)
      return now.s;
    if (done(now))
      return Failure{"the tool meets the workpiece from behind the rim of an open surface"};
    if (std::abs(now.s) > reach)
      return Failure{
          side > 0.0 ? fmt::format("the tool touches nothing within {:g}", reach)
                     : fmt::format("the tool is not clear of the workpiece within {:g}", reach)};
    const double jump = now.gap / approach.closing(); // where the gap would close if it were linear
    if (approach.closing() > 0.0 && std::abs(jump) <= near_gap * size) {
      const State ahead{now.s + jump, approach(now.s + jump)};
      if (std::abs(ahead.gap) <= tolerance)
        return ahead.s;
      if (done(ahead))
        return side > 0.0 ? root(approach, now, ahead, tolerance)
                          : root(approach, ahead, now, tolerance);
      // Nothing was passed over if the free spheres about both positions overlap.
      if (std::abs(now.gap + ahead.gap) >= std::abs(jump)) {
        now = ahead;
        continue;
      }
    }
    now.s += now.gap;
    now.gap = approach(now.s);
  }
  return Failure{"the tool slides along the workpiece without closing the gap"};
}

namespace {

// The facets of a tool on its way towards those of the workpiece.
class FacetApproach {
public:
  FacetApproach(const PlacedBody& tool,
                const Vec3& direction,
                const PlacedBody& workpiece,
                double tolerance)
      : tool_(tool), direction_(direction), workpiece_(workpiece), tolerance_(tolerance) {}

  [[nodiscard]] bool open(double s) const { return gap(s) > closed_gap(); }
  [[nodiscard]] double gap(double s) const { return clearance(at(s), workpiece_); }
  [[nodiscard]] bool cuts(double s) const { return depth(s) > tolerance_; }

  /// Backwards from s to where nothing cuts.
  [[nodiscard]] double retreat(double s) const {
    double back = 0.0;
    for (int i = 0; i < most_retreats; ++i) {
      const double deep = depth(s);
      if (deep <= tolerance_)
        break;
      back = std::max(2.0 * back, deep);
      s -= back;
    }
    // A slender tip is out of a face a little further back.
    return !open(s) && open(s - margin()) ? s - margin() : s;
  }

  /// Where facets that cut at `cutting` closed: if that was long ago they glided along each other,
  /// and what counts is where the cut gets as deep as the tolerance.
  [[nodiscard]] double closing(double last_open, double clear, double cutting) const {
    for (int i = 0; i < most_steps_to_touch && last_open < cutting && open(last_open); ++i)
      last_open += gap(last_open);
    if (cutting - last_open <= margin())
      return std::min(last_open, cutting);
    for (int i = 0; i < most_secants && cutting - clear > tolerance_; ++i) {
      const double middle = 0.5 * (clear + cutting);
      (cuts(middle) ? cutting : clear) = middle;
    }
    return cutting - last_open <= margin() ? last_open : clear;
  }

private:
  // The depth of a pair of facets is the way out sideways too: that of a slender tip is a small
  // part of how far it has come in.
  [[nodiscard]] double margin() const { return 100.0 * tolerance_; }
  [[nodiscard]] double closed_gap() const { return facet_gap * tool_.body.size(); }
  [[nodiscard]] PlacedBody at(double s) const {
    return {tool_.body, {tool_.pose.rotation, tool_.pose.translation + s * direction_}};
  }
  [[nodiscard]] double depth(double s) const {
    return deepest_cut(at(s), workpiece_).value_or(Cut{}).depth;
  }

  const PlacedBody& tool_;
  const Vec3& direction_;
  const PlacedBody& workpiece_;
  double tolerance_;
};

} // namespace

double facet_contact(const PlacedBody& tool,
                     const Vec3& direction,
                     const PlacedBody& workpiece,
                     double latest,
                     double tolerance) {
  const FacetApproach approach(tool, direction, workpiece, tolerance);
  double s = approach.retreat(std::min(0.0, latest)), last_open = s;
  // What is closed may be a tip about to enter or a wall to glide along: short steps first.
  double shortest = tolerance;
  for (int i = 0; i < most_steps_to_touch && s < latest; ++i) {
    const double gap = approach.gap(s);
    shortest = gap > tolerance ? tolerance : 2.0 * shortest;
    if (approach.open(s))
      last_open = s;
    const double next = std::min(s + std::max(gap, shortest), latest);
    if (approach.cuts(next))
      return approach.closing(last_open, s, next);
    s = next;
  }
  return latest;
}

} // namespace billet::geometry
