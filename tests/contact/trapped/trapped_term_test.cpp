// Pockets of a body with a dent in its lower face, which lies on a tool on both sides of the dent.

#include "contact/trapped/trapped_term.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace billet::contact::trapped_term_test {
namespace {

constexpr double sunk = 0.005;  ///< the body lies that deep in the tool [mm]
constexpr double deepest = 0.1; ///< of the dent [mm]

/// From x = 1 to 7, a dent from 3 to 5 in y = 0, parabolic.
mechanics::Mesh dented(const BodyKind& body) {
  mechanics::Mesh mesh =
      mechanics::box_mesh({body.kind, Vec3(1, 0, 0), Vec3(7, 1, 0), {12, 1, 1}, {1, 1, 1}});
  for (Vec3& p : mesh.points)
    if (p.y() == 0.0 && std::abs(p.x() - 4.0) < 1.0)
      p.y() = deepest * (1.0 - (p.x() - 4.0) * (p.x() - 4.0));
  return mesh;
}

Tool tool_below(bool driven) {
  Tool tool = still_tool(geometry::make_plane({4, sunk, 0}, {0, 1, 0}), Frictionless{});
  if (driven)
    tool.motion.force = geometry::Drive{Vec3::Zero(), Vec3(0.0, 1.0, 0.0), TimeFunction(10.0)};
  return tool;
}

class Pockets : public testing::TestWithParam<BodyKind> {
protected:
  explicit Pockets(bool driven = false)
      : mesh_(dented(GetParam())), faces_(mechanics::boundary_faces(mesh_)),
        bench_(mesh_,
               GetParam().analysis,
               bench_material(),
               one_tool(tool_below(driven)),
               ContactSettings{.penalty = 1.0, .penalty_tangent = 1.0},
               faces_) {}

  /// The volume under the dent, seen by the mesh: linear faces cut its bow.
  [[nodiscard]] double volume() const {
    const bool linear = GetParam().kind == mechanics::ElementKind::quad4;
    // Between x = 3 and 5, of y - sunk: the parabola, or its chords over half a millimetre each.
    const double area = 2.0 * deepest * (2.0 / 3.0) - 2.0 * sunk -
                        (linear ? deepest * 4.0 * 0.5 * 0.5 * 0.5 / 6.0 : 0.0);
    return GetParam().analysis == mechanics::Analysis::axisymmetric
               ? 2.0 * std::numbers::pi * 4.0 * area // symmetric about x = 4
               : area;
  }
  [[nodiscard]] TrappedTerm closed(const TrappedMedium& medium) {
    bench_.commit(bench_.x, 1.0);
    TrappedTerm term(bench_.term, medium, {});
    term.commit({0.0, 1.0, bench_.x, bench_.x});
    return term;
  }
  /// Of the trapped medium alone.
  mechanics::System& assembled(TrappedTerm& term, const std::vector<double>& at) {
    bench_.system.clear();
    EXPECT_TRUE(term.assemble({1.0, 2.0, bench_.x, at}, bench_.system));
    return bench_.system;
  }
  /// All of the body comes down, and every node goes somewhere else.
  [[nodiscard]] std::vector<double> shaken() const {
    constexpr double size = 0.002, down = 0.02;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> component(-size, size);
    std::vector<double> at = bench_.x;
    for (std::size_t i = 0; i < at.size(); ++i)
      at[i] += component(generator) - (i % 2 == 1 ? down : 0.0);
    return at;
  }

  mechanics::Mesh mesh_;
  std::vector<mechanics::Face> faces_;
  ContactBench bench_;
};

class PocketsOfDrivenTool : public Pockets {
protected:
  PocketsOfDrivenTool() : Pockets(true) {}
};

TEST_P(Pockets, AreFoundWithTheirVolume) {
  const TrappedTerm term = closed(TrappedGas{0.1, 1.0});
  ASSERT_EQ(term.state().pockets.size(), 1U);
  const Pocket& pocket = term.state().pockets.front();
  EXPECT_EQ(pocket.place.faces.size(), 4U);
  EXPECT_NEAR(pocket.volume / volume(), 1.0, 1e-12);
  EXPECT_EQ(pocket.pressure, 0.0);
  EXPECT_NEAR(pocket.place.centre.x(), 4.0,
              GetParam().analysis == mechanics::Analysis::axisymmetric ? 0.1 : 1e-12);
}

TEST_P(Pockets, PressAsTheirVolumeTells) {
  TrappedTerm term = closed(TrappedGas{0.1, 1.0});
  std::vector<double> at = bench_.x; // all of the body comes down by a tenth of the dent
  for (std::size_t i = 1; i < static_cast<std::size_t>(bench_.pattern.n_dofs()); i += 2)
    at[i] -= 0.1 * deepest;
  const mechanics::System& system = assembled(term, at);
  // Over the dent's width the same is gone everywhere.
  const bool turned = GetParam().analysis == mechanics::Analysis::axisymmetric;
  const double width = turned ? 2.0 * std::numbers::pi * 4.0 * 2.0 : 2.0;
  const double left = volume() - 0.1 * deepest * width;
  const double dead = term.state().pockets.front().dead_volume;
  const PocketPlace& place = term.state().pockets.front().place;
  double depth = 0.0;
  for (const Index face : place.faces)
    depth += bench_.surface.depth(face) / static_cast<double>(place.faces.size());
  EXPECT_NEAR(dead, 0.005 * depth * place.area, 1e-12);
  const double pressure = 0.1 * ((volume() + dead) / (left + dead) - 1.0);
  double up = 0.0;
  for (std::size_t i = 1; i < static_cast<std::size_t>(bench_.pattern.n_dofs()); i += 2)
    up -= system.residual[i];
  EXPECT_NEAR(up / (pressure * width), 1.0, 1e-12);
}

TEST_P(Pockets, TangentIsThatOfDifferences) {
  TrappedTerm term = closed(TrappedLubricant{20.0});
  const std::vector<double> at = shaken();
  const mechanics::System system = assembled(term, at);
  const auto n = static_cast<std::size_t>(bench_.pattern.n_dofs());
  std::vector<double> exact(n * n, 0.0);
  for (const mechanics::Coupling& entry : system.couplings)
    exact[idx(entry.row) * n + idx(entry.column)] += entry.value;
  double largest = 0.0, worst = 0.0;
  constexpr double h = 1e-6;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> x = at;
    x[j] += h;
    const std::vector<double> above = assembled(term, x).residual;
    x[j] -= 2.0 * h;
    const std::vector<double> below = assembled(term, x).residual;
    for (std::size_t i = 0; i < n; ++i) {
      largest = std::max(largest, std::abs(exact[i * n + j]));
      worst = std::max(worst, std::abs((above[i] - below[i]) / (2.0 * h) - exact[i * n + j]));
    }
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(worst / largest, 1e-7);
}

TEST_P(PocketsOfDrivenTool, PressTheToolAsTheyPressTheMetal) {
  TrappedTerm term = closed(TrappedLubricant{20.0});
  std::vector<double> at = shaken();
  const auto n = static_cast<std::size_t>(bench_.pattern.n_dofs());
  at[n] = 0.004;
  const mechanics::System now = assembled(term, at);
  double on_metal = 0.0;
  for (std::size_t i = 1; i < n; i += 2)
    on_metal -= now.residual[i];
  EXPECT_NEAR(now.residual[n] / on_metal, 1.0, 1e-12); // the force on the tool is the opposite
  constexpr double h = 1e-6;
  double largest = 0.0, worst = 0.0;
  for (std::size_t j = 0; j <= n; ++j) {
    std::vector<double> x = at;
    x[j] += h;
    const std::vector<double> above = assembled(term, x).residual;
    x[j] -= 2.0 * h;
    const std::vector<double> below = assembled(term, x).residual;
    for (std::size_t i = j < n ? n : 0; i <= n; ++i) {
      const double value = j < n   ? now.borders[0].row[j]
                           : i < n ? now.borders[0].column[i]
                                   : now.borders[0].corner[0];
      largest = std::max(largest, std::abs(value));
      worst = std::max(worst, std::abs((above[i] - below[i]) / (2.0 * h) - value));
    }
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(worst / largest, 1e-7);
}

TEST_P(Pockets, WorkIsThatOfPressureOverVolume) {
  TrappedTerm term = closed(TrappedGas{0.1, 1.0});
  const double rest =
      term.state().pockets.front().volume + term.state().pockets.front().dead_volume;
  constexpr int steps = 50;
  double time = 1.0;
  for (int s = 0; s < steps; ++s) {
    std::vector<double> at = bench_.x;
    for (std::size_t i = 1; i < static_cast<std::size_t>(bench_.pattern.n_dofs()); i += 2)
      at[i] -= 0.4 * deepest / steps;
    const std::vector<double> before = bench_.x;
    bench_.commit(at, time + 1.0);
    term.commit({time, time + 1.0, before, at});
    time += 1.0;
  }
  ASSERT_EQ(term.state().pockets.size(), 1U);
  const Pocket& pocket = term.state().pockets.front();
  const double now = pocket.volume + pocket.dead_volume;
  EXPECT_NEAR((pocket.pressure + 0.1) * now / (0.1 * rest), 1.0, 1e-12); // Boyle
  // Done on the metal: -integral of (p - p0) dV, with the sign of a gas that is compressed.
  const double exact = -(0.1 * rest * std::log(rest / now) - 0.1 * (rest - now));
  EXPECT_NEAR(term.work() / exact, 1.0, 2e-3);
}

TEST_P(Pockets, AreVentedWhereTheToolLeavesTheirEnds) {
  TrappedTerm term = closed(TrappedGas{0.1, 1.0});
  std::vector<double> at = bench_.x;
  for (std::size_t i = 1; i < static_cast<std::size_t>(bench_.pattern.n_dofs()); i += 2)
    at[i] += 2.0 * sunk;
  const std::vector<double> before = bench_.x;
  bench_.commit(at, 2.0);
  term.commit({1.0, 2.0, before, at});
  EXPECT_TRUE(term.state().pockets.empty());
  EXPECT_EQ(term.state().n_closed, 1);
  EXPECT_EQ(term.state().n_vented, 1);
}

TEST_P(Pockets, ThatAreFullEndTheTry) {
  TrappedTerm term = closed(TrappedGas{0.1, 1.0});
  std::vector<double> at = bench_.x;
  for (std::size_t i = 1; i < static_cast<std::size_t>(bench_.pattern.n_dofs()); i += 2)
    at[i] -= 2.0 * deepest;
  bench_.system.clear();
  EXPECT_FALSE(term.assemble({1.0, 2.0, bench_.x, at}, bench_.system));
}

std::vector<BodyKind> plane_kinds() {
  using mechanics::Analysis;
  using mechanics::ElementKind;
  return {{ElementKind::quad4, Analysis::plane_strain},
          {ElementKind::quad8, Analysis::plane_strain},
          {ElementKind::quad4, Analysis::axisymmetric},
          {ElementKind::quad8, Analysis::axisymmetric}};
}

INSTANTIATE_TEST_SUITE_P(, Pockets, testing::ValuesIn(plane_kinds()));
INSTANTIATE_TEST_SUITE_P(, PocketsOfDrivenTool, testing::ValuesIn(plane_kinds()));

} // namespace
} // namespace billet::contact::trapped_term_test
