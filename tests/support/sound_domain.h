// Whether the mesh of a domain is one.

#pragma once

#include "geometry/base/angle.h"
#include "geometry/mesh2d/domain_remesher.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace billet::geometry {

/// The mesh is one: sides of triangles match, quadratic triangles are sound at their nodes, the
/// boundary runs round its loops.
inline void expect_sound(const RemeshedDomain& domain, const std::string& name) {
  const PlaneMesh& mesh = domain.mesh;
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  std::map<std::array<std::int32_t, 2>, const BoundarySide*> sides;
  for (std::size_t i = 0; i < mesh.boundary.size(); ++i) {
    sides[mesh.boundary[i].corners] = &mesh.boundary[i];
    const std::size_t next = (i + 1) % mesh.boundary.size();
    if (domain.corner_places[i].loop == domain.corner_places[next].loop) {
      EXPECT_EQ(mesh.boundary[i].corners[1], mesh.boundary[next].corners[0]) << name;
    }
  }
  std::set<std::array<std::int32_t, 2>> seen;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec2, 6> x;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::int32_t, 2> side{triangle[i], triangle[(i + 1) % 3]};
      EXPECT_TRUE(seen.insert(side).second) << name;
      x[i] = mesh.points[at(side[0])];
      const auto found = sides.find(side);
      x[3 + i] = found != sides.end()
                     ? found->second->middle
                     : Vec2(0.5 * (mesh.points[at(side[0])] + mesh.points[at(side[1])]));
    }
    for (const auto& [r, s] : std::array<std::array<double, 2>, 6>{
             {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}}) {
      const double q = 1.0 - r - s;
      const Vec2 dr = (4 * r - 1) * x[1] - (4 * q - 1) * x[0] + 4 * (q - r) * x[3] + 4 * s * x[4] -
                      4 * s * x[5];
      const Vec2 ds = (4 * s - 1) * x[2] - (4 * q - 1) * x[0] - 4 * r * x[3] + 4 * r * x[4] +
                      4 * (q - s) * x[5];
      EXPECT_GT(cross(dr, ds), 0.0) << name;
    }
  }
  std::size_t open = 0;
  for (const auto& side : seen)
    if (!seen.contains({side[1], side[0]})) {
      ++open;
      EXPECT_TRUE(sides.contains(side)) << name;
    }
  EXPECT_EQ(open, mesh.boundary.size()) << name;
}

} // namespace billet::geometry
