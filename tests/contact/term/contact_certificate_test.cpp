// The certificate of penetration: every point of every face of every element kind against a hundred
// times as many samples, on tools of every sort.

#include "contact/term/contact_term.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace billet::contact::contact_certificate_test {
namespace {

constexpr double rounding = 1e-12; // of coordinates of order 1
constexpr int fine = 200;          // samples a direction: a hundred times the contact points

struct NamedTool {
  std::string name;
  geometry::SurfacePtr surface;
};

/// Cubes of side 1 with an edge, or a corner, up at (x, height, z).
geometry::TriangleMesh cube_on_edge(double x, double height, double z, bool on_corner) {
  geometry::TriangleMesh mesh = geometry::cube();
  const Vec3 up = (on_corner ? Vec3(1, 1, 1) : Vec3(1, 1, 0)).normalized();
  const Vec3 side = Vec3(1, -1, 0).normalized();
  for (Vec3& p : mesh.points) {
    const Vec3 d = p - (on_corner ? Vec3(1, 1, 1) : Vec3(1, 1, 0.5));
    p = Vec3(x + side.dot(d), height + up.dot(d), z + side.cross(up).dot(d));
  }
  return mesh;
}

/// Tools under the body's lower face, y = 0 from x = 1 to 3 (and z = 0 to 1).
std::vector<NamedTool> tools_for(const BodyKind& body) {
  std::vector<NamedTool> tools;
  tools.push_back({"plane", geometry::make_plane({2, 0.01, 0}, {0.05, 1, 0})});
  if (body.solid()) {
    tools.push_back({"sphere", geometry::make_sphere({2.2, -4, 0.3}, 4.0, false)});
    tools.push_back(
        {"cylinder", geometry::make_cylinder({2.2, -4, 0.3}, {0.3, 0, 1}, 4.02, false)});
    tools.push_back({"bore", geometry::make_cylinder({2.2, 6, 0.3}, {0.3, 0, 1}, 6.0, true)});
    tools.push_back(
        {"edge", geometry::make_triangle_surface(cube_on_edge(1.45, 0.03, 0.5, false))});
    tools.push_back(
        {"corner", geometry::make_triangle_surface(cube_on_edge(2.6, 0.03, 0.4, true))});
    return tools;
  }
  tools.push_back({"circle", geometry::make_circle({2.2, -4, 0}, 4.0, false)});
  tools.push_back({"bore", geometry::make_circle({2.2, 6, 0}, 6.0, true)});
  const std::vector<Vec2> wedge{{1.47, 0.04}, {0.8, -2.0}, {2.1, -2.0}};
  tools.push_back({"wedge", geometry::make_profile(geometry::polygon(wedge, true))});
  return tools;
}

/// Deepest of a fine grid of points over all faces, by the shape functions.
double brute(const ContactSurface& surface, const std::vector<double>& x, const Tool& tool) {
  std::vector<Vec3> points;
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    for (mechanics::Index f = 0; f < surface.n_faces(); ++f)
      for (int j = 0; j <= (Shape::dim == 2 ? fine : 0); ++j)
        for (int i = 0; i <= fine; ++i) {
          mechanics::RefPoint<Shape::dim> xi{};
          xi[0] = 2.0 * i / fine - 1.0;
          if constexpr (Shape::dim == 2)
            xi[1] = 2.0 * j / fine - 1.0;
          if constexpr (is_triangle<Shape>) {
            if (i + j > fine)
              continue;
            xi = {static_cast<double>(i) / fine, static_cast<double>(j) / fine};
          }
          const auto N = Shape::values(xi);
          Vec3 p = Vec3::Zero();
          for (std::size_t a = 0; a < N.size(); ++a)
            for (int d = 0; d <= Shape::dim; ++d)
              p[d] += N[a] * x[as_size(surface.scatter().nodes(f)[a] * (Shape::dim + 1) + d)];
          points.push_back(p);
        }
  });
  std::vector<geometry::Projection> feet(points.size());
  tool.surface->project(points, ContactBench::reach, feet);
  double deepest = 0.0;
  for (const geometry::Projection& foot : feet)
    deepest = std::max(deepest, -foot.gap);
  return deepest;
}

ContactBench bench_with(const BodyKind& body, geometry::SurfacePtr surface) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = faces_at(mesh, 1, 0.0);
  return ContactBench(std::move(mesh), body.analysis, bench_material(),
                      one_tool(still_tool(std::move(surface), Frictionless{})), {}, faces);
}

TEST(ContactCertificate, IsAboveAHundredfoldSamplesOfDistortedFacesAndTight) {
  // A hundredth is asked of the search, three of balls that are known, the samples miss the rest.
  constexpr double tight_at_first = 0.02, tight = 0.04;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> by(-0.04, 0.04);
  for (const BodyKind& body : body_kinds())
    for (std::size_t t = 0; t < tools_for(body).size(); ++t) {
      NamedTool tool = std::move(tools_for(body)[t]);
      ContactBench bench = bench_with(body, std::move(tool.surface));
      double loosest = 0.0, deepest = 0.0;
      for (int shape = 0; shape < 5; ++shape) {
        std::vector<double> x = bench.x;
        for (double& value : x)
          value += by(generator);
        bench.assemble(x, 0.0);
        const Penetration found = bench.term.certify({0.0, 0.0, bench.x, x}, HUGE_VAL);
        const double sampled = brute(bench.surface, x, bench.tools[0]);
        EXPECT_GE(found.bound, sampled - rounding) << body.name() << ", " << tool.name;
        EXPECT_GE(found.bound, found.sampled);
        EXPECT_GE(found.sampled, found.at_points);
        EXPECT_GE(found.share * 1.2, found.bound); // elements 1 high, distorted
        const double reached = std::max(sampled, found.sampled);
        EXPECT_LE(found.bound, (1.0 + (shape == 0 ? tight_at_first : tight)) * reached)
            << body.name() << ", " << tool.name;
        if (reached > 0.0)
          loosest = std::max(loosest, found.bound / reached - 1.0);
        deepest = std::max(deepest, sampled);
      }
      std::printf("%-20s %-9s deepest %.4f, bound at most %.2f %% above\n", body.name().c_str(),
                  tool.name.c_str(), deepest, 100.0 * loosest);
      EXPECT_GT(deepest, 0.01) << body.name() << ", " << tool.name;
    }
}

TEST(ContactCertificate, SeesACornerBetweenContactPoints) {
  // The wedge's tip lies in the middle of the first face, between its two points.
  ContactBench bench =
      bench_with(body_kinds()[1], std::move(tools_for(body_kinds()[1])[3].surface));
  bench.assemble(bench.x, 0.0);
  EXPECT_FALSE(bench.force().isZero(0.0)) << "the corner presses (C.46)";
  const Penetration found = bench.term.certify({0.0, 0.0, bench.x, bench.x}, HUGE_VAL);
  EXPECT_EQ(found.at_points, 0.0);
  EXPECT_GT(found.bound, 0.005);
  EXPECT_NEAR(found.position[0], 1.47, 0.02);
  EXPECT_EQ(found.tool, 0u);
}

TEST(ContactCertificate, CostsNothingWhereKnownDistancesKeepFacesClear) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, geometry::make_plane({0, -2, 0}, {0, 1, 0}));
    bench.assemble(bench.x, 0.0);
    const Penetration found = bench.term.certify({0.0, 0.0, bench.x, bench.x}, HUGE_VAL);
    EXPECT_EQ(found.bound, 0.0) << body.name();
    EXPECT_EQ(found.queries, 0u) << body.name();
  }
}

} // namespace
} // namespace billet::contact::contact_certificate_test
