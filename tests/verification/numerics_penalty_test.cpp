// NUM-01: the penalty from 1e-2 to 1e6 times E / h, on a block 10 high pressed by 0.05.
//
// With nu = 0 the block is a column: Kirchhoff stress E ln(h / h0), pressure E ln(h0 / h) h0 / h at
// the height h = 9.95 + p / Kp. num01_penalty_block.csv has the small-strain figures.

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace billet::process::numerics_penalty_test {
namespace {

constexpr double young = 200e3, height = 10.0, press = 0.05;

/// The pressure in equilibrium with a penalty, by bisection.
double exact_pressure(double penalty) {
  double low = 0.0, high = press;
  for (int i = 0; i < 200; ++i) {
    const double depth = 0.5 * (low + high);
    const double h = height - press + depth;
    (young * std::log(height / h) * height / h > penalty * depth ? low : high) = depth;
  }
  const double h = height - press + 0.5 * (low + high);
  return young * std::log(height / h) * height / h;
}

struct Outcome {
  double pressure, spread;
  int iterations;
};

Outcome pressed(ElementKind kind, int n, double factor) {
  Upsetting u;
  const bool solid = mechanics::dimension(kind) == 3;
  u.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {kind, Vec3::Zero(), solid ? Vec3(10, 10, 10) : Vec3(10, 10, 0), {n, n, n}, {1, 1, 1}});
  u.height = height;
  u.material = elastic_body(young, 0.0);
  u.reduction = press / height;
  Scene scene = upsetting_scene(std::move(u));
  scene.part.contact_faces = faces_on(scene.part.mesh, up(scene.part.analysis), height);
  scene.contact.penalty = factor / n; // of E over the element's depth, h / n
  scene.increments.first = scene.increments.max = scene.stages[0].end;
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(done.process->view().state.increment, 1);
  double least = 1e300, most = 0.0;
  for (const auto& point : contact::point_results(*done.process->view().contact())) {
    least = std::min(least, point.pressure);
    most = std::max(most, point.pressure);
  }
  return {0.5 * (least + most), 1.0 - least / most, done.process->view().state.counters.iterations};
}

TEST(PenaltySweep, HasTheExactPressureInThreeIterations) {
  constexpr double tolerance = 1e-6;    // VALIDATION NUM-01
  constexpr double small_strain = 1e-2; // the CSV's column leaves out terms of the strain .005
  const double rigid = exact_pressure(1e30);
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8, ElementKind::hex20})
    for (const double factor : {1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
      const Outcome got = pressed(kind, kind == ElementKind::hex20 ? 2 : 3, factor);
      const double exact = exact_pressure(factor * young / height);
      const double csv = 1.0 / (1.0 + 1.0 / factor);
      std::printf(
          "%-5s Kp h/E %-7g p/p_rigid %.9f (small strain %.9f), error %.1e (<= 1e-6), spread "
          "%.1e, %d iterations (<= 3)\n",
          std::string(mechanics::name(kind)).c_str(), factor, got.pressure / rigid, csv,
          std::abs(got.pressure / exact - 1.0), got.spread, got.iterations);
      EXPECT_NEAR(got.pressure, exact, tolerance * exact);
      EXPECT_NEAR(got.pressure / rigid, csv, small_strain * csv);
      EXPECT_LT(got.spread, tolerance);
      EXPECT_LE(got.iterations, 3);
    }
}

} // namespace
} // namespace billet::process::numerics_penalty_test
