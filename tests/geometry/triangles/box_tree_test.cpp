#include "geometry/triangles/box_tree.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

namespace billet::geometry::box_tree_test {
namespace {

std::vector<Box> random_boxes(std::size_t n, const Vec3& centre) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> size(0.0, 0.2);
  std::vector<Box> boxes;
  for (const Vec3& p : random_points(n, 1.0)) {
    Box box;
    box.add(centre + p);
    box.add(centre + p + Vec3(size(generator), size(generator), size(generator)));
    boxes.push_back(box);
  }
  return boxes;
}

TEST(BoxTree, WalksToEveryBoxWithinTheLimit) {
  for (const std::size_t n : {1U, 2U, 8U, 9U, 64U, 65U, 1000U})
    for (const double off : {0.0, 1e4}) {
      const Vec3 centre = Vec3::Constant(off);
      const std::vector<Box> boxes = random_boxes(n, centre);
      const BoxTree tree(boxes);
      for (const Vec3& p : random_points(50, 1.5)) {
        const Vec3 x = centre + p;
        std::vector<int> visits(n, 0);
        constexpr double limit2 = 0.09;
        tree.walk(x, limit2, [&](std::int32_t i) {
          ++visits[static_cast<std::size_t>(i)];
          return limit2;
        });
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_LE(visits[i], 1);
          if (distance2(boxes[i], x) <= limit2) {
            EXPECT_EQ(visits[i], 1);
          }
        }
      }
    }
}

TEST(BoxTree, FindsTheNearestBoxOfEqualOnesToo) {
  std::vector<Box> boxes = random_boxes(300, Vec3::Zero());
  boxes.insert(boxes.end(), boxes.begin(), boxes.begin() + 100);
  const BoxTree tree(boxes);
  for (const Vec3& x : random_points(500, 2.0)) {
    double least = std::numeric_limits<double>::infinity(), found = least;
    for (const Box& box : boxes)
      least = std::min(least, distance2(box, x));
    std::size_t visited = 0;
    tree.walk(x, found, [&](std::int32_t i) {
      ++visited;
      found = std::min(found, distance2(boxes[static_cast<std::size_t>(i)], x));
      return found;
    });
    EXPECT_EQ(found, least);
    EXPECT_LT(visited, boxes.size() / 4);
  }
}

/// What a search for the nearest triangle finds, and how many it looks at.
struct Search {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t looked_at = 0;
};

Search nearest(const BoxTree& tree, const TriangleMesh& mesh, const Vec3& x) {
  Search search;
  tree.walk(x, search.distance, [&](std::int32_t i) {
    const auto t = static_cast<std::size_t>(i);
    ++search.looked_at;
    search.distance =
        std::min(search.distance, distance_to_triangle(x, corner(mesh, t, 0), corner(mesh, t, 1),
                                                       corner(mesh, t, 2)));
    return search.distance * search.distance;
  });
  return search;
}

TEST(BoxTree, SlabsTellTheFacetsOfAHollowApartFromNearItsCentre) {
  // 20 000 triangles of a dish of radius 2; at its centre all are equally far. (G.51)
  const TriangleMesh mesh = sheet(100, [](double x, double y) {
    return 2.0 - std::sqrt(4.0 - (x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5));
  });
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      boxes[t].add(corner(mesh, t, i));
  const BoxTree plain(boxes);
  const BoxTree tree(boxes, [&](std::int32_t i) {
    const auto t = static_cast<std::size_t>(i);
    return SlabFacet{{corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)}};
  });
  for (const double share : {0.0, 0.3, 0.8, 0.95, 1.0, 1.5}) {
    const Vec3 x(0.503, 0.501, 2.0 * share);
    const Search without = nearest(plain, mesh, x), with = nearest(tree, mesh, x);
    EXPECT_EQ(with.distance, without.distance);
    EXPECT_EQ(with.distance, brute_distance(mesh, x));
    std::printf("%.2f of the radius off: %zu triangles looked at, %zu by boxes alone\n", share,
                with.looked_at, without.looked_at);
    EXPECT_LE(with.looked_at, without.looked_at);
    if (share > 0.5 && share < 1.0) {
      EXPECT_LT(5 * with.looked_at, without.looked_at);
    }
  }
}

TEST(BoxTree, AnEmptyTreeHasNothingToVisit) {
  BoxTree().walk(Vec3::Zero(), 1.0, [](std::int32_t) {
    ADD_FAILURE();
    return 1.0;
  });
}

} // namespace
} // namespace billet::geometry::box_tree_test
