// Creases of a boundary in space whose walls have met, and the boundary with them drawn flat.

#include "geometry/mesh2d/closed_creases.h"
#include "geometry/mesh3d/solid_remesher.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/repair/self_intersection.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/sound_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace billet::geometry::closed_creases_test {
namespace {

constexpr int across = 20; // squares along an edge of the block

/// A block of 10 whose faces are cut into squares of a half, the parts of its boundary: 0 for the
/// face at y = 0, 1 for all others.
SolidBoundary block() {
  SolidBoundary result;
  TriangleMesh& mesh = result.mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto point = [&](const std::array<int, 3>& at) {
    const auto [known, added] =
        numbers.try_emplace(at, static_cast<std::int32_t>(mesh.points.size()));
    if (added)
      mesh.points.emplace_back(0.5 * Vec3(at[0], at[1], at[2]));
    return known->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int level : {0, across})
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> x{};
            x[axis] = level;
            x[(axis + 1) % 3] = u;
            x[(axis + 2) % 3] = v;
            return point(x);
          };
          std::array<std::int32_t, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          if (level == 0)
            std::reverse(q.begin(), q.end());
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
          for (int k = 0; k < 2; ++k) {
            result.part.push_back(axis == 1 && level == 0 ? 0 : 1);
            result.hold.push_back(0);
          }
        }
  result.keep.assign(mesh.points.size(), 0);
  return result;
}

/// With a crease in the top along y from `from` to `to`: 1 deep, its walls `mouth` apart at the
/// top, below 0 through each other.
SolidBoundary creased(double mouth, double from, double to) {
  SolidBoundary boundary = block();
  for (Vec3& x : boundary.mesh.points) {
    const double along = std::min(x.y() - from, to - x.y());
    const double off = x.x() - 5.0;
    if (x.z() < 10.0 || along < 0.0 || std::abs(off) > 1.0)
      continue;
    const double share = std::min(1.0, from == 0.0 ? to - x.y() : along);
    const double side = std::copysign(1.0, off);
    if (off == 0.0)
      x.z() -= share; // the bottom
    else if (std::abs(off) == 0.5)
      x += share * Vec3(side * (0.5 * mouth - 0.5), 0.0, -0.5);
    else
      x.x() += share * side * (0.5 * mouth - 0.8);
  }
  return boundary;
}

bool cuts_itself(const SolidBoundary& boundary) { return !cutting_pairs(boundary.mesh).empty(); }

TEST(ClosedCreases, WallsThatCutEachOtherAreDrawnFlat) {
  SolidBoundary boundary = creased(-0.3, 3.0, 7.0);
  ASSERT_TRUE(cuts_itself(boundary));
  const auto creases = flatten_creases(boundary, 0.0, 0.5);
  ASSERT_EQ(creases.size(), 1u);
  EXPECT_LT((creases[0].at - Vec3(5.0, 5.0, 9.7)).norm(), 0.5);
  EXPECT_GT(creases[0].depth, 0.5);
  EXPECT_LT(creases[0].depth, 1.2);
  EXPECT_FALSE(cuts_itself(boundary));
  EXPECT_NEAR(health(boundary.mesh).volume, 1000.0, 3.0);
  const RemeshedSolid solid =
      remesh_solid(boundary, {.min = 0.5, .max = 2.0}, health(boundary.mesh).volume);
  expect_sound(solid);
}

TEST(ClosedCreases, OneThatIsOpenStays) {
  SolidBoundary boundary = creased(0.3, 3.0, 7.0);
  const std::vector<Vec3> before = boundary.mesh.points;
  EXPECT_TRUE(flatten_creases(boundary, 0.0, 0.5).empty());
  EXPECT_EQ(boundary.mesh.points, before);
}

TEST(ClosedCreases, ANarrowOneIsDrawnFlatIfAskedFor) {
  SolidBoundary boundary = creased(0.1, 3.0, 7.0);
  ASSERT_FALSE(cuts_itself(boundary));
  EXPECT_TRUE(flatten_creases(boundary, 0.02, 0.5).empty());
  EXPECT_EQ(flatten_creases(boundary, 0.2, 0.5).size(), 1u);
  EXPECT_FALSE(cuts_itself(boundary));
}

TEST(ClosedCreases, TwoAreTold) {
  SolidBoundary boundary = creased(-0.3, 3.0, 7.0);
  // The same from below.
  const std::vector<Vec3> plain = block().mesh.points, above = boundary.mesh.points;
  for (Vec3& x : boundary.mesh.points)
    for (std::size_t i = 0; x.z() == 0.0 && i < plain.size(); ++i)
      if (plain[i] == Vec3(x.x(), x.y(), 10.0))
        x = {above[i].x(), above[i].y(), 10.0 - above[i].z()};
  ASSERT_TRUE(cuts_itself(boundary));
  EXPECT_EQ(flatten_creases(boundary, 0.0, 0.5).size(), 2u);
  EXPECT_FALSE(cuts_itself(boundary));
}

TEST(ClosedCreases, OneThatRunsOutAtAPlaneOfSymmetryStaysOnIt) {
  SolidBoundary boundary = creased(-0.3, 0.0, 4.0);
  ASSERT_TRUE(cuts_itself(boundary));
  EXPECT_EQ(flatten_creases(boundary, 0.0, 0.5).size(), 1u);
  EXPECT_FALSE(cuts_itself(boundary));
  for (std::size_t t = 0; t < boundary.part.size(); ++t)
    for (const std::int32_t p : boundary.mesh.triangles[t]) {
      const double y = boundary.mesh.points[static_cast<std::size_t>(p)].y();
      EXPECT_TRUE(boundary.part[t] != 0 || y == 0.0) << y;
    }
  expect_sound(remesh_solid(boundary, {.min = 0.5, .max = 2.0}, health(boundary.mesh).volume));
}

TEST(ClosedCreases, KeptPointsStay) {
  SolidBoundary boundary = creased(-0.3, 3.0, 7.0);
  const std::vector<Vec3> before = boundary.mesh.points;
  boundary.keep.assign(before.size(), 1);
  EXPECT_TRUE(flatten_creases(boundary, 0.0, 0.5).empty());
  EXPECT_EQ(boundary.mesh.points, before);
}

TEST(ClosedCreases, SharpEdgesWithinAreForgotten) {
  SolidBoundary boundary = creased(-0.3, 3.0, 7.0);
  boundary.creases.emplace();
  const auto number = [&](const Vec3& x) {
    const auto& points = block().mesh.points;
    return static_cast<std::int32_t>(std::find(points.begin(), points.end(), x) - points.begin());
  };
  const std::array<std::int32_t, 2> bottom{number({5, 4.5, 10}), number({5, 5, 10})};
  const std::array<std::int32_t, 2> rim{number({0, 0, 10}), number({0, 0.5, 10})};
  for (auto edge : {bottom, rim})
    boundary.creases->push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  std::sort(boundary.creases->begin(), boundary.creases->end());
  ASSERT_EQ(flatten_creases(boundary, 0.0, 0.5).size(), 1u);
  EXPECT_EQ(boundary.creases->size(), 1u);
}

TEST(ClosedCreases, AWallThroughTheOppositeOneIsNone) {
  SolidBoundary boundary = block();
  for (Vec3& x : boundary.mesh.points) // a tenth of the top and more through the bottom
    if (x.z() == 10.0 && std::abs(x.x() - 5.0) < 4.0 && std::abs(x.y() - 5.0) < 4.0)
      x.z() = -1.0;
  const std::vector<Vec3> before = boundary.mesh.points;
  ASSERT_TRUE(cuts_itself(boundary));
  EXPECT_TRUE(flatten_creases(boundary, 0.0, 0.5).empty());
  EXPECT_EQ(boundary.mesh.points, before);
  const auto found = cut_at(boundary.mesh);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->at.x(), 5.0, 0.5);
  EXPECT_NEAR(found->at.y(), 5.0, 0.5);
  EXPECT_FALSE(cut_at(block().mesh));
}

} // namespace
} // namespace billet::geometry::closed_creases_test
