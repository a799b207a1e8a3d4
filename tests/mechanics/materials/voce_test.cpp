#include "mechanics/materials/voce.h"
#include "tests/support/flow_law_checks.h"

#include <cmath>

namespace billet::mechanics::voce_test {
namespace {

TEST(Voce, has_its_closed_form_values_and_slope) {
  const Voce law{200.0, 500.0, 10.0};
  support::check_slope(law, {1e-3, 0.05, 0.3, 0.6});
  EXPECT_EQ(law.flow_stress(0.0).stress, 200.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.0).slope, 3000.0);
  // Half of the missing stress is gained at ln 2 / rate.
  EXPECT_DOUBLE_EQ(law.flow_stress(std::log(2.0) / 10.0).stress, 350.0);
}

TEST(Voce, saturates) {
  const Voce law{200.0, 500.0, 10.0};
  EXPECT_EQ(law.flow_stress(1e3).stress, 500.0);
  EXPECT_EQ(law.flow_stress(1e3).slope, 0.0);
}

} // namespace
} // namespace billet::mechanics::voce_test
