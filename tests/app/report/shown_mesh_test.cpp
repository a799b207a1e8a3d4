#include "app/report/shown_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace billet::report::shown_mesh_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;

TEST(ShownMesh, PutsMidSidesBetweenCorners) {
  EXPECT_EQ(ring_of(std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7}),
            (std::vector<Index>{0, 4, 1, 5, 2, 6, 3, 7}));
  EXPECT_EQ(ring_of(std::vector<Index>{8, 9, 10, 11, 12, 13}),
            (std::vector<Index>{8, 11, 9, 12, 10, 13}));
  EXPECT_EQ(ring_of(std::vector<Index>{3, 2, 1}), (std::vector<Index>{3, 2, 1}));
}

TEST(ShownMesh, ShowsEveryElementOfThePlane) {
  mechanics::Mesh mesh;
  mesh.points.resize(6);
  mesh.cells = {0, 1, 4, 3, 1, 2, 5, 4};
  const ShownMesh all = shown(mesh, true);
  EXPECT_EQ(all.faces, mesh.cells);
  EXPECT_EQ(all.face_elements, (std::vector<Index>{0, 1}));
  EXPECT_EQ(all.corners, 0U); // a cut of the plane needs none
}

/// Two bricks one above the other, the lower one of nodes 0 to 7.
mechanics::Mesh two_bricks() {
  mechanics::Mesh mesh;
  mesh.kind = ElementKind::hex8;
  mesh.points.resize(12);
  mesh.cells = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
  return mesh;
}

TEST(ShownMesh, ShowsTheSurfaceOfAPartInSpace) {
  const ShownMesh surface = shown(two_bricks(), false);
  EXPECT_EQ(surface.faces.size() / surface.ring, 10U); // all but the face between them
  EXPECT_TRUE(surface.cells.empty());
  EXPECT_EQ(shown(two_bricks(), true).cells, two_bricks().cells);
}

TEST(ShownMesh, LeavesOutMidSidesInside) {
  // Four tetrahedra around node 4: the edges to it have mid-sides that no face has.
  mechanics::Mesh mesh;
  mesh.kind = ElementKind::tet10;
  const int corners[4][4] = {{0, 1, 2, 4}, {0, 3, 1, 4}, {1, 3, 2, 4}, {0, 2, 3, 4}};
  const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  std::map<std::pair<int, int>, Index> middle;
  Index next = 5;
  for (const auto& cell : corners) {
    mesh.cells.insert(mesh.cells.end(), cell, cell + 4);
    for (const auto& edge : edges) {
      const auto key = std::minmax(cell[edge[0]], cell[edge[1]]);
      const auto [at, is_new] = middle.try_emplace({key.first, key.second}, next);
      next += is_new ? 1 : 0;
      mesh.cells.push_back(at->second);
    }
  }
  mesh.points.resize(idx(next));
  ASSERT_EQ(next, 15);
  const ShownMesh surface = shown(mesh, false), whole = shown(mesh, true);
  EXPECT_EQ(surface.nodes.size(), 10U);
  EXPECT_EQ(whole.nodes.size(), 11U); // and the node inside
  EXPECT_EQ(whole.corners, 4U);
  EXPECT_EQ(whole.number((middle[{0, 4}])), -1);
  std::vector<double> values(30);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(i);
  const std::vector<double> chosen = of_shown_nodes(whole, values, 2);
  ASSERT_EQ(chosen.size(), 22U);
  EXPECT_EQ(chosen[8], 2.0 * whole.nodes[4]);
}

} // namespace
} // namespace billet::report::shown_mesh_test
