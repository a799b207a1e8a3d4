#include "contact/friction/friction.h"

namespace billet::contact {

namespace {

/// Shear over pressure of the cone that no limit leaves (F.3): of a law that carries shear without
/// pressure, and of one that vanishes with it and is left as steep as it is.
constexpr double cone_of_adhesion = 1.0, cone_of_any_law = 100.0;

/// No shear without pressure: a limit that does not vanish with the pressure is cut to a cone
/// (F.3). A point that lifts would otherwise lose its shear at once, and between the two states
/// there may be no equilibrium at all.
LimitAtSlip bounded(const LimitAtSlip& limit, double pressure, double cone) {
  if (limit.shear > cone * pressure)
    return {cone * pressure, cone, 0.0, 0.0};
  return limit;
}

double cone_of(const Friction& friction, const InterfacePoint& at, bool limited) {
  if (limited)
    return cone_of_adhesion;
  InterfacePoint without_pressure = at;
  without_pressure.pressure = 0.0;
  return slip_limit(friction.law, without_pressure).shear > 0.0 ? cone_of_adhesion
                                                                : cone_of_any_law;
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
  const InterfacePoint point{at.pressure, at.shear_yield, speed, grown.value * tabled.value};
  const SlipLimit limit = slip_limit(friction.law, point);
  const double d_factor_d_pressure = grown.value * tabled.d_pressure;
  const double d_factor_d_slip =
      tabled.value * grown.d_sliding + grown.value * (tabled.d_sliding + tabled.d_speed / at.dt);
  return bounded({limit.shear, limit.d_pressure + limit.d_factor * d_factor_d_pressure,
                  limit.d_shear_yield, limit.d_speed / at.dt + limit.d_factor * d_factor_d_slip},
                 at.pressure, cone_of(friction, point, at.limited));
}

} // namespace billet::contact
