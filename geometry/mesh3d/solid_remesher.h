// Anew tetrahedra in a body whose boundary is that of a distorted mesh.
//
// The boundary comes as triangles. Between lines that must stay it is read as a smooth surface
// through all its points; nodes and edges of the new boundary lie on that surface, tetrahedra are
// refined by a field of sizes, and the volume is given back what the resampling took. The same
// boundary gives the same mesh, to the bit. Theory: docs/theory/geometry.md (G.45)-(G.48).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/curved/solid_boundary.h"
#include "geometry/mesh3d/mesher_3d.h"

#include <array>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

namespace billet::geometry {

/// What the new edges should be like.
struct SolidSizes {
  double min;                           ///< shortest edge asked for [mm], > 0
  double max;                           ///< longest edge asked for [mm]
  double turn = std::numbers::pi / 6.0; ///< most the surface turns along an edge, unless it is
                                        ///< shorter than `min` by it [rad]
  double growth = 0.5;                  ///< most change of size per distance [-]
  double across = 1.0;                  ///< edges across a thin place (web, flash)
  /// Size asked for at a place of the boundary [mm]; empty: `max`.
  std::function<double(const Vec3&)> wanted = {};
};

/// Where a new node of the boundary should rather be, e.g. on the tool that its face lies on.
///
/// Called for the corners and the middles of edges: parts of the faces around it, place on the old
/// boundary, position on its surface; returns the new position [mm]. Nodes of faces that are not
/// held are moved for the volume afterwards.
using SnapSolid =
    std::function<Vec3(std::span<const std::int32_t> parts, const SurfacePlace& at, const Vec3& x)>;

/// The new mesh and where its boundary comes from.
struct RemeshedSolid {
  /// An edge of the boundary; edges inside are straight.
  struct Edge {
    std::array<std::int32_t, 2> corners; ///< the smaller number first
    Vec3 middle;                         ///< [mm]
  };
  struct Facet {
    std::array<std::int32_t, 3> corners; ///< turn counter-clockwise seen from outside
    std::int32_t part;                   ///< of the old boundary
  };
  /// An edge on a line that stays.
  struct LineEdge {
    std::size_t edge;                ///< number in `edges`
    std::array<std::int32_t, 2> old; ///< ends of the old edge, the smaller number first
  };
  /// A corner of the new mesh that is one of the old boundary.
  struct Kept {
    std::int32_t corner;
    std::int32_t point; ///< of the old boundary
  };

  SolidMesh mesh;
  std::vector<Edge> edges;   ///< sorted by their corners
  std::vector<Facet> facets; ///< of the boundary
  std::vector<LineEdge> on_lines;
  std::vector<Kept> kept;
  double volume;         ///< of the quadratic tetrahedra [mm^3]
  double smallest_angle; ///< between two faces of a straight tetrahedron [degrees]
};

/// Meshes the body anew.
///
/// Edges are kept where `part` changes, where `lines` says so and where the boundary turns by more
/// than 30 degrees. (G.45)
///
/// @param volume  what the new mesh is to have [mm^3]
/// @param snap  puts nodes of the boundary where they should be; empty: they stay on its surface
/// @throws Error(Fault::geometry), with the place, if the boundary is open, cuts itself or cannot
///         be meshed, or not with as many tetrahedra as the sizes let expect, two hundred thousand
///         at most
[[nodiscard]] RemeshedSolid remesh_solid(const SolidBoundary& boundary,
                                         const SolidSizes& sizes,
                                         double volume,
                                         const SnapSolid& snap = {});

} // namespace billet::geometry
