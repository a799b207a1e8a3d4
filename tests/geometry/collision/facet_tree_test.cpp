#include "geometry/collision/facet_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace billet::geometry::facet_tree_test {
namespace {

TEST(FacetTree, knows_distances_and_cuts) {
  constexpr std::array<double, 9> points{0, 0, 0, 1, 0, 0, 0, 1, 0};
  constexpr std::array<FacetTree::Triangle, 1> triangles{{{0, 1, 2}}};
  const auto tree = make_facet_tree(points, triangles);
  constexpr FacetTree::Place here{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  FacetTree::Place above = here;
  above[11] = 0.5;
  EXPECT_NEAR(tree->distance(here, *tree, above), 0.5, 1e-12);
  EXPECT_TRUE(tree->cuts(here, *tree, above).empty());
  // Turned about x by a right angle: it stands on the other one's plane and goes through it.
  constexpr FacetTree::Place across{1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0.2, -0.5};
  EXPECT_EQ(tree->cuts(here, *tree, across), (std::vector<FacetTree::Pair>{{0, 0}}));
}

} // namespace
} // namespace billet::geometry::facet_tree_test
