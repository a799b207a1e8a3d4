#include "contact/friction/frictionless.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>

namespace billet::contact::frictionless_test {
namespace {

TEST(Frictionless, CarriesNothingAtAnyPressure) {
  for (const double p : {0.0, 1e-12, 1.0, 1e9}) {
    EXPECT_EQ(Frictionless{}.slip_limit({p, 500.0}).shear, 0.0);
    EXPECT_EQ(Frictionless{}.slip_limit({p, 500.0}).d_pressure, 0.0);
  }
  expect_exact_slope(Frictionless{}, std::array{1.0, 100.0}, 500.0);
}

} // namespace
} // namespace billet::contact::frictionless_test
