// Stiffer penalties and multipliers: what they do to the pressure, that an uncommitted one leaves
// no trace, and that the books of energy still close.

#include "contact/term/contact_term.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace billet::contact::penalty_factors_test {
namespace {

ContactBench on_the_floor(const Friction& law) {
  mechanics::Mesh mesh = bench_mesh(body_kinds()[4]);
  const auto faces = faces_at(mesh, 1, 0.0);
  return ContactBench(std::move(mesh), mechanics::Analysis::solid, bench_material(),
                      one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), law)),
                      {Form::mixed, 1.0, 1.0}, faces);
}

std::vector<double> moved(std::vector<double> x, const Vec3& by) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += by[static_cast<Eigen::Index>(i % 3)];
  return x;
}

TEST(PenaltyFactors, AMultiplierPressesWithoutPenetrationAndAcrossAGap) {
  const Penalty penalty{1000.0, 100.0};
  geometry::Projection foot;
  foot.normal = Vec3::UnitY();
  for (const double gap : {-2e-3, 0.0, 4e-3}) {
    foot.gap = gap;
    const Traction t = traction(Frictionless{}, penalty, {},
                                {Vec3(0, gap, 0), foot, 0.0, 0.0, 1.0, 1.0, false, 5.0});
    EXPECT_DOUBLE_EQ(t.pressure, 5.0 - 1000.0 * gap);
    EXPECT_EQ(t.dtraction_dx(1, 1), -1000.0);
  }
  foot.gap = 6e-3; // beyond 5 / 1000
  EXPECT_EQ(traction(Frictionless{}, penalty, {},
                     {Vec3(0, 6e-3, 0), foot, 0.0, 0.0, 1.0, 1.0, false, 5.0})
                .status,
            Status::open);
}

TEST(PenaltyFactors, AugmentingKeepsThePressureWhenThePenetrationGoes) {
  ContactBench bench = on_the_floor(Frictionless{});
  constexpr double depth = 1e-3;
  bench.assemble(moved(bench.x, {0, -depth, 0}), 1.0);
  const Eigen::VectorXd pressed = bench.force();
  bench.term.augment();
  bench.assemble(bench.x, 1.0);
  EXPECT_LT((bench.force() - pressed).norm(), 1e-12 * pressed.norm());
  bench.assemble(moved(bench.x, {0, 0.5 * depth, 0}), 1.0);
  EXPECT_LT((bench.force() - 0.5 * pressed).norm(), 1e-12 * pressed.norm());
  // Off the floor the known distance must not hide what a multiplier holds.
  bench.assemble(moved(bench.x, {0, 0.9 * depth, 0}), 1.0);
  EXPECT_LT((bench.force() - 0.1 * pressed).norm(), 1e-12 * pressed.norm());
}

TEST(PenaltyFactors, LeavesNoTraceOfATryThatWasRefused) {
  ContactBench bench = on_the_floor(Coulomb{0.2});
  bench.commit(moved(bench.x, {0, -1e-3, 0}), 1.0);
  const std::vector<double> trial = moved(bench.x, {1e-4, -1e-4, 0});
  bench.assemble(trial, 2.0);
  const Eigen::VectorXd before = bench.force();
  bench.term.augment();
  bench.term.stiffen(7.0);
  bench.assemble(trial, 2.0);
  EXPECT_GT((bench.force() - before).norm(), before.norm());
  bench.term.restart();
  EXPECT_EQ(bench.term.state().penalty.trial, 1.0);
  bench.assemble(trial, 2.0);
  EXPECT_EQ((bench.force() - before).norm(), 0.0);
}

TEST(PenaltyFactors, KeepsTheBooksOfEnergy) {
  // A stiff block wanders over a floor that holds it by penalties and multipliers changed at
  // random; what enters by the nodal forces and by penalty updates is stored or lost to friction.
  for (const auto& [name, law] : every_law()) {
    ContactBench bench = on_the_floor(law);
    std::mt19937 generator(11);
    double height = 0.0, largest = 0.0;
    for (int i = 1; i <= 200; ++i) {
      const Vec3 noise = random_vector(generator);
      const double next = -1e-3 * (1.0 + 0.5 * noise[0]);
      const std::vector<double> x =
          moved(bench.x, {1e-3 * noise[1], next - height, 1e-3 * noise[2]});
      height = next;
      bench.term.restart();
      bench.assemble(x, i);
      if (i % 3 == 0)
        bench.term.augment();
      if (i % 5 == 0)
        bench.term.stiffen(i % 2 == 0 ? 3.0 : 0.4);
      bench.commit(x, i);
      largest = std::max(largest, std::abs(bench.term.work().stored));
    }
    const ContactWork& work = bench.term.work();
    const double error =
        std::abs(bench.entered + work.penalty_update + work.unseen - work.friction - work.stored);
    std::printf(
        "%-22s entered %.4e, penalty updates %.4e, friction %.4e, stored %.4e: error %.1e\n",
        name.c_str(), bench.entered, work.penalty_update, work.friction, work.stored, error);
    EXPECT_NE(work.penalty_update, 0.0);
    EXPECT_LT(error, 1e-10 * (largest + work.friction)) << name;
  }
}

} // namespace
} // namespace billet::contact::penalty_factors_test
