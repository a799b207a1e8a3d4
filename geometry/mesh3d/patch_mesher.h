// Tetrahedra in a body whose surface is divided into patches by lines that stay.
//
// Delaunay refinement with protected lines by a field of sizes, then perturbation and exudation of
// flat tetrahedra, as CGAL does it. Nodes on a patch lie on its triangles, nodes on a line on its
// pieces. The same body gives the same mesh, to the bit. Internal to geometry/. Theory:
// docs/theory/geometry.md (G.46).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh3d/mesher_3d.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace billet::geometry {

/// A chain of edges of the surface; closed if it ends where it begins.
struct FeatureLine {
  std::vector<Vec3> points;          ///< two at least [mm]
  std::vector<std::int32_t> patches; ///< adjacent to it
};

/// A closed surface, turned outwards, and what of it stays.
struct PatchedSurface {
  TriangleMesh mesh;
  std::vector<std::int32_t> patch; ///< of each triangle, from 0
  std::vector<FeatureLine> lines;  ///< their ends stay nodes
  std::vector<Vec3> corners;       ///< further points that stay nodes
};

/// A mesh and what its boundary lies on.
struct PatchedSolid {
  struct Facet {
    std::array<std::int32_t, 3> corners; ///< turn counter-clockwise seen from outside
    std::int32_t patch;
  };
  struct LineEdge {
    std::array<std::int32_t, 2> corners; ///< the smaller number first
    std::int32_t line;
  };

  SolidMesh mesh;
  std::vector<Facet> facets;   ///< of the boundary
  std::vector<LineEdge> edges; ///< on lines, sorted
};

/// Length of the edges asked for at a place [mm], > 0.
using SpaceSize = std::function<double(const Vec3&)>;

/// The new boundary may touch itself where the sizes are larger than a gap or a wall is wide: to
/// make it manifold is not left to the refinement, which does not end on some bodies.
///
/// @param most  tetrahedra that may be made
/// @throws Error(Fault::geometry) if nothing could be meshed, or with the place of the shortest
/// edge
///         if it would take more than `most` tetrahedra
/// @pre the surface is closed, manifold, does not cut itself and faces outwards
[[nodiscard]] PatchedSolid
mesh_patches(const PatchedSurface& surface, const SpaceSize& size, double most);

} // namespace billet::geometry
