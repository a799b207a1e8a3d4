// Bodies to be meshed anew, and whether the mesh of one is one.

#pragma once

#include "geometry/mesh3d/solid_remesher.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace billet::geometry {

/// One part that is held nowhere.
inline SolidBoundary whole(TriangleMesh mesh) {
  SolidBoundary boundary;
  boundary.part.assign(mesh.triangles.size(), 0);
  boundary.hold.assign(mesh.triangles.size(), 0);
  boundary.keep.assign(mesh.points.size(), 0);
  boundary.mesh = std::move(mesh);
  return boundary;
}

inline SolidSizes edges_of(double size) {
  SolidSizes sizes;
  sizes.min = 0.25 * size;
  sizes.max = size;
  return sizes;
}

/// Every face of the boundary is one of a tetrahedron, all of them close it, and every tetrahedron
/// is turned the right way round.
inline void expect_sound(const RemeshedSolid& solid, const std::string& name = "") {
  std::set<std::array<std::int32_t, 3>> faces;
  const auto key = [](std::array<std::int32_t, 3> face) {
    std::sort(face.begin(), face.end());
    return face;
  };
  for (const auto& [a, b, c, d] : solid.mesh.tetrahedra) {
    const auto& x = solid.mesh.points;
    const auto p = [&](std::int32_t i) { return x[static_cast<std::size_t>(i)]; };
    EXPECT_GT((p(b) - p(a)).cross(p(c) - p(a)).dot(p(d) - p(a)), 0.0) << name;
    for (const auto& face : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}})
      if (const auto [place, added] = faces.insert(key(face)); !added)
        faces.erase(place);
  }
  EXPECT_EQ(faces.size(), solid.facets.size()) << name;
  for (const RemeshedSolid::Facet& facet : solid.facets)
    EXPECT_TRUE(faces.contains(key(facet.corners))) << name;
  EXPECT_EQ(2 * solid.edges.size(), 3 * solid.facets.size()) << name;
}

} // namespace billet::geometry
