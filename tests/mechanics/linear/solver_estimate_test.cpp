#include "mechanics/linear/solver_estimate.h"

#include <gtest/gtest.h>

#include <limits>

namespace billet::mechanics::solver_estimate_test {
namespace {

constexpr double any = std::numeric_limits<double>::infinity();

/// Cubes of hex8, as bench/scale measured them: entries, factor entries, operations.
constexpr SystemSize small{3, 2.1e6, 1.4e7, 1.29e10};   // 27 783 unknowns
constexpr SystemSize middle{3, 2.0e7, 3.33e8, 1.31e12}; // 255 552
constexpr SystemSize large{3, 8.2e7, 2.5e9, 2.15e13};   // 1 029 000
constexpr SystemSize slender{3, 8.2e7, 3.0e8, 3.0e11};  // as many, one element thick

TEST(SolverEstimate, costs_are_those_measured) {
  // With two threads a system of `middle` took 1.29 s by factorization; with one twice that, about.
  EXPECT_NEAR(cost_by_factorization(middle).seconds, 2.6, 0.5);
  EXPECT_NEAR(cost_by_multigrid(middle).seconds, 0.72, 0.15);
  EXPECT_NEAR(cost_by_factorization(middle).memory, 1.5 * 1.33e9, 0.1e9);
}

TEST(SolverEstimate, multigrid_is_preferred_where_it_is_far_cheaper) {
  EXPECT_FALSE(prefers_multigrid(small, any));
  EXPECT_FALSE(prefers_multigrid(middle, any));
  EXPECT_TRUE(prefers_multigrid(large, any));
  EXPECT_FALSE(prefers_multigrid(slender, any));
  SystemSize plane = large;
  plane.dim = 2;
  EXPECT_FALSE(prefers_multigrid(plane, any));
}

TEST(SolverEstimate, multigrid_is_preferred_where_factors_find_no_room) {
  EXPECT_TRUE(prefers_multigrid(middle, 1e9));
  EXPECT_FALSE(prefers_multigrid(small, 1e6)) << "nothing that small is worth it";
}

TEST(SolverEstimate, says_what_it_has_found) {
  EXPECT_EQ(costs_in_words(middle), "a system takes about 2.9 s and 1998 MB by factorization, "
                                    "0.79 s and 368 MB by multigrid");
}

} // namespace
} // namespace billet::mechanics::solver_estimate_test
