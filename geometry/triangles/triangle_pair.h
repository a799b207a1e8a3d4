// Two triangles: whether they have more in common than shared corners, and how deep they cut.
//
// Internal to geometry/. Corners are shared if their coordinates are equal.
//
// Units   those of the caller (mm).

#pragma once

#include "geometry/base/vector.h"

#include <array>
#include <cstddef>

namespace billet::geometry {

class TrianglePair {
public:
  TrianglePair(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

  /// Exact: CGAL decides. A triangle without area meets only one with the same corners.
  [[nodiscard]] bool meets() const;

  /// How far one would have to move for both to come apart, seen along their normals, in their
  /// planes, and across pairs of sides [mm].
  [[nodiscard]] double depth() const;

  /// Whether they lie in one plane to within `tolerance`, face opposite ways, and cover each other
  /// by more than it.
  [[nodiscard]] bool back_to_back(double tolerance) const;

  /// The middle of what both boxes have in common [mm].
  [[nodiscard]] Vec3 place() const;

private:
  // By how much projections of both on a direction overlap [mm], < 0: apart.
  [[nodiscard]] double overlap(const Vec3& direction) const;

  std::array<Vec3, 3> a_, b_;
  Vec3 normal_a_, normal_b_;                   ///< of twice the length of the areas
  std::array<std::size_t, 3> at_a_{}, at_b_{}; ///< positions of shared corners, then of free ones
  std::size_t shared_ = 0;
};

} // namespace billet::geometry
