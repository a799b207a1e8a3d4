#include "contact/contact_surface.h"
#include "mechanics/elements/elements.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace billet::contact {
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

TEST(ContactSurface, ScalesPenaltiesWithTheStiffnessOfTheElementBeneath) {
  // The elements are 1 high: E / h = 200e3.
  for (const BodyKind& body : body_kinds()) {
    const ContactBench bench = bench_of(body, {Form::mixed, 50.0, 5.0});
    for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
      EXPECT_NEAR(bench.surface.depth(f), 1.0, rounding) << body.name();
      EXPECT_NEAR(bench.surface.penalty().normal, 50.0 * 200e3, rounding * 1e7);
      EXPECT_NEAR(bench.surface.penalty().tangent, 5.0 * 200e3, rounding * 1e7);
    }
  }
}

TEST(ContactSurface, FindsTheMaterialPointBeneathEachContactPoint) {
  // The lower points of the elements, 0.2113 above the face, spread as the contact points are.
  const ContactBench bench =
      bench_of({mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain}, {});
  std::vector<Vec3> points(bench.surface.n_points());
  bench.surface.positions(bench.x, points);
  std::set<std::size_t> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t state = bench.surface.beneath(k);
    const auto xi = mechanics::ElementQuad8::Rule::point(static_cast<int>(state % 4));
    const double centre = state < 4 ? 1.5 : 2.5;
    EXPECT_NEAR(centre + 0.5 * xi[0], points[k][0], rounding);
    EXPECT_LT(xi[1], 0.0) << "in the lower row";
    found.insert(state);
  }
  EXPECT_EQ(found.size(), points.size()) << "each contact point has its own";
}

TEST(ContactSurface, SamplesAFaceWithItsCorners) {
  for (const BodyKind& body : body_kinds()) {
    const ContactBench bench = bench_of(body, {});
    const auto samples = bench.surface.samples(bench.x, 0);
    const auto nodes = bench.surface.scatter().nodes(0);
    const std::size_t corners = body.solid() ? 4 : 2;
    for (std::size_t a = 0; a < corners; ++a) {
      double closest = 1.0;
      for (const Vec3& p : samples)
        closest = std::min(closest, (p - bench.mesh.points[as_size(nodes[a])]).norm());
      EXPECT_NEAR(closest, 0.0, rounding) << body.name();
    }
  }
}

} // namespace
} // namespace billet::contact
