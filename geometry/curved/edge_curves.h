// Cubic curves over the edges of a triangulation, shared by the triangles on both sides.
//
// A curve leaves each end within the tangent plane there; along a sharp edge, within the tangent
// planes of both sides. Internal to geometry/.
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.17), (G.18).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/corner_normals.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// Position on a curve and its derivatives by the parameter.
struct CurvePoint {
  Vec3 position; ///< [mm]
  Vec3 d;        ///< [mm]
  Vec3 dd;       ///< [mm]
};

enum class EdgeKind { smooth, sharp, border };

/// A cubic in Bernstein form over an edge from `a` to `b`, t from 0 to 1.
struct EdgeCurve {
  std::array<Vec3, 4> control;           ///< [mm]
  std::array<Vec3, 2> normals;           ///< at the ends, of a smooth edge or of a border, unit
  EdgeKind kind;                         ///< smooth: both sides share the tangent plane
  bool straight;                         ///< the curve is the edge
  std::array<std::int32_t, 2> ends;      ///< vertices a and b
  std::array<std::int32_t, 2> triangles; ///< on either side; second -1: border

  [[nodiscard]] CurvePoint at(double t) const;
};

/// The point of a curve nearest to a query.
struct ClosestOnCurve {
  double t;         ///< 0 <= t <= 1
  double distance2; ///< [mm^2]
};

[[nodiscard]] ClosestOnCurve closest_on(const EdgeCurve& curve, const Vec3& x);

/// Curves in the order of `edge_uses(mesh)`, from the smaller point number to the larger.
struct EdgeCurves {
  std::vector<EdgeCurve> curves;
  std::vector<std::array<std::int32_t, 3>> of_triangle; ///< side i: from corner i to the next
};

/// @pre normals = corner_normals(mesh, ...)
[[nodiscard]] EdgeCurves edge_curves(const TriangleMesh& mesh, const CornerNormals& normals);

} // namespace billet::geometry
