#include "mechanics/materials/linear.h"
#include "tests/support/flow_law_checks.h"

namespace billet::mechanics::linear_test {
namespace {

TEST(Linear, grows_by_the_hardening_per_unit_strain) {
  const Linear law{700.0, 300.0};
  support::check_slope(law, {1e-3, 0.1, 3.0});
  EXPECT_EQ(law.flow_stress(0.0).stress, 700.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.5).stress, 850.0);
  EXPECT_EQ(law.flow_stress(0.5).slope, 300.0);
}

TEST(Linear, may_soften) {
  support::check_slope(Linear{700.0, -100.0}, {1e-3, 0.1, 3.0});
  EXPECT_DOUBLE_EQ((Linear{700.0, -100.0}.flow_stress(2.0).stress), 500.0);
}

} // namespace
} // namespace billet::mechanics::linear_test
