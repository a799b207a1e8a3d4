// The boundary of a distorted body read as a smooth surface.
//
// Triangles are curved so that they share tangents across all but sharp edges (G.16)-(G.20); flat
// ones stay flat, to the bit, and one that would fold when curved stays as it is. Places are found
// on the straight triangles, patch by patch, and lead to points of the curved ones. Internal to
// geometry/. Theory: docs/theory/geometry.md (G.45).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/curved/curved_triangle.h"
#include "geometry/curved/edge_curves.h"
#include "geometry/curved/feature_lines.h"
#include "geometry/curved/solid_boundary.h"
#include "geometry/triangles/box_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// A place on a line that stays.
struct LinePlace {
  std::int32_t line;
  std::int32_t piece;
  double t; ///< from 0 where the piece begins to 1 at its end [-]
};

class BoundarySurface {
public:
  /// @param short_crease  as for `feature_lines` [mm]
  /// @pre the boundary is closed, manifold and free of degenerate triangles; it outlives the object
  BoundarySurface(const SolidBoundary& boundary, double short_crease);

  [[nodiscard]] const SolidBoundary& boundary() const { return *boundary_; }
  [[nodiscard]] const FeatureLines& lines() const { return lines_; }
  [[nodiscard]] const CornerNormals& normals() const { return normals_; }

  /// The place of a patch whose straight triangle is nearest to x; of equals the first one.
  [[nodiscard]] SurfacePlace place(std::int32_t patch, const Vec3& x) const;
  /// The same on the straight pieces of a line.
  [[nodiscard]] LinePlace place_on_line(std::int32_t line, const Vec3& x) const;
  /// The same place on the triangle that the piece is a side of.
  [[nodiscard]] SurfacePlace on_triangle(const LinePlace& at) const;

  /// Point of the curved surface. [mm]
  [[nodiscard]] Vec3 point(const SurfacePlace& at) const;
  [[nodiscard]] Vec3 point(const LinePlace& at) const;
  /// Point of the straight triangle. [mm]
  [[nodiscard]] Vec3 flat_point(const SurfacePlace& at) const;

  /// Largest angle between normals at the corners of a triangle over the length between them
  /// [rad/mm].
  [[nodiscard]] double curvature(std::int32_t triangle) const;

private:
  [[nodiscard]] const LinePiece& piece(const LinePlace& at) const;
  [[nodiscard]] bool is_curved(std::size_t t) const;
  [[nodiscard]] const EdgeCurve& curve(std::int32_t triangle, std::int32_t side) const;

  const SolidBoundary* boundary_;
  CornerNormals normals_;
  EdgeCurves edges_;
  FeatureLines lines_;
  std::vector<CurvedTriangle> curved_;
  std::vector<char> is_curved_;
  std::vector<std::vector<std::int32_t>> members_; ///< triangles of each patch
  std::vector<BoxTree> trees_;                     ///< of each patch
};

} // namespace billet::geometry
