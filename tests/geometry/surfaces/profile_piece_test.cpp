#include "geometry/surfaces/profile_piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::geometry::profile_piece_test {
namespace {

constexpr double rounding = 1e-13; // coordinates up to 3
constexpr double pi = std::numbers::pi;

TEST(ProfilePiece, ArcsTurnTheWayTheirRadiusSays) {
  // From (0, 0) to (1, 1): the centre is (0, 1) for a left turn, (1, 0) for a right turn.
  const ProfilePiece left = make_piece({0, 0}, {{1, 1}, 1.0});
  EXPECT_NEAR((left.centre - Vec2(0, 1)).norm(), 0.0, rounding);
  EXPECT_NEAR((left.tangent_a - Vec2(1, 0)).norm(), 0.0, rounding);
  EXPECT_NEAR((left.tangent_b - Vec2(0, 1)).norm(), 0.0, rounding);
  EXPECT_NEAR(left.length(), 0.5 * pi, rounding);
  const ProfilePiece right = make_piece({0, 0}, {{1, 1}, -1.0});
  EXPECT_NEAR((right.centre - Vec2(1, 0)).norm(), 0.0, rounding);
  EXPECT_NEAR((right.tangent_a - Vec2(0, 1)).norm(), 0.0, rounding);
  const ProfilePiece large = make_piece({0, 0}, {{1, 1}, 1.0, true});
  EXPECT_NEAR((large.centre - Vec2(1, 0)).norm(), 0.0, rounding);
  EXPECT_NEAR(large.length(), 1.5 * pi, rounding);
  EXPECT_NEAR((large.tangent_a - Vec2(0, -1)).norm(), 0.0, rounding);
}

TEST(ProfilePiece, PointsRunFromStartToEndAtTheRadius) {
  for (const ProfileSegment& segment :
       {ProfileSegment{{1, 1}}, ProfileSegment{{1, 1}, 0.8}, ProfileSegment{{1, 1}, -0.8},
        ProfileSegment{{1, 1}, 0.8, true}, ProfileSegment{{1, 1}, -0.8, true}}) {
    const ProfilePiece piece = make_piece({0.2, -0.1}, segment);
    EXPECT_NEAR((piece.point(0.0) - piece.a).norm(), 0.0, rounding);
    EXPECT_NEAR((piece.point(1.0) - piece.b).norm(), 0.0, rounding);
    constexpr double h = 1e-6;
    EXPECT_NEAR((piece.point(h) - piece.a).normalized().dot(piece.tangent_a), 1.0, 1e-9);
    EXPECT_NEAR((piece.b - piece.point(1.0 - h)).normalized().dot(piece.tangent_b), 1.0, 1e-9);
    for (double s = 0.05; s < 1.0; s += 0.05) {
      const Vec2 x = piece.point(s);
      const ClosestOnPiece closest = piece.closest(x);
      EXPECT_NEAR(closest.distance2, 0.0, rounding);
      EXPECT_EQ(closest.place, Place::interior);
      const Box box = piece.bounds();
      EXPECT_GE(x.x(), box.low.x() - rounding);
      EXPECT_LE(x.y(), box.high.y() + rounding);
    }
  }
}

TEST(ProfilePiece, HalfATurnGoesTheRightWayRound) {
  const ProfilePiece left = make_piece({0, 0}, {{2, 0}, 1.0});
  EXPECT_NEAR((left.point(0.5) - Vec2(1, -1)).norm(), 0.0, rounding);
  const ProfilePiece right = make_piece({0, 0}, {{2, 0}, -1.0});
  EXPECT_NEAR((right.point(0.5) - Vec2(1, 1)).norm(), 0.0, rounding);
}

TEST(ProfilePiece, AnOpenProfileKeepsItsEndsAndAClosedOneGetsItsLine) {
  Profile profile;
  profile.segments = {{{1, 0}}, {{1, 1}}};
  EXPECT_EQ(pieces(profile).size(), 2U);
  profile.closed = true;
  EXPECT_EQ(pieces(profile).size(), 3U);
  EXPECT_EQ(pieces(profile).back().b, profile.start);
  EXPECT_NEAR(size(profile), std::sqrt(2.0), rounding);
}

} // namespace
} // namespace billet::geometry::profile_piece_test
