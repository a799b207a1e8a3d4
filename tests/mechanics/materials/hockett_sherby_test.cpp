#include "mechanics/materials/hockett_sherby.h"
#include "mechanics/materials/voce.h"
#include "tests/support/flow_law_checks.h"
#include "tests/support/point_driver.h"
#include "tests/support/sample_materials.h"

#include <cmath>
#include <limits>

namespace billet::mechanics::hockett_sherby_test {
namespace {

TEST(HockettSherby, has_its_closed_form_values_and_slope) {
  const HockettSherby law{200.0, 500.0, 4.0, 0.5};
  support::check_slope(law, {1e-4, 1e-2, 0.16, 0.8, 4.0});
  support::check_slope(HockettSherby{200.0, 500.0, 4.0, 1.5}, {1e-2, 0.16, 0.8});
  EXPECT_EQ(law.flow_stress(0.0).stress, 200.0);
  // Half of the missing stress is gained where N eps^p = ln 2, and the slope there is p ln 2 / eps
  // times what is still missing.
  const double half = std::pow(std::log(2.0) / 4.0, 2.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(half).stress, 350.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(half).slope, 150.0 * 0.5 * std::log(2.0) / half);
}

TEST(HockettSherby, with_exponent_1_is_voce) {
  for (const double strain : {0.0, 0.01, 0.3, 2.0}) {
    const FlowStress here = HockettSherby{200.0, 500.0, 10.0, 1.0}.flow_stress(strain);
    const FlowStress voce = Voce{200.0, 500.0, 10.0}.flow_stress(strain);
    EXPECT_DOUBLE_EQ(here.stress, voce.stress);
    EXPECT_DOUBLE_EQ(here.slope, voce.slope);
  }
}

TEST(HockettSherby, saturates) {
  const HockettSherby law{200.0, 500.0, 4.0, 0.5};
  for (const double strain : {1e6, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(law.flow_stress(strain).stress, 500.0) << strain;
    EXPECT_EQ(law.flow_stress(strain).slope, 0.0) << strain;
  }
}

TEST(HockettSherby, starts_with_an_infinite_slope_if_it_hardens_at_all) {
  EXPECT_EQ((HockettSherby{200.0, 500.0, 4.0, 0.5}.flow_stress(0.0).slope),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ((HockettSherby{200.0, 500.0, 4.0, 2.0}.flow_stress(0.0).slope), 0.0);
  for (const HockettSherby& flat :
       {HockettSherby{200.0, 500.0, 0.0, 0.5}, HockettSherby{200.0, 200.0, 4.0, 0.5}})
    for (const double strain : {0.0, 0.3}) {
      EXPECT_EQ(flat.flow_stress(strain).stress, 200.0);
      EXPECT_EQ(flat.flow_stress(strain).slope, 0.0);
    }
}

// The first plastic strain meets the infinite slope; the stress must lie on the curve all the same.
TEST(HockettSherby, yields_through_the_infinite_slope_onto_its_curve) {
  const HockettSherby law{200.0, 500.0, 4.0, 0.3};
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
} // namespace billet::mechanics::hockett_sherby_test
