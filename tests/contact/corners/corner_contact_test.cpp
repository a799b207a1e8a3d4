// Corners of tools between the contact points of faces: forces, derivatives, works.

#include "contact/term/contact_term.h"
#include "geometry/surfaces/profile.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace billet::contact::corner_contact_test {
namespace {

using mechanics::Analysis;

/// A ridge that points up, its top at `top`, its flanks at 45 degrees.
///
/// @param radius  of its rounding; 0: sharp [mm]
geometry::SurfacePtr ridge(const Vec2& top, double radius = 0.0) {
  const double aside = radius / std::numbers::sqrt2;
  geometry::Profile profile;
  profile.start = top + Vec2(2.0, -2.0) + Vec2(0.0, radius * (std::numbers::sqrt2 - 1.0));
  if (radius > 0.0)
    profile.segments = {{top + Vec2(aside, aside - radius), 0.0},
                        {top + Vec2(-aside, aside - radius), radius}};
  else
    profile.segments = {{top, 0.0}};
  profile.segments.push_back({Vec2(2.0 * top.x() - profile.start.x(), profile.start.y()), 0.0});
  return geometry::make_profile(profile);
}

/// The body lies on y = 0, x = 1 ... 3, two elements of length 1, with the ridge beneath it.
ContactBench bench_on(const BodyKind& body, Tool tool, double penalty = 100.0) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = faces_at(mesh, 1, 0.0);
  return {std::move(mesh),
          body.analysis,
          bench_material(),
          one_tool(std::move(tool)),
          ContactSettings{.penalty = penalty, .penalty_tangent = 0.1 * penalty},
          faces};
}

std::vector<BodyKind> plane_kinds() {
  std::vector<BodyKind> kinds;
  for (const BodyKind& body : body_kinds())
    if (!body.solid())
      kinds.push_back(body);
  return kinds;
}

/// All nodes moved by the same way.
std::vector<double> moved(const ContactBench& bench, const Vec2& way) {
  std::vector<double> x = bench.x;
  for (std::size_t i = 0; i < as_size(bench.pattern.n_dofs()); ++i)
    x[i] += way[static_cast<Eigen::Index>(i % 2)];
  return x;
}

/// Sum of the forces on the nodes.
Vec2 sum(const ContactBench& bench) {
  Vec2 total = Vec2::Zero();
  const Eigen::VectorXd f = bench.force();
  for (Eigen::Index i = 0; i < f.size(); ++i)
    total[i % 2] += f[i];
  return total;
}

TEST(CornerContact, PressesLikeAPointOfHalfAnElement) {
  constexpr double deep = 1e-3, place = 1.48;
  for (const BodyKind& body : plane_kinds())
    for (const double radius : {0.0, 0.05}) {
      ContactBench bench =
          bench_on(body, still_tool(ridge(Vec2(place, deep), radius), Frictionless{}));
      bench.assemble(bench.x, 1.0);
      const bool turns = body.analysis == Analysis::axisymmetric;
      // Between the element's own depth and the mean with its neighbour's.
      const CornerTrial& corner = bench.term.state().tools[0].trial.corners[0];
      ASSERT_TRUE(corner.press.foot) << body.name();
      const double depth = corner.press.depth;
      const double own = bench.surface.depth(corner.press.foot->face);
      const double other = bench.surface.depth(1 - corner.press.foot->face);
      EXPECT_GE(depth, std::min(own, 0.5 * (own + other)) - 1e-12) << body.name();
      EXPECT_LE(depth, std::max(own, 0.5 * (own + other)) + 1e-12) << body.name();
      const double area = 0.5 * depth * (turns ? 2.0 * std::numbers::pi * place : 1.0);
      const double expected = bench.surface.penalty().normal * area * deep;
      EXPECT_NEAR(sum(bench).y(), expected, 1e-9 * expected) << body.name();
      EXPECT_NEAR(sum(bench).x(), 0.0, 1e-9 * expected) << body.name();
      bench.commit(bench.x, 1.0);
      EXPECT_NEAR(bench.term.loads()[0].force.y(), -expected, 1e-9 * expected);
      EXPECT_NEAR(bench.term.work().stored, 0.5 * expected * deep, 1e-9 * expected * deep);
    }
}

TEST(CornerContact, PressesOnlyWhereItLooks) {
  // A face that lies flat on the flank of the ridge has its points on it; seen from behind, or
  // through a thin sheet, a corner does not press.
  const BodyKind& body = body_kinds()[0];
  for (const double deep : {-1e-3, 0.9}) { // outside; nearer to the far side of the body
    ContactBench bench = bench_on(body, still_tool(ridge(Vec2(1.48, deep)), Frictionless{}));
    bench.assemble(bench.x, 1.0);
    EXPECT_FALSE(bench.term.state().tools[0].trial.corners[0].press.foot.has_value()) << deep;
  }
  ContactBench bench = bench_on(body, still_tool(ridge(Vec2(1.48, 1e-3)), Frictionless{}));
  std::vector<double> tilted = bench.x; // by 60 degrees: beyond the flank's 45
  for (std::size_t i = 0; i < tilted.size(); i += 2)
    tilted[i + 1] += std::sqrt(3.0) * (bench.x[i] - 1.48);
  bench.assemble(tilted, 1.0);
  EXPECT_FALSE(bench.term.state().tools[0].trial.corners[0].press.foot.has_value());
}

TEST(CornerContact, TakesOverFromTheSideBesideIt) {
  // Half where the face lies along a flank, all of it and nothing soon on both sides.
  const BodyKind& body = body_kinds()[0];
  ContactBench bench = bench_on(body, still_tool(ridge(Vec2(1.48, 1e-3)), Frictionless{}));
  for (const auto& [degrees, share] :
       {std::pair{45.0, 0.5}, std::pair{43.0, 1.0}, std::pair{47.0, 0.0}}) {
    std::vector<double> tilted = bench.x;
    for (std::size_t i = 0; i < tilted.size(); i += 2)
      tilted[i + 1] += std::tan(degrees * std::numbers::pi / 180.0) * (bench.x[i] - 1.48);
    bench.assemble(tilted, 1.0);
    const auto& foot = bench.term.state().tools[0].trial.corners[0].press.foot;
    EXPECT_NEAR(foot ? foot->facing : 0.0, share, 1e-9) << degrees;
  }
}

TEST(CornerContact, PressesAtTheEndOfTheFacesAsOnAPlaneOfSymmetry) {
  const BodyKind& body = body_kinds()[0];
  for (const double aside : {0.0, -5e-4, -2e-3}) { // the faces begin at x = 1
    ContactBench bench = bench_on(body, still_tool(ridge(Vec2(1.0 + aside, 1e-3)), Frictionless{}));
    bench.assemble(bench.x, 1.0);
    EXPECT_EQ(bench.term.state().tools[0].trial.corners[0].press.foot.has_value(), aside > -1e-3)
        << aside;
  }
}

TEST(CornerContact, PressesAsideOfTheBottomOfASharpNotch) {
  // Behind one face of the notch only, closest to its bottom all the same.
  const Vec2 aside(0.8e-3, 1e-3);
  ContactBench bench =
      bench_on(body_kinds()[0], still_tool(ridge(Vec2(2.0, 0.0) + aside), Frictionless{}));
  for (std::size_t a = 0; a < bench.mesh.points.size(); ++a)
    if (const Vec3& p = bench.mesh.points[a]; p.y() == 0.0)
      bench.x[2 * a + 1] -= 1.5 * std::abs(p.x() - 2.0);
  bench.assemble(bench.x, 1.0);
  const auto& foot = bench.term.state().tools[0].trial.corners[0].press.foot;
  ASSERT_TRUE(foot.has_value());
  EXPECT_NEAR(foot->depth, aside.norm(), 1e-12);
  EXPECT_TRUE(foot->normal.isApprox(aside.normalized(), 1e-9));
}

TEST(CornerContact, IsFiniteWithItsCentreOnANode) {
  constexpr double radius = 0.05;
  ContactBench bench =
      bench_on(body_kinds()[0], still_tool(ridge(Vec2(2.0, radius), radius), Coulomb{0.2}));
  bench.assemble(bench.x, 1.0);
  EXPECT_TRUE(bench.force().allFinite());
  EXPECT_TRUE(bench.tangent().allFinite());
  EXPECT_GT(sum(bench).y(), 0.0);
}

TEST(CornerContact, DrawsBackWithItsTool) {
  ContactBench bench =
      bench_on(body_kinds()[1], still_tool(ridge(Vec2(1.48, 1e-3)), Frictionless{}));
  bench.commit(bench.x, 1.0);
  const double pressed = sum(bench).y();
  bench.term.retreat(0, 4e-4, 4e-4);
  bench.commit(bench.x, 2.0);
  EXPECT_NEAR(sum(bench).y(), 0.6 * pressed, 1e-9 * pressed);
  // What the spring gives back goes to the tool that draws back.
  EXPECT_NEAR(bench.term.work().external, -0.5 * 4e-4 * 1.6 * pressed, 1e-9 * pressed * 1e-3);
  EXPECT_NEAR(bench.term.work().stored, 0.5 * 0.6 * pressed * 6e-4, 1e-9 * pressed * 1e-3);
  bench.term.retreat(0, 7e-4, 1.1e-3);
  bench.commit(bench.x, 3.0);
  EXPECT_EQ(sum(bench).y(), 0.0);
  EXPECT_EQ(bearing_area(bench.term), 0.0);
}

/// Largest difference of the tangent and the borders from central differences, over the largest
/// entry.
double worst_derivative(ContactBench& bench, const std::vector<double>& at) {
  constexpr double h = 1e-7;
  const auto n = as_size(bench.pattern.n_dofs());
  bench.assemble(at, 1.0);
  const Eigen::MatrixXd K = bench.tangent();
  const std::vector<mechanics::Border> borders = bench.system.borders;
  double largest = 0.0, worst = 0.0;
  for (std::size_t j = 0; j < at.size(); ++j) {
    std::vector<double> x = at;
    x[j] += h;
    const std::vector<double> above = bench.assemble(x, 1.0).residual;
    x[j] -= 2.0 * h;
    const std::vector<double> below = bench.assemble(x, 1.0).residual;
    EXPECT_EQ(bench.system.contact_changes, 0);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double slope = (above[i] - below[i]) / (2.0 * h);
      double value = 0.0;
      if (i < n && j < n)
        value = K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      else
        value = j < n   ? borders[i - n].row[j]
                : i < n ? borders[j - n].column[i]
                        : borders[i - n].corner[j - n];
      largest = std::max(largest, std::abs(value));
      worst = std::max(worst, std::abs(slope - value));
    }
  }
  EXPECT_GT(largest, 0.0);
  return worst / largest;
}

/// Free to travel and to turn.
Tool driven(Tool tool) {
  tool.motion.force = geometry::Drive{Vec3::Zero(), Vec3(0.6, 0.8, 0), TimeFunction({{0.0, 30.0}})};
  tool.motion.torque =
      geometry::Drive{Vec3(1.0, -2.0, 0.0), Vec3::UnitZ(), TimeFunction({{0.0, 500.0}})};
  return tool;
}

TEST(CornerContact, DerivativesAreThoseOfDifferences) {
  constexpr double tolerance = 1e-6, deep = 2e-3;
  double worst = 0.0;
  for (const BodyKind& body : plane_kinds())
    for (const double radius : {0.0, 0.05})
      for (const double place : {1.48, 2.0}) // within a face; behind the node of two
        for (const Friction& friction :
             {Friction(Frictionless{}), Friction(Sticking{}), Friction(Coulomb{0.2})}) {
          Tool tool = still_tool(ridge(Vec2(place, deep), radius), friction);
          const bool drives = body.analysis == Analysis::plane_strain;
          ContactBench bench = bench_on(body, drives ? driven(std::move(tool)) : std::move(tool));
          if (place == 2.0) // a notch, with its node off the corner
            for (std::size_t a = 0; a < bench.mesh.points.size(); ++a) {
              const Vec3& p = bench.mesh.points[a];
              if (p.y() == 0.0)
                bench.x[2 * a + 1] += p.x() == 2.0 ? -0.02 : -0.3 * std::abs(p.x() - 2.0) - 0.02;
            }
          bench.commit(bench.x, 0.5);
          std::vector<double> at = bench.x;
          const auto n = as_size(bench.pattern.n_dofs());
          for (std::size_t i = 0; i < n; ++i)
            at[i] += 3e-4 * std::sin(3.0 * static_cast<double>(i)) + (i % 2 == 0 ? 1e-3 : 0.0);
          if (drives) {
            at[n] = 1e-4;
            at[n + 1] = 2e-3;
          }
          bench.assemble(at, 1.0);
          ASSERT_TRUE(bench.term.state().tools[0].trial.corners[0].press.foot ||
                      bench.term.state().tools[0].trial.corners.back().press.foot)
              << body.name() << ", place " << place << ", radius " << radius;
          const double error = worst_derivative(bench, at);
          EXPECT_LE(error, tolerance) << body.name() << ", place " << place << ", radius " << radius
                                      << ", friction " << friction.law.index();
          worst = std::max(worst, error);
        }
  std::printf("[CORNER] derivatives differ by at most %.1e from differences (allowed %.0e)\n",
              worst, tolerance);
}

TEST(CornerContact, RubsAndKeepsTheBooks) {
  // The face is drawn over the corner by a fifth of its length.
  constexpr double deep = 1e-3, way = 0.2, mu = 0.2;
  constexpr int steps = 20;
  for (const BodyKind& body : plane_kinds()) {
    ContactBench bench = bench_on(body, still_tool(ridge(Vec2(1.6, 0.0)), Coulomb{mu}));
    bench.commit(moved(bench, Vec2(0.0, -deep)), 0.5);
    const double pressed = std::abs(bench.term.loads()[0].force.y());
    const double down = bench.entered;
    // Where the parent elements differ the corner's share does, too.
    const bool even = std::abs(bench.surface.depth(0) - bench.surface.depth(1)) < 1e-9;
    const double exact = even ? 1e-9 : 0.02;
    double rubbed = 0.0;
    for (int i = 0; i < steps; ++i) {
      bench.commit(moved(bench, Vec2(way / steps, 0.0)), bench.time_old + 1.0);
      rubbed += mu * pressed * way / steps;
      EXPECT_NEAR(bench.term.loads()[0].force.y(), -pressed, exact * pressed) << body.name();
      if (body.analysis == Analysis::plane_strain) {
        EXPECT_NEAR(bench.term.loads()[0].force.x(), mu * pressed, exact * pressed) << body.name();
      }
    }
    const ContactWork& work = bench.term.work();
    // It sticks for the first two thousandths of a millimetre.
    EXPECT_NEAR(work.friction, rubbed, 0.02 * rubbed) << body.name();
    EXPECT_NEAR(down, 0.5 * pressed * deep, 1e-9 * pressed * deep) << body.name();
    EXPECT_NEAR(bench.entered, work.stored + work.friction - work.unseen,
                (even ? 1e-6 : 1e-3) * rubbed)
        << body.name();
  }
}

TEST(CornerContact, GoesOnWithItsPressureOnANewMesh) {
  // The body lies a little deeper on it, and higher.
  for (const double off : {4e-4, -4e-4}) {
    ContactBench old = bench_on(body_kinds()[1], still_tool(ridge(Vec2(1.48, 0.0)), Coulomb{0.2}));
    ContactBench anew = bench_on(body_kinds()[0], still_tool(ridge(Vec2(1.48, 0.0)), Coulomb{0.2}));
    old.commit(moved(old, Vec2(0.0, -1e-3)), 0.5);
    old.commit(moved(old, Vec2(0.01, 0.0)), 1.0);
    anew.x = moved(anew, Vec2(0.01, -1e-3 + off));
    anew.time_old = 1.0;
    anew.term.start(anew.x, 1.0);
    const std::vector<PointSource> sources(anew.surface.n_points(),
                                           PointSource::between(0, 1, 0.5));
    anew.term.go_on_from(snapshot(old.term.state()), {sources, anew.x, 1.0});
    anew.assemble(anew.x, 1.0);
    const Vec2 before = -old.term.loads()[0].force.head<2>();
    EXPECT_NEAR((sum(anew) - before).norm(), 0.0, 1e-9 * before.norm()) << off;
    // What the mesh is off by decays as the part goes on.
    anew.commit(anew.x, 1.0);
    for (int i = 0; i < 10; ++i)
      anew.commit(moved(anew, Vec2(0.001, 0.0)), anew.time_old + 1.0);
    const double there = anew.surface.penalty().normal * 0.5 * (1e-3 - off);
    EXPECT_NEAR(anew.term.loads()[0].force.y(), -there, 0.05 * there) << off;
  }
}

TEST(CornerContact, IsReleasedWithItsTool) {
  ContactBench bench = bench_on(body_kinds()[1], still_tool(ridge(Vec2(1.48, 1e-3)), Sticking{}));
  bench.commit(bench.x, 1.0);
  const Eigen::VectorXd pressed = bench.force();
  EXPECT_TRUE(leaves(bench.term, 0, 1.0) || lies_on(bench.term, 0));
  const std::vector<double> released = bench.term.release(0);
  const Eigen::VectorXd there =
      Eigen::Map<const Eigen::VectorXd>(released.data(), bench.pattern.n_dofs());
  EXPECT_NEAR((there - pressed).norm(), 0.0, 1e-9 * pressed.norm());
  EXPECT_EQ(bench.term.work().stored, 0.0);
}

} // namespace
} // namespace billet::contact::corner_contact_test
