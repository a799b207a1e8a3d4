#include "geometry/base/error.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

namespace billet::geometry::triangle_surface_test {
namespace {

constexpr double rounding = 1e-12; // coordinates up to 3

std::vector<TriangleMesh> bodies() {
  return {cube(), angle_bar(), sphere_mesh(8), spiky(6), flipped(spiky(5))};
}

std::vector<Vec3> around(const TriangleMesh& mesh, std::size_t n) {
  std::vector<Vec3> points = random_points(n, 2.5);
  // Points close to every corner and to the middle of every side, on both sides of the surface.
  std::mt19937 generator(3);
  std::normal_distribution<double> offset(0.0, 0.05);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = corner(mesh, t, i), b = corner(mesh, t, (i + 1) % 3);
      for (const Vec3& x : {a, Vec3(0.5 * (a + b))})
        points.emplace_back(x + Vec3(offset(generator), offset(generator), offset(generator)));
    }
  return points;
}

TEST(TriangleSurface, GapIsTheDistanceToAllTrianglesWithTheSignOfTheWindingNumber) {
  for (const TriangleMesh& mesh : bodies()) {
    const SurfacePtr surface = make_triangle_surface(mesh);
    for (const Vec3& x : around(mesh, 400)) {
      const Projection p = projection(*surface, x);
      const double expected = brute_distance(mesh, x);
      ASSERT_NEAR(std::abs(p.gap), expected, rounding);
      // An inside-out body winds -1 times about its inside, which is its free side.
      const double w = winding(mesh, x);
      const bool in_tool = health(mesh).volume > 0.0 ? w > 0.5 : w > -0.5;
      if (expected > rounding) {
        EXPECT_EQ(p.gap < 0.0, in_tool) << x.transpose();
      }
    }
  }
}

TEST(TriangleSurface, NormalIsTheGradientOfTheGapAndDnormalDxItsDerivative) {
  for (const TriangleMesh& mesh : bodies()) {
    const SurfacePtr surface = make_triangle_surface(mesh);
    const std::vector<Vec3> points = around(mesh, 400);
    std::size_t checked = 0;
    for (const Vec3& x : points) {
      expect_consistent(*surface, x);
      checked += expect_derivatives(*surface, x) ? 1 : 0;
    }
    EXPECT_GT(checked, points.size() * 8 / 10); // the others are too close to a corner
  }
}

TEST(TriangleSurface, ACubeIsRightAtEdgesAndVertices) {
  const SurfacePtr surface = make_triangle_surface(cube());
  const Projection vertex = projection(*surface, {1.2, 1.3, 1.6});
  EXPECT_NEAR(vertex.gap, 0.7, rounding);
  EXPECT_NEAR((vertex.normal - Vec3(2, 3, 6) / 7.0).norm(), 0.0, rounding);
  EXPECT_NEAR(vertex.dnormal_dx.trace(), 2.0 / 0.7, 1e-10);
  const Projection edge = projection(*surface, {1.3, 1.4, 0.3});
  EXPECT_NEAR(edge.gap, 0.5, rounding);
  EXPECT_NEAR(edge.dnormal_dx.trace(), 1.0 / 0.5, 1e-10);
  EXPECT_EQ((edge.dnormal_dx * Vec3::UnitZ()).norm(), 0.0);
  const Projection face = projection(*surface, {0.9, 0.4, 0.3});
  EXPECT_NEAR(face.gap, -0.1, rounding);
  EXPECT_NEAR((face.normal - Vec3::UnitX()).norm(), 0.0, rounding);
  EXPECT_EQ(face.dnormal_dx, Mat3::Zero());
  for (const Vec3& on : {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 0.5, 1), Vec3(0.5, 0.5, 1)}) {
    const Projection p = projection(*surface, on);
    EXPECT_NEAR(p.gap, 0.0, rounding);
    EXPECT_NEAR(p.normal.norm(), 1.0, rounding);
  }
}

TEST(TriangleSurface, BehindAConcaveEdgeTheNormalPointsAtTheEdge) {
  const SurfacePtr surface = make_triangle_surface(angle_bar());
  const Projection p = projection(*surface, {1.0 - 0.15, 1.0 - 0.2, 0.7});
  EXPECT_NEAR(p.gap, -0.25, rounding);
  EXPECT_NEAR((p.normal - Vec3(0.6, 0.8, 0.0)).norm(), 0.0, rounding);
  EXPECT_NEAR(p.dnormal_dx.trace(), -1.0 / 0.25, 1e-10);
  EXPECT_NEAR(projection(*surface, {1.2, 1.3, 0.7}).gap, 0.2, rounding);
}

TEST(TriangleSurface, TheResultDoesNotDependOnTheHint) {
  for (const TriangleMesh& mesh : bodies()) {
    const SurfacePtr surface = make_triangle_surface(mesh);
    std::vector<Vec3> points = around(mesh, 50);
    // Ties: centres, axes of symmetry, and points over shared edges and vertices.
    for (const double t : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5})
      points.insert(points.end(), {{t, t, t}, {0.5, 0.5, t}, {t, 0, 0}, {0.5, t, t}, {1, 1, t}});
    const auto n = static_cast<std::int32_t>(mesh.triangles.size());
    for (const Vec3& x : points) {
      const Projection p = projection(*surface, x);
      EXPECT_GE(p.patch, 0);
      for (std::int32_t hint = 0; hint < n + 3; hint += n / 12)
        EXPECT_TRUE(same_bits(p, projection(*surface, x, far, hint))) << x.transpose();
      // A tighter reach is another bound of the walk, too.
      EXPECT_TRUE(same_bits(p, projection(*surface, x, 1.0000001 * std::abs(p.gap) + rounding)));
    }
  }
}

TEST(TriangleSurface, APointThatMovesFindsWhatASearchFinds) {
  for (const TriangleMesh& mesh : {icosphere(3), spiky(8), angle_bar()}) {
    const SurfacePtr surface = make_triangle_surface(mesh);
    Projection last;
    for (int k = 0; k < 20'000; ++k) {
      const double s = 1e-3 * k;
      const Vec3 on_sphere(std::sin(s) * std::cos(1.3 * s), std::sin(s) * std::sin(1.3 * s),
                           std::cos(s));
      const Vec3 x = (1.0 + 0.1 * std::sin(0.7 * s)) * on_sphere;
      last = projection(*surface, x, far, last.patch);
      ASSERT_TRUE(same_bits(last, projection(*surface, x))) << x.transpose();
    }
  }
}

TEST(TriangleSurface, ManyThreadsGiveTheSameBits) {
  const SurfacePtr surface = make_triangle_surface(spiky(12));
  const std::vector<Vec3> points = random_points(4000, 2.0);
  std::vector<std::vector<Projection>> results(4, std::vector<Projection>(points.size()));
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&] { surface->project(points, far, result); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto& result : results)
      EXPECT_TRUE(same_bits(result[i], results[0][i]));
}

TEST(TriangleSurface, PointsBeyondReachAreNotFound) {
  const SurfacePtr surface = make_triangle_surface(spiky(6));
  for (const Vec3& x : random_points(300, 2.0)) {
    const double gap = std::abs(projection(*surface, x).gap);
    EXPECT_FALSE(projection(*surface, x, 0.999 * gap).found());
    EXPECT_TRUE(projection(*surface, x, 1.001 * gap).found());
  }
}

TEST(TriangleSurface, AnOpenSheetHasAFrontAndNothingBeyondItsRim) {
  const SurfacePtr flat = make_triangle_surface(sheet(4, [](double, double) { return 0.0; }));
  EXPECT_NEAR(projection(*flat, {0.3, 0.4, 0.2}).gap, 0.2, rounding);
  EXPECT_NEAR(projection(*flat, {0.3, 0.4, -0.2}).gap, -0.2, rounding);
  const Projection beside = projection(*flat, {1.3, 0.4, 0.4});
  EXPECT_NEAR(beside.gap, 0.5, rounding);
  EXPECT_NEAR((beside.normal - Vec3(0.6, 0, 0.8)).norm(), 0.0, rounding);
  expect_derivatives(*flat, {1.3, 0.4, 0.4});
  const Projection corner_front = projection(*flat, {1.2, 1.3, 0.6});
  EXPECT_NEAR(corner_front.gap, 0.7, rounding);
  expect_derivatives(*flat, {1.2, 1.3, 0.6});
  for (const Vec3& x : {Vec3(1.3, 0.4, -0.4), Vec3(-0.1, 0.4, -1e-6), Vec3(1.2, 1.3, -0.6),
                        Vec3(1.2, 0.5, -1e-9), Vec3(-0.01, -0.01, -0.01)})
    EXPECT_FALSE(projection(*flat, x).found()) << x.transpose();
}

TEST(TriangleSurface, APointOnTheBorderPlaneStillSeesTheSheet) {
  const SurfacePtr flat = make_triangle_surface(sheet(4, [](double, double) { return 0.0; }));
  for (const double x : {0.0, 1e-17, -1e-17, -1e-10})
    for (const double y : {0.4, 0.5, 0.0, -1e-17}) {
      const Projection p = projection(*flat, {x, y, -1e-3});
      EXPECT_NEAR(p.gap, -1e-3, rounding);
      EXPECT_NEAR((p.normal - Vec3::UnitZ()).norm(), 0.0, rounding);
    }
}

TEST(TriangleSurface, ACurvedOpenSheetIsSignedByItsFrontAwayFromTheRim) {
  const auto f = [](double x, double y) { return 0.2 * std::sin(5 * x) * std::cos(4 * y); };
  const TriangleMesh mesh = sheet(12, f);
  const SurfacePtr surface = make_triangle_surface(mesh);
  for (Vec3 x : random_points(500, 0.5)) {
    x = Vec3(0.5, 0.5, 0.0) + 0.7 * x; // well within the rim
    const Projection p = projection(*surface, x);
    ASSERT_TRUE(p.found());
    EXPECT_NEAR(std::abs(p.gap), brute_distance(mesh, x), rounding);
    if (std::abs(p.gap) > 0.01) { // chords of the sheet
      EXPECT_EQ(p.gap > 0.0, x.z() > f(x.x(), x.y()));
    }
  }
}

TEST(TriangleSurface, GapsScaleWithTheUnitOfLength) {
  const TriangleMesh mesh = spiky(6);
  const SurfacePtr big = make_triangle_surface(mesh);
  for (const double unit : {1e-3, 1e-6, 1e6}) {
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.points)
      p *= unit;
    const SurfacePtr small = make_triangle_surface(scaled);
    for (const Vec3& x : random_points(200, 2.0)) {
      const Projection p = projection(*big, x), q = projection(*small, unit * x, unit * far);
      EXPECT_NEAR(q.gap / unit, p.gap, rounding);
    }
  }
}

TEST(TriangleSurface, ASphereOfTrianglesApproachesTheSphere) {
  const std::int32_t n = 60;
  const SurfacePtr surface = make_triangle_surface(sphere_mesh(n));
  const double sagitta = 1.5 * std::pow(std::numbers::pi / n, 2) / 4; // of a cell's diagonal
  for (const Vec3& x : random_points(500, 2.0))
    EXPECT_NEAR(projection(*surface, x).gap, x.norm() - 1.0, sagitta);
}

TEST(TriangleSurface, OneTriangleIsEnough) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const SurfacePtr surface = make_triangle_surface(mesh);
  EXPECT_NEAR(projection(*surface, {0.2, 0.2, 0.5}).gap, 0.5, rounding);
  EXPECT_NEAR(projection(*surface, {0.2, 0.2, -0.5}).gap, -0.5, rounding);
  EXPECT_FALSE(projection(*surface, {0.2, 0.2, 2.0}, 1.0).found());
  EXPECT_EQ(surface->display({}, false).triangles.size(), 1U);
}

TEST(TriangleSurface, DamagedMeshesAreRefused) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_THROW((void)make_triangle_surface(mesh), Error);
  EXPECT_THROW((void)make_triangle_surface({}), Error);
}

} // namespace
} // namespace billet::geometry::triangle_surface_test
