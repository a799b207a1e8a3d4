// Points that keep changing between open, stick and slip, and get the slip limit of the pressure
// that they had when the increment began. (F.3a)

#include "contact/term/contact_report.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace billet::contact::friction_lag_test {
namespace {

ContactBench bench_with(const BodyKind& body, double mu) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = mechanics::boundary_faces(mesh);
  return {std::move(mesh),
          body.analysis,
          bench_material(),
          one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Coulomb{mu})),
          {},
          faces};
}

std::vector<double> moved(const ContactBench& bench, double along, double down) {
  std::vector<double> x = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += i % dim == 0 ? along : i % dim == 1 ? -down : 0.0;
  return x;
}

/// Contact that opens and closes in one try until its points count as chattering.
void chatter(ContactBench& bench) {
  bench.commit(moved(bench, 0.0, 1e-4), 1.0);
  bench.term.restart();
  for (int i = 0; i <= chattering_changes; ++i)
    bench.assemble(moved(bench, 0.0, i % 2 == 0 ? -1e-2 : 0.0), 2.0);
}

TEST(FrictionLag, BoundsShearByThePressureBefore) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, 0.3);
    chatter(bench);
    ASSERT_TRUE(bench.term.restart_friction_lagged()) << body.name();
    bench.assemble(moved(bench, 1e-2, 1e-4), 2.0); // twice as deep as it was
    const auto now = [&](std::size_t k) { return trial_traction(bench.term, 0, k); };
    std::size_t n_pressed = 0;
    for (std::size_t k = 0; k < bench.term.view().state.positions.size(); ++k) {
      if (now(k).pressure == 0.0)
        continue;
      ++n_pressed;
      EXPECT_EQ(now(k).status, Status::slip) << body.name();
      EXPECT_NEAR(now(k).shear.norm(), 0.15 * now(k).pressure, 1e-9 * now(k).pressure);
      EXPECT_NEAR(now(k).lag, 0.15 * now(k).pressure, 1e-9 * now(k).pressure);
    }
    EXPECT_GT(n_pressed, 0U) << body.name();
    EXPECT_TRUE(friction_lags(bench.term)) << body.name();
    bench.term.restart();
    bench.assemble(moved(bench, 1e-2, 1e-4), 2.0);
    EXPECT_FALSE(friction_lags(bench.term)) << body.name() << ": no point lags";
  }
}

TEST(FrictionLag, IsNotToldWhereNothingSlidesNorWhereThePressureStays) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, 0.3);
    chatter(bench);
    ASSERT_TRUE(bench.term.restart_friction_lagged()) << body.name();
    bench.assemble(moved(bench, 0.0, 1e-4), 2.0);
    EXPECT_FALSE(friction_lags(bench.term)) << body.name() << ": nothing slides";
    bench.assemble(moved(bench, 1e-2, 0.0), 2.0);
    EXPECT_FALSE(friction_lags(bench.term)) << body.name() << ": the pressure is that before";
  }
}

TEST(FrictionLag, EndsWithThePressure) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, 0.3);
    chatter(bench);
    ASSERT_TRUE(bench.term.restart_friction_lagged()) << body.name();
    bench.assemble(moved(bench, 1e-2, -0.999e-4), 2.0); // a thousandth of the pressure before
    for (std::size_t k = 0; k < bench.term.view().state.positions.size(); ++k) {
      const Traction& now = trial_traction(bench.term, 0, k);
      EXPECT_LE(now.shear.norm(), 30.0 * now.pressure * (1.0 + 1e-9)) << body.name();
    }
  }
}

} // namespace
} // namespace billet::contact::friction_lag_test
