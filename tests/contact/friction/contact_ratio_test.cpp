#include "contact/friction/contact_ratio.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace billet::contact::contact_ratio_test {
namespace {

TEST(ContactRatio, IsBaysFitToTheSlipLineFields) {
  // VALIDATION FRI-08, fri02c_wanheim_bay.csv: tau / k = f alpha at p / sigma_0.
  const std::array<double, 8> pressures{0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0};
  struct Row {
    double f;
    std::array<double, 8> shear;
  };
  const std::array rows{
      Row{0.1,
          {0.0085976414, 0.017195283, 0.034390566, 0.051585106, 0.065991841, 0.083220021,
           0.095914851, 0.099880533}},
      Row{0.5,
          {0.048283992, 0.096567984, 0.19313597, 0.28970395, 0.36805803, 0.44807402, 0.49195755,
           0.49992407}},
      Row{0.99,
          {0.15023554, 0.30047109, 0.60094217, 0.90140222, 0.98685586, 0.98999604, 0.99, 0.99}}};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < pressures.size(); ++i) {
      const double shear = row.f * wanheim_bay(pressures[i], row.f).alpha;
      std::printf("FRI-08 f = %.2f, p = %5.2f sigma_0: tau/k %.8f (%.8f)\n", row.f, pressures[i],
                  shear, row.shear[i]);
      EXPECT_NEAR(shear, row.shear[i], 1e-6);
    }
}

TEST(ContactRatio, GrowsFromNoneToAllWithAnExactSlope) {
  for (const double f : {0.0, 1e-9, 0.3, 0.9, 1.0}) {
    double last = 0.0;
    for (double p = 0.0; p < 30.0; p += 0.0937) {
      const ContactRatio ratio = wanheim_bay(p, f);
      EXPECT_GE(ratio.alpha, last) << f;
      EXPECT_LE(ratio.alpha, 1.0) << f;
      constexpr double h = 1e-6;
      if (p > h) {
        const double slope =
            (wanheim_bay(p + h, f).alpha - wanheim_bay(p - h, f).alpha) / (2.0 * h);
        EXPECT_NEAR(ratio.slope, slope, 1e-8) << f << ' ' << p;
      }
      last = ratio.alpha;
    }
    EXPECT_NEAR(last, 1.0, 1e-6) << f;
  }
}

TEST(ContactRatio, IsPressureOverHardnessAfterBowdenAndTabor) {
  EXPECT_DOUBLE_EQ(bowden_tabor(0.3).alpha, 0.1);
  EXPECT_DOUBLE_EQ(bowden_tabor(0.3).slope, 1.0 / 3.0);
  EXPECT_EQ(bowden_tabor(3.0).alpha, 1.0);
  EXPECT_EQ(bowden_tabor(100.0).slope, 0.0);
}

} // namespace
} // namespace billet::contact::contact_ratio_test
