// Rate-dependent metal and its heating in whole problems: VALIDATION MAT-06, MAT-07, NUM-04.

#include "tests/support/contact_scenes.h"
#include "tests/support/figures.h"
#include "tests/support/problems.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace billet::process::mechanics_rate_test {
namespace {

using mechanics::Material;
using mechanics::NortonHoff;
using mechanics::Perzyna;

constexpr mechanics::Elasticity elasticity{200e3, 0.3};

/// Strained at a constant true rate: a step in the table for each of the equal increments.
Scene at_constant_rate(ElementKind kind,
                       const Material& material,
                       double rate,
                       double strain,
                       int increments) {
  std::vector<std::pair<double, double>> table;
  for (int i = 0; i <= increments; ++i)
    table.emplace_back(strain / rate * i / increments, std::exp(strain * i / increments) - 1.0);
  Scene scene = support::unit_bar(kind, material, TimeFunction(table));
  support::one_stage(scene, strain / rate, increments);
  // A landing at each point of the table, and no step cut in two for the rounding of a sum.
  for (const auto& [time, displacement] : table)
    scene.landing_times.push_back(time);
  scene.increments.first = scene.increments.max = *scene.increments.max * (1.0 + 1e-6);
  return scene;
}

/// Kirchhoff stress of the first point, von Mises [MPa].
double stress(const Run& process) {
  return mechanics::mises_stress(process.model.bulk->material(), process.model.bulk->states()[0],
                                 0.0, 1.0, 20.0)
      .stress;
}

constexpr std::array kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::hex8,
                           ElementKind::hex20};

TEST(Rate, MAT_06_a_bar_pulled_at_a_constant_true_rate_has_the_stress_of_the_table) {
  struct Row {
    double rate, perzyna, hoff;
  };
  constexpr std::array rows{Row{1e-4, 215.15717, 15.319435}, Row{1e-2, 238.07308, 38.480682},
                            Row{1.0, 295.63525, 96.659102}, Row{10.0, 351.57166, 153.19435},
                            Row{100.0, 440.22489, 242.79669}};
  constexpr double tolerance = 1e-3; // VALIDATION
  const Material perzyna{elasticity, Perzyna{mechanics::Perfect{200.0}, 1.0 / 40.0, 0.2}};
  const Material hoff{elasticity, NortonHoff{50.0, 0.2, 0.0, 0.0, 0.0}};
  for (const ElementKind kind : kinds)
    for (const Row& row : rows)
      for (const bool first : {true, false}) {
        Process process(at_constant_rate(kind, first ? perzyna : hoff, row.rate, 0.2, 20));
        support::Recorder recorder;
        support::run_to_end(process, recorder);
        const double reference = first ? row.perzyna : row.hoff;
        if (kind == ElementKind::quad8)
          support::show("MAT-06",
                        fmt::format("{} bar at {} /s", first ? "Perzyna" : "Norton-Hoff", row.rate),
                        stress(process), reference);
        EXPECT_NEAR(stress(process), reference, tolerance * reference)
            << mechanics::name(kind) << " " << row.rate;
      }
}

TEST(Rate, MAT_06b_a_bar_held_at_its_length_relaxes_as_backward_euler_does) {
  constexpr double E = 200e3;
  const NortonHoff norton{1000.0 / std::pow(std::numbers::sqrt3, 1.2), 0.2, 0.0, 0.0, 0.0};
  for (const ElementKind kind : kinds) {
    constexpr double loaded = 1e-9; // too short a time to creep
    Scene scene = support::unit_bar(
        kind, {{E, 0.3}, norton}, TimeFunction({{0.0, 0.0}, {loaded, std::exp(300.0 / E) - 1.0}}));
    scene.stages.push_back({"load", loaded, {}, false});
    scene.stages.push_back({"hold", loaded + 100.0, {}, false});
    scene.increments.first = scene.increments.max = 1.0;
    scene.increments.min = 1.0; // none is gone in parts
    std::vector<double> stresses;
    support::Recorder recorder(
        [&](const auto& process, const IncrementReport&) { stresses.push_back(stress(process)); });
    Process process(std::move(scene));
    support::run_to_end(process, recorder);
    ASSERT_EQ(stresses.size(), 101U) << mechanics::name(kind);
    constexpr double digits = 0.005; // of the reference
    for (const auto& [time, reference] :
         {std::pair(1U, 212.78), std::pair(10U, 111.11), std::pair(100U, 59.96)}) {
      support::show("MAT-06b", fmt::format("{} bar after {} s", mechanics::name(kind), time),
                    stresses[time], reference);
      EXPECT_NEAR(stresses[time], reference, digits);
    }
  }
}

/// A round billet between frictionless dies at a rate of about 1/s in its time.
Scene billet(const Material& material, double duration, contact::Friction friction = {}) {
  Upsetting u;
  u.mesh = mechanics::box_mesh({ElementKind::quad8, Vec3::Zero(), Vec3(10, 15, 0), {3, 4, 1}});
  u.material = material;
  u.friction = friction;
  u.reduction = 0.3;
  Scene scene = upsetting_scene(u);
  scene.tools[0].motion.velocity = Vec3(0, -4.5 / duration, 0);
  scene.stages[0].end = duration;
  scene.increments.first = scene.increments.max = duration / 20;
  return scene;
}

TEST(Rate, a_billet_is_pressed_over_12_decades_of_speed_and_8_of_strength) {
  for (const double K : {1e-4, 1.0, 50.0, 1e4})
    for (double duration = 1e-6; duration < 2e6; duration *= 1e3) {
      constexpr double m = 0.15;
      Process process(billet({elasticity, NortonHoff{K, m, 0.0, 0.0, 0.0}}, duration));
      support::Recorder recorder;
      support::run_to_end(process, recorder);
      const double height = 0.7;
      const double rate = 0.3 / duration / height; // at the end, nominally
      const double sigma = std::numbers::sqrt3 * K * std::pow(std::numbers::sqrt3 * rate, m);
      support::show("MAT-06", fmt::format("K = {}, {} s: stress", K, duration), stress(process),
                    sigma);
      // Elastic strain, and the rate at the end against the average over the last increment.
      const double tolerance = 0.005 + 2.0 * sigma / 200e3;
      if (sigma < 0.05 * 200e3) { // else the billet is mostly elastic
        EXPECT_NEAR(stress(process), sigma, tolerance * sigma) << K << " " << duration;
      }
    }
}

TEST(Rate, overstress_leads_to_the_rate_independent_billet_as_eta_vanishes) {
  const mechanics::Linear base{700.0, 300.0};
  const auto pressed = [](const Material& material, int& iterations) {
    Process process(billet(material, 1.0, contact::Coulomb{0.1}));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    iterations = process.view().state.counters.iterations;
    return process.view().contact()->loads()[0].force[1];
  };
  int iterations = 0;
  const double limit = pressed({elasticity, base}, iterations);
  for (const double eta : {1e-3, 1e-6, 1e-9, 1e-12, 1e-20}) {
    int now = 0;
    const double force = pressed({elasticity, Perzyna{base, eta, 0.3}}, now);
    support::show(
        "MAT-06",
        fmt::format("eta = {}: {} iterations (rate-independent {}), force", eta, now, iterations),
        force, limit);
    EXPECT_NEAR(force, limit, 2.0 * std::pow(eta, 0.3) * std::abs(limit) + 1e-6 * std::abs(limit));
    EXPECT_LE(now, iterations + 10) << eta;
  }
}

TEST(Rate, a_molten_billet_is_pressed_to_the_end) {
  Process process(billet({elasticity, support::steel_4340, 2000.0}, 1.0, contact::Tresca{0.3, {}}));
  support::Recorder recorder;
  support::run_to_end(process, recorder);
  EXPECT_LT(std::abs(process.view().contact()->loads()[0].force[1]), 1e4 * 1e-4);
  EXPECT_TRUE(std::isfinite(process.view().state.energy.plastic));
}

TEST(Heating, the_rise_of_temperature_is_the_share_of_the_plastic_work) {
  // rho c = 3.6 MPa/K, nine tenths of the work.
  constexpr double per_work = 0.9 / 3.6;
  const mechanics::Linear linear{700.0, 300.0};
  for (const ElementKind kind : kinds) {
    Process process(at_constant_rate(kind, {elasticity, linear, 20.0, per_work}, 1.0, 0.5, 10));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    const double eps = process.view().model.bulk->states()[0].plastic_strain;
    const double closed = 20.0 + per_work * (700.0 * eps + 150.0 * eps * eps);
    support::show("heating", std::string(mechanics::name(kind)) + " temperature",
                  process.view().model.bulk->temperature(0), closed);
    for (std::size_t k = 0; k < process.view().model.bulk->temperatures().size(); ++k)
      EXPECT_NEAR(process.view().model.bulk->temperature(k), closed, 1e-9 * closed);
    double heat = 0.0;
    for (std::size_t k = 0; k < process.view().model.bulk->temperatures().size(); ++k)
      heat += process.view().model.bulk->volumes()[k] *
              (process.view().model.bulk->temperature(k) - 20.0);
    EXPECT_NEAR(heat, per_work * process.view().state.energy.plastic, 1e-9 * heat);
  }
}

TEST(Heating, is_stored_only_where_it_is_asked_for) {
  Process process(
      at_constant_rate(ElementKind::quad8, {elasticity, support::steel_4340, 300.0}, 1.0, 0.1, 2));
  EXPECT_TRUE(process.view().model.bulk->temperatures().empty());
  EXPECT_EQ(process.view().model.bulk->temperature(0), 300.0);
}

/// dT = chi sigma(eps, rate, T) d eps by Runge and Kutta: temperature after `strain`.
double adiabatic(const mechanics::JohnsonCook& law, double chi, double rate, double strain) {
  constexpr int steps = 20000;
  const double h = strain / steps;
  double T = 20.0;
  const auto slope = [&](double eps, double at) {
    return chi * law.flow_stress({std::max(eps, 0.0), rate, at}).stress;
  };
  for (int i = 0; i < steps; ++i) {
    const double eps = i * h;
    const double k1 = slope(eps, T);
    const double k2 = slope(eps + 0.5 * h, T + 0.5 * h * k1);
    const double k3 = slope(eps + 0.5 * h, T + 0.5 * h * k2);
    const double k4 = slope(eps + h, T + h * k3);
    T += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return T;
}

TEST(Heating, MAT_07_adiabatic_johnson_cook_converges_with_first_order) {
  constexpr double chi = 0.9 / (7.83e-9 * 477e6);
  constexpr double rate = 1000.0;
  const mechanics::JohnsonCook law = support::steel_4340;
  std::array<double, 3> errors{};
  std::array<double, 3> of_stress{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int n = 10 << i;
    Process process(
        at_constant_rate(ElementKind::quad4, {elasticity, law, 20.0, chi}, rate, 0.5, n));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    const double eps = process.view().model.bulk->states()[0].plastic_strain;
    const double T = adiabatic(law, chi, rate, eps);
    const double sigma = law.flow_stress({eps, rate, T}).stress;
    errors[i] = process.view().model.bulk->temperature(0) - T;
    of_stress[i] = stress(process) - sigma;
    support::show("MAT-07", fmt::format("{} increments: temperature", n),
                  process.view().model.bulk->temperature(0), T);
    support::show("MAT-07", fmt::format("{} increments: stress", n), stress(process), sigma);
  }
  const double order = std::log2(errors[1] / errors[2]);
  support::show("MAT-07", "order in time of the temperature", order, 1.0);
  support::show("MAT-07", "order in time of the stress", std::log2(of_stress[1] / of_stress[2]),
                1.0);
  EXPECT_GT(order, 0.8);
  EXPECT_LT(std::abs(errors[0]), 5.0);
}

/// Factors from mm, N, MPa, s.
struct Units {
  const char* name;
  double length, stress, time;
};

/// Forces, temperature and work of a billet in mm, N, MPa.
std::vector<double> pressed(const Units& u, const Material& in_MPa, std::vector<int>& iterations) {
  Scene scene = billet(in_MPa, 0.2, contact::Tresca{0.3, {}});
  for (Vec3& p : scene.part.mesh.points)
    p *= u.length;
  scene.tools[0].surface = geometry::make_plane(Vec3(0, 15.0 * u.length, 0), -Vec3::UnitY());
  scene.tools[0].motion.velocity = Vec3(0, -4.5 * u.length / (0.2 * u.time), 0);
  scene.stages[0].end *= u.time;
  // A little more than a twentieth, lest the rounding of a sum of times decide on one more.
  scene.increments.first = scene.increments.max = *scene.increments.max * u.time * (1.0 + 1e-6);
  Process process(std::move(scene));
  support::Recorder recorder(
      [&](const auto&, const IncrementReport& report) { iterations.push_back(report.iterations); });
  support::run_to_end(process, recorder);
  std::vector<double> values{
      process.view().contact()->loads()[0].force[1] / (u.stress * u.length * u.length),
      process.view().state.energy.plastic / (u.stress * std::pow(u.length, 3))};
  values.insert(values.end(), process.view().model.bulk->temperatures().begin(),
                process.view().model.bulk->temperatures().end());
  return values;
}

TEST(Rate, NUM_04_results_do_not_depend_on_the_units) {
  constexpr double tolerance = 1e-9; // VALIDATION
  const auto material = [](const Units& u) {
    mechanics::JohnsonCook law = support::steel_4340;
    law.A *= u.stress;
    law.B *= u.stress;
    law.rate0 /= u.time;
    return Material{{200e3 * u.stress, 0.3}, law, 20.0, 0.25 / u.stress};
  };
  std::vector<int> reference_iterations;
  const Units first{"mm, N, MPa, s", 1.0, 1.0, 1.0};
  const auto reference = pressed(first, material(first), reference_iterations);
  for (const Units& u :
       {Units{"m, N, Pa, s", 1e-3, 1e6, 1.0}, Units{"um, uN, MPa, ms", 1e3, 1.0, 1e3}}) {
    std::vector<int> iterations;
    const auto values = pressed(u, material(u), iterations);
    EXPECT_EQ(iterations, reference_iterations) << u.name;
    ASSERT_EQ(values.size(), reference.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      worst = std::max(worst, std::abs(values[i] / reference[i] - 1.0));
    support::show_error("NUM-04", std::string("heated billet in ") + u.name, worst, tolerance);
    EXPECT_LE(worst, tolerance) << u.name;
  }
}

} // namespace
} // namespace billet::process::mechanics_rate_test
