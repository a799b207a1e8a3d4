// Faces, edges and vertices of a triangulated surface with their pseudo-normals.
//
// Internal to geometry/: the distance from a point to one triangle, and the projection onto the
// face, edge or vertex that turned out to be the nearest. An edge is measured in one direction
// whichever of its triangles asks, so both give the same bits. (G.12)-(G.14)
//
// Frame   tool frame. Units: mm.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace billet::geometry {

enum class Feature { face, edge, vertex };

/// The part of a triangle that is nearest to a query, and how far it is.
struct ClosestFeature {
  double distance2;    ///< [mm^2]
  Feature feature;     ///< what
  std::int32_t number; ///< which face, edge or vertex of the surface
};

/// How far a point of the plane of a triangle lies within its nearest side.
struct Inside {
  double distance;  ///< [mm]; < 0: outside of the triangle
  std::size_t side; ///< 0, 1, 2: from that corner to the next
};

class TriangleFeatures {
public:
  /// @pre complaints(health(mesh)) is empty
  explicit TriangleFeatures(const TriangleMesh& mesh);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Of coordinates. [mm]
  [[nodiscard]] double rounding() const { return rounding_; }

  [[nodiscard]] ClosestFeature closest(std::int32_t triangle, const Vec3& x) const;

  /// Distance of x from the plane of a triangle [mm]: a bound of that from the triangle.
  [[nodiscard]] double height(std::int32_t triangle, const Vec3& x) const {
    const auto t = static_cast<std::size_t>(triangle);
    return std::abs((x - point(mesh_.triangles[t][0])).dot(face_normals_[t]));
  }

  /// Where the foot of x in the plane of a triangle lies.
  [[nodiscard]] Inside inside(std::int32_t triangle, const Vec3& x) const;

  /// The triangle across a side; -1: none.
  [[nodiscard]] std::int32_t neighbour(std::int32_t triangle, std::size_t side) const {
    return neighbours_[static_cast<std::size_t>(triangle)][side];
  }

  /// Signed projection onto that feature; not found beyond a rim. `patch` is left at -1.
  [[nodiscard]] Projection project(const ClosestFeature& closest, const Vec3& x) const;

  /// Projection onto a point, or a curve, of the surface from which `v` leads to x; v turns within
  /// the subspace that `free` projects on.
  ///
  /// @param overshoot  how far x lies past the border [mm]; -inf if the feature is not on it
  [[nodiscard]] Projection around(const Vec3& x,
                                  const Vec3& v,
                                  const Vec3& pseudo_normal,
                                  const Mat3& free,
                                  double overshoot) const;

private:
  struct Edge {
    std::int32_t a; ///< smaller point number
    std::int32_t b; ///< larger
    Vec3 normal;    ///< pseudo-normal, unit
    bool border;    ///< has one triangle only
    Vec3 outward;   ///< at a border: unit vector in the triangle's plane, away from it
  };

  [[nodiscard]] const Vec3& point(std::int32_t i) const {
    return mesh_.points[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] ClosestFeature closest_on_edge(std::int32_t edge, const Vec3& x) const;
  [[nodiscard]] Projection on_edge(const Edge& edge, const Vec3& x) const;
  [[nodiscard]] Projection on_vertex(std::int32_t vertex, const Vec3& x) const;
  void find_normals();
  void find_edges();

  TriangleMesh mesh_;
  Box bounds_;
  double rounding_ = 0.0;                                   ///< of coordinates [mm]
  std::vector<Vec3> face_normals_;                          ///< unit
  std::vector<Vec3> vertex_normals_;                        ///< pseudo-normals, unit
  std::vector<Edge> edges_;                                 ///< sorted by (a, b)
  std::vector<std::array<std::int32_t, 3>> triangle_edges_; ///< from corner i to the next
  std::vector<std::array<std::int32_t, 3>> neighbours_;     ///< across these edges; -1: none
  std::vector<std::pair<std::int32_t, std::int32_t>> rim_;  ///< (vertex, border edge), sorted
};

} // namespace billet::geometry
