#include "geometry/triangles/triangle_surroundings.h"

#include "geometry/base/limits.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::geometry {

namespace {

constexpr double steep = 1.0;        // what rises more is kept away from, if it does not touch
constexpr double slenderest = 1e3;   // longest side over height: beyond, directions are uncertain
constexpr double wider = 1.0 + 1e-6; // for rounding to single precision

bool slender(const TriangleShape& shape) { return shape.longest > slenderest * shape.height; }

} // namespace

SurroundingsOf::SurroundingsOf(const TriangleMesh& mesh, std::int32_t triangle)
    : mesh_(mesh), corners_(mesh.triangles[static_cast<std::size_t>(triangle)]),
      triangle_(triangle), normal_(doubled_area(mesh, corners_).stableNormalized()),
      middle_((corner(mesh, corners_, 0) + corner(mesh, corners_, 1) + corner(mesh, corners_, 2)) /
              3.0) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const Vec3 side = corner(mesh, corners_, next) - corner(mesh, corners_, i);
    ways_[i] = {side.cross(normal_).stableNormalized(), {}, 0.0};
    ways_[i].farthest[i] = ways_[i].farthest[next] = true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    ways_[3 + i] = {
        (ways_[i].direction + ways_[(i + 2) % 3].direction).stableNormalized(), {}, 0.0};
    ways_[3 + i].farthest[i] = true;
  }
  for (Way& way : ways_)
    for (std::size_t k = 0; k < 3; ++k)
      if (way.farthest[k])
        way.reach = std::max(way.reach, way.direction.dot(corner(mesh, corners_, k) - middle_));
  const TriangleShape shape = shape_of(mesh, corners_);
  clear_ = shape.longest;
  radius_ = 2.0 * shape.longest; // no corner is as far from the middle as the longest side is long
  if (slender(shape))
    slope_ = infinity;
}

SurroundingsOf::Other SurroundingsOf::other(std::int32_t triangle) const {
  const std::array<std::int32_t, 3>& corners = mesh_.triangles[static_cast<std::size_t>(triangle)];
  Other other{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = std::find(corners_.begin(), corners_.end(), corners[k]);
    other.shared[k] = found == corners_.end() ? -1 : static_cast<int>(found - corners_.begin());
    other.corners[k] = corner(mesh_, corners, k) - middle_;
    other.heights[k] = other.corners[k].dot(normal_);
  }
  return other;
}

// Height above the triangle and distance outside of it are linear over the other one, so that their
// ratio is largest at a corner, if all corners lie outside.
double SurroundingsOf::slope(const Other& other, const Way& way) {
  double slope = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (other.shared[k] >= 0 && !way.farthest[static_cast<std::size_t>(other.shared[k])])
      return infinity;
    if (other.shared[k] >= 0)
      continue; // in the plane, at no distance
    const double beside = way.direction.dot(other.corners[k]) - way.reach;
    if (beside <= 0.0)
      return infinity;
    slope = std::max(slope, std::abs(other.heights[k]) / beside);
  }
  return slope;
}

// A lower bound of the distance to the other triangle: outside of this one, or above or below it.
double SurroundingsOf::distance(const Other& other) const {
  const auto [low, high] = std::minmax_element(other.heights.begin(), other.heights.end());
  double distance = std::max({0.0, *low, -*high});
  for (const Way& way : ways_) {
    double beside = infinity;
    for (const Vec3& corner : other.corners)
      beside = std::min(beside, way.direction.dot(corner) - way.reach);
    distance = std::max(distance, beside);
  }
  return distance;
}

void SurroundingsOf::add(std::int32_t triangle) {
  if (triangle == triangle_ || slope_ == infinity)
    return;
  const Other other = this->other(triangle);
  double least = infinity;
  for (const Way& way : ways_)
    least = std::min(least, slope(other, way));
  const auto is_shared = [](int corner) { return corner >= 0; };
  const bool touches = std::any_of(other.shared.begin(), other.shared.end(), is_shared);
  if (slender(shape_of(mesh_, mesh_.triangles[static_cast<std::size_t>(triangle)])))
    slope_ = infinity;
  else if (touches || least <= steep)
    slope_ = std::max(slope_, least);
  else
    clear_ = std::min(clear_, distance(other));
}

Surroundings SurroundingsOf::result() const {
  return {static_cast<float>(slope_ * wider), static_cast<float>(clear_ / wider)};
}

// A point no farther off the surface than its foot lies within the ball about it that touches the
// plane at the foot; there, the rest of the surface lies below a line that rises from the nearest
// side on.
bool is_nearest(const Surroundings& around, double distance, double inside, double margin) {
  const auto slope = static_cast<double>(around.slope);
  if (inside <= 0.0 || 2.0 * distance + margin >= static_cast<double>(around.radius) ||
      std::isinf(slope))
    return false;
  const double to_rest = distance * slope > inside
                             ? (distance + slope * inside) / std::sqrt(1.0 + slope * slope)
                             : std::sqrt(distance * distance + inside * inside);
  return to_rest > distance + margin;
}

} // namespace billet::geometry
