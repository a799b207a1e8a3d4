#include "geometry/mesh2d/boundary_sides.h"

#include "geometry/base/angle.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/triangles/box_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace billet::geometry {

namespace {

/// Steps of the integral of 1 / size, per edge.
constexpr double steps_per_side = 4.0;

/// Rounding of the number of edges.
constexpr double rounding_of_counts = 1e-6;

/// Most of them between two kept corners; such a domain has too many triangles.
constexpr double most_sides = 1e6;

/// Least number of edges of a loop.
constexpr double least_sides = 3.0;

/// A corner with a smaller angle is a tip: both its edges get the same length, 60 degrees.
constexpr double tip_angle = std::numbers::pi / 3.0;

/// An edge at a tip takes no more of the way to the next kept corner.
constexpr double most_of_span = 0.4;

/// How many edges fit up to a place.
struct Count {
  double s, sides;
};

/// The integral of 1 / size along a span, by the trapezoidal rule in steps of a fraction of it.
std::vector<Count> count_along(const BoundaryCurve& curve,
                               double from,
                               double to,
                               const std::function<double(const Vec2&)>& size) {
  std::vector<Count> result{{from, 0.0}};
  double here = size(curve.point(from));
  while (result.back().s < to) {
    const double s = std::min(to, result.back().s + here / steps_per_side);
    const double next = size(curve.point(s));
    const double more = 0.5 * (s - result.back().s) * (1.0 / here + 1.0 / next);
    result.push_back({s, result.back().sides + more});
    here = next;
    if (result.back().sides > most_sides)
      throw Error(Fault::limit, "",
                  fmt::format("the boundary would have more than {:.0e} sides", most_sides),
                  "give larger sizes");
  }
  return result;
}

void spread(const BoundaryCurve& curve,
            CurveSide span,
            double least,
            const std::function<double(const Vec2&)>& size,
            std::vector<CurveSide>& sides) {
  const std::vector<Count> count = count_along(curve, span.from, span.to, size);
  const double n = std::max(least, std::ceil(count.back().sides - rounding_of_counts));
  double from = span.from;
  std::size_t k = 1;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(n); ++i) {
    const double share = static_cast<double>(i) / n;
    const double wanted = count.back().sides * share;
    while (k + 1 < count.size() && count[k].sides < wanted)
      ++k;
    const Count &a = count[k - 1], &b = count[k];
    const double to =
        share == 1.0 ? span.to : a.s + (b.s - a.s) * (wanted - a.sides) / (b.sides - a.sides);
    sides.push_back({span.loop, from, to});
    from = to;
  }
}

/// Of each kept corner: length of the edges next to it, where it is a tip; otherwise 0. (G.42)
std::vector<double> tip_lengths(const BoundaryCurve& curve,
                                const std::function<double(const Vec2&)>& size,
                                double min) {
  const std::vector<double>& kept = curve.kept();
  std::vector<double> result(kept.size(), 0.0);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const double angle = std::numbers::pi - curve.turn_at(k);
    if (!(angle < tip_angle))
      continue;
    const double before = k > 0 ? kept[k] - kept[k - 1] : curve.length() - kept.back();
    const double after = (k + 1 < kept.size() ? kept[k + 1] : curve.length()) - kept[k];
    const double wanted = std::max(size(curve.point(kept[k])), min / (2.0 * std::sin(0.5 * angle)));
    result[k] = std::min(wanted, most_of_span * std::min(before, after));
  }
  return result;
}

/// The triangle that holds the parabola of an edge: its ends and where its end tangents meet.
struct Hull {
  Vec2 a, apex, b;
};

Hull hull(const BoundaryCurve& curve, const CurveSide& side) {
  const Vec2 a = curve.point(side.from), b = curve.point(side.to);
  return {a, 2.0 * curve.point(side.middle()) - 0.5 * (a + b), b};
}

bool within(double t) { return t >= 0.0 && t <= 1.0; }

/// Whether segments have a point in common.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 u = b - a, v = d - c, w = c - a;
  const double det = cross(u, v);
  if (det != 0.0)
    return within(cross(w, v) / det) && within(cross(w, u) / det);
  if (cross(u, w) != 0.0 || cross(v, w) != 0.0)
    return false;
  const double s = w.dot(u) / u.squaredNorm(), t = (d - a).dot(u) / u.squaredNorm();
  return within(s) || within(t) || s * t < 0.0;
}

bool holds(const Hull& hull, const Vec2& x) {
  const double p = cross(hull.apex - hull.a, x - hull.a);
  const double q = cross(hull.b - hull.apex, x - hull.apex);
  const double r = cross(hull.a - hull.b, x - hull.b);
  return (p > 0.0 && q > 0.0 && r > 0.0) || (p < 0.0 && q < 0.0 && r < 0.0);
}

using Segments = std::array<std::array<Vec2, 2>, 3>;

/// Of hulls without a common corner.
bool hulls_overlap(const Hull& h, const Hull& k) {
  const Segments first{{{h.a, h.apex}, {h.apex, h.b}, {h.a, h.b}}};
  const Segments second{{{k.a, k.apex}, {k.apex, k.b}, {k.a, k.b}}};
  for (const auto& [a, b] : first)
    for (const auto& [c, d] : second)
      if (meet(a, b, c, d))
        return true;
  return holds(h, k.a) || holds(k, h.a);
}

/// Whether direction x lies between u and v, which are less than half a turn apart.
bool between(const Vec2& u, const Vec2& v, const Vec2& x) {
  const double sense = cross(u, v) >= 0.0 ? 1.0 : -1.0;
  return sense * cross(u, x) >= 0.0 && sense * cross(x, v) >= 0.0 && x.dot(u + v) > 0.0;
}

/// Of hulls with h.b == k.a.
bool overlap_beyond_corner(const Hull& h, const Hull& k) {
  const Vec2 ha = h.a - h.b, hp = h.apex - h.b, kb = k.b - k.a, kp = k.apex - k.a;
  if (between(ha, hp, kb) || between(ha, hp, kp) || between(kb, kp, ha) || between(kb, kp, hp))
    return true;
  return meet(h.a, h.apex, k.a, k.apex) || meet(h.a, h.apex, k.a, k.b) ||
         meet(h.a, h.apex, k.apex, k.b) || meet(h.apex, h.b, k.apex, k.b) ||
         meet(h.a, h.b, k.apex, k.b);
}

Box box(const Hull& hull) {
  Box result;
  for (const Vec2& x : {hull.a, hull.apex, hull.b})
    result.add({x.x(), x.y(), 0.0});
  return result;
}

/// Sets the flags of edges whose hulls overlap.
bool flag_overlaps(const std::vector<Hull>& hulls, std::vector<char>& flags) {
  std::vector<Box> boxes(hulls.size());
  std::transform(hulls.begin(), hulls.end(), boxes.begin(), box);
  bool any = false;
  visit_box_pairs(boxes, [&](std::int32_t i, std::int32_t j) {
    const Hull &h = hulls[static_cast<std::size_t>(i)], &k = hulls[static_cast<std::size_t>(j)];
    const bool before = h.b == k.a, after = k.b == h.a;
    const bool wrong = before || after ? (before && overlap_beyond_corner(h, k)) ||
                                             (after && overlap_beyond_corner(k, h))
                                       : hulls_overlap(h, k);
    if (wrong)
      flags[static_cast<std::size_t>(i)] = flags[static_cast<std::size_t>(j)] = 1;
    any = any || wrong;
    return true;
  });
  return any;
}

} // namespace

std::vector<CurveSide> spread_sides(std::span<const BoundaryCurve> curves,
                                    const std::function<double(const Vec2&)>& size,
                                    double min) {
  std::vector<CurveSide> sides;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto loop = static_cast<std::int32_t>(i);
    const std::vector<double> tips = tip_lengths(curves[i], size, min);
    std::vector<double> ends = curves[i].kept();
    if (ends.empty())
      ends.push_back(0.0);
    const double least = std::ceil(least_sides / static_cast<double>(ends.size()));
    ends.push_back(curves[i].length());
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      CurveSide span{loop, ends[k], ends[k + 1]};
      if (!tips.empty() && tips[k] > 0.0) {
        span.from = curves[i].place_at(ends[k], tips[k], 1.0);
        sides.push_back({loop, ends[k], span.from});
      }
      const double tip = tips.empty() ? 0.0 : tips[(k + 1) % tips.size()];
      if (tip > 0.0)
        span.to = curves[i].place_at(ends[k + 1], tip, -1.0);
      spread(curves[i], span, least, size, sides);
      if (tip > 0.0)
        sides.push_back({loop, span.to, ends[k + 1]});
    }
  }
  return sides;
}

std::vector<CurveSide> halved(const std::vector<CurveSide>& sides, const std::vector<char>& flags) {
  std::vector<CurveSide> result;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (flags[i] == 0) {
      result.push_back(sides[i]);
      continue;
    }
    result.push_back({sides[i].loop, sides[i].from, sides[i].middle()});
    result.push_back({sides[i].loop, sides[i].middle(), sides[i].to});
  }
  return result;
}

void separate(std::span<const BoundaryCurve> curves,
              std::vector<CurveSide>& sides,
              double shortest) {
  while (true) {
    std::vector<Hull> hulls;
    hulls.reserve(sides.size());
    for (const CurveSide& side : sides)
      hulls.push_back(hull(curves[static_cast<std::size_t>(side.loop)], side));
    std::vector<char> flags(sides.size(), 0);
    if (!flag_overlaps(hulls, flags))
      return;
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (flags[i] != 0 && sides[i].to - sides[i].from < 2.0 * shortest)
        throw Error(Fault::geometry, "",
                    fmt::format("the boundary of the domain touches itself near ({:.6g}, {:.6g})",
                                hulls[i].a.x(), hulls[i].a.y()));
    sides = halved(sides, flags);
  }
}

} // namespace billet::geometry
