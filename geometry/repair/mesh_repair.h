// Repair of a tool's surface, as far as its shape stays within a tolerance.
//
// Steps, in this order: identical points welded, triangles without area and repeated ones dropped
// (triangle_mesh.h); cracks stitched (mesh_stitch.h); doubled faces resolved; triangles oriented
// and fans that touch in a point parted (mesh_orientation.h); outer shells turned outwards
// (mesh_parts.h). Every step counts what it did. What is left is for `complaints` to refuse.
//
// Units   those of the caller (mm). Guide: docs/guide/stl-tools.md.

#pragma once

#include "geometry/repair/mesh_parts.h"
#include "geometry/repair/mesh_stitch.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace billet::geometry {

/// The tolerance of repairs as a share of the diagonal [-].
inline constexpr double default_repair_tolerance = 1e-5;

/// What a repair did.
struct Repairs {
  double tolerance = 0.0; ///< no point has moved farther [mm]
  CleanUp clean_up;
  Stitching stitching;
  std::int64_t opposite_triangles = 0; ///< back to back with another one: dropped
  std::int64_t turned_triangles = 0;   ///< faced the other way than their neighbours
  std::int64_t parted_points = 0;      ///< added where fans touched in a point or an edge
  std::int64_t turned_shells = 0;      ///< outer shells that faced their inside

  /// One sentence for each kind of repair done, with its count; welding of identical points is no
  /// repair.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// A surface after its repair.
struct Repaired {
  Repairs done;
  MeshParts parts; ///< of the repaired surface
};

/// Repairs `mesh`.
///
/// @param tolerance  how far points may move [mm], > 0
/// @param precision  of the coordinates [mm], >= 0; triangles flatter than it are flat
Repaired repair(TriangleMesh& mesh, double tolerance, double precision);

} // namespace billet::geometry
