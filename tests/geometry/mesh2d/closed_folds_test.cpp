// Creases of a boundary whose walls have met, and the boundary without them.

#include "geometry/base/angle.h"
#include "geometry/mesh2d/closed_folds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::geometry::closed_folds_test {
namespace {

/// Straight sides between points, each cut into pieces of about `size`.
SideLoop straight(const std::vector<Vec2>& points, double size) {
  SideLoop loop;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i], way = points[(i + 1) % points.size()] - a;
    const int pieces = std::max(1, static_cast<int>(way.norm() / size));
    for (int k = 0; k < pieces; ++k) {
      loop.corners.emplace_back(a + k * way / pieces);
      loop.middles.emplace_back(a + (k + 0.5) * way / pieces);
      loop.part.push_back(0);
      loop.keep.push_back(0);
      loop.hold.push_back(0);
    }
  }
  return loop;
}

/// A square of 10 with a crease from above, 1 deep and `mouth` wide; below 0 its lips overlap.
SideLoop creased(double mouth, double bottom = 0.1) {
  return straight({{0, 0},
                   {10, 0},
                   {10, 10},
                   {5 + 0.5 * mouth, 10},
                   {5 + 0.5 * bottom, 9},
                   {5 - 0.5 * bottom, 9},
                   {5 - 0.5 * mouth, 10},
                   {0, 10}},
                  0.5);
}

double area(const SideLoop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    const Vec2 &a = loop.corners[i], &b = loop.corners[(i + 1) % loop.corners.size()];
    twice += cross(a, loop.middles[i]) + cross(loop.middles[i], b);
  }
  return 0.5 * twice;
}

std::optional<ClosedFold> fold_of(const SideLoop& loop, double near = 0.0) {
  return closed_fold(loop, std::vector<char>(loop.corners.size(), 0), near);
}

TEST(ClosedFolds, WallsThatCrossAreFoundAndWelded) {
  const SideLoop loop = creased(-0.2);
  const auto fold = fold_of(loop);
  ASSERT_TRUE(fold);
  // The walls cross a third of the way up; the lips' tops lie over each other as well.
  EXPECT_NEAR(fold->at.x(), 5.0, 0.1 + 1e-12);
  EXPECT_GT(fold->at.y(), 9.3);
  const WeldedLoop welded = without_fold(loop, *fold, 0.3);
  EXPECT_FALSE(fold_of(welded.loop));
  EXPECT_LT(welded.loop.corners.size(), loop.corners.size());
  EXPECT_NEAR(area(welded.loop), 100.0, 0.1);
}

TEST(ClosedFolds, ACreaseThatIsOpenIsNone) { EXPECT_FALSE(fold_of(creased(0.2))); }

TEST(ClosedFolds, ANarrowCreaseIsFilledToWhereItIsAsWideAsAskedFor) {
  const SideLoop loop = creased(0.05, 0.05);
  EXPECT_FALSE(fold_of(loop, 0.04));
  const auto fold = fold_of(loop, 0.06);
  ASSERT_TRUE(fold);
  EXPECT_NEAR(fold->depth(), 1.0, 0.1);
  const WeldedLoop welded = without_fold(loop, *fold, 0.3);
  EXPECT_NEAR(area(welded.loop), 100.0, 0.02);
  EXPECT_FALSE(fold_of(welded.loop, 0.06));
  // Numbers of sides and corners are those of the old loop, but for the weld's.
  EXPECT_EQ(std::count(welded.corners.begin(), welded.corners.end(), -1), 1);
  for (std::size_t i = 0; i < welded.sides.size(); ++i)
    if (welded.corners[i] >= 0) {
      EXPECT_EQ(welded.loop.corners[i], loop.corners[static_cast<std::size_t>(welded.corners[i])]);
    }
}

constexpr double deepest = 0.3;

/// The root of a crease, no deeper than that.
std::optional<ClosedFold> root_of(const SideLoop& loop, const std::vector<Vec2>& welds = {}) {
  return closed_fold(loop, std::vector<char>(loop.corners.size(), 0), 0.06, deepest, welds);
}

TEST(ClosedFolds, NoDeeperThanAskedForIsTheRootAlone) {
  const SideLoop loop = creased(0.05, 0.05);
  const auto root = root_of(loop);
  ASSERT_TRUE(root);
  EXPECT_LE(root->depth(), deepest);
  EXPECT_GT(root->depth(), 0.5 * deepest);
  EXPECT_NEAR(root->at.y(), 9.0 + root->depth(), 0.05);
  // The crease is that much less deep.
  const WeldedLoop welded = without_fold(loop, *root, 0.05);
  const auto rest = fold_of(welded.loop, 0.06);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->depth(), 1.0 - root->depth(), 0.1);
}

TEST(ClosedFolds, TheRestOfAWeldedCreaseIsLeftForTheNextOne) {
  const SideLoop loop = creased(0.05, 0.05);
  const auto root = root_of(loop);
  ASSERT_TRUE(root);
  const std::vector<Vec2> here{root->at}, elsewhere{root->at + Vec2(2.1 * deepest, 0)};
  const WeldedLoop welded = without_fold(loop, *root, 0.05);
  EXPECT_FALSE(root_of(welded.loop, here));
  EXPECT_TRUE(root_of(welded.loop, elsewhere));
}

TEST(ClosedFolds, SidesThatBulgeCrossNextToTheirCorner) {
  SideLoop loop =
      straight({{0, 0}, {10, 0}, {10, 10}, {5.5, 10}, {5, 10}, {4.5, 10}, {0, 10}}, 0.5);
  const auto bulge = [&](const Vec2& from, const Vec2& middle) {
    const auto side = std::find(loop.corners.begin(), loop.corners.end(), from);
    ASSERT_NE(side, loop.corners.end());
    loop.middles[static_cast<std::size_t>(side - loop.corners.begin())] = middle;
  };
  // Parabolas that meet again where a sixth of each is left.
  bulge({5.5, 10}, {5.1, 10.3});
  bulge({5, 10}, {4.9, 10.3});
  const auto fold = fold_of(loop);
  ASSERT_TRUE(fold);
  EXPECT_NEAR(fold->at.x(), 5.0, 1e-9);
  EXPECT_NEAR(fold->at.y(), 10.0 + 1.0 / 6.0, 0.01);
  EXPECT_FALSE(fold_of(without_fold(loop, *fold, 0.1).loop));
}

TEST(ClosedFolds, AThinWebIsNoFold) {
  // The same shape of the boundary with the metal between the walls.
  const SideLoop loop = straight(
      {{0, 0}, {10, 0}, {10, 10}, {5.025, 10}, {5.025, 11}, {4.975, 11}, {4.975, 10}, {0, 10}},
      0.5);
  EXPECT_FALSE(fold_of(loop, 0.1));
}

TEST(ClosedFolds, AHoleFoldsAsWell) {
  // The same shapes as holes: the metal is on the other side of the way.
  const auto hole = [](std::vector<Vec2> points) {
    std::reverse(points.begin(), points.end());
    return straight(points, 0.5);
  };
  const std::vector<Vec2> with_spur{{0, 0},      {10, 0},     {10, 10},    {5.025, 10},
                                    {5.025, 11}, {4.975, 11}, {4.975, 10}, {0, 10}};
  EXPECT_TRUE(fold_of(hole(with_spur), 0.06)) << "a crease in the metal around";
  const std::vector<Vec2> with_web{{0, 0},     {10, 0},    {10, 10},    {5.025, 10},
                                   {5.025, 9}, {4.975, 9}, {4.975, 10}, {0, 10}};
  EXPECT_FALSE(fold_of(hole(with_web), 0.06)) << "a thin web of metal";
}

TEST(ClosedFolds, WhatIsSupportedStays) {
  const SideLoop loop = creased(-0.2);
  ASSERT_TRUE(fold_of(loop));
  std::vector<char> stays(loop.corners.size(), 0);
  for (std::size_t i = 0; i < stays.size(); ++i)
    stays[i] = loop.corners[i].y() == 9.0 ? 1 : 0;
  EXPECT_FALSE(closed_fold(loop, stays, 0.0));
}

TEST(ClosedFolds, HalfOfAPartIsNoFold) {
  const SideLoop loop = straight({{0, 0}, {4, 4}, {4, 0}, {0, 3}}, 0.5);
  EXPECT_FALSE(fold_of(loop));
}

TEST(ClosedFolds, ASideShorterThanAskedForIsJoinedAtTheWeld) {
  const SideLoop loop = creased(-0.2);
  const WeldedLoop welded = without_fold(loop, *fold_of(loop), 0.8);
  const std::vector<Vec2>& corners = welded.loop.corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool at_weld = welded.corners[i] < 0 || welded.corners[(i + 1) % corners.size()] < 0;
    if (at_weld) {
      EXPECT_GE((corners[(i + 1) % corners.size()] - corners[i]).norm(), 0.8);
    }
  }
}

} // namespace
} // namespace billet::geometry::closed_folds_test
