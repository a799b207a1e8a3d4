#include "geometry/base/error.h"
#include "geometry/base/late_library.h"
#include "geometry/collision/facet_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace billet::geometry::late_library_test {
namespace {

TEST(LateLibrary, says_what_is_missing_and_where_it_belongs) {
  try {
    (void)late_symbol("billet_nothing.so", "nothing");
    FAIL() << "there is no such library";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input_output);
    const std::string text = error.what();
    for (const char* piece : {"billet_nothing.so", "cannot be loaded", "belongs beside it"})
      EXPECT_NE(text.find(piece), std::string::npos) << piece << " is not in: " << text;
  }
  EXPECT_THROW((void)late_symbol("billet_fcl.so", "nothing"), Error);
}

TEST(LateLibrary, makes_trees_that_know_distances_and_cuts) {
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
} // namespace billet::geometry::late_library_test
