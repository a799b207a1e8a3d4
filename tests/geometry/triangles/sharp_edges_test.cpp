// Sharp edges: which there are, how far apart they lie, and which a coarse mesh can follow.

#include "geometry/triangles/sharp_edges.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/studded_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace billet::geometry::sharp_edges_test {
namespace {

double length(const std::vector<std::vector<Vec3>>& lines) {
  double sum = 0.0;
  for (const std::vector<Vec3>& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      sum += (line[i] - line[i - 1]).norm();
  return sum;
}

TEST(SharpEdges, AreThoseOfACubeWithoutTheDiagonals) {
  EXPECT_EQ(sharp_edges(cube(), 30.0).size(), 12U);
}

TEST(SharpEdges, AreAsFarApartAsThoseThatAreNoNeighbours) {
  const TriangleMesh mesh = cube();
  const std::vector<SharpEdge> edges = sharp_edges(mesh, 30.0);
  const SharpNetwork network(mesh, edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec3 middle = 0.5 * (mesh.points[static_cast<std::size_t>(edges[i].a)] +
                               mesh.points[static_cast<std::size_t>(edges[i].b)]);
    EXPECT_NEAR(network.distance(static_cast<std::int32_t>(i), middle, 5.0), 1.0, 1e-12);
  }
}

TEST(SharpEdges, OfACircleAreNotNearEachOther) {
  const TriangleMesh mesh = round_bar({.n = 60, .radius = 1.0, .length = 20.0});
  const std::vector<SharpEdge> edges = sharp_edges(mesh, 30.0);
  ASSERT_EQ(edges.size(), 120U);
  const SharpNetwork network(mesh, edges);
  const Vec3& on_rim = mesh.points[static_cast<std::size_t>(edges[0].a)];
  EXPECT_EQ(network.distance(0, on_rim, 3.0), 3.0);
}

TEST(SharpEdges, OfDetailsAreLeftOutAndOthersStayWhole) {
  const TriangleMesh block = studded_block(3, 0.2);
  const double of_block = 4.0 * (20.0 + 20.0 + 6.0), of_studs = 9.0 * 12.0 * 0.2;
  EXPECT_NEAR(length(lines_without_details(block, 30.0, 0.3)), of_block, 1e-9);
  EXPECT_NEAR(length(lines_without_details(block, 30.0, 0.05)), of_block + of_studs, 1e-9);
}

TEST(SharpEdges, OfSmallHolesAreDetailsThoughTheyAreClosedLines) {
  const TriangleMesh bar = round_bar({.n = 60, .radius = 1.0, .length = 20.0});
  EXPECT_EQ(lines_without_details(bar, 30.0, 1.5).size(), 2U);
  EXPECT_TRUE(lines_without_details(bar, 30.0, 2.5).empty());
  const auto rims = lines_without_details(bar, 30.0, 1.5);
  EXPECT_TRUE(std::all_of(rims.begin(), rims.end(), [](const std::vector<Vec3>& rim) {
    return rim.size() == 61 && rim.front() == rim.back();
  }));
}

} // namespace
} // namespace billet::geometry::sharp_edges_test
