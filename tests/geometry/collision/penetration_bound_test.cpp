// The bound of penetration against a hundred times as many samples: never below, and tight.

#include "geometry/collision/penetration_bound.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::geometry::penetration_bound_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t plenty = 200000;
constexpr double rounding = 1e-12; // of coordinates to 10

/// A face over [-1, 1] (squared): y = shape(x, z), or in space z = shape(x, y).
using Shape = std::function<double(double, double)>;

BezierPatch face(bool planar, const Shape& shape) {
  std::vector<Vec3> at;
  for (int j = planar ? 0 : -1; j <= (planar ? 0 : 1); ++j)
    for (int i = -1; i <= 1; ++i)
      at.push_back(planar ? Vec3(i, shape(i, 0.0), 0.0) : Vec3(i, j, shape(i, j)));
  return BezierPatch(at);
}

/// Half of the square, above its diagonal.
BezierPatch triangular_face(const Shape& shape) {
  std::vector<Vec3> at;
  for (const auto& [x, y] : {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {0, 0}, {-1, 1}})
    at.emplace_back(x, y, shape(x, y));
  return BezierPatch(at);
}

/// Points of a fine grid over a triangle.
std::vector<Vec3> grid_of_triangle(std::span<const Vec3> c, int n) {
  std::vector<Vec3> points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i + j <= n; ++i) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n, w = 1.0 - u - v;
      points.emplace_back(w * w * c[0] + u * u * c[2] + v * v * c[5] + 2 * u * w * c[1] +
                          2 * u * v * c[4] + 2 * v * w * c[3]);
    }
  return points;
}

/// Deepest of the points of a fine grid over a face.
double brute(const RigidSurface& surface, const BezierPatch& patch, int n) {
  const auto control = patch.control();
  const auto weights = [](double t) {
    return std::array{(1 - t) * (1 - t), 2 * t * (1 - t), t * t};
  };
  std::vector<Vec3> points;
  const bool triangle = control.size() == 6;
  if (triangle)
    points = grid_of_triangle(control, n);
  for (int j = 0; !triangle && j <= (control.size() == 3 ? 0 : n); ++j)
    for (int i = 0; i <= n; ++i) {
      const auto u = weights(static_cast<double>(i) / n), v = weights(static_cast<double>(j) / n);
      Vec3 x = Vec3::Zero();
      for (std::size_t k = 0; k < control.size(); ++k)
        x += u[k % 3] * (control.size() == 3 ? 1.0 : v[k / 3]) * control[k];
      points.push_back(x);
    }
  std::vector<Projection> feet(points.size());
  surface.project(points, far, feet);
  double deepest = 0.0;
  for (const Projection& foot : feet)
    deepest = std::max(deepest, -foot.gap);
  return deepest;
}

PenetrationBound bound_afresh(const RigidSurface& surface,
                              std::span<const CandidateFace> faces,
                              const BoundSearch& search) {
  std::vector<KnownPiece> nothing;
  return bound_penetration(surface, faces, search, nothing);
}

PenetrationBound bounded(const RigidSurface& surface, const BezierPatch& patch) {
  const std::vector<CandidateFace> faces{{patch, 1.0, 0}};
  return bound_afresh(surface, faces, {.reach = far, .most_queries = plenty});
}

void expect_bound(const std::string& name,
                  const RigidSurface& surface,
                  const BezierPatch& patch,
                  double tightness) {
  const bool planar = patch.control().size() == 3;
  const double sampled = brute(surface, patch, planar ? 20000 : 400);
  const PenetrationBound found = bounded(surface, patch);
  std::printf("%-34s samples %.6e, bound %.6e (%+.3f %%), %zu queries\n", name.c_str(), sampled,
              found.bound, 100.0 * (found.bound / sampled - 1.0), found.queries);
  EXPECT_GE(found.bound, sampled - rounding) << name;
  EXPECT_LE(found.bound, (1.0 + tightness) * std::max(found.deepest.depth, sampled) + 1.1e-6)
      << name;
  EXPECT_LE(found.deepest.depth, found.bound) << name;
}

TEST(PenetrationBound, IsAboveAHundredfoldSamplesAndTight) {
  constexpr double tight = 0.011;
  const Shape flat = [](double, double) { return -1e-4; };
  const Shape bowl = [](double x, double y) { return 0.05 * (x * x + y * y) - 1e-4; };
  const Shape dome = [](double x, double y) { return -0.05 * (x * x + y * y) - 1e-4; };
  const Shape saddle = [](double x, double y) { return 0.03 * x * x - 0.02 * y * y - 1e-3; };
  for (const auto& [name, shape] :
       {std::pair{"flat", flat}, {"bowl", bowl}, {"dome", dome}, {"saddle", saddle}}) {
    const std::string of = name;
    expect_bound("line, plane, " + of, *make_plane({0, 0, 0}, {0, 1, 0}), face(true, shape), tight);
    expect_bound("line, circle, " + of, *make_circle({0, -10, 0}, 10.0, false), face(true, shape),
                 tight);
    expect_bound("line, bore, " + of, *make_circle({0, 10, 0}, 10.0, true), face(true, shape),
                 tight);
    expect_bound("quad, plane, " + of, *make_plane({0, 0, 0}, {0, 0, 1}), face(false, shape),
                 tight);
    expect_bound("triangle, plane, " + of, *make_plane({0, 0, 0}, {0, 0, 1}),
                 triangular_face(shape), tight);
    expect_bound("triangle, sphere, " + of, *make_sphere({0, 0, -10}, 10.0, false),
                 triangular_face(shape), tight);
    expect_bound("triangle, hollow, " + of, *make_sphere({0, 0, 10}, 10.0, true),
                 triangular_face(shape), tight);
    expect_bound("quad, sphere, " + of, *make_sphere({0, 0, -10}, 10.0, false), face(false, shape),
                 tight);
    expect_bound("quad, hollow, " + of, *make_sphere({0, 0, 10}, 10.0, true), face(false, shape),
                 tight);
    expect_bound("quad, cylinder, " + of, *make_cylinder({0, 0, -10}, {1, 0.3, 0}, 10.0, false),
                 face(false, shape), tight);
    expect_bound("quad, bore, " + of, *make_cylinder({0, 0, 10}, {1, 0.3, 0}, 10.0, true),
                 face(false, shape), tight);
    expect_bound("quad, torus, " + of, *make_torus({0, 0, 10}, {1, 0, 0}, 12.0, 2.0, false),
                 face(false, shape), tight);
  }
}

TEST(PenetrationBound, FindsACornerThatPokesBetweenPoints) {
  const Shape flat = [](double, double) { return 0.0; };
  const std::vector<Vec2> wedge{{0.2, 0.01}, {-1.0, -2.0}, {1.0, -2.0}};
  expect_bound("line, wedge", *make_profile(polygon(wedge, true)), face(true, flat), 0.011);
  const std::vector<Vec2> needle{{0.21, 0.3}, {0.2, -2.0}, {0.22, -2.0}};
  expect_bound("line, needle", *make_profile(polygon(needle, true)), face(true, flat), 0.011);
  TriangleMesh cone = cube(); // its corner (1, 1, 1) up
  for (Vec3& p : cone.points) {
    const Vec3 d = p - Vec3(1, 1, 1);
    p = {Vec3(1, -1, 0).normalized().dot(d) + 0.3, Vec3(1, 1, -2).normalized().dot(d) - 0.1,
         Vec3(1, 1, 1).normalized().dot(d) + 0.05};
  }
  expect_bound("quad, corner of a cube", *make_triangle_surface(cone), face(false, flat), 0.011);
  TriangleMesh edge = cube(); // its edge along y at x = z = 1 up, turned in the plane of the face
  for (Vec3& p : edge.points) {
    const double c = std::cos(0.4), s = std::sin(0.4);
    const Vec3 q(((p.x() - 1) - (p.z() - 1)) / std::sqrt(2.0), 6.0 * (p.y() - 0.5),
                 ((p.x() - 1) + (p.z() - 1)) / std::sqrt(2.0) + 0.02);
    p = {c * q.x() - s * q.y() + 0.1, s * q.x() + c * q.y(), q.z()};
  }
  expect_bound("quad, edge of a cube", *make_triangle_surface(edge), face(false, flat), 0.011);
}

TEST(PenetrationBound, VanishesWhereTheFaceIsClear) {
  const BezierPatch line = face(true, [](double x, double) { return 0.02 + 0.01 * x; });
  const PenetrationBound found = bounded(*make_plane({0, 0, 0}, {0, 1, 0}), line);
  EXPECT_EQ(found.bound, 0.0);
  EXPECT_EQ(found.relative_bound, 0.0);
  EXPECT_EQ(found.deepest.depth, 0.0);
  EXPECT_EQ(bound_afresh(*make_plane({0, 0, 0}, {0, 1, 0}), {}, {.reach = far}).bound, 0.0);
}

TEST(PenetrationBound, HoldsWhenTheQueriesRunOut) {
  // A sunken dome on a ball of the same radius: tangent planes come close to it slowly.
  const SurfacePtr ball = make_sphere({0, 0, -10}, 10.0, false);
  const BezierPatch dome =
      face(false, [](double x, double y) { return -0.05 * (x * x + y * y) - 1e-4; });
  const double sampled = brute(*ball, dome, 400);
  double last = 1.0;
  for (const std::size_t most : {1u, 10u, 100u, 1000u, 10000u}) {
    const std::vector<CandidateFace> faces{{dome, 1.0, 0}};
    const double bound = bound_afresh(*ball, faces, {.reach = far, .most_queries = most}).bound;
    std::printf("  %6zu queries: bound %.3e of %.3e\n", most, bound, sampled);
    EXPECT_GE(bound, sampled - rounding);
    EXPECT_LT(bound, last);
    last = bound;
  }
  EXPECT_LT(last, 2.0 * sampled);
}

TEST(PenetrationBound, MeasuresEachFaceByItsOwnElement) {
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, 1, 0});
  const auto sunk = [](double by) { return face(true, [by](double, double) { return -by; }); };
  const std::vector<CandidateFace> faces{{sunk(0.02), 1.0, 7}, {sunk(0.01), 0.1, 8}};
  const PenetrationBound found =
      bound_afresh(*plane, faces, {.reach = far, .most_queries = plenty});
  EXPECT_EQ(found.deepest.face, 7u);
  EXPECT_EQ(found.deepest_relative.face, 8u);
  EXPECT_NEAR(found.bound, 0.02, 0.01 * 0.02);
  EXPECT_NEAR(found.relative_bound, 0.1, 0.01 * 0.1);
}

TEST(PenetrationBound, DoesNotCountWhatLiesBeyondTheRimOfAnOpenTool) {
  // A face behind the tangent of an open profile that ends at x = 0, from x = -1 to 1.
  const SurfacePtr die = make_profile(polygon(std::vector<Vec2>{{0, 0}, {-5, 0}}, false));
  ASSERT_GT(projection(*die, {-1, 1, 0}).gap, 0.0);
  const BezierPatch across = face(true, [](double x, double) { return -0.1 - 0.05 * x; });
  const PenetrationBound found = bounded(*die, across);
  // The deepest place that counts is at the rim itself: 0.1.
  EXPECT_GE(found.bound, 0.1 - rounding);
  EXPECT_LT(found.bound, 0.103);
  std::vector<Vec3> at{{0.1, -0.1, 0}, {0.6, -0.1, 0}, {1.1, -0.1, 0}};
  EXPECT_EQ(bounded(*die, BezierPatch(at)).bound, 0.0);
}

TEST(PenetrationBound, HoldsForTriangles) {
  RoundBar bar;
  bar.n = 90;
  TriangleMesh mesh = round_bar(bar);
  for (Vec3& p : mesh.points)
    p = Vec3(p.z() - 25.0, p.y(), p.x() - 10.0);
  mesh = flipped(std::move(mesh));
  const Shape flat = [](double, double) { return -1e-3; };
  const Shape along = [](double, double y) { return -0.05 * y * y - 1e-3; };
  expect_bound("quad, facets, flat", *make_triangle_surface(mesh), face(false, flat), 0.011);
  expect_bound("quad, facets, along", *make_triangle_surface(mesh), face(false, along), 0.011);
  const SurfacePtr smooth = make_smooth_triangle_surface(mesh, pi / 6.0).surface;
  expect_bound("quad, smoothed, flat", *smooth, face(false, flat), 0.011);
  expect_bound("quad, smoothed, along", *smooth, face(false, along), 0.011);
}

/// A face that is pressed along a tool, a little way at each of some steps.
struct Way {
  std::string name;
  SurfacePtr tool;
  Shape shape;
  Vec3 step; ///< [mm]
};

BezierPatch moved(const BezierPatch& patch, const Vec3& by) {
  Pose pose; // of a tool that goes the other way
  pose.translation = -by;
  return patch.in_tool(pose);
}

TEST(PenetrationBound, WhatWasClearServesTheNextSearch) {
  const Shape bowl = [](double x, double y) { return 0.05 * (x * x + y * y) - 0.05; };
  const Shape flat = [](double, double) { return -0.02; };
  const std::vector<Way> ways{
      {"sphere", make_sphere({0, 0, -40}, 40.0, false), flat, {1e-3, 1e-3, -1e-5}},
      {"hollow", make_sphere({0, 0, 10}, 10.0, true), bowl, {1e-3, 1e-3, -1e-5}},
      {"plane", make_plane({0, 0, 0}, {0, 0, 1}), flat, {1e-2, 1e-2, -1e-5}},
  };
  constexpr int steps = 10;
  for (const auto& [name, tool, shape, step] : ways) {
    std::vector<KnownPiece> known;
    std::size_t first = 0, later = 0;
    for (int i = 0; i <= steps; ++i) {
      const BezierPatch patch = moved(face(false, shape), i * step);
      const double sampled = brute(*tool, patch, 200);
      const std::vector<CandidateFace> faces{{patch, 1.0, 3}};
      // Contact points have been seen before.
      const BoundSearch search{
          .reach = far, .most_queries = plenty, .known_depth = sampled, .known_relative = sampled};
      const PenetrationBound found = bound_penetration(*tool, faces, search, known);
      EXPECT_GE(found.bound, sampled - rounding) << name << ", step " << i;
      EXPECT_LE(found.bound, 1.031 * sampled) << name << ", step " << i;
      EXPECT_FALSE(known.empty());
      (i == 0 ? first : later) += found.queries;
    }
    std::printf("%-8s %zu queries, then %.1f a step\n", name.c_str(), first,
                static_cast<double>(later) / steps);
    EXPECT_LT(later, steps * first / 2) << name;
  }
}

TEST(PenetrationBound, HoldsWithWhatWasKnownOfAnotherFace) {
  const SurfacePtr bore = make_cylinder({0, 0, 10}, {1, 0.3, 0}, 10.0, true);
  const Shape flat = [](double, double) { return -1e-3; };
  const Shape tilted = [](double x, double y) { return 0.02 * x - 0.03 * y - 1e-3; };
  std::vector<KnownPiece> known;
  const std::vector<CandidateFace> before{{face(false, flat), 1.0, 0}};
  const std::vector<CandidateFace> after{{face(false, tilted), 1.0, 0}};
  const BoundSearch search{.reach = far, .most_queries = plenty};
  static_cast<void>(bound_penetration(*bore, before, search, known));
  const double sampled = brute(*bore, face(false, tilted), 400);
  const double bound = bound_penetration(*bore, after, search, known).bound;
  EXPECT_GE(bound, sampled - rounding);
  // Balls of the search before may leave three times (G.27).
  EXPECT_LE(bound, 1.03 * sampled + 3e-6);
}

} // namespace
} // namespace billet::geometry::penetration_bound_test
