#include "geometry/base/error.h"
#include "geometry/curved/edge_curves.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "geometry/triangles/corner_normals.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <thread>
#include <vector>

namespace billet::geometry::smooth_triangle_surface_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double rounding = 1e-12; // coordinates up to 3
constexpr double feature = 30.0 * degree;

/// A bar of radius 1 with flat ends.
TriangleMesh small_bar(std::int32_t n = 36, bool caps = true) {
  RoundBar bar;
  bar.n = n;
  bar.radius = 1.0;
  bar.length = 3.0;
  bar.caps = caps;
  return round_bar(bar);
}

/// Bumps and hollows of different curvature, nowhere sharp.
TriangleMesh pebble(std::int32_t n) {
  return star(n, [](const Vec3& d) {
    return 1.0 + 0.15 * std::sin(2.0 * d.x()) * d.y() + 0.1 * std::cos(3.0 * d.z());
  });
}

TriangleMesh hills(std::int32_t n) {
  return sheet(n, [](double x, double y) { return 0.1 * std::sin(4.0 * x) * std::cos(3.0 * y); });
}

SurfacePtr smooth(const TriangleMesh& mesh, double angle = feature) {
  return make_smooth_triangle_surface(mesh, angle).surface;
}

struct Body {
  const char* name;
  TriangleMesh mesh;
  double angle;
};

std::vector<Body> bodies() {
  return {{"bar", small_bar(), feature},
          {"hole", flipped(small_bar(24, false)), feature},
          {"ball", icosphere(2), feature},
          {"pebble", pebble(12), feature},
          {"cone", cone(24), feature},
          {"hills", hills(8), feature},
          {"table", table_with_round(6), feature},
          {"spiky, folding", spiky(6), pi}};
}

/// Points close to the surface, on both sides: above corners, sides and middles of triangles.
std::vector<Vec3> close_to(const TriangleMesh& mesh, std::size_t n, double off) {
  std::mt19937 generator(3);
  std::uniform_int_distribution<std::size_t> triangle(0, mesh.triangles.size() - 1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> offset(0.0, off);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t t = triangle(generator);
    double v = share(generator), w = share(generator) * (1.0 - v);
    if (i % 3 == 1)
      w = 0.0;
    if (i % 3 == 2)
      v = w = 0.0;
    const Vec3 y =
        (1.0 - v - w) * corner(mesh, t, 0) + v * corner(mesh, t, 1) + w * corner(mesh, t, 2);
    points.emplace_back(y + Vec3(offset(generator), offset(generator), offset(generator)));
  }
  return points;
}

/// Central differences of gap and normal. Where dnormal_dx jumps between neighbouring triangles the
/// difference lies between its values on either side.
///
/// @return whether the point was checked: not where the normal itself jumps or turns too fast
bool derivatives_hold(const RigidSurface& surface, const Vec3& x) {
  constexpr double h = 1e-6, tolerance = 1e-5;
  const Projection p = projection(surface, x);
  for (int i = 0; i < 3; ++i) {
    const Projection plus = projection(surface, x + h * Vec3::Unit(i));
    const Projection minus = projection(surface, x - h * Vec3::Unit(i));
    const double curvature =
        std::max({p.dnormal_dx.norm(), plus.dnormal_dx.norm(), minus.dnormal_dx.norm()});
    const double jump = (plus.normal - minus.normal).norm();
    if (!plus.found() || !minus.found() || h * curvature > 1e-4 || jump > 4.0 * h * curvature + h)
      return false;
    const double scale = tolerance * (1.0 + curvature * curvature);
    EXPECT_NEAR((plus.gap - minus.gap) / (2.0 * h), p.normal[i], scale) << x.transpose();
    const Vec3 slope = (plus.normal - minus.normal) / (2.0 * h);
    const double spread = (plus.dnormal_dx - p.dnormal_dx).col(i).norm() +
                          (minus.dnormal_dx - p.dnormal_dx).col(i).norm();
    EXPECT_LE((slope - p.dnormal_dx.col(i)).norm(), spread + scale) << x.transpose();
  }
  return true;
}

TEST(SmoothTriangleSurface, NormalIsTheGradientOfTheGapAndDnormalDxItsDerivative) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const SurfacePtr surface = smooth(body.mesh, body.angle);
    const std::vector<Vec3> points = close_to(body.mesh, 600, 0.04);
    std::size_t checked = 0;
    for (const Vec3& x : points)
      if (projection(*surface, x).found()) { // else beyond a rim
        expect_consistent(*surface, x);
        checked += derivatives_hold(*surface, x) ? 1 : 0;
      } else {
        ++checked;
      }
    EXPECT_GT(checked, points.size() * 7 / 10); // the others are too close to a corner
  }
}

// The normal turns by curvature times distance; a kink would add a jump that does not shrink.
TEST(SmoothTriangleSurface, TheNormalIsContinuousAcrossSmoothEdgesAndVertices) {
  constexpr double h = 1e-9;
  for (const Body& body : bodies()) {
    if (std::string_view(body.name).starts_with("spiky"))
      continue;
    SCOPED_TRACE(body.name);
    const SurfacePtr surface = smooth(body.mesh, body.angle);
    const SurfacePtr raw = make_triangle_surface(body.mesh);
    const CornerNormals normals = corner_normals(body.mesh, body.angle);
    const std::vector<Vec3> ways = random_points(7, 1.0);
    double worst = 0.0, worst_raw = 0.0;
    std::size_t crossed = 0;
    for (const EdgeCurve& edge : edge_curves(body.mesh, normals).curves) {
      for (const double t : {0.0, 0.23, 0.5, 0.8, 1.0}) {
        const auto end = static_cast<std::size_t>(t < 0.5 ? edge.ends[0] : edge.ends[1]);
        const bool corner = (t == 0.0 || t == 1.0) && normals.one_fan[end] == 0;
        if (edge.kind != EdgeKind::smooth || corner)
          continue;
        const Vec3 y = edge.at(t).position;
        for (const Vec3& way : ways) {
          const Projection p = projection(*surface, y + h * way);
          const Projection q = projection(*surface, y - h * way);
          if (!p.found() || !q.found() || p.patch == q.patch)
            continue;
          worst = std::max(worst, (p.normal - q.normal).norm());
          const Vec3 along = edge.at(t).d.normalized();
          const Vec3 side = (way - way.dot(along) * along).normalized();
          worst_raw = std::max(worst_raw, (projection(*raw, y + 1e-3 * side).normal -
                                           projection(*raw, y - 1e-3 * side).normal)
                                              .norm());
          ++crossed;
        }
      }
    }
    EXPECT_GT(crossed, 10U);
    std::printf("%-7s largest jump of the normal at smooth edges %.1e (facets %.1e)\n", body.name,
                worst, worst_raw);
    EXPECT_LT(worst, 1e-7);
  }
}

TEST(SmoothTriangleSurface, NoPointOfTheSurfaceIsCloserThanTheFoot) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const SurfacePtr surface = smooth(body.mesh, body.angle);
    std::vector<Vec3> feet;
    for (const Vec3& x : close_to(body.mesh, 3000, 0.02)) {
      const Projection p = projection(*surface, x);
      if (p.found())
        feet.push_back(p.foot);
    }
    // A triangle that bends by more than half a right angle may have several nearest points.
    const double slack = std::string_view(body.name).starts_with("spiky") ? 0.02 : 1e-9;
    for (const Vec3& x : random_points(300, 2.0)) {
      const Projection p = projection(*surface, x);
      if (!p.found())
        continue;
      for (const Vec3& foot : feet)
        ASSERT_LT(std::abs(p.gap), (foot - x).norm() + slack) << x.transpose();
    }
  }
}

TEST(SmoothTriangleSurface, CornersOfTheMeshLieOnTheSurface) {
  for (const Body& body : bodies()) {
    const SurfacePtr surface = smooth(body.mesh, body.angle);
    for (const Vec3& p : body.mesh.points) {
      const Projection at = projection(*surface, p);
      EXPECT_TRUE(at.found()) << body.name;
      EXPECT_NEAR(at.gap, 0.0, rounding) << body.name << " at " << p.transpose();
    }
  }
}

TEST(SmoothTriangleSurface, BoxesAndBarsWithSharpEdgesAnswerAsTheFacetsDo) {
  for (const TriangleMesh& mesh : {cube(), angle_bar(), flipped(angle_bar())}) {
    const SurfacePtr raw = make_triangle_surface(mesh), sharp = smooth(mesh);
    for (const Vec3& x : random_points(1000, 2.5)) {
      const Projection p = projection(*raw, x), q = projection(*sharp, x);
      EXPECT_EQ(p.gap, q.gap);
      EXPECT_EQ(p.normal, q.normal);
      EXPECT_EQ(p.dnormal_dx, q.dnormal_dx);
    }
  }
}

TEST(SmoothTriangleSurface, WithAFeatureAngleOfZeroEveryEdgeStaysSharp) {
  const TriangleMesh mesh = icosphere(2);
  const SurfacePtr raw = make_triangle_surface(mesh), sharp = smooth(mesh, 0.0);
  for (const Vec3& x : random_points(300, 2.0)) {
    const Projection p = projection(*raw, x), q = projection(*sharp, x);
    EXPECT_EQ(p.gap, q.gap);
    EXPECT_EQ(p.normal, q.normal);
  }
}

TEST(SmoothTriangleSurface, TheRimOfABarIsASharpCircle) {
  const SurfacePtr surface = smooth(small_bar(36));
  for (double a = 0.013; a < 2.0 * pi; a += 0.037) {
    const Vec3 er(std::cos(a), std::sin(a), 0.0);
    // Above the end, also between the polygon of the facets and the circle.
    for (const double r : {0.5, 0.99, 0.9975, 0.9999}) {
      const Projection above = projection(*surface, r * er + Vec3(0, 0, 3.001));
      EXPECT_NEAR(above.gap, 0.001, 1e-9);
      EXPECT_NEAR((above.normal - Vec3::UnitZ()).norm(), 0.0, 1e-9);
      EXPECT_NEAR(projection(*surface, r * er + Vec3(0, 0, 2.99995)).gap, -std::min(5e-5, 1.0 - r),
                  1e-5);
    }
    const Projection beside = projection(*surface, 1.3 * er + Vec3(0, 0, 3.4));
    EXPECT_NEAR(beside.gap, 0.5, 1e-5);
    EXPECT_NEAR((beside.normal - (0.6 * er + Vec3(0, 0, 0.8))).norm(), 0.0, 1e-4);
    EXPECT_NEAR(beside.dnormal_dx.trace(), 1.0 / 0.5 + 0.6 / 1.3, 2e-2);
    EXPECT_NEAR(projection(*surface, 1.2 * er + Vec3(0, 0, 2.9)).gap, 0.2, 1e-5);
  }
}

TEST(SmoothTriangleSurface, ATableThatRunsIntoARoundStaysFlat) {
  const SurfacePtr surface = smooth(table_with_round(6));
  for (const double x : {-2.9, -1.0, -0.1, -1e-3})
    for (const double y : {0.2, 2.0, 3.9}) {
      const Projection p = projection(*surface, {x, y, 0.05});
      EXPECT_NEAR(p.gap, 0.05, rounding);
      EXPECT_NEAR((p.normal - Vec3::UnitZ()).norm(), 0.0, rounding);
      EXPECT_EQ(p.dnormal_dx, Mat3::Zero());
    }
  for (double a = 0.02; a < 0.5 * pi; a += 0.05) { // also the last facet, before the border
    const Vec3 n(std::sin(a), 0.0, std::cos(a));
    const Projection p = projection(*surface, Vec3(0, 2, -0.5) + 0.6 * n);
    EXPECT_NEAR(p.gap, 0.1, 5e-5);                 // facets: 4e-3
    EXPECT_NEAR((p.normal - n).norm(), 0.0, 1e-3); // facets: 0.13
  }
}

TEST(SmoothTriangleSurface, AConeKeepsItsTip) {
  const SurfacePtr surface = smooth(cone(24));
  const Projection tip = projection(*surface, {0, 0, 2.3});
  EXPECT_NEAR(tip.gap, 0.3, rounding);
  EXPECT_NEAR((tip.normal - Vec3::UnitZ()).norm(), 0.0, rounding);
  const double slope = std::atan(0.5);
  for (double a = 0.01; a < 2 * pi; a += 0.11)
    for (const double z : {0.3, 1.0, 1.7}) {
      const Vec3 er(std::cos(a), std::sin(a), 0.0);
      const Vec3 n = std::cos(slope) * er + Vec3(0, 0, std::sin(slope));
      const Projection p = projection(*surface, (1.0 - 0.5 * z) * er + Vec3(0, 0, z) + 0.05 * n);
      EXPECT_NEAR(p.gap, 0.05, 2.5e-3); // facets: 8e-3
    }
}

TEST(SmoothTriangleSurface, TrianglesThatWouldFoldStayAsTheyAre) {
  const TriangleMesh mesh = spiky(6);
  const SmoothSurface made = make_smooth_triangle_surface(mesh, pi);
  EXPECT_GT(made.smoothing.kept, 0);
  EXPECT_EQ(made.smoothing.kept + made.smoothing.curved + made.smoothing.flat,
            static_cast<std::int64_t>(mesh.triangles.size()));
  for (const Vec3& x : random_points(1000, 2.5)) {
    const Projection p = projection(*made.surface, x);
    ASSERT_TRUE(p.found());
    EXPECT_NEAR(p.normal.norm(), 1.0, rounding);
    EXPECT_TRUE(p.dnormal_dx.allFinite());
    EXPECT_LT(std::abs(std::abs(p.gap) - brute_distance(mesh, x)), 0.5);
  }
}

TEST(SmoothTriangleSurface, FarPointsHaveTheSideOfTheFacets) {
  for (const TriangleMesh& mesh : {small_bar(), icosphere(1), pebble(8), cone(16)}) {
    const SurfacePtr surface = smooth(mesh), raw = make_triangle_surface(mesh);
    const double chord = make_smooth_triangle_surface(mesh, feature).smoothing.chord_error;
    for (const Vec3& x : random_points(1500, 4.0)) {
      const Projection p = projection(*surface, x), q = projection(*raw, x);
      EXPECT_NEAR(p.gap, q.gap, 1.05 * chord + rounding) << x.transpose();
    }
  }
}

TEST(SmoothTriangleSurface, TheResultDoesNotDependOnHintReachOrThread) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const SurfacePtr surface = smooth(body.mesh, body.angle);
    std::vector<Vec3> points = close_to(body.mesh, 60, 0.3);
    for (const double t : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5}) // ties on axes of symmetry
      points.insert(points.end(), {{t, t, t}, {0.0, 0.0, t}, {t, 0, 0}, {0.5, t, t}});
    const auto n = static_cast<std::int32_t>(body.mesh.triangles.size());
    std::vector<Projection> reference;
    for (const Vec3& x : points) {
      reference.push_back(projection(*surface, x));
      const Projection& p = reference.back();
      for (std::int32_t hint = 0; hint < n + 3; hint += std::max(1, n / 9))
        EXPECT_TRUE(same_bits(p, projection(*surface, x, far, hint))) << x.transpose();
      if (p.found()) {
        const double reach = (p.foot - x).norm() * 1.0000001 + rounding;
        EXPECT_TRUE(same_bits(p, projection(*surface, x, reach)));
        if (std::abs(p.gap) > rounding) {
          EXPECT_FALSE(projection(*surface, x, 0.999 * std::abs(p.gap)).found());
        }
      }
    }
    std::vector<std::vector<Projection>> results(3, std::vector<Projection>(points.size()));
    std::vector<std::thread> threads;
    for (auto& result : results)
      threads.emplace_back([&] { surface->project(points, far, result); });
    for (std::thread& thread : threads)
      thread.join();
    for (const auto& result : results)
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_TRUE(same_bits(result[i], reference[i]));
  }
}

TEST(SmoothTriangleSurface, AnOpenPatchEndsAtItsRim) {
  const SurfacePtr patch = smooth(hills(8));
  EXPECT_TRUE(projection(*patch, {0.5, 0.5, 0.3}).found());
  EXPECT_GT(projection(*patch, {1.2, 0.5, 0.3}).gap, 0.2);
  EXPECT_FALSE(projection(*patch, {1.3, 0.5, -0.4}).found());
  EXPECT_LT(projection(*patch, {0.5, 0.5, -0.3}).gap, 0.0);
  const SurfacePtr tube = smooth(small_bar(36, false));
  EXPECT_NEAR(projection(*tube, {0.9 * std::cos(0.2), 0.9 * std::sin(0.2), 1.0}).gap, -0.1, 1e-5);
}

TEST(SmoothTriangleSurface, GapsScaleWithTheUnitOfLength) {
  const TriangleMesh mesh = small_bar();
  const SurfacePtr big = smooth(mesh);
  for (const double unit : {1e-3, 1e-6, 1e6}) {
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.points)
      p *= unit;
    const SurfacePtr other = smooth(scaled);
    for (const Vec3& x : random_points(200, 2.0))
      EXPECT_NEAR(projection(*other, unit * x, unit * far).gap / unit, projection(*big, x).gap,
                  1e-10);
  }
}

TEST(SmoothTriangleSurface, CoordinatesOfSinglePrecisionDoNotMatter) {
  TriangleMesh mesh = small_bar();
  const SurfacePtr exact = smooth(mesh);
  for (Vec3& p : mesh.points)
    for (double& coordinate : p.reshaped())
      coordinate = static_cast<double>(static_cast<float>(coordinate));
  const SmoothSurface rounded = make_smooth_triangle_surface(mesh, feature);
  EXPECT_EQ(rounded.smoothing.flat, 68);
  for (const Vec3& x : close_to(mesh, 500, 0.05)) {
    const Projection p = projection(*exact, x), q = projection(*rounded.surface, x);
    EXPECT_NEAR(p.gap, q.gap, 1e-6);
  }
}

TEST(SmoothTriangleSurface, DamagedMeshesAreRefused) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_THROW((void)smooth(mesh), Error);
  EXPECT_THROW((void)smooth({}), Error);
}

} // namespace
} // namespace billet::geometry::smooth_triangle_surface_test
