// One curved triangle: a cubic through three edge curves, bent so that neighbours share tangents.
//
// Parameters are the barycentric coordinates (1 - v - w, v, w) of the three corners. Two triangles
// over one smooth edge have the same curve and the same normals there (G1). Internal to geometry/.
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.19)-(G.22).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"
#include "geometry/curved/edge_curves.h"
#include "geometry/curved/taylor.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <optional>

namespace billet::geometry {

/// Point of a curved triangle and the derivatives of its position. [mm]
struct SurfacePoint {
  Vec3 position, v, w, vv, vw, ww;

  [[nodiscard]] Vec3 normal() const; ///< unit, out of the tool
};

/// Derivative of the unit normal by the query point at signed distance `gap`. (G.22)
///
/// @return empty if the point lies at or beyond the centre of curvature
[[nodiscard]] std::optional<Mat3> normal_slope(const SurfacePoint& at, double gap);

/// The four straight triangles between the corners and the middles of the sides of a curved one.
struct Quarters {
  std::array<Vec3, 6> points;  ///< corners, then the middles of the sides from corner 0, 1, 2 [mm]
  std::array<double, 4> rises; ///< no point of that part is farther from it [mm]

  /// A bound from below of the square of the distance of x to the curved triangle. [mm^2] (G.50)
  [[nodiscard]] double least_distance2(const Vec3& x) const;
};

class CurvedTriangle {
public:
  /// A side as its triangle runs through it.
  struct Side {
    EdgeCurve curve; ///< turned to lead from corner i to the next
    bool forward;    ///< as it is stored for both triangles
  };

  /// How far it leaves its facet; sampled.
  struct Shape {
    double departure;    ///< largest distance from the plane of the facet [mm]
    double least_cosine; ///< between its normal and that of the facet
  };

  explicit CurvedTriangle(const std::array<Side, 3>& sides);

  [[nodiscard]] SurfacePoint at(double v, double w) const;

  [[nodiscard]] Box bounds() const;
  /// No point of it is farther than this from the straight triangle between the corners. [mm]
  [[nodiscard]] double rise() const;
  [[nodiscard]] Quarters quarters() const;
  [[nodiscard]] Shape shape() const;
  [[nodiscard]] const std::array<Side, 3>& sides() const { return sides_; }

  /// Parameters (v, w) of the point of side i at the parameter t of the stored curve.
  [[nodiscard]] std::array<double, 2> on_side(std::size_t i, double t) const;

  /// Parameters (v, w) inside the triangle at which x - y is normal to the surface and y the
  /// closest point; empty if the search leads to the boundary. (G.21)
  ///
  /// @param start  parameters (v, w) inside or on the triangle
  [[nodiscard]] std::optional<std::array<double, 2>> foot(const Vec3& x,
                                                          std::array<double, 2> start) const;

private:
  using Corners = std::array<std::array<double, 3>, 3>; ///< barycentric coordinates of each

  /// Control point of the part of the cubic between three places. [mm]
  [[nodiscard]] Vec3 blossom(const Corners& at) const;
  /// Largest distance of a point of that part from the same point of the straight triangle. [mm]
  [[nodiscard]] double rise_between(const Corners& corners) const;
  [[nodiscard]] SurfacePoint cubic(double v, double w) const; ///< without bends
  [[nodiscard]] Taylor1<Vec3> bend(std::size_t side, double t) const;
  void add_bends(double v, double w, SurfacePoint& at) const;
  [[nodiscard]] double largest_bend() const;

  std::array<Side, 3> sides_;
  Vec3 centre_;                               ///< control point of the middle [mm]
  std::array<std::array<Vec3, 3>, 3> across_; ///< derivative of the cubic across side i [mm]
  std::array<bool, 3> bends_;                 ///< side i needs a correction
};

/// The curved triangle over triangle t of a mesh.
///
/// @pre edges = edge_curves(mesh, ...)
[[nodiscard]] CurvedTriangle
curved_triangle(const TriangleMesh& mesh, const EdgeCurves& edges, std::size_t t);

} // namespace billet::geometry
