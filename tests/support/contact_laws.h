// Checks that every friction law and the interface law must pass.
//
// Units: mm, MPa.

#pragma once

#include "contact/interface_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::contact {

/// The limit's slope is the derivative of its value at each pressure (away from kinks).
template <FrictionLaw Law>
void expect_exact_slope(const Law& law, std::span<const double> pressures, double shear_yield) {
  constexpr double tolerance = 1e-7; // cancellation 1e-16 / 1e-6 of values of order 100
  for (const double p : pressures) {
    const double h = 1e-6 * std::max(p, 1.0);
    const double above = law.slip_limit({p + h, shear_yield}).shear;
    const double below = law.slip_limit({p - h, shear_yield}).shear;
    EXPECT_NEAR(law.slip_limit({p, shear_yield}).d_pressure, (above - below) / (2.0 * h), tolerance)
        << Law::name << " at p = " << p;
  }
}

/// The limit is never negative and never falls as the pressure grows.
template <FrictionLaw Law> void expect_monotone_limit(const Law& law, double shear_yield) {
  double last = 0.0;
  for (double p = 0.0; p <= 5000.0; p += 12.5) {
    const SlipLimit limit = law.slip_limit({p, shear_yield});
    EXPECT_GE(limit.shear, last) << Law::name << " at p = " << p;
    EXPECT_GE(limit.d_pressure, 0.0) << Law::name << " at p = " << p;
    last = limit.shear;
  }
}

/// One law with a name to print.
using NamedLaw = std::pair<std::string, AnyFrictionLaw>;

/// Every law of the program, with the branches of each.
inline std::vector<NamedLaw> every_law() {
  return {{"frictionless", Frictionless{}},
          {"sticking", Sticking{}},
          {"coulomb", Coulomb{0.3}},
          {"coulomb threshold", Coulomb{0.3, 20.0}},
          {"coulomb capped", Coulomb{0.3, 0.0, 25.0}},
          {"coulomb capped at k", Coulomb{0.6, 0.0, 1e9, true}},
          {"coulomb quadratic", Coulomb{0.2, 5.0, 1e9, true, 5e-3}},
          {"tresca", Tresca{0.5, 80.0}},
          {"tresca of the material", Tresca{0.2, {}}}};
}

/// The projection of one point.
inline geometry::Projection foot_of(const geometry::RigidSurface& surface, const Vec3& x) {
  constexpr double reach = 1e3; // leaves nothing out
  geometry::Projection p;
  surface.project({&x, 1}, reach, {&p, 1});
  return p;
}

/// Penalties of the order that a billet of steel gets.
inline constexpr Penalty test_penalty{2000.0, 1500.0};
inline constexpr double test_shear_yield = 110.0; ///< k [MPa]

/// Traction on a surface at x.
inline Traction traction_at(const geometry::RigidSurface& surface,
                            const AnyFrictionLaw& law,
                            const PointHistory& old,
                            const Vec3& x) {
  return traction(law, test_penalty, old, {x, foot_of(surface, x), test_shear_yield});
}

/// A vector with components evenly spread over (-1, 1).
inline Vec3 random_vector(std::mt19937& generator) {
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  const double x = component(generator), y = component(generator), z = component(generator);
  return {x, y, z};
}

/// A point just inside a surface near x, and the history of it at the start of an increment.
inline PointHistory closed_history(const geometry::RigidSurface& surface,
                                   const Vec3& near,
                                   double depth,
                                   const Vec3& shear) {
  const geometry::Projection foot = foot_of(surface, near);
  PointHistory old;
  old.position = foot.foot - depth * foot.normal;
  old.normal = foot_of(surface, old.position).normal;
  old.shear = shear - old.normal.dot(shear) * old.normal;
  return old;
}

} // namespace billet::contact
