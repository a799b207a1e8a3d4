#include "geometry/triangles/segment_pair.h"

#include "geometry/base/angle.h"

#include <algorithm>

namespace billet::geometry {

namespace {

double distance(const Segment& s, const Vec2& x) {
  const Vec2 along = s.to - s.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((x - s.from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (s.from + t * along - x).norm();
}

/// How far the shorter part of `other` reaches beyond the line of `line`; 0: it stays on one side.
double beyond(const Segment& line, const Segment& other) {
  const Vec2 along = (line.to - line.from).stableNormalized();
  const double p = cross(along, other.from - line.from), q = cross(along, other.to - line.from);
  return p * q < 0.0 ? std::min(std::abs(p), std::abs(q)) : 0.0;
}

} // namespace

double distance(const Segment& a, const Segment& b) {
  if (cut_depth(a, b) > 0.0)
    return 0.0;
  return std::min({distance(a, b.from), distance(a, b.to), distance(b, a.from), distance(b, a.to)});
}

double cut_depth(const Segment& a, const Segment& b) {
  return std::min(beyond(a, b), beyond(b, a));
}

Vec2 crossing(const Segment& a, const Segment& b) {
  const Vec2 u = a.to - a.from, v = b.to - b.from;
  return a.from + cross(b.from - a.from, v) / cross(u, v) * u;
}

} // namespace billet::geometry
