// What a triangle can tell of the rest of its surface, so that a point close above it needs no
// search.
//
// Around a triangle the other triangles rise no steeper out of its plane than some slope, and
// whatever does is some distance away. A point that projects well inside the triangle and is near
// enough cannot be nearer to anything else. (G.34) Internal to geometry/.
//
// Units   lengths in mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>

namespace billet::geometry {

/// One word, so that threads can store and load it as a whole.
struct alignas(8) Surroundings {
  /// Largest height of points of other triangles over or under the plane of this one, as a multiple
  /// of how far they lie outside of it [-]; infinite: nothing is known
  float slope;
  /// The slope holds for points nearer to the triangle than this [mm]
  float radius;
};

/// Gathers the surroundings of one triangle from the others, one by one.
class SurroundingsOf {
public:
  SurroundingsOf(const TriangleMesh& mesh, std::int32_t triangle);

  /// The ball that holds every triangle that counts.
  [[nodiscard]] const Vec3& middle() const { return middle_; }
  [[nodiscard]] double radius() const { return radius_; }

  void add(std::int32_t other);
  [[nodiscard]] Surroundings result() const;

private:
  /// A direction in the plane away from the triangle. [-]
  struct Way {
    Vec3 direction;
    std::array<bool, 3> farthest; ///< which corners lie farthest along it
    double reach;                 ///< of those along the direction, from the middle [mm]
  };
  /// Another triangle's corners, from the middle of this one.
  struct Other {
    std::array<Vec3, 3> corners;
    std::array<double, 3> heights; ///< above the plane [mm]
    std::array<int, 3> shared;     ///< which corner of this one it is; -1: none
  };

  [[nodiscard]] Other other(std::int32_t triangle) const;
  [[nodiscard]] static double slope(const Other& other, const Way& way);
  [[nodiscard]] double distance(const Other& other) const;

  const TriangleMesh& mesh_;
  std::array<std::int32_t, 3> corners_;
  std::int32_t triangle_;
  Vec3 normal_;
  std::array<Way, 6> ways_; ///< across the sides and past the corners
  Vec3 middle_;
  double radius_;
  double slope_ = 0.0;
  double clear_; ///< what is steeper is farther away than this [mm]
};

/// Whether nothing else of the surface is nearer to a point than its foot on the triangle, or as
/// near but for `margin`.
///
/// @param distance  of the point from the plane of the triangle [mm]
/// @param inside    of its foot from the nearest edge [mm]; < 0: outside of the triangle
[[nodiscard]] bool
is_nearest(const Surroundings& around, double distance, double inside, double margin);

} // namespace billet::geometry
