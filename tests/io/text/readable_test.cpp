#include "io/text/readable.h"

#include <gtest/gtest.h>

namespace billet::io::readable_test {
namespace {

TEST(Readable, takes_the_unit_in_which_numbers_are_short) {
  struct Example {
    double largest;
    const char* unit;
    double factor;
    const char* expected;
  };
  for (const auto& [largest, unit, factor, expected] :
       {Example{9999.0, "N", 1.0, "N"}, Example{1e4, "N", 1e-3, "kN"},
        Example{-303572.0, "N", 1e-3, "kN"}, Example{2e7, "N", 1e-6, "MN"},
        Example{0.0033, "m", 1e3, "mm"}, Example{2.0, "m", 1.0, "m"}, Example{3.3, "mm", 1.0, "mm"},
        Example{1e9, "lbf", 1.0, "lbf"}}) {
    const Readable readable = io::readable(largest, unit);
    EXPECT_EQ(readable.factor, factor) << largest << unit;
    EXPECT_EQ(readable.unit, expected) << largest << unit;
  }
}

} // namespace
} // namespace billet::io::readable_test
