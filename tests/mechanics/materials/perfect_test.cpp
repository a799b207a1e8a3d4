#include "mechanics/materials/perfect.h"
#include "tests/support/flow_law_checks.h"

namespace billet::mechanics::perfect_test {
namespace {

TEST(Perfect, keeps_its_yield_stress) {
  const Perfect law{240.0};
  support::check_slope(law, {1e-3, 0.1, 3.0});
  for (const double strain : {0.0, 1e-12, 10.0})
    EXPECT_EQ(law.flow_stress(strain).stress, 240.0);
}

} // namespace
} // namespace billet::mechanics::perfect_test
