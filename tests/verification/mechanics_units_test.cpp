// A pressed billet in three systems of units: VALIDATION NUM-04, and its balance of energy.

#include "tests/support/figures.h"
#include "tests/support/problems.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace billet::process::mechanics_units_test {
namespace {

/// Factors from mm, N, MPa (scl01_units.csv).
struct Units {
  std::string name;
  double length, stress;

  [[nodiscard]] double force() const { return stress * length * length; }
  [[nodiscard]] double energy() const { return force() * length; }
};

/// Between a fixed and a moving die; only friction and stabilization hold it along the axis.
Scene billet(const Units& units, mechanics::ElementKind kind, int increments) {
  const double mm = units.length;
  const double MPa = units.stress;
  Scene scene;
  scene.part.analysis = mechanics::Analysis::axisymmetric;
  scene.part.mesh =
      mechanics::box_mesh({.kind = kind, .high = Vec3(10, 15, 0) * mm, .cells = {4, 6, 1}});
  support::support(scene, "x-min", 0);
  scene.material = {{200e3 * MPa, 0.3}, mechanics::Linear{700 * MPa, 300 * MPa}};
  contact::Tool die;
  die.name = "die";
  die.surface = geometry::make_plane(Vec3(0, 15 * mm, 0), -Vec3::UnitY());
  die.motion.velocity = Vec3(0, -mm, 0);
  die.friction = contact::Coulomb{0.1};
  contact::Tool base;
  base.name = "base";
  base.surface = geometry::make_plane(Vec3::Zero(), Vec3::UnitY());
  base.friction = contact::Tresca{0.2, {}};
  scene.tools.push_back(std::move(die));
  scene.tools.push_back(std::move(base));
  scene.touch = {1, 0};
  for (const mechanics::Face& face : mechanics::boundary_faces(scene.part.mesh)) {
    bool on_axis = true;
    for (const Index node : face.nodes)
      on_axis = on_axis && scene.part.mesh.points[static_cast<std::size_t>(node)][0] == 0.0;
    if (!on_axis)
      scene.part.contact_faces.push_back(face);
  }
  support::one_stage(scene, 2.0, increments);
  return scene;
}

struct Result {
  std::vector<int> iterations;
  std::vector<double> values; ///< positions, forces and energies in mm, N, N mm
};

Result pressed(const Units& units, mechanics::ElementKind kind) {
  Process process(billet(units, kind, 12));
  EXPECT_EQ(process.view().model.free_motions, 1);
  Result result;
  support::Recorder recorder([&](const auto& p, const IncrementReport& report) {
    result.iterations.push_back(report.iterations);
    result.values.push_back(p.contact()->loads()[0].force[1] / units.force());
    result.values.push_back(report.energy.external / units.energy());
    result.values.push_back(report.energy.plastic / units.energy());
    result.values.push_back(report.contact_area / (units.length * units.length));
  });
  support::run_to_end(process, recorder);
  for (const double x : process.view().positions())
    result.values.push_back(x / units.length);
  for (const auto& state : process.view().model.bulk->states())
    result.values.push_back(state.plastic_strain);
  return result;
}

TEST(Units, NUM_04_results_do_not_depend_on_the_units) {
  constexpr double tolerance = 1e-9; // VALIDATION
  const std::array systems{Units{"mm, N, MPa", 1.0, 1.0}, Units{"m, N, Pa", 1e-3, 1e6},
                           Units{"um, uN, MPa", 1e3, 1.0}};
  for (const auto kind : {mechanics::ElementKind::quad8, mechanics::ElementKind::quad4,
                          mechanics::ElementKind::tri6}) {
    const Result reference = pressed(systems[0], kind);
    for (const Units& units : systems) {
      const Result result = pressed(units, kind);
      EXPECT_EQ(result.iterations, reference.iterations) << units.name;
      ASSERT_EQ(result.values.size(), reference.values.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < result.values.size(); ++i)
        worst = std::max(worst, std::abs(result.values[i] - reference.values[i]) /
                                    std::max(1.0, std::abs(reference.values[i])));
      support::show_error("NUM-04", std::string(mechanics::name(kind)) + " in " + units.name, worst,
                          tolerance);
      EXPECT_LE(worst, tolerance) << units.name;
    }
  }
}

TEST(Upsetting, the_work_of_the_dies_is_accounted_for) {
  constexpr double tolerance = 0.005; // of trapezoidal sums
  for (const auto kind : {mechanics::ElementKind::quad8, mechanics::ElementKind::quad4,
                          mechanics::ElementKind::tri6}) {
    Process process(billet({"mm", 1.0, 1.0}, kind, 60));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    const EnergyBalance& energy = process.view().state.energy;
    support::show("energy", std::string(mechanics::name(kind)) + " external against the rest",
                  energy.external,
                  energy.elastic + energy.plastic + energy.friction + energy.contact +
                      energy.stabilization);
    EXPECT_LT(energy.error(), tolerance);
    EXPECT_GT(energy.plastic, 0.9 * energy.external);
    EXPECT_GT(energy.friction, 0.0);
    EXPECT_LT(energy.stabilization, 1e-3 * energy.external);
  }
}

} // namespace
} // namespace billet::process::mechanics_units_test
