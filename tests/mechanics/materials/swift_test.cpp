#include "mechanics/materials/swift.h"
#include "tests/support/flow_law_checks.h"

namespace billet::mechanics::swift_test {
namespace {

TEST(Swift, has_its_closed_form_values_and_slope) {
  // 1000 (0.01 + e)^0.5: square roots by hand.
  const Swift law{1000.0, 0.01, 0.5};
  support::check_slope(law, {1e-4, 1e-2, 0.15, 0.8, 4.0});
  EXPECT_DOUBLE_EQ(law.flow_stress(0.0).stress, 100.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.15).stress, 400.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.15).slope, 1250.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.0).slope, 5000.0);
}

TEST(Swift, without_exponent_does_not_harden) {
  const Swift law{350.0, 0.002, 0.0};
  for (const double strain : {0.0, 0.1, 2.0}) {
    EXPECT_EQ(law.flow_stress(strain).stress, 350.0);
    EXPECT_EQ(law.flow_stress(strain).slope, 0.0);
  }
}

} // namespace
} // namespace billet::mechanics::swift_test
