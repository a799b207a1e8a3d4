// Checks that every friction law and the interface law must pass.
//
// Units: mm, MPa.

#pragma once

#include "contact/law/interface_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::contact {

/// The limit's slopes are the derivatives of its value at each pressure (away from kinks).
template <FrictionLaw Law>
void expect_exact_slope(const Law& law, std::span<const double> pressures, double shear_yield) {
  constexpr double tolerance = 1e-7; // cancellation 1e-16 / 1e-6 of values of order 100
  for (const double p : pressures) {
    const InterfacePoint at{p, shear_yield, 3.0, 0.8};
    const SlipLimit limit = law.slip_limit(at);
    const auto expect = [&](double InterfacePoint::*member, double slope, const char* by) {
      const double h = 1e-6 * std::max(at.*member, 1.0);
      InterfacePoint above = at;
      InterfacePoint below = at;
      above.*member += h;
      below.*member -= h;
      const double difference =
          (law.slip_limit(above).shear - law.slip_limit(below).shear) / (2.0 * h);
      EXPECT_NEAR(slope, difference, tolerance * std::max(1.0, std::abs(difference)))
          << Law::name << " by " << by << " at p = " << p;
    };
    expect(&InterfacePoint::pressure, limit.d_pressure, "pressure");
    expect(&InterfacePoint::shear_yield, limit.d_shear_yield, "shear yield stress");
    expect(&InterfacePoint::speed, limit.d_speed, "speed");
    expect(&InterfacePoint::factor, limit.d_factor, "factor");
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

/// One friction with a name to print.
using NamedLaw = std::pair<std::string, Friction>;

/// Whether a law carries shear at rest: the others creep.
inline bool carries_at_rest(const Friction& friction) {
  return !std::holds_alternative<Frictionless>(friction.law) && !creeps(friction.law);
}

/// Laws with what modifies them.
inline std::vector<NamedLaw> modified_laws() {
  Friction evolving = Coulomb{0.3};
  evolving.evolution = {{{{}, {}, {0.0, 0.02, 0.3}}}, {1.0, 0.6, 1.4}};
  Friction tabled = Coulomb{1.0};
  tabled.table = {{{{0.0, 30.0, 90.0}, {0.0, 0.02}, {0.0, 0.1}}},
                  {0.1, 0.15, 0.2, 0.1, 0.3, 0.25, 0.2, 0.3, 0.4, 0.2, 0.3, 0.2}};
  const Vec3 direction = Vec3(1.0, 0.3, 0.2).normalized();
  Friction anisotropic = Coulomb{1.0};
  anisotropic.tensor = FrictionTensor{(Mat2() << 0.1, 0.02, -0.05, 0.3).finished(), direction};
  Friction creeping = Viscoplastic{60.0, 0.1, 0.3};
  creeping.tensor = FrictionTensor{(Mat2() << 0.5, 0.1, 0.1, 1.0).finished(), direction};
  return {{"coulomb evolving", evolving},
          {"coulomb by table", tabled},
          {"coulomb anisotropic", anisotropic},
          {"viscoplastic anisotropic", creeping},
          {"tresca of von Mises", Tresca{0.3, FollowedStress::von_mises}}};
}

/// Every law of the program, with the branches of each, and laws with modifiers.
inline std::vector<NamedLaw> every_law() {
  std::vector<NamedLaw> laws{{"frictionless", Frictionless{}},
                             {"sticking", Sticking{}},
                             {"coulomb", Coulomb{0.3}},
                             {"coulomb threshold", Coulomb{0.3, 20.0}},
                             {"coulomb capped", Coulomb{0.3, 0.0, 25.0}},
                             {"coulomb capped at k", Coulomb{0.6, 0.0, FollowedStress::yield}},
                             {"coulomb quadratic", Coulomb{0.2, 5.0, FollowedStress::yield, 5e-3}},
                             {"tresca", Tresca{0.5, 80.0}},
                             {"tresca of the material", Tresca{0.2, {}}},
                             {"levanov", Levanov{0.5, {}}},
                             {"shaw", Shaw{80.0, 0.3}},
                             {"shaw of the material", Shaw{{}, 1.0, Flattening::bowden_tabor}},
                             {"asperity", Asperity{0.6, {}, 0.5}},
                             {"thick film", ThickFilm{8.0, 0.01}},
                             {"viscoplastic", Viscoplastic{40.0, 0.1, 0.15}}};
  for (NamedLaw& law : modified_laws())
    laws.push_back(std::move(law));
  return laws;
}

/// Every integrator.
inline std::vector<SlipScheme> every_scheme() {
  return {
      {Integrator::radial}, {Integrator::midpoint}, {Integrator::midpoint, 3}, {Integrator::exact}};
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
                            const Friction& friction,
                            const PointHistory& old,
                            const Vec3& x,
                            const SlipScheme& scheme = {},
                            double touching = 0.0,
                            const Vec3& turn = Vec3::Zero(),
                            bool lagged = false) {
  InterfaceInput at{x, foot_of(surface, x), test_shear_yield};
  at.touching = touching;
  at.turn = turn;
  at.friction_lagged = lagged;
  return traction(friction, test_penalty, old, at, scheme);
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
  old.limit = 1.1 * old.shear.norm() + 0.1;
  return old;
}

} // namespace billet::contact
