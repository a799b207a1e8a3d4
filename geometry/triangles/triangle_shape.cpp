#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace billet::geometry {

Vec3 doubled_area(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  const Vec3& a = corner(mesh, t, 0);
  return (corner(mesh, t, 1) - a).cross(corner(mesh, t, 2) - a);
}

TriangleShape shape_of(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i)
    length[i] = (corner(mesh, t, (i + 1) % 3) - corner(mesh, t, i)).norm();
  const auto [shortest, longest] = std::minmax_element(length.begin(), length.end());
  return {static_cast<std::size_t>(longest - length.begin()), *longest, *shortest,
          *longest > 0.0 ? doubled_area(mesh, t).norm() / *longest : 0.0};
}

double coordinate_rounding(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vec3& point : mesh.points)
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return 8.0 * std::numeric_limits<double>::epsilon() * largest;
}

} // namespace billet::geometry
