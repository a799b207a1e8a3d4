// A boundary that lies inside a tool is divided and laid on it before it is resampled.

#include "geometry/mesh2d/domain_remesher.h"
#include "geometry/mesh2d/snapped_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace billet::geometry::snapped_loops_test {
namespace {

/// Depth of a wedge of 90 degrees pointing down at x = 1 into the square [0, 2] x [-2, 0].
constexpr double depth = 0.3;

/// Square of straight sides of length 1; part 1 is the top.
SideLoop square() {
  SideLoop loop;
  const std::vector<Vec2> corners{{0, -2}, {1, -2}, {2, -2}, {2, -1},
                                  {2, 0},  {1, 0},  {0, 0},  {0, -1}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& next = corners[(i + 1) % corners.size()];
    const bool top = corners[i].y() == 0.0 && next.y() == 0.0;
    loop.corners.push_back(corners[i]);
    loop.middles.push_back(0.5 * (corners[i] + next));
    loop.part.push_back(top ? 1 : 0);
    loop.keep.push_back(0);
    loop.hold.push_back(static_cast<char>(corners[i].y() + next.y() < -1.0)); // but the top
  }
  return loop;
}

/// Of the wedge's surface over x.
double wedge(double x) { return std::abs(x - 1.0) - depth; }

/// Down onto the wedge where it has entered.
Vec2 onto_wedge(std::int32_t part, const BoundaryPlace&, const Vec2& x) {
  return part == 1 && x.y() > wedge(x.x()) ? Vec2(x.x(), wedge(x.x())) : x;
}

TEST(SnappedLoops, SidesThatLieDeepAreDivided) {
  const std::vector<SideLoop> loops{square()};
  const SnappedLoops snapped(loops, onto_wedge, 0.1);
  const SideLoop& loop = snapped.loops().front();
  // The two sides of the top, with the length 1, in ten pieces each.
  EXPECT_EQ(loop.corners.size(), 6U + 2U * 10U);
  for (std::size_t i = 0; i < loop.corners.size(); ++i)
    for (const Vec2& x : {loop.corners[i], loop.middles[i]})
      EXPECT_TRUE(loop.part[i] != 1 || x.y() <= wedge(x.x()) + 1e-15);
  EXPECT_EQ(std::count(loop.part.begin(), loop.part.end(), 1), 20);
}

TEST(SnappedLoops, PlacesAreThoseOfTheLoopsBefore) {
  const std::vector<SideLoop> loops{square()};
  const SnappedLoops snapped(loops, onto_wedge, 0.1);
  const SideLoop& loop = snapped.loops().front();
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    const auto side = static_cast<std::int32_t>(i);
    for (const double xi : {0.0, 0.5, 1.0}) {
      const BoundaryPlace place = snapped.original({0, side, xi});
      const Vec2& x = xi == 0.0   ? loop.corners[i]
                      : xi == 0.5 ? loop.middles[i]
                                  : loop.corners[(i + 1) % loop.corners.size()];
      // The wedge moves points down only, and the sides are straight.
      const auto old = static_cast<std::size_t>(place.side);
      const Vec2& a = loops[0].corners[old];
      const Vec2& b = loops[0].corners[(old + 1) % loops[0].corners.size()];
      EXPECT_NEAR(a.x() + place.xi * (b.x() - a.x()), x.x(), 1e-14);
    }
  }
}

TEST(SnappedLoops, WithoutAnythingToDoTheyStayToTheBit) {
  const std::vector<SideLoop> loops{square()};
  for (const Snap& snap :
       {Snap{}, Snap([](std::int32_t, const BoundaryPlace&, const Vec2& x) { return x; })}) {
    const SnappedLoops snapped(loops, snap, 0.1);
    EXPECT_EQ(snapped.loops().front().corners, loops[0].corners);
    EXPECT_EQ(snapped.loops().front().middles, loops[0].middles);
    EXPECT_EQ(snapped.original({0, 3, 0.25}).xi, 0.25);
  }
}

TEST(SnappedLoops, PiecesWithoutLengthAreJoined) {
  const std::vector<SideLoop> loops{square()};
  // All of the top goes to one point but for its ends.
  const Snap to_a_point = [](std::int32_t part, const BoundaryPlace&, const Vec2& x) {
    return part == 1 && x.x() > 0.2 && x.x() < 1.8 ? Vec2(1.0, -0.5) : x;
  };
  const SnappedLoops snapped(loops, to_a_point, 0.1);
  const SideLoop& loop = snapped.loops().front();
  const std::size_t n = loop.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = loop.corners[i], &m = loop.middles[i], &b = loop.corners[(i + 1) % n];
    EXPECT_GT((b - a).norm(), 1e-4);
    EXPECT_GT((m - a).norm(), 1e-4);
    EXPECT_GT((b - m).norm(), 1e-4);
  }
}

TEST(SnappedLoops, ANotchIsMeshedWithSoundSidesAndTheMeasureKept) {
  const std::vector<SideLoop> loops{square()};
  const RemeshedDomain domain = remesh_domain(loops, {0.05, 0.5}, Measure::area, onto_wedge);
  EXPECT_NEAR(domain.old_measure, 4.0, 1e-14);
  EXPECT_NEAR(domain.measure, 4.0, 4e-10);
  // Middles stay in the middle though the tip went a third of the largest side.
  for (const BoundarySide& side : domain.mesh.boundary) {
    const Vec2& a = domain.mesh.points[static_cast<std::size_t>(side.corners[0])];
    const Vec2& b = domain.mesh.points[static_cast<std::size_t>(side.corners[1])];
    const double first = (side.middle - a).norm(), second = (b - side.middle).norm();
    EXPECT_LT(std::max(first, second), 1.5 * std::min(first, second));
  }
  const auto lowest =
      std::min_element(domain.mesh.boundary.begin(), domain.mesh.boundary.end(),
                       [&](const BoundarySide& a, const BoundarySide& b) {
                         const auto height = [&](const BoundarySide& side) {
                           const Vec2& x =
                               domain.mesh.points[static_cast<std::size_t>(side.corners[0])];
                           return side.segment == 1 && std::abs(x.x() - 1.0) < 0.5 ? x.y() : 1.0;
                         };
                         return height(a) < height(b);
                       });
  EXPECT_NEAR(domain.mesh.points[static_cast<std::size_t>(lowest->corners[0])].y(), -depth, 0.03);
}

} // namespace
} // namespace billet::geometry::snapped_loops_test
