// What is wrong with a triangulated surface.
//
// Counts, measures and places of everything a tool's surface may suffer from, cuts of triangles
// through each other excepted (self_intersection.h). Nothing is repaired here (mesh_repair.h).
//
// Units   those of the caller (mm). Guide: docs/guide/stl-tools.md.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace billet::geometry {

/// Triangles longer than this many times their smallest height count as needles [-].
inline constexpr double needle_aspect = 1e4;

/// The angle between the normals of two triangles above which their edge is a feature [degrees].
inline constexpr double default_feature_angle = 30.0;

/// The state of a surface.
struct MeshHealth {
  std::int64_t points = 0;
  std::int64_t triangles = 0;
  std::int64_t degenerate_triangles = 0;  ///< no area
  std::int64_t duplicate_triangles = 0;   ///< same corners as an earlier one, any orientation
  std::int64_t needles = 0;               ///< aspect ratio above `needle_aspect`
  std::int64_t border_edges = 0;          ///< belong to one triangle
  std::int64_t border_loops = 0;          ///< rims and holes
  std::int64_t non_manifold_edges = 0;    ///< belong to more than two triangles
  std::int64_t non_manifold_vertices = 0; ///< where fans of triangles touch in a point only
  std::int64_t inconsistent_edges = 0;    ///< both triangles run through it in the same direction
  std::int64_t feature_edges = 0;         ///< sharper than the feature angle
  std::int64_t components = 0;            ///< parts that share no point
  double worst_aspect = 0.0;           ///< longest side over smallest height [-], 1.15: equilateral
  double volume = 0.0;                 ///< enclosed [mm^3], < 0: inside out; 0 if not closed
  double area = 0.0;                   ///< [mm^2]
  Box bounds;                          ///< [mm]
  std::optional<Vec3> non_manifold_at; ///< the middle of the first such edge [mm]
  std::optional<Vec3> non_manifold_vertex_at; ///< the first such vertex [mm]
  std::optional<Vec3> inconsistent_at;        ///< the middle of the first such edge [mm]
  std::optional<Vec3> degenerate_at;          ///< the first corner of the first such triangle [mm]
  std::optional<Vec3> worst_aspect_at;        ///< the first corner of the worst triangle [mm]
  std::optional<Vec3> border_at;              ///< the middle of the first border edge [mm]

  [[nodiscard]] bool closed() const {
    return triangles > 0 && border_edges == 0 && non_manifold_edges == 0 && inconsistent_edges == 0;
  }
  [[nodiscard]] bool inside_out() const { return closed() && volume < 0.0; }
};

/// Counts what `MeshHealth` lists; O(n log n).
///
/// @param feature_angle  [degrees], 0 to 180
[[nodiscard]] MeshHealth health(const TriangleMesh& mesh,
                                double feature_angle = default_feature_angle);

/// Why this surface cannot serve as a tool, with coordinates; empty if it can.
[[nodiscard]] std::vector<Complaint> complaints(const MeshHealth& health, const std::string& place);

/// "(1, 2.5, 0)", as places are given in messages.
[[nodiscard]] std::string coordinates(const Vec3& x);

} // namespace billet::geometry
