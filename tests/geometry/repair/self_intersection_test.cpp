#include "geometry/repair/self_intersection.h"
#include "geometry/triangles/triangle_pair.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

namespace billet::geometry::self_intersection_test {
namespace {

using Corners = std::array<Vec3, 3>;

const Corners flat{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

SelfIntersections found_in(const TriangleMesh& mesh) {
  return self_intersections(mesh, parts_of(mesh), 1e-6);
}

TriangleMesh with(TriangleMesh mesh, const TriangleMesh& other, const Vec3& by) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Vec3& p : other.points)
    mesh.points.emplace_back(p + by);
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

TriangleMesh pair_of(const Corners& a, const Corners& b) {
  TriangleMesh mesh;
  mesh.points = {a[0], a[1], a[2], b[0], b[1], b[2]};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

// Whether two triangles in general position meet: a side of one passes through the other.
bool pierces(const Corners& a, const Corners& b) {
  const auto volume = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    return (q - p).cross(r - p).dot(s - p);
  };
  for (const auto& [t, u] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &p = (*t)[i], &q = (*t)[(i + 1) % 3];
      if (volume((*u)[0], (*u)[1], (*u)[2], p) * volume((*u)[0], (*u)[1], (*u)[2], q) > 0.0)
        continue;
      const double x = volume(p, q, (*u)[0], (*u)[1]), y = volume(p, q, (*u)[1], (*u)[2]);
      const double z = volume(p, q, (*u)[2], (*u)[0]);
      if ((x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0))
        return true;
    }
  return false;
}

TEST(TrianglePair, MeetsExactlyWhenASideOfOnePassesThroughTheOther) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int meeting = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Corners a, b;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = Vec3(any(random), any(random), any(random));
      b[i] = Vec3(any(random), any(random), any(random));
    }
    const bool meets = TrianglePair(a, b).meets();
    ASSERT_EQ(meets, pierces(a, b));
    ASSERT_EQ(meets, TrianglePair(b, a).meets());
    meeting += meets ? 1 : 0;
    ASSERT_EQ(TrianglePair(a, b).depth() > 0.0, meets);
  }
  EXPECT_GT(meeting, 1000);
}

TEST(TrianglePair, NeighboursMeetInTheirCommonPartOnly) {
  EXPECT_FALSE(TrianglePair(flat, {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, -1, 0)}).meets());
  EXPECT_FALSE(TrianglePair(flat, {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0.1, 0.1, 1e-3)}).meets());
  EXPECT_FALSE(TrianglePair(flat, {Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)}).meets());
  // Folded upon each other; and through a shared corner.
  EXPECT_TRUE(TrianglePair(flat, {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0.5, 0.5, 0)}).meets());
  EXPECT_TRUE(TrianglePair(flat, {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 1, -1)}).meets());
  EXPECT_TRUE(TrianglePair(flat, {flat[0], flat[2], flat[1]}).meets());
}

TEST(SelfIntersection, SoundSurfacesHaveNone) {
  for (const TriangleMesh& mesh : {cube(), angle_bar(), spiky(12), sphere_mesh(20)}) {
    const SelfIntersections found = found_in(mesh);
    EXPECT_EQ(found.cuts + found.overlaps + found.touches, 0);
    EXPECT_TRUE(found.complete);
    EXPECT_TRUE(complaints(found, "").empty());
  }
}

TEST(SelfIntersection, SheetsThroughEachOtherAreCutsWithTheirPlace) {
  const SelfIntersections found =
      found_in(pair_of(flat, {Vec3(0.2, 0.2, -1), Vec3(0.3, 0.2, -1), Vec3(0.25, 0.25, 1)}));
  EXPECT_EQ(found.cuts, 1);
  EXPECT_NEAR((*found.cut_at - Vec3(0.25, 0.225, 0.0)).norm(), 0.0, 0.05);
  ASSERT_EQ(complaints(found, "die.stl").size(), 1U);
  EXPECT_NE(complaints(found, "die.stl")[0].text().find("(0.25"), std::string::npos);
}

TEST(SelfIntersection, PairsThatCutAreListedWhateverTheirParts) {
  const std::vector<std::array<std::int32_t, 2>> one{{0, 1}};
  EXPECT_EQ(
      cutting_pairs(pair_of(flat, {Vec3(0.2, 0.2, -1), Vec3(0.3, 0.2, -1), Vec3(0.25, 0.25, 1)})),
      one);
  EXPECT_TRUE(cutting_pairs(cube()).empty());
  // Overlapping bodies may; their boundaries cut each other nevertheless.
  EXPECT_FALSE(cutting_pairs(with(cube(), cube(), Vec3(0.5, 0.4, 0.3))).empty());
}

TEST(SelfIntersection, ACutShallowerThanTheToleranceIsATouch) {
  const Corners needle{Vec3(0.2, 0.2, -1e-7), Vec3(0.3, 0.2, 1), Vec3(0.2, 0.3, 1)};
  EXPECT_EQ(found_in(pair_of(flat, needle)).touches, 1);
  EXPECT_EQ(found_in(pair_of(flat, needle)).cuts, 0);
}

TEST(SelfIntersection, SheetsInOnePlaneTouchIfTheyFaceTheSameWayAndCutIfNot) {
  const Corners same{Vec3(0.1, 0.1, 0), Vec3(0.9, 0.1, 0), Vec3(0.1, 0.9, 0)};
  EXPECT_EQ(found_in(pair_of(flat, same)).touches, 1);
  EXPECT_EQ(found_in(pair_of(flat, {same[0], same[2], same[1]})).cuts, 1);
}

TEST(SelfIntersection, ClosedBodiesThatFaceOutwardsMayOverlap) {
  const SelfIntersections found = found_in(with(cube(), cube(), {0.3, 0.4, 0.5}));
  EXPECT_GT(found.overlaps, 0);
  EXPECT_EQ(found.cuts, 0);
  const SelfIntersections hole = found_in(with(cube(), flipped(cube()), {0.3, 0.4, 0.5}));
  EXPECT_EQ(hole.overlaps, 0);
  EXPECT_GT(hole.cuts, 0);
}

TEST(SelfIntersection, AHeapOfTrianglesEndsTheSearch) {
  TriangleMesh mesh; // all boxes overlap, no triangle meets another
  for (std::int32_t i = 0; i < 3000; ++i) {
    const double z = 1e-4 * i;
    mesh.points.insert(mesh.points.end(), {{0, 0, z}, {1, 0, z + 1}, {0, 1, z + 1}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_FALSE(found_in(mesh).complete);
}

} // namespace
} // namespace billet::geometry::self_intersection_test
