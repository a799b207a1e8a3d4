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

// A direction is trusted if its triangle is not flatter than this; then its components are right to
// `blur`, and what differs by more than `clear` (relative) differs indeed.
constexpr double flattest = 1e-4;
constexpr double blur = 1e-11;
constexpr double clear = 1e-10;

// Normals nearer to antiparallel than this face opposite ways.
constexpr double opposite = -0.99;

Kernel::Point_3 exact(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Kernel::Triangle_3 exact(const std::array<Vec3, 3>& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

Vec3 side(const std::array<Vec3, 3>& t, std::size_t i) { return t[(i + 1) % 3] - t[i]; }

bool trusted(const std::array<Vec3, 3>& t, const Vec3& normal) {
  double longest2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    longest2 = std::max(longest2, side(t, i).squaredNorm());
  return normal.norm() > flattest * longest2;
}

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
  return !(shared_ == 2 ? clearly_folded() : clearly_apart()) && meet_exactly();
}

bool TrianglePair::clearly_apart() const {
  for (const auto& [t, normal] : {std::pair(&a_, &normal_a_), std::pair(&b_, &normal_b_)}) {
    if (!trusted(*t, *normal))
      continue;
    if (parted_by(*normal))
      return true;
    for (std::size_t i = 0; i < 3; ++i)
      if (parted_by(normal->cross(side(*t, i))))
        return true;
  }
  return false;
}

bool TrianglePair::parted_by(const Vec3& direction) const {
  if (shared_ == 1)
    return parted_at_shared_corner(direction);
  double low_a = 0.0, high_a = 0.0, extent2 = 0.0; // from the first corner
  double low_b = std::numeric_limits<double>::infinity(), high_b = -low_b;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from_a = a_[i] - a_[0], from_b = b_[i] - a_[0];
    const double along_a = from_a.dot(direction), along_b = from_b.dot(direction);
    low_a = std::min(low_a, along_a);
    high_a = std::max(high_a, along_a);
    low_b = std::min(low_b, along_b);
    high_b = std::max(high_b, along_b);
    extent2 = std::max({extent2, from_a.squaredNorm(), from_b.squaredNorm()});
  }
  const double margin = clear * std::sqrt(extent2) * direction.norm();
  return low_b - high_a > margin || low_a - high_b > margin;
}

// Seen from the shared corner each triangle is a cone; a plane through the corner parts them.
bool TrianglePair::parted_at_shared_corner(const Vec3& direction) const {
  const Vec3& corner = a_[at_a_[0]];
  const double length = direction.norm();
  double low_a = 1.0, high_a = -1.0, low_b = 1.0, high_b = -1.0;
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3 to_a = a_[at_a_[k]] - corner, to_b = b_[at_b_[k]] - corner;
    const double a = to_a.dot(direction) / (to_a.norm() * length);
    const double b = to_b.dot(direction) / (to_b.norm() * length);
    low_a = std::min(low_a, a);
    high_a = std::max(high_a, a);
    low_b = std::min(low_b, b);
    high_b = std::max(high_b, b);
  }
  return (high_a <= blur && low_b > clear) || (high_a < -clear && low_b >= -blur) ||
         (low_a >= -blur && high_b < -clear) || (low_a > clear && high_b <= blur);
}

// Triangles with a common side overlap only if they are folded upon each other.
bool TrianglePair::clearly_folded() const {
  const Vec3& corner = a_[at_a_[0]];
  const Vec3 along = (a_[at_a_[1]] - corner).stableNormalized();
  const Vec3 to_a = a_[at_a_[2]] - corner, to_b = b_[at_b_[2]] - corner;
  const Vec3 height_a = to_a - to_a.dot(along) * along, height_b = to_b - to_b.dot(along) * along;
  const double a = height_a.norm(), b = height_b.norm();
  constexpr double fold = 1e-9;
  return a > flattest * to_a.norm() && b > flattest * to_b.norm() &&
         height_a.dot(height_b) < (1.0 - fold) * a * b;
}

bool TrianglePair::meet_exactly() const {
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
      if (across.norm() > clear * side(a_, i).norm() * side(b_, j).norm())
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
