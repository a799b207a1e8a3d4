// The tangent of every element with every flow law on a random plastic state: VALIDATION ELT-07.

#include "mechanics/bulk/element_kernel.h"
#include "tests/support/differences.h"
#include "tests/support/element_probe.h"
#include "tests/support/figures.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace billet::mechanics::element_tangent_test {
namespace {

using support::ElementCase;
using support::ElementProbe;
using support::every_element;

constexpr double tangent_tolerance = 1e-6;   // VALIDATION ELT-07
constexpr double symmetry_tolerance = 1e-13; // rounding of sums over the points

std::vector<double> shifted(std::vector<double> x, const std::vector<double>& by, double factor) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += factor * by[i];
  return x;
}

/// An element with plastic history, and positions at which it flows on.
struct PlasticState {
  ElementProbe probe;
  std::vector<double> x;
};

PlasticState random_state(const ElementCase& element, const Material& material, unsigned seed) {
  support::Random random(seed);
  const auto X = support::distorted_nodes(element, 0.1);
  PlasticState state{ElementProbe(element, material, X), X};
  // Moves of up to 3 % of the size: strains of about 5 %, well beyond yield, in two increments.
  EXPECT_EQ(state.probe.commit(shifted(X, random.list(X.size(), 0.06), 1.0)), ElementStatus::good);
  state.x = shifted(state.probe.x(), random.list(X.size(), 0.06), 1.0);
  EXPECT_EQ(state.probe.evaluate(state.x), ElementStatus::good);
  return state;
}

/// Error of the tangent along a random direction.
double tangent_error(PlasticState& state, unsigned seed) {
  support::Random random(seed);
  const std::vector<double> direction = random.list(state.x.size(), 1.0);
  EXPECT_EQ(state.probe.evaluate(state.x), ElementStatus::good);
  const Eigen::VectorXd derivative =
      state.probe.tangent() *
      Eigen::Map<const Eigen::VectorXd>(direction.data(), state.probe.size());
  const auto force = [&](double h) -> Eigen::VectorXd {
    const auto status = state.probe.evaluate(shifted(state.x, direction, h));
    EXPECT_EQ(status, ElementStatus::good);
    return state.probe.force();
  };
  return support::best_difference_error(force, derivative, 0.1);
}

TEST(ElementTangent, ELT_07_is_the_derivative_of_the_forces_for_every_element_and_law) {
  for (const auto& [name, material] : support::every_material()) {
    double worst = 0.0;
    for (const ElementCase& element : every_element)
      for (const unsigned seed : {1U, 2U, 3U}) {
        PlasticState state = random_state(element, material, seed);
        const auto flowed = [&](std::size_t k) {
          return state.probe.trial()[k].plastic_strain > state.probe.states()[k].plastic_strain;
        };
        if (support::yields(material)) {
          EXPECT_TRUE(flowed(0)) << "the state is not plastic: " << element.name();
        }
        const double error = tangent_error(state, seed + 10);
        EXPECT_LE(error, tangent_tolerance) << element.name() << " " << name;
        worst = std::max(worst, error);
      }
    support::show_error("ELT-07", name + ", all elements", worst, tangent_tolerance);
  }
}

TEST(ElementTangent, ELT_07_is_exact_where_principal_stretches_coincide) {
  // A homogeneous stretch with equal values: in the plane and out of it, and no stretch at all.
  for (const ElementCase& element : every_element)
    for (const double level : {1.0, 1.03})
      for (const auto& [name, material] : support::every_material()) {
        const auto X = support::distorted_nodes(element, 0.1);
        const Mat3 F = Vec3(level, level, element.planar() ? 1.0 : level * level).asDiagonal();
        PlasticState state{ElementProbe(element, material, X), support::moved(X, element.dim(), F)};
        EXPECT_LE(tangent_error(state, 5), tangent_tolerance) << element.name() << " " << name;
      }
}

TEST(ElementTangent, is_symmetric_for_every_element_and_law) {
  double worst = 0.0;
  for (const auto& [name, material] : support::every_material())
    for (const ElementCase& element : every_element) {
      PlasticState state = random_state(element, material, 4);
      const auto& K = state.probe.tangent();
      worst = std::max(worst, (K - K.transpose()).cwiseAbs().maxCoeff() / K.cwiseAbs().maxCoeff());
    }
  support::show_error("ELT-07", "asymmetry", worst, symmetry_tolerance);
  EXPECT_LE(worst, symmetry_tolerance);
}

TEST(ElementTangent, evaluation_repeats_to_the_bit_and_leaves_the_history_alone) {
  for (const ElementCase& element : every_element) {
    PlasticState state = random_state(element, {support::steel, Linear{300.0, 500.0}}, 9);
    const Eigen::VectorXd force = state.probe.force();
    const auto tangent = state.probe.tangent();
    const double strain = state.probe.states()[0].plastic_strain;
    EXPECT_EQ(state.probe.evaluate(shifted(state.x, state.x, 0.05)), ElementStatus::good);
    EXPECT_EQ(state.probe.evaluate(state.x), ElementStatus::good);
    EXPECT_EQ(force, state.probe.force()) << element.name();
    EXPECT_EQ(tangent, state.probe.tangent()) << element.name();
    EXPECT_EQ(strain, state.probe.states()[0].plastic_strain);
  }
}

} // namespace
} // namespace billet::mechanics::element_tangent_test
