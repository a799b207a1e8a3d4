// Rows and columns of driven tools against differences of the residual.

#include "contact/term/contact_term.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace billet::contact::drive_test {
namespace {

/// A round tool under a body, free to travel and to turn; the body is pressed a little into it.
ContactBench
driven_bench(mechanics::ElementKind kind, const Friction& friction, double penalty = 1.0) {
  const bool solid = kind != mechanics::ElementKind::quad8;
  Tool tool = still_tool(solid ? geometry::make_sphere({1.0, -3.99, 0.4}, 4.0, false)
                               : geometry::make_circle({1.0, -3.99, 0.0}, 4.0, false),
                         friction);
  tool.motion.force = geometry::Drive{Vec3::Zero(), solid ? Vec3(0.6, 0.0, 0.8) : Vec3(0.6, 0.8, 0),
                                      TimeFunction({{0.0, 30.0}})};
  tool.motion.torque =
      geometry::Drive{Vec3(1.0, -3.99, 0.2), solid ? Vec3(0.0, 0.6, 0.8) : Vec3(0.0, 0.0, 1.0),
                      TimeFunction({{0.0, 500.0}})};
  mechanics::Mesh mesh = mechanics::box_mesh(
      {kind, Vec3::Zero(), Vec3(2, 1, solid ? 1 : 0), {3, 1, solid ? 2 : 1}, {1, 1, 1}});
  const auto faces = faces_at(mesh, 1, 0.0);
  return {std::move(mesh),
          solid ? mechanics::Analysis::solid : mechanics::Analysis::plane_strain,
          bench_material(),
          one_tool(std::move(tool)),
          ContactSettings{.penalty = penalty, .penalty_tangent = 1.0},
          faces};
}

/// Largest difference between the borders and central differences, over the largest entry.
double worst_border(ContactBench& bench, const std::vector<double>& at) {
  const auto n = static_cast<std::size_t>(bench.pattern.n_dofs());
  const std::size_t m = at.size() - n;
  const std::vector<mechanics::Border> exact = bench.assemble(at, 1.0).borders;
  constexpr double h = 1e-6;
  double largest = 0.0;
  double worst = 0.0;
  for (std::size_t j = 0; j < at.size(); ++j) {
    std::vector<double> x = at;
    x[j] += h;
    const std::vector<double> above = bench.assemble(x, 1.0).residual;
    x[j] -= 2.0 * h;
    const std::vector<double> below = bench.assemble(x, 1.0).residual;
    EXPECT_EQ(bench.system.contact_changes, 0);
    for (std::size_t i = j < n ? n : 0; i < at.size(); ++i) {
      const double slope = (above[i] - below[i]) / (2.0 * h);
      const double value = j < n   ? exact[i - n].row[j]
                           : i < n ? exact[j - n].column[i]
                                   : exact[i - n].corner[j - n];
      largest = std::max(largest, std::abs(value));
      worst = std::max(worst, std::abs(slope - value));
    }
  }
  EXPECT_EQ(m, 2U);
  EXPECT_GT(largest, 0.0);
  return worst / largest;
}

TEST(Drive, rows_and_columns_are_those_of_differences) {
  constexpr double tolerance = 1e-6; // DESIGN: tangents to 1e-6 of their norm
  using mechanics::ElementKind;
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex8, ElementKind::hex20})
    for (const Friction& friction :
         {Friction(Frictionless{}), Friction(Sticking{}), Friction(Coulomb{0.1})}) {
      ContactBench bench = driven_bench(kind, friction);
      bench.commit(bench.x, 0.5);
      std::vector<double> at = bench.x;
      const auto n = static_cast<std::size_t>(bench.pattern.n_dofs());
      for (std::size_t i = 0; i < n; ++i)
        at[i] += 1e-3 * std::sin(3.0 * static_cast<double>(i));
      at[n] = 2e-3;
      at[n + 1] = 0.05;
      const double worst = worst_border(bench, at);
      std::printf("[DRIVE] %s, friction %zu: borders differ by %.1e from differences (allowed "
                  "%.0e)\n",
                  std::string(mechanics::name(kind)).c_str(), friction.law.index(), worst,
                  tolerance);
      EXPECT_LE(worst, tolerance);
    }
}

// On pressure-averaged faces (C.45) the pressure of a point goes with the gaps of the others, too.
TEST(Drive, rows_and_columns_of_even_faces_are_those_of_differences) {
  using mechanics::ElementKind;
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex20}) {
    ContactBench bench = driven_bench(kind, Coulomb{0.1}, 50.0);
    for (std::size_t a = 0; a < bench.mesh.points.size(); ++a) {
      const Vec3 r =
          bench.mesh.points[a] - Vec3(1.0, -3.99, kind == ElementKind::hex20 ? 0.4 : 0.0);
      const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
      bench.x[a * dim + 1] -= r.norm() - 3.995 > 0.2 ? 0.0 : r.norm() - 3.995; // all of it lies on
    }
    bench.commit(bench.x, 0.3);
    bench.commit(bench.x, 0.5);
    std::vector<double> at = bench.x;
    const auto n = static_cast<std::size_t>(bench.pattern.n_dofs());
    for (std::size_t i = 0; i < n; ++i)
      at[i] += 1e-4 * std::sin(3.0 * static_cast<double>(i));
    at[n] = 1e-4;
    at[n + 1] = 0.002;
    EXPECT_LE(worst_border(bench, at), 1e-6);
  }
}

TEST(Drive, unknowns_follow_the_order_of_the_tools) {
  std::vector<Tool> tools(3);
  tools[0].motion.torque = geometry::Drive{};
  tools[2].motion.force = geometry::Drive{};
  tools[2].motion.torque = geometry::Drive{};
  const std::vector<DriveUnknown> drives = drive_unknowns(tools);
  ASSERT_EQ(drives.size(), 3U);
  EXPECT_EQ(drives[0].tool, 0U);
  EXPECT_TRUE(drives[0].turns);
  EXPECT_EQ(drives[1].tool, 2U);
  EXPECT_FALSE(drives[1].turns);
  EXPECT_TRUE(drives[2].turns);
}

} // namespace
} // namespace billet::contact::drive_test
