#include "geometry/triangles/edge_table.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

namespace billet::geometry::edge_table_test {
namespace {

TEST(EdgeTable, EveryEdgeOfAClosedBodyHasTwoSidesThatRunOppositeWays) {
  const TriangleMesh mesh = cube();
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  EXPECT_EQ(uses.size(), 36U);
  int edges = 0;
  for_each_edge(uses, [&](std::span<const EdgeUse> sides) {
    ++edges;
    ASSERT_EQ(sides.size(), 2U);
    EXPECT_NE(sides[0].forward, sides[1].forward);
    for (const EdgeUse& use : sides) {
      const auto& t = mesh.triangles[static_cast<std::size_t>(use.triangle)];
      const auto side = static_cast<std::size_t>(use.side);
      EXPECT_EQ(use.forward ? t[side] : t[(side + 1) % 3], use.low);
      EXPECT_EQ(use.forward ? t[(side + 1) % 3] : t[side], use.high);
    }
  });
  EXPECT_EQ(edges, 18); // Euler: 8 - 18 + 12 = 2
}

} // namespace
} // namespace billet::geometry::edge_table_test
