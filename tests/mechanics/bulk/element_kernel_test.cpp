// One element by itself: zero-energy modes, rigid motion, volumes, refusal of inversion.
// VALIDATION ELT-03, ELT-04 (ii)-(iii), MAT-04.

#include "mechanics/bulk/element_kernel.h"
#include "tests/support/element_probe.h"
#include "tests/support/figures.h"
#include "tests/support/sample_materials.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <numeric>

namespace billet::mechanics::element_kernel_test {
namespace {

using support::ElementCase;
using support::ElementProbe;
using support::every_element;

const Material elastic_steel{support::steel, Elastic{}};

/// Eigenvalues that vanish next to the largest, at a stress-free state.
int zero_modes(const ElementCase& element) {
  const std::vector<double> X = support::distorted_nodes(element, 0.15);
  ElementProbe probe(element, elastic_steel, X);
  EXPECT_EQ(probe.evaluate(X), ElementStatus::good);
  EXPECT_LE(probe.force().norm(), 1e-12 * support::steel.young); // rounding of b_e = 1
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(probe.tangent());
  const Eigen::VectorXd& values = solver.eigenvalues();
  constexpr double zero = 1e-10; // between rounding 1e-15 and the softest mode 1e-3
  int count = 0;
  for (const double value : values) {
    EXPECT_GT(value, -zero * values.maxCoeff());
    count += std::abs(value) < zero * values.maxCoeff() ? 1 : 0;
  }
  return count;
}

TEST(ElementKernel, ELT_03_has_the_zero_modes_of_its_kind_and_no_others) {
  // Rigid motions, and what 2 points per direction cannot see of a serendipity element: 1 in the
  // plane, 6 in space, none communicable between elements. The points of
  // simplices see all that is not rigid.
  constexpr std::array expected{3, 3 + 1, 1, 1, 6, 6 + 6, 3, 1, 6, 6};
  for (std::size_t i = 0; i < every_element.size(); ++i) {
    const int modes = zero_modes(every_element[i]);
    support::show("ELT-03", every_element[i].name() + " zero modes", modes, expected[i]);
    EXPECT_EQ(modes, expected[i]) << every_element[i].name();
  }
}

/// A rigid motion that the analysis knows; in axisymmetry the angle becomes a shift along the axis.
struct RigidMotion {
  Mat3 R;
  Vec3 d;
};
RigidMotion rigid_motion(const ElementCase& element, double angle) {
  if (element.analysis == Analysis::axisymmetric)
    return {Mat3::Identity(), Vec3(0.0, 3.0 * angle, 0.0)};
  const Vec3 axis = element.planar() ? Vec3::UnitZ().eval() : Vec3(1.0, -2.0, 0.7);
  return {support::rotation(axis, angle), Vec3(4.0, -1.0, element.planar() ? 0.0 : 2.0)};
}

constexpr double force_tolerance = 1e-10; // VALIDATION ELT-03: times E h^2, h about 1 here

TEST(ElementKernel, ELT_03_feels_no_rigid_rotation_in_one_step) {
  for (const ElementCase& element : every_element)
    for (const double angle : {30.0, 90.0, 180.0}) {
      const auto X = support::distorted_nodes(element, 0.15);
      ElementProbe probe(element, elastic_steel, X);
      const auto [R, d] = rigid_motion(element, angle * support::degree);
      ASSERT_EQ(probe.evaluate(support::moved(X, element.dim(), R, d)), ElementStatus::good);
      const double force = probe.force().cwiseAbs().maxCoeff() / support::steel.young;
      support::show_error("ELT-03", fmt::format("{} turned {} deg", element.name(), angle), force,
                          force_tolerance);
      EXPECT_LE(force, force_tolerance) << element.name();
    }
}

/// Forces of a stretched body turned in steps, against the stretched body's forces turned.
double turned_force_error(const ElementCase& element, const Material& material, int steps) {
  const auto X = support::distorted_nodes(element, 0.15);
  ElementProbe probe(element, material, X);
  const Mat3 U = Vec3(1.05, 0.99, element.planar() ? 1.0 : 0.97).asDiagonal();
  const std::vector<double> stretched = support::moved(X, element.dim(), U);
  EXPECT_EQ(probe.commit(stretched), ElementStatus::good);
  const Eigen::VectorXd before = probe.force();
  const double strain = probe.states()[0].plastic_strain;
  RigidMotion motion{Mat3::Identity(), Vec3::Zero()};
  for (int i = 1; i <= steps; ++i) {
    motion = rigid_motion(element, 330.0 * i / steps * support::degree);
    EXPECT_EQ(probe.commit(support::moved(stretched, element.dim(), motion.R, motion.d)),
              ElementStatus::good);
  }
  const std::vector<double> flat_force(before.begin(), before.end());
  const std::vector<double> wanted = support::moved(flat_force, element.dim(), motion.R);
  const Eigen::Map<const Eigen::VectorXd> reference(wanted.data(), before.size());
  EXPECT_LE(probe.states()[0].plastic_strain - strain, 1e-12); // no plastic flow from rotation
  return (probe.force() - reference).norm() / before.norm();
}

TEST(ElementKernel, MAT_04_turns_its_stress_with_it_in_few_or_many_steps) {
  constexpr double tolerance = 1e-10; // VALIDATION MAT-04
  for (const ElementCase& element : every_element)
    for (const bool plastic : {false, true})
      for (const int steps : {1, 4, 12, 36, 360}) {
        const Material material{support::steel,
                                plastic ? AnyFlowLaw(Linear{300.0, 500.0}) : AnyFlowLaw(Elastic{})};
        const double error = turned_force_error(element, material, steps);
        if (steps == 360)
          support::show_error("MAT-04",
                              fmt::format("{} plastic {} {} steps", element.name(), plastic, steps),
                              error, tolerance);
        EXPECT_LE(error, tolerance) << element.name() << " " << steps;
      }
}

TEST(ElementKernel, ELT_04_is_finite_at_the_axis) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6}) {
    const ElementCase element{kind, Analysis::axisymmetric};
    std::vector<double> X = support::distorted_nodes(element, 0.0);
    for (std::size_t i = 0; i < X.size(); i += 2)
      X[i] -= 2.0; // the inner side on the axis
    ElementProbe probe(element, elastic_steel, X);
    ASSERT_EQ(probe.evaluate(support::moved(X, 2, Vec3(1.1, 0.9, 1.0).asDiagonal())),
              ElementStatus::good);
    EXPECT_TRUE(probe.force().allFinite());
    EXPECT_TRUE(probe.tangent().allFinite());
  }
}

TEST(ElementKernel, point_volumes_sum_to_the_volume_of_the_element) {
  constexpr double rounding = 1e-14;
  for (const ElementCase& element : every_element) {
    // A block of size 2 by 2 (by 2), at radii 2 to 4, or the simplex in its lowest corner.
    const auto X = support::distorted_nodes(element, 0.0);
    const ElementProbe probe(element, elastic_steel, X);
    const double sum = std::accumulate(probe.volumes().begin(), probe.volumes().end(), 0.0);
    const double share = !element.simplex() ? 1.0 : element.planar() ? 1.0 / 2.0 : 1.0 / 6.0;
    const double mean_radius = element.simplex() ? 2.0 + 2.0 / 3.0 : 3.0;
    const double turn =
        element.analysis == Analysis::axisymmetric ? 2.0 * std::numbers::pi * mean_radius : 1.0;
    const double exact = share * turn * (element.planar() ? 4.0 : 8.0);
    EXPECT_NEAR(sum, exact, rounding * exact) << element.name();
  }
}

TEST(ElementKernel, refuses_an_inverted_element_and_one_across_the_axis) {
  for (const ElementCase& element : every_element) {
    const auto X = support::distorted_nodes(element, 0.0);
    ElementProbe probe(element, elastic_steel, X);
    EXPECT_EQ(probe.evaluate(support::moved(X, element.dim(), Vec3(1, -1, 1).asDiagonal())),
              ElementStatus::inverted);
    std::vector<double> not_a_number = X;
    not_a_number[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(probe.evaluate(not_a_number), ElementStatus::inverted);
    if (element.analysis == Analysis::axisymmetric) {
      EXPECT_EQ(probe.evaluate(support::moved(X, 2, Mat3::Identity(), Vec3(-4.5, 0, 0))),
                ElementStatus::inverted);
    }
  }
}

TEST(ElementKernel, takes_the_pressure_from_the_mean_dilatation_in_linear_elements_only) {
  const std::vector<double> now{1.0, 2.0, 3.0, 4.0};
  const std::vector<double> then{1.0, 1.0, 1.0, 1.0};
  EXPECT_EQ(pressure_ratio(ElementKind::quad4, now, then, 1), 2.5);
  EXPECT_EQ(pressure_ratio(ElementKind::hex8, now, then, 3), 2.5);
  EXPECT_EQ(pressure_ratio(ElementKind::quad8, now, then, 1), 2.0);
  EXPECT_EQ(pressure_ratio(ElementKind::hex20, now, then, 3), 4.0);
  EXPECT_EQ(pressure_ratio(ElementKind::tri6, now, then, 1), 2.0);
  EXPECT_EQ(pressure_ratio(ElementKind::tet10, now, then, 3), 4.0);
}

} // namespace
} // namespace billet::mechanics::element_kernel_test
