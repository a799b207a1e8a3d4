#include "geometry/triangles/triangle_pair.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace billet::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Sides whose directions differ by less (relative) are parallel.
constexpr double parallel = 1e-10;

// Normals nearer to antiparallel than this face opposite ways.
constexpr double opposite = -0.99;

Kernel::Point_3 exact(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Kernel::Triangle_3 exact(const std::array<Vec3, 3>& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

Vec3 side(const std::array<Vec3, 3>& t, std::size_t i) { return t[(i + 1) % 3] - t[i]; }

double spread(const std::array<Vec3, 3>& t, const Vec3& origin, const Vec3& unit) {
  double most = 0.0;
  for (const Vec3& corner : t)
    most = std::max(most, std::abs((corner - origin).dot(unit)));
  return most;
}

} // namespace

TrianglePair::TrianglePair(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b)
    : a_(a), b_(b), normal_a_(side(a, 0).cross(side(a, 1))),
      normal_b_(side(b, 0).cross(side(b, 1))) {
  std::array<bool, 3> taken_a{}, taken_b{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (!taken_a[i] && !taken_b[j] && a[i] == b[j]) {
        taken_a[i] = taken_b[j] = true;
        at_a_[shared_] = i;
        at_b_[shared_] = j;
        ++shared_;
      }
  for (std::size_t i = 0, free_a = shared_, free_b = shared_; i < 3; ++i) {
    if (!taken_a[i])
      at_a_[free_a++] = i;
    if (!taken_b[i])
      at_b_[free_b++] = i;
  }
}

bool TrianglePair::meets() const {
  if (shared_ == 3)
    return true;
  if (exact(a_).is_degenerate() || exact(b_).is_degenerate())
    return false; // without area there is nothing that could cut
  const auto a = [&](std::size_t k) { return exact(a_[at_a_[k]]); };
  const auto b = [&](std::size_t k) { return exact(b_[at_b_[k]]); };
  if (shared_ == 2)
    return CGAL::coplanar(a(0), a(1), a(2), b(2)) &&
           CGAL::coplanar_orientation(a(0), a(1), a(2), b(2)) == CGAL::POSITIVE;
  if (shared_ == 1)
    return CGAL::do_intersect(Kernel::Segment_3(a(1), a(2)), exact(b_)) ||
           CGAL::do_intersect(Kernel::Segment_3(b(1), b(2)), exact(a_));
  return CGAL::do_intersect(exact(a_), exact(b_));
}

double TrianglePair::overlap(const Vec3& direction) const {
  const Vec3 unit = direction.stableNormalized();
  double low_a = 0.0, high_a = 0.0;
  double low_b = std::numeric_limits<double>::infinity(), high_b = -low_b;
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = (a_[i] - a_[0]).dot(unit), b = (b_[i] - a_[0]).dot(unit);
    low_a = std::min(low_a, a);
    high_a = std::max(high_a, a);
    low_b = std::min(low_b, b);
    high_b = std::max(high_b, b);
  }
  return std::min(high_a - low_b, high_b - low_a);
}

double TrianglePair::depth() const {
  double least = std::min(overlap(normal_a_), overlap(normal_b_));
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(
        {least, overlap(normal_a_.cross(side(a_, i))), overlap(normal_b_.cross(side(b_, i)))});
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3 across = side(a_, i).cross(side(b_, j));
      // Parallel sides span no direction of their own.
      if (across.norm() > parallel * side(a_, i).norm() * side(b_, j).norm())
        least = std::min(least, overlap(across));
    }
  }
  return least;
}

bool TrianglePair::back_to_back(double tolerance) const {
  if (normal_a_.dot(normal_b_) > opposite * normal_a_.norm() * normal_b_.norm())
    return false;
  if (std::min(spread(b_, a_[0], normal_a_.stableNormalized()),
               spread(a_, b_[0], normal_b_.stableNormalized())) > tolerance)
    return false;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(
        {least, overlap(normal_a_.cross(side(a_, i))), overlap(normal_b_.cross(side(b_, i)))});
  return least > tolerance;
}

Vec3 TrianglePair::place() const {
  Vec3 low = Vec3::Constant(-std::numeric_limits<double>::infinity()), high = -low;
  for (const std::array<Vec3, 3>* t : {&a_, &b_}) {
    low = low.cwiseMax((*t)[0].cwiseMin((*t)[1]).cwiseMin((*t)[2]));
    high = high.cwiseMin((*t)[0].cwiseMax((*t)[1]).cwiseMax((*t)[2]));
  }
  return 0.5 * (low + high);
}

} // namespace billet::geometry
