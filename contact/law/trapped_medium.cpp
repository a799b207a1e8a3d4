#include "contact/law/trapped_medium.h"

#include <cmath>

namespace billet::contact {

MediumPressure TrappedGas::at(double rest_volume, double volume) const {
  const double absolute = ambient * std::pow(rest_volume / volume, exponent);
  return {absolute - ambient, -exponent * absolute / volume};
}

MediumPressure TrappedLubricant::at(double rest_volume, double volume) const {
  if (volume >= rest_volume)
    return {0.0, 0.0};
  return {bulk * std::log(rest_volume / volume), -bulk / volume};
}

MediumPressure pressure_of(const TrappedMedium& medium, double rest_volume, double volume) {
  return std::visit([&](const auto& kind) { return kind.at(rest_volume, volume); }, medium);
}

} // namespace billet::contact
