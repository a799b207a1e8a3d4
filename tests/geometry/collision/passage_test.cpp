#include "geometry/collision/passage.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace billet::geometry::passage_test {
namespace {

/// A plate |x| < width/2, |y| < 5, |z| < 5.
SurfacePtr plate(double width) {
  TriangleMesh mesh = cube();
  for (Vec3& p : mesh.points)
    p = Vec3(width, 10, 10).cwiseProduct(p - Vec3::Constant(0.5));
  return make_triangle_surface(mesh);
}

bool passes(const RigidSurface& surface, const Vec3& from, const Vec3& to, double slack = 0.0) {
  const Motion still;
  return passage(surface, {still, {}, {}, from, to}, slack).has_value();
}

TEST(Passage, APointThroughAPlateOfAnyThicknessIsFound) {
  for (const double width : {1.0, 0.1, 1e-3, 1e-5})
    for (const double tilt : {0.0, 0.7}) {
      const SurfacePtr thin = plate(width);
      EXPECT_TRUE(passes(*thin, {-1, 0.1, 0.2}, {1, 0.1 + tilt, 0.2})) << width;
      EXPECT_FALSE(passes(*thin, {-1, 0.1, 0.2}, {-0.6, 0.1 + tilt, 0.2})) << width;
    }
}

TEST(Passage, ItIsTheMiddleThatTells) {
  const SurfacePtr thick = plate(1.0);
  EXPECT_FALSE(passes(*thick, {-0.6, 0, 0}, {-0.1, 0, 0})); // it is pushed out where it came in
  EXPECT_TRUE(passes(*thick, {-0.6, 0, 0}, {0.1, 0, 0}));
  EXPECT_FALSE(passes(*thick, {-0.45, 0, 0}, {-0.1, 0, 0}));
  EXPECT_TRUE(passes(*thick, {-0.45, 0, 0}, {0.1, 0, 0}));
  EXPECT_FALSE(passes(*thick, {-0.01, 0, 0}, {0.01, 0, 0}, 0.05)) << "within the slack";
}

TEST(Passage, AWayRoundTheEdgeIsNone) {
  const SurfacePtr thin = plate(0.01);
  EXPECT_FALSE(passes(*thin, {-1, 5.01, 0}, {1, 5.01, 0}));
  EXPECT_FALSE(passes(*thin, {-1, 4.5, 0}, {1, 5.6, 0}));
  EXPECT_TRUE(passes(*thin, {-1, 4.98, 0}, {1, 4.99, 0}));
}

TEST(Passage, SlidingAlongAThickToolIsNone) {
  const SurfacePtr block = plate(4.0), ball = make_sphere(Vec3::Zero(), 1.0, false);
  EXPECT_FALSE(passes(*block, {-2, 0, 0}, {-2, 1, 0}));
  EXPECT_FALSE(passes(*block, {-2.001, 4.9, 0}, {-1.9, 5.001, 0})) << "over a square corner";
  EXPECT_FALSE(passes(*ball, {0, 1, 0}, {0.5, 0.9, 0}));
  EXPECT_TRUE(passes(*ball, {0, 1.2, 0}, {0, -1.2, 0}));
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, 1, 0});
  EXPECT_FALSE(passes(*plane, {0, 1, 0}, {0, -50, 0})) << "half of space has no other side";
  const SurfacePtr bore = make_cylinder({0, 0, 0}, {0, 0, 1}, 1.0, true);
  EXPECT_FALSE(passes(*bore, {-1, 0, 0}, {1, 0, 0})) << "across a bore, from wall to wall";
}

TEST(Passage, APaddleThatTurnsThroughAPointIsFound) {
  // A blade of a wheel, in the plane: 0.1 thick, from radius 2 to 5, turning about the origin.
  const std::vector<Vec2> blade{{2, -0.05}, {5, -0.05}, {5, 0.05}, {2, 0.05}};
  const SurfacePtr paddle = make_profile(polygon(blade, true));
  Motion motion;
  motion.rotation = Rotation{Vec3::Zero(), Vec3::UnitZ(), 1.0};
  const auto turned = [&](double from, double to, const Vec3& x) {
    return passage(*paddle, {motion, {Vec3::Zero(), from}, {Vec3::Zero(), to}, x, x}, 0.0);
  };
  const auto place = turned(-0.3, 0.3, {3, 0, 0});
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place - Vec3(3, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(turned(-0.3, 2.0 * std::numbers::pi - 0.4, {3, 0, 0})) << "once round";
  EXPECT_FALSE(turned(-0.3, 0.3, {1.9, 0, 0}));
  EXPECT_FALSE(turned(-0.3, 0.3, {5.1, 0, 0}));
  EXPECT_FALSE(turned(0.1, 0.5, {3, 0, 0}));
}

TEST(Passage, APointThatRidesOnATurningToolOrSeesARollSpinDoesNotPass) {
  Motion motion;
  motion.rotation = Rotation{Vec3::Zero(), Vec3::UnitZ(), 1.0};
  const SurfacePtr roll = make_cylinder({0, 0, 0}, {0, 0, 1}, 1.0, false);
  const Vec3 x(0, 0.999, 0);
  EXPECT_FALSE(passage(*roll, {motion, {}, {Vec3::Zero(), 3.0}, x, x}, 0.0));
  const SurfacePtr thin = plate(0.2);
  const Vec3 carried = rotation_about(Vec3::Zero(), Vec3::UnitZ(), 0.4).to_space({-0.11, 0, 0});
  EXPECT_FALSE(passage(*thin, {motion, {}, {Vec3::Zero(), 0.4}, {-0.11, 0, 0}, carried}, 0.0));
}

TEST(Passage, APointAtTheTipOfAWedgeMayEnterIt) {
  const std::vector<Vec2> wedge{{-0.2, 1}, {0, 0}, {0.2, 1}};
  const SurfacePtr tool = make_profile(polygon(wedge, false));
  EXPECT_FALSE(passes(*tool, {0, -0.01, 0}, {0, 0.001, 0}));
  EXPECT_FALSE(passes(*tool, {1e-6, 0.01, 0}, {-1e-6, 0.011, 0}, 0.02));
}

TEST(Passage, TheWayIsNeverShorterThanThePathInTheToolsFrame) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto vector = [&] { return Vec3(any(generator), any(generator), any(generator)); };
  for (int k = 0; k < 100; ++k) {
    Motion motion;
    motion.rotation = Rotation{vector(), vector().normalized(), 1.0};
    motion.offset = vector();
    const Encounter e{
        motion, {vector(), any(generator)}, {vector(), 3.0 * any(generator)}, vector(), vector()};
    double length = 0.0;
    Vec3 before = motion.pose_at(e.tool_old.shift, e.tool_old.angle).to_tool(e.point_old);
    constexpr int n = 200;
    for (int i = 1; i <= n; ++i) {
      const double s = static_cast<double>(i) / n;
      const Vec3 now = motion
                           .pose_at(e.tool_old.shift + s * (e.tool_new.shift - e.tool_old.shift),
                                    e.tool_old.angle + s * (e.tool_new.angle - e.tool_old.angle))
                           .to_tool(e.point_old + s * (e.point_new - e.point_old));
      length += (now - before).norm();
      before = now;
    }
    EXPECT_GE(way(e), length);
    EXPECT_LE(way(e), 2.5 * length)
        << "the mean of a linear velocity is 0.41 of its largest at least";
  }
}

TEST(Passage, RandomWaysThroughABumpyBodyAgreeWithDenseSampling) {
  const TriangleMesh mesh = star(8, [](const Vec3& n) { return 1.0 + 0.1 * n.x() * n.y(); });
  const SurfacePtr tool = make_triangle_surface(mesh);
  std::mt19937 generator(17);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto around = [&] {
    return Vec3(1.6 * Vec3(normal(generator), normal(generator), normal(generator)).normalized());
  };
  int through = 0, clear = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 u = around(), v = around();
    double deepest = far;
    constexpr int n = 500;
    for (int i = 0; i <= n; ++i)
      deepest = std::min(deepest, projection(*tool, u + (v - u) * i / n).gap);
    if (deepest > 0.01) {
      ++clear;
      EXPECT_FALSE(passes(*tool, u, v)) << k;
    } else if (deepest < -0.6) { // it leaves by the opposite side
      ++through;
      EXPECT_TRUE(passes(*tool, u, v)) << k;
    }
  }
  EXPECT_GT(through, 10);
  EXPECT_GT(clear, 20);
}

} // namespace
} // namespace billet::geometry::passage_test
