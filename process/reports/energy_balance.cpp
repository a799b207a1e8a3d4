#include "process/reports/energy_balance.h"

#include <algorithm>
#include <cmath>

namespace billet::process {

double EnergyBalance::error() const {
  return scale() > nothing ? std::abs(missing()) / scale() : 0.0;
}

double EnergyBalance::largest_since(const EnergyBalance& before) const {
  return std::max({std::abs(external - before.external), std::abs(elastic - before.elastic),
                   plastic - before.plastic, friction - before.friction,
                   std::abs(contact - before.contact)});
}

double EnergyBalance::error_since(const EnergyBalance& before) const {
  const double largest = largest_since(before);
  return largest > 0.0 ? std::abs(missing() - before.missing()) / largest : 0.0;
}

} // namespace billet::process
