#include "contact/friction/friction.h"

namespace billet::contact {

namespace {

/// No shear without pressure: a limit that does not vanish with the pressure is cut to a steep
/// cone (F.3). A point that lifts would otherwise lose its shear at once, and between the two
/// states there may be no equilibrium at all.
LimitAtSlip bounded(const LimitAtSlip& limit, const SlipState& at) {
  if (limit.shear > at.steepest * at.pressure)
    return {at.steepest * at.pressure, at.steepest, 0.0, 0.0};
  return limit;
}

} // namespace

bool Friction::depends_on_slip() const {
  return creeps(law) || !evolution.empty() || table.depends_on_speed() ||
         table.depends_on_sliding();
}

LimitAtSlip limit_at(const Friction& friction, const SlipState& at, double slip) {
  const double speed = slip / at.dt;
  const CoefficientPoint where{at.pressure, speed, at.sliding + slip};
  const Coefficient grown = friction.evolution(where);
  const Coefficient tabled = friction.table(where);
  const SlipLimit limit =
      slip_limit(friction.law, {at.pressure, at.shear_yield, speed, grown.value * tabled.value});
  const double d_factor_d_pressure = grown.value * tabled.d_pressure;
  const double d_factor_d_slip =
      tabled.value * grown.d_sliding + grown.value * (tabled.d_sliding + tabled.d_speed / at.dt);
  return bounded({limit.shear, limit.d_pressure + limit.d_factor * d_factor_d_pressure,
                  limit.d_shear_yield, limit.d_speed / at.dt + limit.d_factor * d_factor_d_slip},
                 at);
}

} // namespace billet::contact
