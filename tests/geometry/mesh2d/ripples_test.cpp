// Boundaries with ripples: sides pass over what is small for them and follow what is not.

#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "tests/support/sound_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace billet::geometry::ripples_test {
namespace {

constexpr double size = 1.0;
constexpr double pi = std::numbers::pi;
const RemeshSizes sizes{.min = 0.1, .max = size};

/// A square of 10 mm whose right wall has teeth of that height, ten to a mm; part 1 is that wall.
SideLoop with_teeth(double height) {
  SideLoop loop;
  const auto add = [&](const Vec2& a, const Vec2& b, std::int32_t part) {
    loop.corners.push_back(a);
    loop.middles.push_back(0.5 * (a + b));
    loop.part.push_back(part);
    loop.keep.push_back(0);
    loop.hold.push_back(0);
  };
  for (int i = 0; i < 10; ++i)
    add({i, 0.0}, {i + 1.0, 0.0}, 0);
  constexpr int teeth = 100;
  const auto wall = [&](int i) {
    return Vec2(10.0 + (i % 2 == 1 ? height : 0.0), 10.0 * i / (2.0 * teeth));
  };
  for (int i = 0; i < 2 * teeth; ++i)
    add(wall(i), wall(i + 1), 1);
  for (int i = 10; i > 0; --i)
    add({i, 10.0}, {i - 1.0, 10.0}, 2);
  for (int i = 10; i > 0; --i)
    add({0.0, i}, {0.0, i - 1.0}, 3);
  return loop;
}

/// How many sides of a new mesh lie on that wall.
long sides_of_wall(const SideLoop& loop) {
  const RemeshedDomain domain = remesh_domain(std::vector<SideLoop>{loop}, sizes, Measure::area);
  expect_sound(domain, "teeth");
  EXPECT_NEAR(domain.measure, domain.old_measure, 1e-9 * domain.old_measure);
  return std::count_if(domain.mesh.boundary.begin(), domain.mesh.boundary.end(),
                       [](const BoundarySide& side) { return side.segment == 1; });
}

TEST(Ripples, AreNoneForSidesThatAreLongEnough) {
  // A side of 1 mm that turns by 10 degrees leaves its chord by 0.022 mm.
  EXPECT_LE(sides_of_wall(with_teeth(0.015)), 12);
  EXPECT_GE(sides_of_wall(with_teeth(0.06)), 90);
}

TEST(Ripples, OnAToolAreItsOwn) {
  SideLoop loop = with_teeth(0.015);
  for (std::size_t i = 0; i < loop.part.size(); ++i)
    loop.hold[i] = loop.part[i] == 1 ? 1 : 0;
  EXPECT_GE(sides_of_wall(loop), 90);
}

TEST(Ripples, AreFollowedWhereShorterSidesAreAskedFor) {
  const SideLoop loop = with_teeth(0.015);
  RemeshSizes finer = sizes;
  finer.wanted = [](const Vec2&) { return 0.3; }; // a side of that leaves its chord by 0.0065
  const RemeshedDomain domain = remesh_domain(std::vector<SideLoop>{loop}, finer, Measure::area);
  EXPECT_GE(std::count_if(domain.mesh.boundary.begin(), domain.mesh.boundary.end(),
                          [](const BoundarySide& side) { return side.segment == 1; }),
            90);
}

TEST(Ripples, MayNotPassAKeptCorner) {
  SideLoop loop = with_teeth(0.015);
  const auto tooth = std::find(loop.part.begin(), loop.part.end(), 1) - loop.part.begin() + 101;
  loop.keep[static_cast<std::size_t>(tooth)] = 1;
  const RemeshedDomain domain = remesh_domain(std::vector<SideLoop>{loop}, sizes, Measure::area);
  const Vec2 kept = loop.corners[static_cast<std::size_t>(tooth)];
  EXPECT_NE(std::find(domain.mesh.points.begin(), domain.mesh.points.end(), kept),
            domain.mesh.points.end());
}

TEST(Ripples, CornersAreKeptWhateverTheSides) {
  const CornerRule rule{pi / 6.0, pi / 18.0, [](const Vec2&) { return size; }};
  const std::vector<char> even = kept_corners(with_teeth(0.0), rule);
  EXPECT_EQ(std::count(even.begin(), even.end(), 1), 4);
  const std::vector<char> rippled = kept_corners(with_teeth(0.015), rule);
  EXPECT_EQ(std::count(rippled.begin(), rippled.end(), 1), 4);
  const std::vector<char> toothed = kept_corners(with_teeth(0.06), rule);
  EXPECT_GE(std::count(toothed.begin(), toothed.end(), 1), 200);
}

TEST(Ripples, FlatFoldsAreNone) {
  // A lap 0.5 mm long and 0.004 mm thick on a wall.
  SideLoop loop = with_teeth(0.0);
  const auto first = std::find(loop.part.begin(), loop.part.end(), 1) - loop.part.begin() + 100;
  const double y = loop.corners[static_cast<std::size_t>(first)].y();
  loop.corners[static_cast<std::size_t>(first)] = {10.002, y + 0.5};
  loop.corners[static_cast<std::size_t>(first) + 1] = {9.998, y};
  for (auto i = static_cast<std::size_t>(first) - 1; i < static_cast<std::size_t>(first) + 2; ++i)
    loop.middles[i] = 0.5 * (loop.corners[i] + loop.corners[i + 1]);
  const CornerRule rule{pi / 6.0, pi / 18.0, [](const Vec2&) { return size; }};
  const std::vector<char> kept = kept_corners(loop, rule);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 6);
}

TEST(Ripples, OfALoopWithoutCornersAreFoundWhereverItBegins) {
  // A disc of 5 mm: a side of 0.4 mm leaves its chord by 0.004 mm, and may by 0.009 mm.
  SideLoop loop;
  constexpr int n = 400;
  const auto at = [&](double i) {
    const double radius = 5.0 + (std::lround(i) % 2 == 1 ? 0.003 : 0.0);
    return Vec2(radius * std::cos(2.0 * pi * i / n), radius * std::sin(2.0 * pi * i / n));
  };
  for (int i = 0; i < n; ++i) {
    loop.corners.push_back(at(i));
    loop.middles.push_back(0.5 * (at(i) + at(i + 1)));
    loop.part.push_back(0);
    loop.keep.push_back(0);
    loop.hold.push_back(0);
  }
  const CornerRule rule{pi / 60.0, pi / 18.0, [](const Vec2&) { return 2.0; }};
  const CornerRule without{.turn = pi / 60.0};
  const std::vector<char> all = kept_corners(loop, without);
  EXPECT_EQ(std::count(all.begin(), all.end(), 1), n);
  const std::vector<char> kept = kept_corners(loop, rule);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 0);
}

} // namespace
} // namespace billet::geometry::ripples_test
