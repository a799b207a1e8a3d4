#include "contact/surface/contact_surface.h"
#include "mechanics/elements/elements.h"
#include "mechanics/mesh/mesh_edges.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace billet::contact::contact_surface_test {
namespace {

constexpr double rounding = 1e-12; // a few hundred units in the last place of sizes of order 1

ContactBench bench_of(const BodyKind& body, const ContactSettings& settings) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = faces_at(mesh, 1, 0.0);
  return ContactBench(std::move(mesh), body.analysis, bench_material(), {}, settings, faces);
}

TEST(ContactSurface, HasAreasThatSumToTheFace) {
  // Bottom 1 <= x <= 3, thickness 1 in space; axisymmetric: pi (3^2 - 1^2).
  for (const BodyKind& body : body_kinds())
    for (const Form form : {Form::mixed, Form::compatible}) {
      const ContactBench bench = bench_of(body, {form, 100.0, 10.0});
      std::vector<double> areas(bench.surface.n_points());
      bench.surface.areas(bench.x, areas);
      const double exact =
          body.analysis == mechanics::Analysis::axisymmetric ? 8.0 * std::numbers::pi : 2.0;
      double sum = 0.0;
      for (const double area : areas)
        sum += area;
      EXPECT_NEAR(sum, exact, rounding * exact) << body.name();
    }
}

TEST(ContactSurface, PlacesItsPointsOnTheFaceInsideIt) {
  for (const BodyKind& body : body_kinds())
    for (const Form form : {Form::mixed, Form::compatible}) {
      const ContactBench bench = bench_of(body, {form, 100.0, 10.0});
      std::vector<Vec3> points(bench.surface.n_points());
      bench.surface.positions(bench.x, points);
      EXPECT_EQ(static_cast<int>(points.size()), bench.surface.n_faces() * bench.surface.points());
      for (const Vec3& p : points) {
        EXPECT_NEAR(p[1], 0.0, rounding);
        EXPECT_GT(p[0], 1.0);
        EXPECT_LT(p[0], 3.0);
      }
    }
}

TEST(ContactSurface, ScalesPenaltiesWithTheStiffnessOfTheParentElement) {
  // The elements are 1 high: E / h = 200e3. Around an axis the volume of a triangle goes with the
  // radius of its centre, its face's area with that of its middle.
  for (const BodyKind& body : body_kinds()) {
    const ContactBench bench = bench_of(body, {Form::mixed, 50.0, 5.0});
    const bool wedge = body.kind == mechanics::ElementKind::tri6 &&
                       body.analysis == mechanics::Analysis::axisymmetric;
    for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
      EXPECT_NEAR(bench.surface.depth(f), 1.0, wedge ? 0.12 : rounding) << body.name();
      if (wedge)
        continue;
      EXPECT_NEAR(bench.surface.penalty().normal, 50.0 * 200e3, rounding * 1e7);
      EXPECT_NEAR(bench.surface.penalty().tangent, 5.0 * 200e3, rounding * 1e7);
    }
  }
}

TEST(ContactSurface, FindsTheClosestBulkPointOfEachContactPoint) {
  // The lower points of the elements, 0.2113 above the face, spread as the contact points are.
  const ContactBench bench =
      bench_of({mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain}, {});
  std::vector<Vec3> points(bench.surface.n_points());
  bench.surface.positions(bench.x, points);
  std::set<std::size_t> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t state = bench.surface.bulk_point(k);
    const auto xi = mechanics::ElementQuad8::Rule::point(static_cast<int>(state % 4));
    const double centre = state < 4 ? 1.5 : 2.5;
    EXPECT_NEAR(centre + 0.5 * xi[0], points[k][0], rounding);
    EXPECT_LT(xi[1], 0.0) << "in the lower row";
    found.insert(state);
  }
  EXPECT_EQ(found.size(), points.size()) << "each contact point has its own";
}

/// Area (length in the plane) of a footprint.
double size_of(const Footprint& piece) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < piece.n_corners; ++i)
    twice += (piece.corners[i] - piece.corners[0]).cross(piece.corners[i + 1] - piece.corners[0]);
  return piece.n_corners == 2 ? (piece.corners[1] - piece.corners[0]).norm() : 0.5 * twice.norm();
}

// On flat faces with straight sides: each piece has the area of its point, is convex, and holds it;
// together they fill the face.
TEST(ContactSurface, DividesAFaceIntoPiecesOfTheAreaOfItsPoints) {
  for (const BodyKind& body : body_kinds())
    for (const Form form : {Form::mixed, Form::compatible}) {
      const ContactBench bench = bench_of(body, {form, 100.0, 10.0});
      std::vector<double> areas(bench.surface.n_points());
      std::vector<Vec3> points(bench.surface.n_points());
      bench.surface.areas(bench.x, areas);
      bench.surface.positions(bench.x, points);
      double sum = 0.0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Footprint piece = bench.surface.footprint(bench.x, k);
        sum += size_of(piece);
        if (body.analysis != mechanics::Analysis::axisymmetric) {
          EXPECT_NEAR(size_of(piece), areas[k], rounding) << body.name();
        }
        for (std::size_t i = 0; i < piece.n_corners && piece.n_corners > 2; ++i) {
          const Vec3& from = piece.corners[i];
          const Vec3 side = piece.corners[(i + 1) % piece.n_corners] - from;
          // Faces look down, against y, and their corners turn about that.
          EXPECT_LT(side.cross(points[k] - from)[1], 0.0) << body.name() << " " << k;
        }
      }
      EXPECT_NEAR(sum, 2.0, rounding) << body.name();
    }
}

TEST(ContactSurface, SamplesAFaceWithItsCorners) {
  for (const BodyKind& body : body_kinds()) {
    const ContactBench bench = bench_of(body, {});
    const auto samples = bench.surface.samples(bench.x, 0, 4);
    const auto nodes = bench.surface.scatter().nodes(0);
    const bool triangle = mechanics::is_simplex(body.kind) && body.solid();
    const std::size_t corners = triangle ? 3 : body.solid() ? 4 : 2;
    EXPECT_EQ(samples.size(), triangle ? 15U : body.solid() ? 25U : 5U);
    for (std::size_t a = 0; a < corners; ++a) {
      double closest = 1.0;
      for (const Vec3& p : samples)
        closest = std::min(closest, (p - bench.mesh.points[as_size(nodes[a])]).norm());
      EXPECT_NEAR(closest, 0.0, rounding) << body.name();
    }
  }
}

} // namespace
} // namespace billet::contact::contact_surface_test
