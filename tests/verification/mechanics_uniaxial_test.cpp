// Bars under uniaxial stress, one element each: VALIDATION MAT-01, MAT-09; supports and energy.

#include "geometry/base/error.h"
#include "tests/support/element_probe.h"
#include "tests/support/figures.h"
#include "tests/support/problems.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace billet::process::mechanics_uniaxial_test {
namespace {

using mechanics::Analysis;
using mechanics::ElementKind;

/// A bar pulled to a logarithmic strain.
Scene bar(ElementKind kind, const mechanics::Material& material, double strain, int increments) {
  Scene scene =
      support::unit_bar(kind, material, TimeFunction({{0.0, 0.0}, {1.0, std::exp(strain) - 1.0}}));
  support::one_stage(scene, 1.0, increments);
  return scene;
}

/// Pull of the moved end per initial area [MPa].
double nominal_stress(const Run& process) {
  const bool solid = process.part().analysis == Analysis::solid;
  const int axis = solid ? 2 : 1;
  const int dim = process.mesh().dimension();
  double force = 0.0;
  for (const Index node : process.mesh().node_sets.at(solid ? "z-max" : "y-max"))
    force += process.state.reactions[static_cast<std::size_t>(node * dim + axis)];
  return force / (solid ? 1.0 : std::numbers::pi);
}

constexpr std::array kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                           ElementKind::hex8,  ElementKind::hex20, ElementKind::tet10};

// Column B_F_over_A0 of mat01_uniaxial_linear_hardening.csv.
TEST(Uniaxial, MAT_01_one_element_gives_the_closed_form_for_any_number_of_increments) {
  struct Row {
    double strain, nominal;
  };
  constexpr std::array rows{Row{0.1, 659.542}, Row{0.5, 514.77889}, Row{-0.5, -1399.3141},
                            Row{-0.91629073, -2433.5677}};
  constexpr double tolerance = 1e-6; // VALIDATION
  for (const ElementKind kind : kinds)
    for (const Row& row : rows)
      for (const int increments : {5, 20}) {
        Process process(
            bar(kind, {{200e3, 0.3}, mechanics::Linear{700.0, 300.0}}, row.strain, increments));
        support::Recorder recorder;
        support::run_to_end(process, recorder);
        const double nominal = nominal_stress(process);
        if (increments == 5)
          support::show("MAT-01", fmt::format("{} F/A0 at {}", mechanics::name(kind), row.strain),
                        nominal, row.nominal);
        EXPECT_NEAR(nominal, row.nominal, tolerance * std::abs(row.nominal));
      }
}

/// Where the load of a bar is largest.
struct LoadMaximum {
  double strain;  ///< plastic, equivalent [-]
  double nominal; ///< load per initial area [MPa]
};

LoadMaximum load_maximum(ElementKind kind, const mechanics::Material& material, double strain) {
  LoadMaximum most{0.0, 0.0};
  support::Recorder recorder([&](const auto& process, const IncrementReport&) {
    const double nominal = nominal_stress(process);
    if (nominal > most.nominal)
      most = {process.model.bulk->states()[0].plastic_strain, nominal};
  });
  Process process(bar(kind, material, strain, 300));
  support::run_to_end(process, recorder);
  return most;
}

/// The same of K eps^n in closed form: with tau = K eps^n of the plastic strain and a logarithmic
/// strain eps + tau / E, the load tau exp(-eps - tau / E) is largest at eps = n (1 - tau / E).
LoadMaximum exact_maximum(double young, double K, double n) {
  double eps = n;
  double tau = 0.0;
  for (int i = 0; i < 50; ++i) {
    tau = K * std::pow(eps, n);
    eps = n * (1.0 - tau / young);
  }
  return {eps, tau * std::exp(-eps - tau / young)};
}

void check_maximum(ElementKind kind, const mechanics::Material& material, double K, double n) {
  constexpr double tolerance = 0.01; // VALIDATION
  // An increment is at most 0.6 % of n, and a maximum is flat: 0.5 n 0.006^2.
  constexpr double of_load = 1e-5;
  const auto law = std::visit([](const auto& flow) { return flow.name; }, material.flow);
  const std::string what = fmt::format("{} {} K = {}, n = {}:", mechanics::name(kind), law, K, n);
  const LoadMaximum most = load_maximum(kind, material, 1.5 * n);
  const LoadMaximum exact = exact_maximum(material.elasticity.young, K, n);
  support::show("MAT-09", what + " uniform strain", most.strain, n);
  support::show("MAT-09", what + " tensile strength", most.nominal, exact.nominal);
  EXPECT_NEAR(most.strain, n, tolerance * n) << what;
  EXPECT_NEAR(most.nominal, exact.nominal, of_load * exact.nominal) << what;
}

// mat09_considere.csv: Hollomon's K eps^n through Ludwik without yield stress and through Swift.
TEST(Uniaxial, MAT_09_the_load_is_largest_where_strain_equals_the_exponent) {
  struct Row {
    double K, n, strength; ///< the last of a rigid-plastic bar, K n^n exp(-n)
  };
  constexpr std::array rows{Row{500.0, 0.1, 359.36895}, Row{500.0, 0.2, 296.6997},
                            Row{1000.0, 0.25, 550.69531}};
  constexpr double eps0 = 1e-7;    // Swift's, in place of none
  constexpr double elastic = 4e-3; // the bar is also longer by its elastic strain
  constexpr mechanics::Elasticity steel{200e3, 0.3};
  for (const Row& row : rows) {
    EXPECT_NEAR(exact_maximum(steel.young, row.K, row.n).nominal, row.strength,
                elastic * row.strength);
    EXPECT_NEAR(exact_maximum(1e6 * steel.young, row.K, row.n).nominal, row.strength,
                1e-7 * row.strength);
    for (const ElementKind kind : kinds) {
      check_maximum(kind, {steel, mechanics::Swift{row.K, eps0, row.n}}, row.K, row.n);
      check_maximum(kind, {steel, mechanics::Ludwik{0.0, row.K, row.n}}, row.K, row.n);
    }
  }
}

TEST(Uniaxial, the_work_of_the_supports_is_stored_or_dissipated) {
  constexpr double tolerance = 0.005; // VALIDATION; trapezoidal sums over 100 increments
  for (const ElementKind kind : kinds) {
    Process process(bar(kind, {{200e3, 0.3}, mechanics::Linear{700.0, 300.0}}, -0.6, 100));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    support::show_error("energy", std::string(mechanics::name(kind)) + " bar",
                        process.view().state.energy.error(), tolerance);
    EXPECT_LT(process.view().state.energy.error(), tolerance);
    EXPECT_GT(process.view().state.energy.plastic, 100.0);
  }
}

TEST(Uniaxial, supports_end_exactly_where_they_are_told) {
  Process process(bar(ElementKind::hex8, {{200e3, 0.3}, mechanics::Perfect{300.0}}, 0.2, 7));
  support::Recorder recorder;
  support::run_to_end(process, recorder);
  for (const Index node : process.view().mesh().node_sets.at("z-max"))
    EXPECT_EQ(process.view().positions()[static_cast<std::size_t>(3 * node + 2)],
              1.0 + (std::exp(0.2) - 1.0));
  EXPECT_EQ(process.view().model.free_motions, 0);
}

TEST(Uniaxial, a_body_that_nothing_holds_is_refused) {
  Scene scene = bar(ElementKind::quad8, {{200e3, 0.3}, mechanics::Perfect{300.0}}, 0.1, 2);
  scene.part.supports.clear();
  try {
    const Process process(std::move(scene));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::case_file);
    EXPECT_NE(std::string(error.what()).find("move freely"), std::string::npos);
  }
}

} // namespace
} // namespace billet::process::mechanics_uniaxial_test
