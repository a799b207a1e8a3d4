// Normals of the smooth surface that a triangulation stands for.
//
// Corners of triangles that meet at a vertex without a sharp edge between them form a fan and share
// one normal; edges sharper than the feature angle separate fans, so that both sides keep their
// own. Internal to geometry/.
//
// Units   angles in rad. Theory: docs/theory/geometry.md (G.16).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

/// Two directions closer than this are one: coordinates of an STL have seven digits [rad].
inline constexpr double same_direction = 1e-4;

struct CornerNormals {
  std::vector<Vec3> faces;                    ///< unit
  std::vector<std::array<Vec3, 3>> corners;   ///< unit normal of the fan of each corner
  std::vector<std::array<char, 3>> is_tip;    ///< the fan turns too far for one normal: a cone
  std::vector<std::array<char, 3>> is_sharp;  ///< side i, from corner i to the next
  std::vector<std::array<char, 3>> is_border; ///< side i has no neighbour
  std::vector<char> one_fan;                  ///< vertex: inside a smooth part of the surface
  std::vector<std::array<std::int32_t, 3>> neighbours; ///< triangle beyond side i; -1: none
};

/// Fans and their normals by Max's weights and quadratics, flat parts kept flat. (G.16)
///
/// @param feature_angle  edges that turn by more stay sharp [rad], >= 0
/// @pre complaints(health(mesh)) is empty
[[nodiscard]] CornerNormals corner_normals(const TriangleMesh& mesh, double feature_angle);

/// The same, and further edges stay sharp.
///
/// @param creases  point numbers of their ends, the smaller first, sorted
[[nodiscard]] CornerNormals corner_normals(const TriangleMesh& mesh,
                                           double feature_angle,
                                           std::span<const std::array<std::int32_t, 2>> creases);

} // namespace billet::geometry
