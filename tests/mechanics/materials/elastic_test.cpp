#include "mechanics/materials/elastic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::mechanics::elastic_test {
namespace {

TEST(Elastic, never_yields_whatever_the_strain) {
  for (const double strain : {0.0, 1e-9, 1.0, 1e9}) {
    EXPECT_TRUE(std::isinf(Elastic{}.flow_stress(strain).stress));
    EXPECT_GT(Elastic{}.flow_stress(strain).stress, 0.0);
    EXPECT_EQ(Elastic{}.flow_stress(strain).slope, 0.0);
  }
}

} // namespace
} // namespace billet::mechanics::elastic_test
