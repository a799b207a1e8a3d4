#include "contact/friction/sticking.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <limits>

namespace billet::contact::sticking_test {
namespace {

TEST(Sticking, HasNoLimitOfItsOwn) {
  for (const double p : {0.0, 1.0, 1e9}) {
    EXPECT_EQ(Sticking{}.slip_limit({p, 500.0}).shear, std::numeric_limits<double>::infinity());
    EXPECT_EQ(Sticking{}.slip_limit({p, 500.0}).d_pressure, 0.0);
  }
}

} // namespace
} // namespace billet::contact::sticking_test
