// Whole paths of a material point against closed forms: VALIDATION MAT-01, MAT-03, MAT-04, MAT-05.

#include "mechanics/materials/j2_hencky.h"
#include "tests/support/figures.h"
#include "tests/support/point_driver.h"
#include "tests/support/sample_materials.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace billet::mechanics::point_paths_test {
namespace {

using support::PointDriver;
using support::show;

Mat3 simple_shear(double gamma) {
  Mat3 F = Mat3::Identity();
  F(0, 1) = gamma;
  return F;
}

// Column B of mat01_uniaxial_linear_hardening.csv: multiplicative Hencky, Kirchhoff yield.
TEST(PointPaths, MAT_01_uniaxial_linear_hardening_is_exact_for_any_number_of_steps) {
  struct Row {
    double strain, cauchy, plastic, lateral, J;
  };
  constexpr std::array rows{Row{0.0035, 699.02069, 0.0, -0.00105, 1.001401},
                            Row{0.01, 700.96231, 0.0064902646, -0.0042980529, 1.0014049},
                            Row{0.1, 727.8448, 0.096355467, -0.049271093, 1.0014589},
                            Row{0.5, 847.28746, 0.49575637, -0.24915127, 1.0016989},
                            Row{1.0, 996.51022, 0.99500749, -0.4990015, 1.001999},
                            Row{-0.1, -729.97002, 0.096355467, 0.049271093, 0.99854325},
                            Row{-0.91629073, -975.32405, 0.9114236, 0.45717194, 0.99805504},
                            Row{-1.5, -1150.9177, 1.4942586, 0.74885172, 0.99770608}};
  constexpr double tolerance = 1e-6; // VALIDATION; the table has 8 digits
  for (const Row& row : rows)
    for (const int steps : {1, 7, 50}) {
      PointDriver point({{200e3, 0.3}, Linear{700.0, 300.0}});
      for (int i = 1; i <= steps; ++i)
        point.go_uniaxial(row.strain * i / steps);
      if (steps == 1)
        show("MAT-01", fmt::format("Cauchy stress at {}", row.strain), point.sigma()(0, 0),
             row.cauchy);
      EXPECT_NEAR(point.sigma()(0, 0), row.cauchy, tolerance * std::abs(row.cauchy)) << steps;
      EXPECT_NEAR(point.state().plastic_strain, row.plastic, tolerance) << steps;
      EXPECT_NEAR(std::log(point.F()(1, 1)), row.lateral, tolerance) << steps;
      EXPECT_NEAR(point.F().determinant(), row.J, tolerance) << steps;
      EXPECT_NEAR(point.sigma()(1, 1), 0.0, tolerance);
    }
}

// Column Hencky of mat03_simple_shear_elastic.csv.
TEST(PointPaths, MAT_03_elastic_simple_shear_follows_the_hencky_column) {
  struct Row {
    double gamma, t12, t11;
  };
  constexpr std::array rows{Row{0.1, 0.099833666, 0.0049916833}, Row{0.5, 0.48015546, 0.12003887},
                            Row{1, 0.86081788, 0.43040894},      Row{2, 1.2464505, 1.2464505},
                            Row{3, 1.3254708, 1.9882062},        Row{4, 1.2912268, 2.5824536},
                            Row{10, 0.90701294, 4.5350647}};
  constexpr double tolerance = 1e-6; // VALIDATION; the table has 8 digits
  const Elasticity unit{2.6, 0.3};   // G = 1
  for (const Row& row : rows)
    for (const int steps : {1, 20})
      for (const bool planar : {true, false}) {
        PointDriver point({unit, Elastic{}}, planar);
        for (int i = 1; i <= steps; ++i)
          point.go(simple_shear(row.gamma * i / steps));
        if (steps == 1 && planar)
          show("MAT-03", fmt::format("t12/G at gamma {}", row.gamma), point.tau()(0, 1), row.t12);
        EXPECT_NEAR(point.tau()(0, 1), row.t12, tolerance);
        EXPECT_NEAR(point.tau()(0, 0), row.t11, tolerance * std::max(1.0, row.t11));
        EXPECT_NEAR(point.tau()(1, 1), -row.t11, tolerance * std::max(1.0, row.t11));
      }
}

TEST(PointPaths, MAT_03_the_largest_shear_stress_is_where_the_closed_form_has_it) {
  const auto shear = [](double gamma) {
    PointDriver point({{2.6, 0.3}, Elastic{}});
    point.go(simple_shear(gamma));
    return point.tau()(0, 1);
  };
  show("MAT-03", "largest t12/G (gamma = 3.0177)", shear(3.0177), 1.32549);
  constexpr double digits = 1e-5; // of the reference
  EXPECT_NEAR(shear(3.0177), 1.32549, digits);
  EXPECT_LT(shear(2.98), shear(3.0177));
  EXPECT_LT(shear(3.06), shear(3.0177));
}

TEST(PointPaths, MAT_05_simple_shear_of_a_plastic_body_has_no_normal_stress) {
  PointDriver point({{200e3, 0.3}, Linear{200.0, 100.0}}, true);
  constexpr int steps = 500;
  constexpr double tolerance = 0.005; // VALIDATION: elastic strains and increments
  for (int i = 1; i <= steps; ++i) {
    const double gamma = 5.0 * i / steps;
    point.go(simple_shear(gamma));
    if (i != steps / 5 && i != steps)
      continue;
    const double reference = (200.0 + 100.0 * gamma / std::numbers::sqrt3) / std::numbers::sqrt3;
    show("MAT-05", fmt::format("s12 at gamma {}", gamma), point.sigma()(0, 1), reference);
    show("MAT-05", fmt::format("s11/s12 at gamma {}", gamma),
         point.sigma()(0, 0) / point.sigma()(0, 1), 0.0);
    EXPECT_NEAR(point.sigma()(0, 1), reference, tolerance * reference);
    EXPECT_LT(std::abs(point.sigma()(0, 0)), 0.01 * point.sigma()(0, 1));
  }
}

TEST(PointPaths, MAT_04_a_full_turn_in_few_or_many_steps_gives_the_stress_back) {
  constexpr double tolerance = 1e-10; // VALIDATION
  for (const bool plastic : {false, true})
    for (const int steps : {4, 12, 36, 360}) {
      PointDriver point({support::steel, Linear{plastic ? 100.0 : 1e9, 50.0}}, true);
      const Mat3 U = Vec3(plastic ? 1.05 : 1.0005, 1.0, 1.0).asDiagonal();
      point.go(U);
      const Mat3 before = point.sigma();
      const double strain = point.state().plastic_strain;
      for (int i = 1; i <= steps; ++i)
        point.go(support::rotation(Vec3::UnitZ(), 360.0 * i / steps * support::degree) * U);
      const double error = (point.sigma() - before).norm() / before.norm();
      support::show_error("MAT-04", fmt::format("{} steps, plastic {}", steps, plastic), error,
                          tolerance);
      EXPECT_LE(error, tolerance);
      EXPECT_LE(point.state().plastic_strain - strain, 1e-12); // none but rounding
    }
}

double elastic_energy(const Elasticity& elasticity, const PointState& state) {
  double energy = 0.0;
  elastic_energies(elasticity, std::span(&state, 1), false, std::span(&energy, 1));
  return energy;
}

Mat3 kirchhoff_stress(const Elasticity& elasticity, const PointState& state) {
  Mat3 stress;
  kirchhoff_stresses(elasticity, std::span(&state, 1), false, std::span(&stress, 1));
  return stress;
}

TEST(PointPaths, the_elastic_energy_is_the_potential_of_the_stress) {
  support::Random random(8);
  const Elasticity elasticity{1000.0, 0.35};
  for (int i = 0; i < 50; ++i) {
    const Mat3 strain = random.symmetric(0.4);
    const Mat3 direction = random.symmetric(1.0);
    const auto energy = [&](double h) {
      const Mat3 f = support::exponential(h * direction);
      const PointState state{f * support::exponential(2.0 * strain) * f.transpose(), 0.0};
      return elastic_energy(elasticity, state);
    };
    const PointState state{support::exponential(2.0 * strain), 0.0};
    const double power = kirchhoff_stress(elasticity, state).cwiseProduct(direction).sum();
    constexpr double h = 1e-5; // truncation and rounding both near 1e-10
    constexpr double tolerance = 1e-7;
    EXPECT_NEAR((energy(h) - energy(-h)) / (2.0 * h), power, tolerance * 1000.0);
    const Mat3 F = support::exponential(strain);
    EXPECT_LE((kirchhoff_stress(elasticity, state) -
               F.determinant() * support::hencky_stress(1000.0, 0.35, F))
                  .norm(),
              1e-9);
  }
}

TEST(PointPaths, plastic_work_is_the_integral_of_the_flow_stress) {
  EXPECT_DOUBLE_EQ(plastic_work(Perfect{240.0}, 0.1, {0.6, 0.0, 20.0}), 120.0);
  EXPECT_DOUBLE_EQ(plastic_work(Linear{200.0, 100.0}, 0.0, {2.0, 0.0, 20.0}), 600.0);
  EXPECT_EQ(plastic_work(Linear{200.0, 100.0}, 0.3, {0.3, 0.0, 20.0}), 0.0);
  EXPECT_EQ(plastic_work(Elastic{}, 0.0, {0.0, 0.0, 20.0}), 0.0);
  // Voce, in closed form; three Gauss points are good to 1e-6 over an increment of 2 %.
  const double exact = 500.0 * 0.02 + 300.0 / 12.0 * (std::exp(-12.0 * 0.02) - 1.0);
  EXPECT_NEAR(plastic_work(Voce{200.0, 500.0, 12.0}, 0.0, {0.02, 0.0, 20.0}), exact, 1e-6 * exact);
}

} // namespace
} // namespace billet::mechanics::point_paths_test
