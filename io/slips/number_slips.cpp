// Slips that the numbers of a case alone tell.

#include "geometry/base/angle.h"
#include "io/case/case.h"
#include "io/slips/slip.h"
#include "io/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

/// A stress of the case in MPa.
double in_megapascal(double stress, const UnitSystem& units) {
  constexpr int megapascal = 6; // in powers of Pa
  return stress * std::pow(10.0, -2 * units.length_power - megapascal);
}

/// Metals and plastics have 100 to 1e6 MPa: diamond has 1.2e6, lead 1.6e4, polyethylene 200.
Slip odd_modulus(const std::string& name, const Material& material, const UnitSystem& units) {
  constexpr double least = 1e2, most = 1e6, per_giga = 1e3;
  const double young = in_megapascal(material.elastic.young, units);
  if (young >= least && young <= most)
    return std::nullopt;
  std::string likely;
  if (young < least && young * per_giga <= most)
    likely = fmt::format(": is it \"{:g} GPa\"?", material.elastic.young);
  return fmt::format("material '{}': young = {:g} {} is {} than any metal has{}", name,
                     material.elastic.young, units.stress, young < least ? "less" : "more", likely);
}

/// Solids that are formed have 900 (polyethylene) to 22 600 kg/m^3 (osmium).
Slip odd_density(const std::string& name, const Material& material, const UnitSystem& units) {
  constexpr double least = 500.0, most = 25e3;
  if (!material.density)
    return std::nullopt;
  // In units of the case a density is a force times time squared over length to the fourth.
  const double density = *material.density * std::pow(10.0, -4 * units.length_power);
  if (density >= least && density <= most)
    return std::nullopt;
  return fmt::format("material '{}': density = {:g} is {:.3g} kg/m^3, {} than any metal has{}",
                     name, *material.density, density, density < least ? "less" : "more",
                     *material.density >= least && *material.density <= most
                         ? fmt::format(": is it \"{:g} kg/m^3\"?", *material.density)
                         : "");
}

/// Metals have 120 (gold, lead) to 2000 J/(kg K) (beryllium), plastics up to 2500.
Slip odd_heat_capacity(const std::string& name, const Material& material, const UnitSystem& units) {
  constexpr double least = 50.0, most = 5e3;
  if (!material.heat_capacity)
    return std::nullopt;
  const double capacity = *material.heat_capacity * std::pow(10.0, 2 * units.length_power);
  if (capacity >= least && capacity <= most)
    return std::nullopt;
  return fmt::format(
      "material '{}': heat_capacity = {:g} is {:.3g} J/(kg K), {} than any metal has{}", name,
      *material.heat_capacity, capacity, capacity < least ? "less" : "more",
      *material.heat_capacity >= least && *material.heat_capacity <= most
          ? fmt::format(": is it \"{:g} J/kg/K\"?", *material.heat_capacity)
          : "");
}

/// A stress of a flow law and the key that gives it.
struct KeyedStress {
  std::string_view key;
  double value;
};

using KeyedStresses = std::vector<KeyedStress>;

template <class AnyLaw> void add_stresses_of(const AnyLaw& any, KeyedStresses& stresses);

// Stresses that one parameter of a law gives.
void add_stresses(std::string_view key, const Quantity& measured, double value, KeyedStresses& to) {
  if (measured.dimension == quantity::stress.dimension && value > 0.0)
    to.push_back({key, value});
}
void add_stresses(std::string_view /*key*/,
                  const Quantity& /*measured*/,
                  const std::vector<std::pair<double, double>>& points,
                  KeyedStresses& to) {
  double most = 0.0;
  for (const auto& [strain, stress] : points)
    most = std::max(most, stress);
  to.push_back({"the largest stress of its points", most});
}
void add_stresses(std::string_view /*key*/,
                  const Quantity& /*measured*/,
                  const mechanics::AnyStaticLaw& base,
                  KeyedStresses& to) {
  add_stresses_of(base, to);
}

/// Stresses among the parameters of a law.
template <class AnyLaw> void add_stresses_of(const AnyLaw& any, KeyedStresses& stresses) {
  const auto add = [&]<class Law>(const Law& law) {
    const auto add_one = [&](const auto& parameter) {
      add_stresses(parameter.key, parameter.measured, law.*parameter.member, stresses);
    };
    // The A of Hensel and Spittel stands for a stress at no degree and a rate of one.
    if constexpr (!std::same_as<Law, mechanics::HanselSpittel>)
      std::apply([&](const auto&... parameters) { (add_one(parameters), ...); }, Law::parameters);
  };
  std::visit(add, any);
}

/// A metal flows at a thousandth of its modulus; its theoretical strength is a tenth of it.
Slip odd_strength(const std::string& name, const Material& material, const UnitSystem& units) {
  constexpr double least = 1e-6, most = 0.1;
  if (!material.flow)
    return std::nullopt;
  KeyedStresses stresses;
  add_stresses_of(*material.flow, stresses);
  for (const KeyedStress& stress : stresses) {
    const double ratio = stress.value / material.elastic.young;
    const bool may_be_small = stress.key == "hardening" || stress.key == "B";
    if (ratio > most || (ratio < least && !may_be_small))
      return fmt::format(
          "material '{}': {} = {:g} {} is {:.3g} of young = {:g} {}, of metals it is "
          "1e-4 to 0.03: is one of them in another unit?",
          name, stress.key, stress.value, units.stress, ratio, material.elastic.young,
          units.stress);
  }
  return std::nullopt;
}

/// Metals on tools have 0.02 to 0.6; above 1 metal shears before it slides.
Slip large_friction(const Tool& tool) {
  constexpr double most = 1.0, per_cent = 0.01;
  const auto* const coulomb = std::get_if<contact::Coulomb>(&tool.friction.law);
  if (coulomb == nullptr)
    return std::nullopt;
  const std::vector<double>& table = tool.friction.table.values;
  const double mu = table.empty() ? coulomb->mu : *std::max_element(table.begin(), table.end());
  if (mu <= most)
    return std::nullopt;
  return fmt::format(
      "tool '{}': mu = {:g} is more than metals have; in per cent it would be {:g}, "
      "and what does not slide is law = \"sticking\". Where metal leaves a tool that "
      "holds it so, its force is right to some per cent only, whatever the increments",
      tool.name, mu, per_cent * mu);
}

/// The round angle that a number of degrees is in radians.
std::optional<double> round_angle_in_radians(double number) {
  constexpr double rounding = 1e-3; // 3.14
  for (const double angle : {30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 150.0, 180.0, 270.0, 360.0})
    if (std::abs(std::abs(number) - angle * degree) <= rounding * angle * degree)
      return std::copysign(angle, number);
  return std::nullopt;
}

Slip radians(const std::string& whose, std::string_view key, double number) {
  if (const std::optional<double> meant_angle = round_angle_in_radians(number))
    return fmt::format(
        "{}: {} = {:g} is in degrees; in radians it would be {:g} degrees: write that, or "
        "\"{:g} rad\"",
        whose, key, number, *meant_angle, number);
  return std::nullopt;
}

Slip turned_in_radians(const std::string& whose, const Place& place) {
  return place.rotate ? radians(whose, "place.rotate.degrees", place.rotate->degrees)
                      : std::nullopt;
}

/// Angles of a tool that are given in degrees, other than that of its place.
Slip angle_in_radians(const Tool& tool) {
  const std::string whose = fmt::format("tool '{}'", tool.name);
  if (const auto* const cone = std::get_if<ConeSurface>(&tool.surface))
    return radians(whose, "half_angle", cone->half_angle);
  const auto* const press =
      tool.motion.translation ? std::get_if<PressMotion>(&*tool.motion.translation) : nullptr;
  const auto* const crank = press != nullptr ? std::get_if<CrankMotion>(press) : nullptr;
  return crank != nullptr ? radians(whose, "start", crank->start) : std::nullopt;
}

/// The speed of what turns, if anything does.
const TimeFunction* turning_speed(const ToolMotion& motion) {
  if (motion.rotation)
    if (const auto* const turn = std::get_if<RotationMotion>(&*motion.rotation))
      return &turn->speed;
  if (motion.translation)
    if (const auto* const press = std::get_if<PressMotion>(&*motion.translation))
      if (const auto* const crank = std::get_if<CrankMotion>(press))
        return &crank->speed;
  return nullptr;
}

/// Tools of forming turn by parts of a turn, rolls by a few; 360 rad/s are 57 turns a second.
Slip speed_in_degrees(const Tool& tool, double end) {
  constexpr double step = 15.0, least = 30.0, few_turns = 2.0;
  const TimeFunction* const speed = turning_speed(tool.motion);
  if (speed == nullptr)
    return std::nullopt;
  const double turns = std::abs(speed->integral(end)) / (2.0 * std::numbers::pi);
  for (const auto& [time, value] : speed->points())
    if (std::abs(value) >= least && std::fmod(value, step) == 0.0 && turns > few_turns)
      return fmt::format("tool '{}': speed = {:g} is in rad/s, and makes {:.3g} turns; degrees or "
                         "turns are written as \"{:g} deg/s\" or \"{:g} rpm\"",
                         tool.name, value, turns, value, value);
  return std::nullopt;
}

} // namespace

std::vector<std::string> number_slips(const Case& content) {
  std::vector<std::string> slips;
  const std::string& name = content.workpiece.material;
  if (const auto material = content.materials.find(name); material != content.materials.end()) {
    add_slip(slips, "modulus", odd_modulus(name, material->second, content.units));
    add_slip(slips, "density", odd_density(name, material->second, content.units));
    add_slip(slips, "heat-capacity", odd_heat_capacity(name, material->second, content.units));
    if (!odd_modulus(name, material->second,
                     content.units)) // else it is the modulus that the strength is far from
      add_slip(slips, "strength", odd_strength(name, material->second, content.units));
  }
  add_slip(slips, "radians", turned_in_radians("the workpiece", content.workpiece.place));
  for (const Tool& tool : content.tools) {
    add_slip(slips, "radians", turned_in_radians(fmt::format("tool '{}'", tool.name), tool.place));
    add_slip(slips, "radians", angle_in_radians(tool));
    add_slip(slips, "speed-in-degrees", speed_in_degrees(tool, content.time.end));
    add_slip(slips, "large-friction", large_friction(tool));
  }
  return slips;
}

} // namespace billet::io
