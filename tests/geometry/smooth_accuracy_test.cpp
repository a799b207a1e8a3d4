// How much smoothing gains on shapes whose answer is known: gap and normal, before and after.

#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>

namespace billet::geometry::smooth_accuracy_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Largest errors of the gap [mm] and of the direction of the normal [rad].
struct Errors {
  double gap = 0.0;
  double normal = 0.0;
};

using Exact = std::function<Projection(const Vec3&)>;

Errors errors(const RigidSurface& surface, const Exact& exact, const std::vector<Vec3>& points) {
  Errors worst;
  for (const Vec3& x : points) {
    const Projection p = projection(surface, x), q = exact(x);
    worst.gap = std::max(worst.gap, std::abs(p.gap - q.gap));
    worst.normal =
        std::max(worst.normal, std::atan2(p.normal.cross(q.normal).norm(), p.normal.dot(q.normal)));
  }
  return worst;
}

Projection on_bar(const Vec3& x) {
  const Vec3 radial(x.x(), x.y(), 0.0);
  Projection p;
  p.gap = radial.norm() - 10.0;
  p.normal = radial.normalized();
  return p;
}

Projection on_ball(const Vec3& x) {
  Projection p;
  p.gap = x.norm() - 1.0;
  p.normal = x.normalized();
  return p;
}

/// Points up to 1 mm off the side of the bar, clear of its ends.
std::vector<Vec3> near_bar(std::size_t n) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> off(-1.0, 1.0), z(2.0, 48.0);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = angle(generator), r = 10.0 + off(generator);
    points.emplace_back(r * std::cos(a), r * std::sin(a), z(generator));
  }
  return points;
}

double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

struct RawAndSmooth {
  Errors raw;
  Errors smooth;
};

/// Errors of a bar's facets, as they are and smoothed, printed as the begin of a line.
RawAndSmooth
row_of_table(std::int32_t n, const TriangleMesh& bar, const std::vector<Vec3>& points) {
  const RawAndSmooth found{
      errors(*make_triangle_surface(bar), on_bar, points),
      errors(*make_smooth_triangle_surface(bar, 30.0 * degree).surface, on_bar, points)};
  std::printf("%4d  %9.2e  %9.2e   %9.2e   %9.2e", n, found.raw.gap, found.raw.normal,
              found.smooth.gap, found.smooth.normal);
  return found;
}

void bar_table(const char* title, RoundBar bar, double least_gain) {
  std::printf("%s\n   N   raw gap    raw normal  smooth gap  smooth normal  orders\n", title);
  Errors last;
  std::int32_t last_n = 0;
  const std::vector<Vec3> points = near_bar(2000);
  for (const std::int32_t n : {16, 36, 64, 180, 256}) {
    bar.n = n;
    const auto [raw, smooth] = row_of_table(n, round_bar(bar), points);
    if (last_n > 0)
      std::printf("     %4.1f %4.1f", order(last.gap, smooth.gap, 1.0 * n / last_n),
                  order(last.normal, smooth.normal, 1.0 * n / last_n));
    std::printf("\n");
    EXPECT_LT(smooth.gap, raw.gap / least_gain);
    EXPECT_LT(smooth.normal, raw.normal / least_gain);
    last = smooth;
    last_n = n;
  }
}

TEST(SmoothAccuracy, OnACylinderOfLongFacetsGapAndNormalGainOrders) {
  bar_table("caps, one layer, parallel diagonals", {}, 50.0);
  RoundBar bar;
  bar.diagonals = Diagonals::alternating;
  bar_table("caps, one layer, alternating diagonals", bar, 50.0);
  bar.layers = 7;
  bar_table("caps, seven layers, alternating diagonals", bar, 50.0);
  bar.caps = false;
  bar.layers = 1;
  bar_table("no caps", bar, 50.0);
  bar.unevenness = 0.5;
  bar.caps = true;
  bar_table("facets of uneven width", bar, 8.0);
}

/// Corners displaced on the cylinder by up to a fifth of a facet, those of the rims around only.
TriangleMesh irregular_bar(std::int32_t n) {
  RoundBar bar;
  bar.n = n;
  bar.layers = n / 4;
  TriangleMesh mesh = round_bar(bar);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (Vec3& p : mesh.points) {
    const bool rim = p.z() < 1e-9 || p.z() > bar.length - 1e-9;
    const double angle = std::atan2(p.y(), p.x()) + 2.0 * std::numbers::pi / n * shift(generator);
    const double rise = shift(generator) * bar.length / bar.layers;
    p = Vec3(10.0 * std::cos(angle), 10.0 * std::sin(angle), p.z() + (rim ? 0.0 : rise));
  }
  return mesh;
}

TEST(SmoothAccuracy, OnIrregularTrianglesOfACylinderTheGainIsLargeToo) {
  std::printf("irregular\n   N   raw gap    raw normal  smooth gap  smooth normal\n");
  const std::vector<Vec3> points = near_bar(3000);
  for (const std::int32_t n : {36, 72}) {
    const auto [raw, smooth] = row_of_table(n, irregular_bar(n), points);
    std::printf("\n");
    EXPECT_LT(smooth.gap, raw.gap / 8.0);
    EXPECT_LT(smooth.normal, raw.normal / 5.0);
  }
}

TEST(SmoothAccuracy, OnASphereGapAndNormalGainOrders) {
  std::printf("sphere\nlevel  raw gap    raw normal  smooth gap  smooth normal  orders\n");
  Errors last;
  std::vector<Vec3> points;
  for (const Vec3& x : random_points(1000, 1.0))
    points.emplace_back((0.9 + 0.2 * x.norm()) * x.normalized());
  for (const int level : {0, 1, 2, 3, 4}) {
    const TriangleMesh mesh = icosphere(level);
    const Errors raw = errors(*make_triangle_surface(mesh), on_ball, points);
    const Errors smooth =
        errors(*make_smooth_triangle_surface(mesh, 60.0 * degree).surface, on_ball, points);
    std::printf("%4d  %9.2e  %9.2e   %9.2e   %9.2e", level, raw.gap, raw.normal, smooth.gap,
                smooth.normal);
    if (level > 0) {
      std::printf("     %4.1f %4.1f", order(last.gap, smooth.gap, 2.0),
                  order(last.normal, smooth.normal, 2.0));
      EXPECT_LT(smooth.gap, raw.gap / 20.0);
    }
    std::printf("\n");
    last = smooth;
  }
}

TEST(SmoothAccuracy, FlatFacesHaveNoChordErrorAndABallsIsItsDepth) {
  EXPECT_EQ(chord_error(cube(), 30.0 * degree), 0.0);
  const TriangleMesh mesh = icosphere(3);
  const double exact = make_smooth_triangle_surface(mesh, 30.0 * degree).smoothing.chord_error;
  EXPECT_NEAR(chord_error(mesh, 30.0 * degree), exact, 0.05 * exact);
}

TEST(SmoothAccuracy, TheChordErrorIsReportedBeforeAndAfter) {
  for (const std::int32_t n : {16, 36, 180}) {
    RoundBar bar;
    bar.n = n;
    const SmoothSurface smooth = make_smooth_triangle_surface(round_bar(bar), 30.0 * degree);
    const double sagitta = 10.0 * (1.0 - std::cos(std::numbers::pi / n));
    EXPECT_NEAR(smooth.smoothing.chord_error, sagitta, 0.05 * sagitta);
    EXPECT_NEAR(chord_error(round_bar(bar), 30.0 * degree), sagitta, 0.05 * sagitta);
    const Errors after = errors(*smooth.surface, on_bar, near_bar(1000));
    EXPECT_GT(smooth.smoothing.remaining_error, after.gap);
    EXPECT_LT(smooth.smoothing.remaining_error, 0.1 * sagitta);
    EXPECT_EQ(smooth.smoothing.curved, 2 * n);
    EXPECT_EQ(smooth.smoothing.flat, 2 * (n - 2));
    EXPECT_EQ(smooth.smoothing.kept, 0);
  }
}

TEST(SmoothAccuracy, SpeedOfAQueryForTheRecord) {
  RoundBar bar;
  bar.n = 180;
  const TriangleMesh mesh = round_bar(bar);
  const SurfacePtr raw = make_triangle_surface(mesh);
  const SurfacePtr smooth = make_smooth_triangle_surface(mesh, 30.0 * degree).surface;
  const std::vector<Vec3> points = near_bar(5000);
  std::vector<Projection> out(points.size());
  for (const auto& [name, surface] : {std::pair{"raw", raw.get()}, {"smooth", smooth.get()}})
    for (const char* hint : {"without hint", "with hint"}) {
      const auto begin = std::chrono::steady_clock::now();
      surface->project(points, far, out);
      const std::chrono::duration<double, std::micro> took =
          std::chrono::steady_clock::now() - begin;
      std::printf("%-6s %-12s %6.2f us a point\n", name, hint,
                  took.count() / static_cast<double>(points.size()));
      EXPECT_TRUE(out.front().found());
    }
}

} // namespace
} // namespace billet::geometry::smooth_accuracy_test
