#include "mechanics/numerics/simd_pack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::mechanics::simd_pack_test {
namespace {

/// Lengths below, at and above those of the processor's vectors; all that elements have.
template <class Length> class SimdPackOf : public testing::Test {};
template <int n> struct Length { static constexpr int value = n; };
using Lengths =
    testing::Types<Length<2>, Length<3>, Length<4>, Length<6>, Length<8>, Length<10>, Length<20>>;
TYPED_TEST_SUITE(SimdPackOf, Lengths);

TYPED_TEST(SimdPackOf, GoesNumberByNumber) {
  constexpr int n = TypeParam::value;
  SimdPack<n> a{};
  SimdPack<n> b = SimdPack<n>::constant(2.0);
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(a[i], 0.0);
    EXPECT_EQ(b[i], 2.0);
    a.set(i, i + 1.0);
  }
  b.set(n - 1, -4.0);
  SimdPack<n> sum = a;
  sum += b;
  const SimdPack<n> difference = a - b;
  const SimdPack<n> product = a * b;
  const SimdPack<n> quotient = b / a;
  const SimdPack<n> scaled = 3.0 * a;
  for (int i = 0; i < n; ++i) {
    const double x = i + 1.0;
    const double y = i == n - 1 ? -4.0 : 2.0;
    EXPECT_EQ(sum[i], x + y);
    EXPECT_EQ((a + b)[i], x + y);
    EXPECT_EQ(difference[i], x - y);
    EXPECT_EQ(product[i], x * y);
    EXPECT_EQ(quotient[i], y / x);
    EXPECT_EQ(scaled[i], 3.0 * x);
    EXPECT_EQ(abs(b)[i], std::abs(y));
    EXPECT_EQ(where_negative(b, a, scaled)[i], y < 0.0 ? x : 3.0 * x);
  }
  EXPECT_EQ(where_negative(SimdPack<n>::constant(-0.0), a, b)[0], b[0]);
  EXPECT_EQ(where_negative(SimdPack<n>::constant(std::nan("")), a, b)[0], b[0]);
}

TYPED_TEST(SimdPackOf, TellsWhatIsBeyond) {
  constexpr int n = TypeParam::value;
  EXPECT_TRUE(all_zero(unless_positive(SimdPack<n>::constant(1e-300))));
  EXPECT_TRUE(all_zero(unless_within(SimdPack<n>::constant(-2.0), 2.0)));
  for (int i = 0; i < n; ++i)
    for (const double bad : {0.0, -1.0, std::nan("")}) {
      SimdPack<n> a = SimdPack<n>::constant(3.0);
      a.set(i, bad);
      const SimdPack<n> flags = unless_positive(a);
      EXPECT_FALSE(all_zero(flags));
      for (int k = 0; k < n; ++k)
        EXPECT_EQ(flags[k], k == i ? 1.0 : 0.0);
    }
  for (int i = 0; i < n; ++i)
    for (const double bad : {2.5, -2.5, HUGE_VAL, std::nan("")}) {
      SimdPack<n> a = SimdPack<n>::constant(-2.0);
      a.set(i, bad);
      EXPECT_FALSE(all_zero(unless_within(a, 2.0)));
      EXPECT_EQ(unless_within(a, 2.0)[i], 1.0);
    }
}

} // namespace
} // namespace billet::mechanics::simd_pack_test
