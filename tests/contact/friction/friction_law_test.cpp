#include "contact/friction/friction_law.h"

#include <gtest/gtest.h>

#include <string_view>
#include <tuple>

namespace billet::contact::friction_law_test {
namespace {

/// A law as a user would add one.
struct HalfThePressure {
  static constexpr std::string_view name = "half";
  static constexpr std::tuple<> parameters{};

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    return {0.5 * at.pressure, 0.5};
  }
};

/// Forgets its slope.
struct WithoutSlope {
  static constexpr std::string_view name = "without slope";
  static constexpr std::tuple<> parameters{};

  [[nodiscard]] double slip_limit(const InterfacePoint&) const noexcept { return 1.0; }
};

struct WithoutName {
  static constexpr std::tuple<> parameters{};

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint&) const noexcept { return {1.0, 0.0}; }
};

struct WithoutParameters {
  static constexpr std::string_view name = "without parameters";
  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint&) const noexcept { return {1.0, 0.0}; }
};

TEST(FrictionLaw, IsAnythingWithANameParametersAndALimit) {
  EXPECT_TRUE(FrictionLaw<HalfThePressure>);
  EXPECT_FALSE(FrictionLaw<WithoutSlope>);
  EXPECT_FALSE(FrictionLaw<WithoutName>);
  EXPECT_FALSE(FrictionLaw<WithoutParameters>);
  EXPECT_FALSE(FrictionLaw<double>);
}

} // namespace
} // namespace billet::contact::friction_law_test
