#include "io/case/units.h"

#include <gtest/gtest.h>

#include <numbers>

namespace billet::io::units_test {
namespace {

const UnitSystem millimetres = unit_systems()[0];
const UnitSystem metres = unit_systems()[1];

double in_mm(const std::string& text, const Quantity& measured) {
  const Outcome<double> value = converted(text, measured, millimetres);
  EXPECT_TRUE(value.has_value()) << text << ": " << (value ? "" : value.error().reason);
  return value ? *value : 0.0;
}

std::string reason(const std::string& text, const Quantity& measured) {
  const Outcome<double> value = converted(text, measured, millimetres);
  EXPECT_FALSE(value.has_value()) << text;
  return value ? "" : value.error().reason;
}

// Decimal factors are exact: the expected values are compared to the bit.
TEST(Units, convert_decimal_multiples_exactly) {
  EXPECT_EQ(in_mm("10 mm", quantity::length), 10.0);
  EXPECT_EQ(in_mm("0.3 um", quantity::length), 3e-4);
  EXPECT_EQ(in_mm("7.1cm", quantity::length), 71.0);
  EXPECT_EQ(in_mm("1.1 m", quantity::length), 1100.0);
  EXPECT_EQ(in_mm("210 GPa", quantity::stress), 210000.0);
  EXPECT_EQ(in_mm("1 N/mm^2", quantity::stress), 1.0);
  EXPECT_EQ(in_mm("3 kN/cm^2", quantity::stress), 30.0);
  EXPECT_EQ(in_mm("5 ms", quantity::duration), 0.005);
  EXPECT_EQ(in_mm("2 min", quantity::duration), 120.0);
  EXPECT_EQ(in_mm("25 mm/s", quantity::speed), 25.0);
  EXPECT_EQ(in_mm("7850 kg/m^3", quantity::density), 7.85e-9);
  EXPECT_DOUBLE_EQ(in_mm("7.85 g/cm^3", quantity::density), 7.85e-9);
  EXPECT_EQ(in_mm("2 Pa.s", quantity::viscosity), 2e-6);
}

TEST(Units, convert_inch_units) {
  EXPECT_EQ(in_mm("1 in", quantity::length), 25.4);
  EXPECT_EQ(in_mm("2 ft", quantity::length), 609.6);
  EXPECT_NEAR(in_mm("1 ksi", quantity::stress), 6.894757293168361, 1e-14);
  EXPECT_NEAR(in_mm("1 lbf/in^2", quantity::stress), 6.894757293168361e-3, 1e-17);
}

TEST(Units, know_both_systems) {
  EXPECT_EQ(*converted("210 GPa", quantity::stress, metres), 210e9);
  EXPECT_EQ(*converted("10 mm", quantity::length, metres), 0.01);
  EXPECT_EQ(*converted("7850 kg/m^3", quantity::density, metres), 7850.0);
  EXPECT_EQ(*length_factor("mm", metres), 1e-3);
  EXPECT_EQ(*length_factor("m", millimetres), 1e3);
}

TEST(Units, treat_temperatures_as_affine) {
  EXPECT_EQ(in_mm("1150 degC", quantity::temperature), 1150.0);
  EXPECT_NEAR(in_mm("1423.15 K", quantity::temperature), 1150.0, 1e-12);
  EXPECT_NEAR(in_mm("212 degF", quantity::temperature), 100.0, 1e-12);
  EXPECT_EQ(in_mm("20 \u00b0C", quantity::temperature), 20.0);
  (void)reason("20 K^1", quantity::temperature);
}

TEST(Units, count_angles_in_degrees_and_their_rates_in_radians) {
  EXPECT_EQ(in_mm("30 deg", quantity::angle), 30.0);
  EXPECT_NEAR(in_mm("1 rad", quantity::angle), 180.0 / std::numbers::pi, 1e-13);
  EXPECT_NEAR(in_mm("60 rpm", quantity::angular_speed), 2.0 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(in_mm("360 deg/s", quantity::angular_speed), 2.0 * std::numbers::pi, 1e-15);
}

TEST(Units, read_products_quotients_powers_and_signs) {
  EXPECT_EQ(in_mm("-4 N*mm", quantity::torque), -4.0);
  EXPECT_EQ(in_mm("+4 N\u00b7mm", quantity::torque), 4.0);
  EXPECT_EQ(in_mm("4 J", quantity::torque), 4000.0);
  EXPECT_EQ(in_mm("4 N/(mm.mm)", quantity::stress), 4.0);
  EXPECT_EQ(in_mm("4 1/s", quantity::rate), 4.0);
  EXPECT_EQ(in_mm("4 s^-1", quantity::rate), 4.0);
  EXPECT_EQ(in_mm("9 N/mm\u00b2", quantity::stress), 9.0);
  EXPECT_EQ(in_mm("-4 N mm", quantity::torque), -4.0);
  EXPECT_EQ(in_mm("4 N (mm)", quantity::torque), 4.0);
  EXPECT_EQ(in_mm("470 J/(kg K)", quantity::heat_capacity),
            in_mm("470 J/kg/K", quantity::heat_capacity));
  EXPECT_EQ(reason("470 J/kg K", quantity::heat_capacity),
            "the unit cannot be read; allowed is a heat capacity such as \"10 J/kg/K\"");
}

TEST(Units, name_what_is_expected) {
  EXPECT_EQ(reason("5 s", quantity::length),
            "'s' does not measure a length; allowed is a length such as \"10 mm\"");
  EXPECT_NE(reason("5 furlong", quantity::length).find("there is no unit 'furlong'"),
            std::string::npos);
  EXPECT_EQ(reason("5", quantity::length), "allowed is a length such as \"10 mm\"");
  EXPECT_EQ(reason("mm", quantity::length), "allowed is a length such as \"10 mm\"");
  EXPECT_EQ(reason("", quantity::length), "allowed is a length such as \"10 mm\"");
  EXPECT_EQ(reason("5 mm", quantity::number), "allowed is a number without a unit");
  (void)reason("nan mm", quantity::length);
  (void)reason("5 mm^", quantity::length);
  (void)reason("5 mm^99999999999", quantity::length);
  (void)reason("5 (mm", quantity::length);
  (void)reason("5 mm)", quantity::length);
  (void)reason("5 mm**s", quantity::length);
  (void)reason("5 " + std::string(1000, '('), quantity::length);
}

} // namespace
} // namespace billet::io::units_test
