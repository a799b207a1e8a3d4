#include "io/advice/metal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace billet::io {

namespace {

/// A metal and what tells it.
struct KnownMetal {
  Metal metal;
  std::array<double, 2> density; ///< of its alloys [kg/m^3]
  std::array<double, 2> young;   ///< that is no other metal's [GPa]
  bool is_hot = false;           ///< constants above 700 degC
};

// Typical values, rounded, at room temperature but for hot steel; aluminium is an alloy, titanium
// Ti-6Al-4V. The modulus of copper is that of some titanium alloys as well, and tells neither.
constexpr std::array known_metals{
    KnownMetal{{"steel", 7850.0, 480.0, 45.0, 1500.0}, {7500.0, 8150.0}, {180.0, 230.0}},
    KnownMetal{{"hot steel", 7850.0, 630.0, 28.0, 1500.0}, {7500.0, 8150.0}, {80.0, 230.0}, true},
    KnownMetal{{"aluminium", 2700.0, 900.0, 180.0, 600.0}, {2600.0, 2900.0}, {62.0, 78.0}},
    KnownMetal{{"copper", 8960.0, 385.0, 390.0, 1083.0}, {8850.0, 9000.0}, {0.0, 0.0}},
    KnownMetal{{"titanium", 4430.0, 560.0, 7.0, 1650.0}, {4350.0, 4700.0}, {0.0, 0.0}},
    KnownMetal{{"lead", 11340.0, 129.0, 35.0, 327.0}, {11000.0, 11500.0}, {12.0, 20.0}},
};

bool is_in(const std::array<double, 2>& range, double value) {
  return value >= range[0] && value <= range[1] && value > 0.0;
}

} // namespace

std::optional<Metal> metal_of(const Case& content) {
  constexpr double hot = 700.0, room = 20.0; // [degC]
  const Material& material = content.materials.at(content.workpiece.material);
  const int power = content.units.length_power;
  const double young = material.elastic.young * std::pow(10.0, -2 * power - 9); // [GPa]
  const bool is_hot = content.temperature.value_or(room) > hot;
  // In units of the case a density is a force times time squared over length to the fourth.
  const double per_density = std::pow(10.0, -4 * power);
  const auto* const found =
      std::find_if(known_metals.begin(), known_metals.end(), [&](const KnownMetal& known) {
        const bool is_steel = known.metal.name.ends_with("steel");
        const bool fits = material.density ? is_in(known.density, *material.density * per_density)
                                           : is_in(known.young, young);
        return fits && (!is_steel || known.is_hot == is_hot);
      });
  if (found == known_metals.end())
    return std::nullopt;
  Metal metal = found->metal;
  if (material.density)
    metal.density = *material.density * per_density;
  if (material.heat_capacity)
    metal.heat_capacity = *material.heat_capacity * std::pow(10.0, 2 * power);
  return metal;
}

} // namespace billet::io
