#include "geometry/base/error.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "study/expression.h"

namespace billet::study::expression_test {
namespace {

const std::vector<std::string> names{"time",   "punch.force_y", "tool-a.force_y",
                                     "height", "heights",       "summary.energy.plastic_work"};

double value(const std::string& text, const std::vector<double>& values) {
  return Expression(text, names)(values);
}

TEST(Expression, IsOfNamesWithDotsAndSigns) {
  EXPECT_DOUBLE_EQ(value("-punch.force_y / 1000", {4e3}), -4.0);
  EXPECT_DOUBLE_EQ(value("tool-a.force_y - time", {5.0, 2.0}), 3.0);
  EXPECT_DOUBLE_EQ(value("heights-height", {5.0, 2.0}), 3.0);
  EXPECT_DOUBLE_EQ(value("2*summary.energy.plastic_work^2", {3.0}), 18.0);
  EXPECT_NEAR(value("ln(7.5/height) + 1e-3*pi", {2.5}), 1.0986122886681098 + 3.14159265358979e-3,
              1e-14);
}

TEST(Expression, SaysWhichNamesItUses) {
  EXPECT_EQ(Expression("height * time + height", names).used(), (std::vector<std::size_t>{3, 0}));
  EXPECT_TRUE(Expression("2 + 2", names).used().empty());
}

std::string refusal(const std::string& text) {
  try {
    const Expression expression(text, names);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Expression, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(refusal("punch.force_z").find("did you mean 'punch.force_y'?"), std::string::npos)
      << refusal("punch.force_z");
  EXPECT_NE(refusal("height +").find("expression 'height +'"), std::string::npos);
  EXPECT_NE(refusal("frobnicate(height)"), "");
  EXPECT_NE(refusal(""), "");
}

TEST(Expression, RefusesWhatMuParserWouldTakeForSomethingElse) {
  EXPECT_NE(refusal("1,5 * height").find("decimals take a point"), std::string::npos);
  EXPECT_NE(refusal("height, time").find("2 values"), std::string::npos);
  EXPECT_NE(refusal("height = 3").find("'==' compares"), std::string::npos);
  EXPECT_EQ(refusal("min(height, time)"), "");
  EXPECT_DOUBLE_EQ(value("(height == 3) + (height <= 3) + (height != 3)", {3.0}), 2.0);
}

TEST(Expression, KnowsMistakesBeforeItKnowsTheNames) {
  for (const char* sound :
       {"height", "-upper die.force_y / 1e3", "tool-a.force_y - time", "ln(7.5 / half height) + pi",
        "Gesenk_ö.force_y", "2 + 2", "max(a b.c, 0.5)"})
    EXPECT_EQ(Expression::mistake_in(sound), "") << sound;
  for (const char* wrong : {"", "height +", "frobnicate(height)", "(height", "1,5", "h = 3"})
    EXPECT_NE(Expression::mistake_in(wrong), "") << wrong;
}

} // namespace
} // namespace billet::study::expression_test
