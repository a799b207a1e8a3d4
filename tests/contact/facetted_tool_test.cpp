// CON-06: what the facets of a tool do to a point that slides over them, and what smoothing gains.

#include "contact/law/interface_law.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/round_meshes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace billet::contact::facetted_tool_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double load = 1000.0;    // P [N], on a point of area 1
constexpr double penalty = 1e4;    // [MPa/mm]
constexpr double spring = 100.0;   // drives the point along [N/mm]
constexpr double level = 21.7;     // z of the point: on no vertex [mm]
constexpr double tolerance = 1e-9; // of the load

geometry::TriangleMesh roll(std::int32_t n) {
  geometry::RoundBar bar;
  bar.n = n;
  return geometry::round_bar(bar);
}

Vec3 radial(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

Traction pressed(const geometry::RigidSurface& surface, const Vec3& x) {
  geometry::Projection p;
  surface.project({&x, 1}, 1e3, {&p, 1});
  return traction(Frictionless{}, {penalty, penalty}, {}, {x, p, 0.0, 0.0});
}

/// Tangential force on a point that the load presses on at this angle, by Newton's method in r.
double drag(const geometry::RigidSurface& surface, double angle) {
  const Vec3 e = radial(angle), along(-e.y(), e.x(), 0.0);
  double r = 10.0 - load / penalty;
  for (int i = 0; i < 30; ++i) {
    const Traction t = pressed(surface, r * e + Vec3(0, 0, level));
    const double residual = t.traction.dot(e) - load;
    if (std::abs(residual) < tolerance * load)
      return std::abs(t.traction.dot(along));
    r -= residual / e.dot(t.dtraction_dx * e);
  }
  ADD_FAILURE() << "no equilibrium at " << angle;
  return 0.0;
}

/// Iterations until a point at `x`, pulled towards `to`, is in equilibrium; 100: never.
int iterations(const geometry::RigidSurface& surface, Vec3 x, const Vec3& to, const Vec3& inwards) {
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    const Traction t = pressed(surface, x);
    const Vec3 residual = t.traction + load * inwards + spring * (to - x);
    if (residual.norm() < tolerance * load)
      return i;
    x -= (t.dtraction_dx - spring * Mat3::Identity()).lu().solve(residual);
  }
  return most;
}

TEST(FacettedTool, TheDragOfASmoothedRollIsBelowAFifthOfThatOfItsFacets) {
  for (const std::int32_t n : {36, 180}) {
    const geometry::TriangleMesh mesh = roll(n);
    const geometry::SurfacePtr raw = geometry::make_triangle_surface(mesh);
    const geometry::SurfacePtr smooth =
        geometry::make_smooth_triangle_surface(mesh, pi / 6.0).surface;
    double largest_raw = 0.0, largest = 0.0;
    constexpr int steps = 120; // over three facets; every fortieth starts exactly on an edge
    for (int i = 0; i <= steps; ++i) {
      const double angle = 6.0 * pi / n * i / steps;
      largest_raw = std::max(largest_raw, drag(*raw, angle) / load);
      largest = std::max(largest, drag(*smooth, angle) / load);
    }
    const double band = std::tan(pi / n);
    std::printf("N = %3d: tan(pi/N) %.2e, largest T/P of facets %.2e, smoothed %.2e\n", n, band,
                largest_raw, largest);
    EXPECT_LT(largest, band / 5.0);
    EXPECT_LT(largest, 1e-2 * band); // what the curved triangles give beyond what is asked
  }
}

TEST(FacettedTool, NewtonDoesNotCycleFromAnEdgeOfTheFacets) {
  for (const std::int32_t n : {36, 180}) {
    const geometry::TriangleMesh mesh = roll(n);
    const geometry::SurfacePtr raw = geometry::make_triangle_surface(mesh);
    const geometry::SurfacePtr smooth =
        geometry::make_smooth_triangle_surface(mesh, pi / 6.0).surface;
    const double facet = 2.0 * pi / n;
    int most = 0, max_raw = 0;
    for (const double edge : {0.0, facet, 0.5 * facet, 2.0 * facet}) // one of them a diagonal
      for (const double way : {-1.5, -0.3, 0.0, 1e-9, 0.4, 2.0})
        for (const double depth : {load / penalty, 1e-3}) {
          const Vec3 x = (10.0 - depth) * radial(edge) + Vec3(0, 0, level);
          const Vec3 to = (10.0 - depth) * radial(edge + way * facet) + Vec3(0, 0, level);
          most = std::max(most, iterations(*smooth, x, to, -radial(edge)));
          max_raw = std::max(max_raw, iterations(*raw, x, to, -radial(edge)));
        }
    std::printf("N = %3d: most iterations from an edge: facets %d%s, smoothed %d\n", n, max_raw,
                max_raw == 100 ? " (cycles)" : "", most);
    EXPECT_LE(most, 12);
  }
}

} // namespace
} // namespace billet::contact::facetted_tool_test
