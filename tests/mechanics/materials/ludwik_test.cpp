#include "mechanics/materials/ludwik.h"
#include "tests/support/flow_law_checks.h"
#include "tests/support/point_driver.h"
#include "tests/support/sample_materials.h"

#include <cmath>

namespace billet::mechanics::ludwik_test {
namespace {

TEST(Ludwik, has_its_closed_form_values_and_slope) {
  const Ludwik law{200.0, 500.0, 0.5};
  support::check_slope(law, {1e-4, 1e-2, 0.16, 0.8, 4.0});
  EXPECT_EQ(law.flow_stress(0.0).stress, 200.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.16).stress, 400.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.16).slope, 625.0);
}

TEST(Ludwik, starts_with_an_infinite_slope) {
  const FlowStress start = Ludwik{200.0, 500.0, 0.5}.flow_stress(0.0);
  EXPECT_TRUE(std::isinf(start.slope));
  EXPECT_GT(start.slope, 0.0);
}

TEST(Ludwik, with_exponents_0_and_1_is_perfect_and_linear) {
  EXPECT_EQ((Ludwik{200.0, 50.0, 0.0}.flow_stress(0.0).stress), 250.0);
  EXPECT_EQ((Ludwik{200.0, 50.0, 0.0}.flow_stress(0.0).slope), 0.0);
  EXPECT_EQ((Ludwik{200.0, 50.0, 1.0}.flow_stress(0.0).slope), 50.0);
  EXPECT_DOUBLE_EQ((Ludwik{200.0, 50.0, 1.0}.flow_stress(2.0).stress), 300.0);
}

// The first plastic strain meets the infinite slope; the stress must lie on the curve all the same.
TEST(Ludwik, yields_through_the_infinite_slope_onto_its_curve) {
  const Ludwik law{200.0, 500.0, 0.3};
  for (const double beyond : {1e-12, 1e-6, 1e-3, 0.1}) {
    support::PointDriver point({support::steel, law});
    const double strain = 200.0 / support::steel.young + beyond;
    point.go_uniaxial(strain);
    const double plastic = point.state().plastic_strain;
    EXPECT_GE(plastic, 0.0);
    // The strain carries an error of a few eps, the stress one of E times that.
    constexpr double rounding = 200e3 * 4e-15;
    EXPECT_NEAR(point.tau()(0, 0), law.flow_stress(plastic).stress, rounding) << beyond;
    EXPECT_NEAR(point.tau()(0, 0), support::steel.young * (strain - plastic), rounding) << beyond;
  }
}

} // namespace
} // namespace billet::mechanics::ludwik_test
