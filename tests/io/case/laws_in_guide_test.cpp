// The tables of laws in docs/guide/case-file.md say what the laws list as their parameters.

#include "io/case/units.h"
#include "io/case/write_law.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace billet::io::laws_in_guide_test {
namespace {

/// A unit in which the numbers of a case in mm, N, s, MPa and degC measure this.
std::string unit_of(const Quantity& measured) {
  for (const std::string unit :
       {"MPa", "1/MPa", "mm", "s", "1/s", "mm/s", "MPa s", "degC", "N", "N mm", "t", "deg"}) {
    const Outcome<double> one = converted("1 " + unit, measured, UnitSystem{});
    if (one && *one == 1.0)
      return unit;
  }
  return "a unit that this test does not know";
}

std::string number(double value) {
  return value < 0.0 ? fmt::format("−{}", -value) : fmt::format("{}", value);
}

/// " > 0", " from 0 to 1", " in (0, 1]"; nothing for any value.
std::string bounds_of(const Bounds& bounds) {
  const auto& [low, high, low_open, high_open] = bounds;
  if (low == high)
    return " = " + number(low);
  if (std::isfinite(low) && std::isfinite(high))
    return low_open || high_open ? fmt::format(" in {}{}, {}{}", low_open ? "(" : "[", number(low),
                                               number(high), high_open ? ")" : "]")
                                 : fmt::format(" from {} to {}", number(low), number(high));
  if (std::isfinite(low))
    return (low_open ? " > " : " ≥ ") + number(low);
  return std::isfinite(high) ? (high_open ? " < " : " ≤ ") + number(high) : "";
}

template <class Law> std::string key_of(double Law::*member) {
  std::string key;
  const auto look = [&]<class One>(const One& parameter) {
    if constexpr (std::same_as<One, Parameter<Law>>)
      if (parameter.member == member)
        key = parameter.key;
  };
  std::apply([&](const auto&... parameters) { (look(parameters), ...); }, Law::parameters);
  return key;
}

/// What stands in brackets.
std::string default_text(double value) { return std::isfinite(value) ? number(value) : "none"; }
std::string default_text(const std::optional<contact::ShearYieldStress>& strength) {
  return strength ? toml_text(*strength) : "none";
}
template <class Value> std::string default_text(const Value& value) {
  return fmt::format("`{}`", toml_text(value));
}

template <class Law, class Value> std::string described(const Parameter<Law, Value>& parameter) {
  std::string text = fmt::format("`{}`", parameter.key);
  if (parameter.measured.takes_unit)
    text += fmt::format(" [{}]", unit_of(parameter.measured));
  const LowerLimit<Law>& above = parameter.above;
  text += above.member == nullptr
              ? bounds_of(parameter.bounds)
              : fmt::format(" {} `{}`", above.is_open ? ">" : "≥", key_of(above.member));
  if (parameter.presence != Presence::required)
    text += fmt::format(" ({})", default_text(Law{}.*parameter.member));
  return text;
}

template <class Law, class Value, class Choice>
std::string described(const ConditionalParameter<Law, Value, Choice>& conditional) {
  return described(conditional.parameter);
}

template <class Law> std::string row_of(const Law& /*law*/) {
  std::vector<std::string> texts;
  std::apply([&](const auto&... parameters) { (texts.push_back(described(parameters)), ...); },
             Law::parameters);
  return fmt::format("| `\"{}\"` | {}", Law::name, fmt::join(texts, ", "));
}

std::vector<std::string> lines_of_guide() {
  std::ifstream file(std::string(BILLET_SOURCE_DIR) + "/docs/guide/case-file.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    lines.push_back(line);
  return lines;
}

template <class Law> void expect_row(const std::vector<std::string>& guide) {
  const std::string row = row_of(Law{});
  EXPECT_TRUE(std::any_of(guide.begin(), guide.end(),
                          [&](const std::string& line) {
                            return line.starts_with(row) &&
                                   !line.substr(row.size()).starts_with(",");
                          }))
      << "docs/guide/case-file.md has no row that begins with\n"
      << row;
}

template <class... Laws>
void expect_rows(const std::vector<std::string>& guide, const std::variant<Laws...>* /*any*/) {
  (expect_row<Laws>(guide), ...);
}

TEST(LawsInGuide, have_a_row_each_with_every_parameter_its_unit_bounds_and_default) {
  const std::vector<std::string> guide = lines_of_guide();
  ASSERT_GT(guide.size(), 100U);
  expect_rows(guide, static_cast<const FlowLaw*>(nullptr));
  expect_rows(guide, static_cast<const FrictionLaw*>(nullptr));
}

/// A law with parameters of every sort.
struct Sample {
  double a, b, c = 2.5, d = -3.0, e;

  static constexpr std::string_view name = "sample";
  static constexpr std::tuple parameters{
      Parameter{"a", &Sample::a, quantity::viscosity, allowed::positive},
      Parameter{"b", &Sample::b, quantity::number, allowed::fraction}.more_than(&Sample::a, "a"),
      Parameter{"c", &Sample::c, quantity::number, allowed::positive_fraction}.optional(),
      Parameter{"d", &Sample::d, quantity::rate}.or_absent(),
      Parameter{"e", &Sample::e, quantity::temperature, allowed::above_absolute_zero},
  };
};

TEST(LawsInGuide, are_described_by_key_unit_bounds_and_default) {
  EXPECT_EQ(row_of(Sample{}), "| `\"sample\"` | `a` [MPa s] > 0, `b` > `a`, `c` in (0, 1] (2.5), "
                              "`d` [1/s] (−3), `e` [degC] ≥ −273.15");
}

} // namespace
} // namespace billet::io::laws_in_guide_test
