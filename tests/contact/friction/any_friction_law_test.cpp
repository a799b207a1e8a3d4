#include "contact/friction/any_friction_law.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <variant>

namespace billet::contact::any_friction_law_test {
namespace {

TEST(AnyFrictionLaw, AsksTheLawItHolds) {
  const InterfacePoint at{200.0, 150.0};
  EXPECT_EQ(slip_limit(Frictionless{}, at).shear, 0.0);
  EXPECT_DOUBLE_EQ(slip_limit(Coulomb{0.25}, at).shear, 50.0);
  EXPECT_DOUBLE_EQ(slip_limit(Coulomb{0.25}, at).d_pressure, 0.25);
  EXPECT_DOUBLE_EQ(slip_limit(Tresca{0.5, {}}, at).shear, 75.0);
  EXPECT_TRUE(std::isinf(slip_limit(Sticking{}, at).shear));
}

TEST(AnyFrictionLaw, GivesEveryLawANameOfItsOwn) {
  std::set<std::string> names;
  for (const auto& [label, law] : every_law())
    names.insert(std::visit([](const auto& one) { return std::string(one.name); }, law.law));
  EXPECT_EQ(names.size(), std::variant_size_v<AnyFrictionLaw>) << "every_law() covers the variant";
}

} // namespace
} // namespace billet::contact::any_friction_law_test
