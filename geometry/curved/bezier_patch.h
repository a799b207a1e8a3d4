// A curved piece of a boundary in Bezier form: it lies in the hull of its control points.
//
// Isoparametric faces of degree one and two, lines, quadrilaterals and triangles, are such pieces
// exactly, so what holds for every control point and is preserved by averaging holds for the whole
// face.
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.24).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/motion.h"

#include <array>
#include <cstddef>
#include <span>

namespace billet::geometry {

/// Curve of degree 2 (3 control points), triangle of degree 2 (6) or patch of degree 2 in both
/// directions (9).
class BezierPatch {
public:
  /// The piece that passes through points at the parameters -1, 0 and 1; of a triangle, through its
  /// corners and the points at the middle of its edges' parameters.
  ///
  /// @param at  shape (3), (9) or (6), the first parameter running fastest; the 6 of a triangle are
  ///            rows of 3, 2 and 1 [mm]
  explicit BezierPatch(std::span<const Vec3> at);

  [[nodiscard]] std::span<const Vec3> control() const { return std::span(control_).first(size_); }
  /// The point at the parameters 0, of a triangle at equal barycentric coordinates [mm].
  [[nodiscard]] Vec3 centre() const;
  /// No point of the piece is farther from `from` than this [mm]. (G.24)
  [[nodiscard]] double farthest(const Vec3& from) const;
  /// The end or corner of the piece that is farthest from `from` [mm].
  [[nodiscard]] Vec3 farthest_corner(const Vec3& from) const;
  /// The two halves, cut across the direction in which the piece is longer, of a triangle from the
  /// middle of its longest edge to the corner opposite.
  [[nodiscard]] std::array<BezierPatch, 2> halves() const;
  /// The same piece seen from a tool's frame.
  [[nodiscard]] BezierPatch in_tool(const Pose& pose) const;

private:
  BezierPatch() = default;
  /// Length of the control polygons along a direction, the longest of them.
  [[nodiscard]] double length(std::size_t direction) const;
  [[nodiscard]] bool triangle() const;
  [[nodiscard]] std::array<BezierPatch, 2> triangle_halves() const;

  std::array<Vec3, 9> control_;
  std::size_t size_ = 0;
};

} // namespace billet::geometry
