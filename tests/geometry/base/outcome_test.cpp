#include "geometry/base/outcome.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace billet::outcome_test {
namespace {

TEST(Outcome, holds_a_value) {
  const Outcome<std::string> good(std::string("yes"));
  ASSERT_TRUE(good);
  EXPECT_TRUE(good.has_value());
  EXPECT_EQ(*good, "yes");
  EXPECT_EQ(good->size(), 3U);
}

TEST(Outcome, holds_a_reason) {
  const Outcome<double> bad(Failure{"the tangent is singular"});
  ASSERT_FALSE(bad);
  EXPECT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().reason, "the tangent is singular");
}

TEST(Outcome, can_hold_what_cannot_be_copied) {
  Outcome<std::unique_ptr<int>> good(std::make_unique<int>(5));
  ASSERT_TRUE(good);
  const std::unique_ptr<int> taken = std::move(*good);
  EXPECT_EQ(*taken, 5);
}

TEST(Outcome, a_value_of_zero_is_still_a_value) {
  EXPECT_TRUE(Outcome<double>(0.0));
  EXPECT_TRUE(Outcome<bool>(false).has_value());
}

} // namespace
} // namespace billet::outcome_test
