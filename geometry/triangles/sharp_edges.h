// The sharp edges of a triangulated surface: where they are, how far apart they lie, and those that
// a coarse mesh can follow. Internal to geometry/.
//
// Units   mm; angles in degrees. Theory: docs/theory/geometry.md (G.57), (G.58).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/box_tree.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>
#include <map>
#include <vector>

namespace billet::geometry {

struct SharpEdge {
  std::int32_t a, b; ///< points of the surface
  double length;     ///< [mm]
};

/// Edges whose triangles' normals differ by more than the feature angle.
[[nodiscard]] std::vector<SharpEdge> sharp_edges(const TriangleMesh& mesh, double feature_angle);

/// The network of sharp edges, and how far they are apart where they are not neighbours.
class SharpNetwork {
public:
  /// Keeps references.
  SharpNetwork(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges);

  /// Distance from a place on an edge to the nearest other one, `most` at most [mm]. Edges to which
  /// the way along the network is no longer than 1.9 times the distance are its continuation.
  /// (G.57)
  [[nodiscard]] double distance(std::int32_t edge, const Vec3& x, double most) const;

private:
  using Ways = std::map<std::int32_t, double>; ///< to points of the surface [mm]

  [[nodiscard]] const Vec3& point(std::int32_t edge, int end) const;
  [[nodiscard]] Ways ways(std::int32_t edge, const Vec3& x, double most) const;
  [[nodiscard]] double way(const Ways& ways, std::int32_t edge, double at) const;

  const TriangleMesh& mesh_;
  const std::vector<SharpEdge>& edges_;
  std::map<std::int32_t, std::vector<std::int32_t>> at_point_;
  BoxTree tree_;
};

/// Chains of points along the sharp edges where these are no details: where no other sharp edge is
/// nearer than `details`, in groups that are larger than it. A closed chain ends where it begins.
/// (G.58)
[[nodiscard]] std::vector<std::vector<Vec3>>
lines_without_details(const TriangleMesh& mesh, double feature_angle, double details);

} // namespace billet::geometry
