#include "io/slips/slips.h"
#include "tests/io/case/case_text.h"

#include <gtest/gtest.h>

namespace billet::io::number_slips_test {
namespace {

/// A slip: what is changed in a good case, and what is said of it.
struct NumberSlip {
  std::string from;
  std::string to;
  std::string told;
};

const std::string roll_speed = "speed = \"30 rpm\"";
const std::string tresca = R"({ law = "tresca", m = 0.08, k = "100 MPa" })";
const std::string swift = R"({ law = "swift", K = 740, eps0 = 0.01, n = 0.2 })";

const std::vector<NumberSlip> slips{
    {"\"210 GPa\"", "70", "young = 70 MPa is less than any metal has: is it \"70 GPa\"?"},
    {"\"210 GPa\"", "210e9", "young = 2.1e+11 MPa is more than any metal has"},
    {"\"210 GPa\"", "210", "K = 740 MPa is 3.52 of young = 210 MPa"},
    {swift, R"({ law = "perfect", yield = 0.1 })", "yield = 0.1 MPa is 4.76e-07 of young"},
    {swift, R"({ law = "table", points = [[0, 300], [1, 3e8]] })", "the largest stress of its"},
    {"\"7850 kg/m^3\"", "7850", "density = 7850 is 7.85e+15 kg/m^3, more than any metal"},
    {"\"7850 kg/m^3\"", "7850", "is it \"7850 kg/m^3\"?"},
    {swift, swift + "\nheat_capacity = 460",
     "heat_capacity = 460 is 0.00046 J/(kg K), less than any metal has: is it \"460 J/kg/K\"?"},
    {tresca, R"({ law = "coulomb", mu = 10 })",
     "tool 'punch': mu = 10 is more than metals have; in per cent it would be 0.1"},
    {tresca, R"({ law = "coulomb", table = [[0, 5], [100, 20]] })", "mu = 20 is more than"},
    {"degrees = 90", "degrees = 1.5708",
     "the workpiece: place.rotate.degrees = 1.5708 is in degrees; in radians it would be 90"},
    {"place = { translate = [1, 0] }", "place = { rotate = { degrees = -3.14 } }",
     "tool 'die': place.rotate.degrees = -3.14 is in degrees; in radians it would be -180"},
    {roll_speed, "speed = 360",
     "tool 'roll': speed = 360 is in rad/s, and makes 172 turns; degrees or turns are written as "
     "\"360 deg/s\" or \"360 rpm\""},
    {R"({ velocity = [0, "-60 mm/min"] })",
     R"({ press = { kind = "crank", direction = [0, -1], radius = 5, rod = 20, speed = 1, start = 1.5708 } })",
     "tool 'punch': start = 1.5708 is in degrees"},
};

TEST(NumberSlips, a_good_case_has_none) {
  const std::string in_metres =
      "units = \"m-N-s-Pa-degC\"\n" +
      replaced(replaced(space_case, "young = 16000", "young = \"16 GPa\""), "[[0, 10], [0.1, 20]]",
               "[[0, 1e7], [0.1, 2e7]]");
  for (const std::string& text : {plane_case, space_case, in_metres})
    EXPECT_EQ(number_slips(read(text)), std::vector<std::string>()) << text;
}

TEST(NumberSlips, are_told_one_by_one) {
  for (const NumberSlip& slip : slips) {
    const auto told = number_slips(read(replaced(plane_case, slip.from, slip.to)));
    ASSERT_EQ(told.size(), 1U) << slip.to;
    EXPECT_TRUE(told.front().starts_with("warning: ")) << told.front();
    EXPECT_NE(told.front().find(slip.told), std::string::npos) << told.front();
  }
}

TEST(NumberSlips, do_not_depend_on_the_units_of_the_case) {
  const std::string in_metres = "units = \"m-N-s-Pa-degC\"\n" + space_case;
  const auto told = number_slips(read(in_metres)); // 16 000 Pa
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().find("young = 16000 Pa is less than any metal has"), std::string::npos)
      << told.front();
}

TEST(NumberSlips, a_cone_in_radians) {
  const auto told =
      number_slips(read(replaced(space_case, "half_angle = 30", "half_angle = 0.5236")));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().find("half_angle = 0.5236 is in degrees"), std::string::npos);
}

TEST(NumberSlips, an_angle_and_a_speed_with_a_unit_are_what_they_say) {
  const std::string turned = replaced(plane_case, "degrees = 90", "degrees = \"1.5708 rad\"");
  EXPECT_TRUE(number_slips(read(turned)).empty());
  const std::string turning = replaced(plane_case, roll_speed, "speed = \"90 deg/s\"");
  EXPECT_TRUE(number_slips(read(turning)).empty());
}

} // namespace
} // namespace billet::io::number_slips_test
