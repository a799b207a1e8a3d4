#include "io/case/units.h"

#include "geometry/base/angle.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace billet::io {

namespace {

/// A unit in terms of m, N, s, K, rad: mantissa * 10^power.
struct Unit {
  Dimension dimension;
  double mantissa = 1.0;
  int power = 0;
};

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr Dimension length_dimension{1, 0, 0};
constexpr Dimension force_dimension{0, 1, 0};
constexpr Dimension time_dimension{0, 0, 1};
constexpr Dimension stress_dimension{-2, 1, 0};
constexpr Dimension mass_dimension{-1, 1, 2};
constexpr Dimension work_dimension{1, 1, 0};
constexpr Dimension power_dimension{1, 1, -1};
constexpr Dimension frequency_dimension{0, 0, -1};
constexpr Dimension temperature_dimension{0, 0, 0, 1};
constexpr Dimension angle_dimension{0, 0, 0, 0, 1};
constexpr Dimension angular_speed_dimension{0, 0, -1, 0, 1};

constexpr double pound_force = 4.4482216152605; // exact by definition [N]
constexpr double psi = 6.894757293168361e3;     // pound_force / (0.0254 m)^2 [Pa]

constexpr std::array named_units{
    NamedUnit{"nm", {length_dimension, 1.0, -9}},
    NamedUnit{"um", {length_dimension, 1.0, -6}},
    NamedUnit{"\u00b5m", {length_dimension, 1.0, -6}}, // micro sign
    NamedUnit{"\u03bcm", {length_dimension, 1.0, -6}}, // Greek mu
    NamedUnit{"mm", {length_dimension, 1.0, -3}},
    NamedUnit{"cm", {length_dimension, 1.0, -2}},
    NamedUnit{"m", {length_dimension, 1.0, 0}},
    NamedUnit{"in", {length_dimension, 254.0, -4}},
    NamedUnit{"ft", {length_dimension, 3048.0, -4}},
    NamedUnit{"mN", {force_dimension, 1.0, -3}},
    NamedUnit{"N", {force_dimension, 1.0, 0}},
    NamedUnit{"kN", {force_dimension, 1.0, 3}},
    NamedUnit{"MN", {force_dimension, 1.0, 6}},
    NamedUnit{"lbf", {force_dimension, pound_force, 0}},
    NamedUnit{"Pa", {stress_dimension, 1.0, 0}},
    NamedUnit{"kPa", {stress_dimension, 1.0, 3}},
    NamedUnit{"MPa", {stress_dimension, 1.0, 6}},
    NamedUnit{"GPa", {stress_dimension, 1.0, 9}},
    NamedUnit{"bar", {stress_dimension, 1.0, 5}},
    NamedUnit{"psi", {stress_dimension, psi, 0}},
    NamedUnit{"ksi", {stress_dimension, psi, 3}},
    NamedUnit{"us", {time_dimension, 1.0, -6}},
    NamedUnit{"ms", {time_dimension, 1.0, -3}},
    NamedUnit{"s", {time_dimension, 1.0, 0}},
    NamedUnit{"min", {time_dimension, 60.0, 0}},
    NamedUnit{"h", {time_dimension, 3600.0, 0}},
    NamedUnit{"Hz", {frequency_dimension, 1.0, 0}},
    NamedUnit{"g", {mass_dimension, 1.0, -3}},
    NamedUnit{"kg", {mass_dimension, 1.0, 0}},
    NamedUnit{"t", {mass_dimension, 1.0, 3}},
    NamedUnit{"J", {work_dimension, 1.0, 0}},
    NamedUnit{"kJ", {work_dimension, 1.0, 3}},
    NamedUnit{"W", {power_dimension, 1.0, 0}},
    NamedUnit{"K", {temperature_dimension, 1.0, 0}},
    NamedUnit{"degC", {temperature_dimension, 1.0, 0}},
    NamedUnit{"\u00b0C", {temperature_dimension, 1.0, 0}},
    NamedUnit{"degF", {temperature_dimension, 5.0 / 9.0, 0}},
    NamedUnit{"rad", {angle_dimension, 1.0, 0}},
    NamedUnit{"deg", {angle_dimension, degree, 0}},
    NamedUnit{"degrees", {angle_dimension, degree, 0}},
    NamedUnit{"\u00b0", {angle_dimension, degree, 0}},
    NamedUnit{"rev", {angle_dimension, 2.0 * std::numbers::pi, 0}},
    NamedUnit{"rpm", {angular_speed_dimension, std::numbers::pi / 30.0, 0}},
};

constexpr int largest_power = 9; // of a unit in a text: "mm^9" is already a typing error

Unit product(const Unit& a, const Unit& b, int exponent) {
  Unit c = a;
  c.dimension.length += exponent * b.dimension.length;
  c.dimension.force += exponent * b.dimension.force;
  c.dimension.time += exponent * b.dimension.time;
  c.dimension.temperature += exponent * b.dimension.temperature;
  c.dimension.angle += exponent * b.dimension.angle;
  c.mantissa *= std::pow(b.mantissa, exponent);
  c.power += exponent * b.power;
  return c;
}

bool is_part_of_unit(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalpha(byte) != 0 || byte >= 0x80;
}

/// Recursive-descent parser: product = factor {("*" | "." | "/" | " ") factor};
/// factor = atom ["^" n]. After a "/" a blank could mean either, so "W/m K" is none.
class UnitParser {
public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  /// The unit, or why it is none.
  Outcome<Unit> parse() {
    const std::optional<Unit> unit = parse_product(0);
    if (unit && trimmed(rest_).empty())
      return *unit;
    return Failure{reason_.empty() ? "the unit cannot be read" : reason_};
  }

private:
  bool skip(std::string_view symbol) {
    const std::string_view next = trimmed(rest_);
    if (!next.starts_with(symbol))
      return false;
    rest_ = next.substr(symbol.size());
    return true;
  }

  bool factor_after_blank() const {
    const std::string_view next = trimmed(rest_);
    return next.size() < rest_.size() && !next.empty() &&
           (is_part_of_unit(next.front()) || next.front() == '(') && !next.starts_with("\u00b7");
  }

  std::optional<Unit> parse_product(int depth) {
    std::optional<Unit> unit = parse_factor(depth);
    int factors = 1;
    bool divided = false;
    while (unit) {
      const bool apart = factor_after_blank() && !divided;
      const bool over = skip("/");
      if (!over && !skip("*") && !skip(".") && !skip("\u00b7") && !apart)
        break;
      divided = divided || over;
      const int exponent = over ? -1 : 1;
      const std::optional<Unit> factor = parse_factor(depth);
      if (!factor || ++factors > largest_power)
        return std::nullopt;
      unit = product(*unit, *factor, exponent);
    }
    return unit;
  }

  std::optional<Unit> parse_factor(int depth) {
    const std::optional<Unit> atom = parse_atom(depth);
    if (!atom)
      return std::nullopt;
    if (skip("^"))
      return parse_power(*atom);
    return atom;
  }

  std::optional<Unit> parse_power(const Unit& atom) {
    const bool negative = skip("-");
    rest_ = trimmed(rest_);
    int exponent = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), exponent);
    if (error != std::errc{} || exponent < 1 || exponent > largest_power)
      return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return product(Unit{}, atom, negative ? -exponent : exponent);
  }

  std::optional<Unit> parse_atom(int depth) {
    if (skip("(")) {
      const std::optional<Unit> unit =
          depth < largest_power ? parse_product(depth + 1) : std::nullopt;
      return skip(")") ? unit : std::nullopt;
    }
    if (skip("1"))
      return Unit{};
    rest_ = trimmed(rest_);
    std::size_t size = 0;
    while (size < rest_.size() && is_part_of_unit(rest_[size]) &&
           !rest_.substr(size).starts_with("\u00b7") && !is_superscript(rest_.substr(size)))
      ++size;
    return with_superscript(look_up(rest_.substr(0, size)), size);
  }

  static bool is_superscript(std::string_view text) {
    return text.starts_with("\u00b2") || text.starts_with("\u00b3");
  }

  std::optional<Unit> with_superscript(const std::optional<Unit>& unit, std::size_t size) {
    if (!unit)
      return std::nullopt;
    rest_.remove_prefix(size);
    if (rest_.starts_with("\u00b2") && skip("\u00b2"))
      return product(Unit{}, *unit, 2);
    if (rest_.starts_with("\u00b3") && skip("\u00b3"))
      return product(Unit{}, *unit, 3);
    return unit;
  }

  std::optional<Unit> look_up(std::string_view name) {
    const auto* const found = std::find_if(named_units.begin(), named_units.end(),
                                           [&](const NamedUnit& u) { return u.name == name; });
    if (found != named_units.end())
      return found->unit;
    if (!name.empty() && name.size() <= 40)
      reason_ = fmt::format("there is no unit '{}'", name);
    return std::nullopt;
  }

  std::string_view rest_;
  std::string reason_;
};

/// Multiplies by mantissa * 10^power with at most one rounding for a decimal factor.
double scaled(double value, double mantissa, int power) {
  const double by = value * mantissa;
  return power >= 0 ? by * std::pow(10.0, power) : by / std::pow(10.0, -power);
}

/// An absolute temperature; none when `unit` is not the bare name of one.
std::optional<double> temperature_in_celsius(double value, std::string_view unit) {
  if (unit == "degC" || unit == "\u00b0C")
    return value;
  if (unit == "K")
    return value - 273.15;
  if (unit == "degF")
    return (value - 32.0) * 5.0 / 9.0;
  return std::nullopt;
}

std::string allowed_unit(const Quantity& measured) {
  return fmt::format("allowed is {} such as \"10 {}\"", measured.name, measured.example);
}

/// Splits "25 mm/s" into 25 and "mm/s".
std::optional<std::pair<double, std::string_view>> number_and_unit(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+'))
    text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value))
    return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return std::pair{value, trimmed(text)};
}

} // namespace

std::span<const UnitSystem> unit_systems() {
  static const std::array systems{
      UnitSystem{},
      UnitSystem{"m-N-s-Pa-degC", "m", "N", "s", "Pa", "degC", 0},
  };
  return systems;
}

Outcome<double>
converted(std::string_view text, const Quantity& measured, const UnitSystem& system) {
  if (!measured.takes_unit)
    return Failure{fmt::format("allowed is {} without a unit", measured.name)};
  const auto parts = number_and_unit(text);
  if (!parts || parts->second.empty())
    return Failure{allowed_unit(measured)};
  const auto [value, unit_text] = *parts;
  const Outcome<Unit> unit = UnitParser(unit_text).parse();
  if (!unit)
    return Failure{unit.error().reason + "; " + allowed_unit(measured)};
  if (!(unit->dimension == measured.dimension))
    return Failure{fmt::format("'{}' does not measure {}; {}", unit_text, measured.name,
                               allowed_unit(measured))};
  if (unit->dimension == temperature_dimension) {
    const std::optional<double> celsius = temperature_in_celsius(value, unit_text);
    return celsius ? Outcome<double>(*celsius) : Failure{allowed_unit(measured)};
  }
  if (measured.degrees && unit->mantissa == degree)
    return value;
  const int power = unit->power - measured.dimension.length * system.length_power;
  const double mantissa = measured.degrees ? unit->mantissa / degree : unit->mantissa;
  return scaled(value, mantissa, power);
}

Outcome<double> length_factor(std::string_view unit, const UnitSystem& system) {
  return converted("1 " + std::string(unit), quantity::length, system);
}

} // namespace billet::io
