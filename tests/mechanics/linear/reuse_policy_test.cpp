#include "mechanics/linear/linear_solver.h"

#include <gtest/gtest.h>

namespace billet::mechanics::reuse_policy_test {
namespace {

TEST(ReusePolicy, says_when_another_system_of_the_kind_would_cost_more_than_the_average) {
  ReusePolicy reuse;
  reuse.begin(10);
  for (const int solves : {4, 5, 6}) { // 14 / 2, 19 / 3, 25 / 4
    reuse.take(solves);
    EXPECT_FALSE(reuse.wants_new()) << solves;
  }
  reuse.take(7); // 32 / 5
  EXPECT_TRUE(reuse.wants_new());
  reuse.take(6);
  EXPECT_FALSE(reuse.wants_new()); // 38 / 6
  reuse.begin(10);
  EXPECT_FALSE(reuse.wants_new());
}

} // namespace
} // namespace billet::mechanics::reuse_policy_test
