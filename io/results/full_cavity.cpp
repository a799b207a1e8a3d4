#include "io/results/full_cavity.h"

#include <cmath>

namespace billet::io {

bool Squeeze::is_full() const {
  constexpr double little = 0.02; // of the volume: what does no harm
  constexpr double open = 5.0;    // flow stresses: a sticking disc twenty times as wide as high
  return volume_lost > little && pressure > open * flow_stress;
}

Squeeze squeeze_of(const process::Run& run, double volume) {
  const mechanics::Bulk& bulk = *run.model.bulk;
  const double share = volume / bulk.reference_volume();
  Squeeze squeeze{1.0 - share, -bulk.material().elasticity.bulk() * std::log(share), 0.0};
  for (std::size_t k = 0; k < bulk.states().size(); ++k)
    squeeze.flow_stress +=
        bulk.volumes()[k] / bulk.reference_volume() *
        mechanics::yield_stress(
            bulk.material().flow,
            {bulk.states()[k].plastic_strain, run.state.plastic_rate[k], bulk.temperature(k)});
  return squeeze;
}

} // namespace billet::io
