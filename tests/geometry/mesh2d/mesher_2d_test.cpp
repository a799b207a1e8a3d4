// Meshes of outlines: they fill the domain, follow its arcs, have no small angles and repeat.

#include "geometry/base/error.h"
#include "geometry/mesh2d/mesher_2d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace billet::geometry::mesher_2d_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Named {
  std::string name;
  Profile outline;
  double area;
  double size;
};

Profile chain(const Vec2& start, std::vector<ProfileSegment> segments) {
  return {start, std::move(segments), true};
}

std::vector<Named> outlines() {
  const Profile square = chain({0, 0}, {{{10, 0}}, {{10, 10}}, {{0, 10}}});
  const Profile clockwise = chain({0, 0}, {{{0, 10}}, {{10, 10}}, {{10, 0}}});
  const Profile disc = chain({5, 0}, {{{-5, 0}, 5.0}, {{5, 0}, 5.0}});
  const Profile fillet = chain({0, 0}, {{{10, 0}}, {{10, 9}}, {{9, 10}, 1.0}, {{0, 10}}});
  const Profile notch = chain({0, 0}, {{{4, 0}}, {{6, 0}, -1.0}, {{10, 0}}, {{10, 5}}, {{0, 5}}});
  const Profile slit = chain(
      {0, 0}, {{{10, 0}}, {{10, 4}}, {{6, 4}}, {{6, 0.2}}, {{5.9, 0.2}}, {{5.9, 4}}, {{0, 4}}});
  const Profile wedge = chain({0, 0}, {{{10, 0}}, {{10, 6}}});
  return {{"square", square, 100.0, 1.0},
          {"square in one", square, 100.0, 20.0},
          {"clockwise", clockwise, 100.0, 1.0},
          {"disc", disc, 25.0 * pi, 1.0},
          {"coarse disc", disc, 25.0 * pi, 10.0},
          {"fillet", fillet, 100.0 - (1.0 - pi / 4.0), 1.5},
          {"notch", notch, 50.0 - 0.5 * pi, 0.7},
          {"slit", slit, 40.0 - 0.38, 1.0},
          {"wedge", wedge, 30.0, 0.5}};
}

/// Area of the triangles, with the parabola of each curved side.
double area_of(const PlaneMesh& mesh) {
  const auto at = [&](std::int32_t i) -> const Vec2& {
    return mesh.points[static_cast<std::size_t>(i)];
  };
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 u = at(b) - at(a), v = at(c) - at(a);
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  for (const BoundarySide& side : mesh.boundary) {
    const Vec2 along = at(side.corners[1]) - at(side.corners[0]);
    const Vec2 sag = side.middle - 0.5 * (at(side.corners[0]) + at(side.corners[1]));
    area += 2.0 / 3.0 * (along.y() * sag.x() - along.x() * sag.y());
  }
  return area;
}

TEST(OutlineMesh, FillsTheDomainWithGoodTriangles) {
  for (const Named& outline : outlines()) {
    const PlaneMesh mesh = mesh_outline(outline.outline, outline.size);
    const double error = area_of(mesh) / outline.area - 1.0;
    std::printf("%-14s %5zu triangles, smallest angle %.1f deg, area %+.1e\n", outline.name.c_str(),
                mesh.triangles.size(), smallest_angle(mesh), error);
    EXPECT_GE(smallest_angle(mesh), 20.0) << outline.name;
    // Parabolas for arcs of up to 22.5 degrees.
    EXPECT_LT(std::abs(error), 1e-4) << outline.name;
  }
}

TEST(OutlineMesh, KnowsItsBoundary) {
  for (const Named& outline : outlines()) {
    const PlaneMesh mesh = mesh_outline(outline.outline, outline.size);
    std::map<std::set<std::int32_t>, int> sides;
    for (const auto& [a, b, c] : mesh.triangles)
      for (const auto& side : {std::set{a, b}, {b, c}, {c, a}})
        ++sides[side];
    std::size_t outer = 0;
    for (const auto& [side, count] : sides)
      outer += count == 1 ? 1 : 0;
    EXPECT_EQ(outer, mesh.boundary.size()) << outline.name;
    std::set<std::int32_t> segments;
    for (std::size_t i = 0; i < mesh.boundary.size(); ++i) {
      const BoundarySide& side = mesh.boundary[i];
      EXPECT_EQ(sides.at({side.corners[0], side.corners[1]}), 1) << outline.name;
      EXPECT_EQ(side.corners[1], mesh.boundary[(i + 1) % mesh.boundary.size()].corners[0]);
      segments.insert(side.segment);
    }
    EXPECT_GE(segments.size(), outline.outline.segments.size()) << outline.name;
    EXPECT_EQ(*segments.begin(), 0);
  }
}

TEST(OutlineMesh, PutsCornersAndMiddlesOnItsArcs) {
  for (const double size : {0.3, 1.0, 10.0}) {
    const PlaneMesh mesh = mesh_outline(outlines()[3].outline, size);
    for (const BoundarySide& side : mesh.boundary) {
      EXPECT_NEAR(side.middle.norm(), 5.0, 1e-12);
      EXPECT_NEAR(mesh.points[static_cast<std::size_t>(side.corners[0])].norm(), 5.0, 1e-12);
    }
  }
}

TEST(OutlineMesh, KeepsToTheSizeAndRepeatsToTheBit) {
  for (const Named& outline : outlines()) {
    const PlaneMesh mesh = mesh_outline(outline.outline, outline.size);
    std::vector<std::vector<double>> elsewhere; // so that the next mesh lies in other memory
    for (std::size_t i = 1; i < 6; ++i) {
      elsewhere.emplace_back(977 * i * i);
      const PlaneMesh again = mesh_outline(outline.outline, outline.size);
      EXPECT_TRUE(mesh.points == again.points) << outline.name;
      EXPECT_TRUE(mesh.triangles == again.triangles) << outline.name;
    }
    double longest = 0.0;
    for (const auto& triangle : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        longest = std::max(longest, (mesh.points[static_cast<std::size_t>(triangle[i])] -
                                     mesh.points[static_cast<std::size_t>(triangle[(i + 1) % 3])])
                                        .norm());
    EXPECT_LE(longest, 1.5 * outline.size) << outline.name;
  }
}

TEST(OutlineMesh, RefusesWhatIsNoDomain) {
  const Profile square = outlines()[0].outline;
  Profile open = square;
  open.closed = false;
  EXPECT_THROW((void)mesh_outline(open, 1.0), Error);
  EXPECT_THROW((void)mesh_outline(square, 0.0), Error);
  EXPECT_THROW((void)mesh_outline(square, 1e-5), Error);
  const Profile crossing = chain({0, 0}, {{{10, 10}}, {{10, 0}}, {{0, 10}}});
  EXPECT_THROW((void)mesh_outline(crossing, 1.0), Error);
}

} // namespace
} // namespace billet::geometry::mesher_2d_test
