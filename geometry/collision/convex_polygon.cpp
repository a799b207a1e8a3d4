#include "geometry/collision/convex_polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace billet::geometry {

ConvexPolygon::ConvexPolygon(std::span<const Vec3> corners) {
  for (const Vec3& corner : corners)
    add(corner);
}

// Of a line only the first pass of the loop looks at an edge: there is no way back from its end.
void ConvexPolygon::cut(const Vec3& point, const Vec3& inward) {
  std::array<double, most_corners> inside; // distances, as long as `inward` is
  bool all = true, none = true;
  for (std::size_t i = 0; i < n_; ++i) {
    inside[i] = (corners_[i] - point).dot(inward);
    all = all && inside[i] >= 0.0;
    none = none && inside[i] < 0.0;
  }
  if (all)
    return;
  const std::size_t n = std::exchange(n_, 0);
  if (none)
    return;
  std::array<Vec3, most_corners> whole;
  std::copy_n(corners_.begin(), n, whole.begin());
  const bool line = n == 2;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = i + 1 < n ? i + 1 : 0;
    if (inside[i] >= 0.0)
      add(whole[i]);
    if (line && i == 1)
      break;
    if ((inside[i] > 0.0 && inside[next] < 0.0) || (inside[i] < 0.0 && inside[next] > 0.0))
      add(whole[i] + inside[i] / (inside[i] - inside[next]) * (whole[next] - whole[i]));
  }
}

void ConvexPolygon::cut(const Box& box) {
  for (int d = 0; d < 3; ++d) {
    if (std::isfinite(box.low[d]))
      cut(box.low[d] * Vec3::Unit(d), Vec3::Unit(d));
    if (std::isfinite(box.high[d]))
      cut(box.high[d] * Vec3::Unit(d), -Vec3::Unit(d));
  }
}

Vec3 ConvexPolygon::area_vector() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < n_; ++i)
    sum += (corners_[i - 1] - corners_[0]).cross(corners_[i] - corners_[0]);
  return 0.5 * sum;
}

Vec3 ConvexPolygon::middle() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : corners())
    sum += corner;
  return sum / static_cast<double>(n_);
}

std::pair<Vec3, Vec3> ConvexPolygon::farthest_corners() const {
  std::pair<std::size_t, std::size_t> ends{0, 0};
  double most = 0.0;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = i + 1; j < n_; ++j)
      if (const double d2 = (corners_[j] - corners_[i]).squaredNorm(); d2 > most) {
        most = d2;
        ends = {i, j};
      }
  return {corners_[ends.first], corners_[ends.second]};
}

} // namespace billet::geometry
