// The interface law's derivative against central differences, on curved tools.

#include "geometry/surfaces/analytic_surfaces.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace billet::contact::interface_tangent_test {
namespace {

struct Shape {
  std::string name;
  geometry::SurfacePtr surface;
};

/// Small radii, so that the curvature terms weigh as much as the penalties.
std::vector<Shape> shapes() {
  std::vector<Shape> all;
  all.push_back({"plane", geometry::make_plane({0, 0, 0}, {1, 2, 3})});
  all.push_back({"sphere", geometry::make_sphere({0, 0, 0}, 0.5, false)});
  all.push_back({"hollow sphere", geometry::make_sphere({0, 0, 0}, 0.5, true)});
  all.push_back({"cylinder", geometry::make_cylinder({0, 0, 0}, {1, 1, 0}, 0.4, false)});
  all.push_back({"cone", geometry::make_cone({0, 0, -0.5}, {0, 0, 1}, 0.5, false)});
  all.push_back({"torus", geometry::make_torus({0, 0, 0}, {0, 0, 1}, 0.8, 0.3, false)});
  return all;
}

enum class Kind { first_touch, stick, slip };

/// Of the increment, in the states that touch first.
constexpr double touching = 0.3;

/// A random state: history, and the place at the end of the increment.
struct State {
  PointHistory old;
  Vec3 x;
  Vec3 turn = Vec3::Zero(); ///< of the tool [rad]
  bool lagged = false;      ///< friction of the pressure before (F.3a)
};

State random_state(const geometry::RigidSurface& surface, std::mt19937& generator, bool first) {
  constexpr double depth = 0.02;
  const Vec3 near = 0.6 * random_vector(generator) + Vec3(0.1, 0.05, 0.0);
  // Small and large shears, short and long ways, so that points stick and slip.
  std::uniform_real_distribution<double> decades(-4.0, -1.0);
  const double size = 400.0 * std::pow(10.0, decades(generator));
  State s{closed_history(surface, near, depth, size * random_vector(generator)), {}};
  const Vec3 way = std::pow(10.0, decades(generator)) * random_vector(generator);
  const geometry::Projection end = foot_of(surface, s.old.position + way);
  s.x = end.foot - depth * (1.0 + 0.5 * random_vector(generator)[0]) * end.normal;
  if (first) {
    s.old.normal.setZero();
    s.old.shear.setZero();
  }
  return s;
}

/// Smallest relative error over steps of difference; negative: a neighbour has another status.
double derivative_error(const geometry::RigidSurface& surface,
                        const Friction& law,
                        const SlipScheme& scheme,
                        const State& s) {
  const Traction at = traction_at(surface, law, s.old, s.x, scheme, touching, s.turn, s.lagged);
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    Mat3 difference;
    for (int j = 0; j < 3; ++j) {
      const Vec3 step = h * Vec3::Unit(j);
      const Traction above =
          traction_at(surface, law, s.old, s.x + step, scheme, touching, s.turn, s.lagged);
      const Traction below =
          traction_at(surface, law, s.old, s.x - step, scheme, touching, s.turn, s.lagged);
      if (above.status != at.status || below.status != at.status)
        return -1.0;
      difference.col(j) = (above.traction - below.traction) / (2.0 * h);
    }
    best = std::min(best, (difference - at.dtraction_dx).norm() / difference.norm());
  }
  return best;
}

class InterfaceTangent : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(InterfaceTangent, AgreesWithCentralDifferences) {
  constexpr double tolerance = 1e-6; // DESIGN: tangents to 1e-6 of their norm
  const auto [which, how] = GetParam();
  const auto [name, law] = every_law()[static_cast<std::size_t>(which)];
  const SlipScheme scheme = every_scheme()[static_cast<std::size_t>(how)];
  for (const Shape& shape : shapes()) {
    std::mt19937 generator(3);
    std::array<int, 3> seen{};
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      const bool first = i % 6 == 0;
      State s = random_state(*shape.surface, generator, first);
      if (i % 2 == 0) // of tools that spin
        s.turn = 0.5 * Vec3(std::sin(i), std::cos(3 * i), std::sin(7 * i));
      if (i % 3 == 1) { // as much as before, and a small rest of what was
        s.lagged = true;
        s.old.pressure = (i % 2 == 0 ? 1.0 : 1e3) * 0.02 * test_penalty.normal;
      }
      const double error = derivative_error(*shape.surface, law, scheme, s);
      if (error < 0.0)
        continue;
      const Status status =
          traction_at(*shape.surface, law, s.old, s.x, scheme, touching, s.turn, s.lagged).status;
      const Kind kind = first                     ? Kind::first_touch
                        : status == Status::stick ? Kind::stick
                                                  : Kind::slip;
      ++seen[static_cast<std::size_t>(kind)];
      worst = std::max(worst, error);
      EXPECT_LT(error, tolerance) << name << " on a " << shape.name << ", state " << i;
    }
    std::printf("%-22s %-14s first %d stick %d slip %d: largest error %.1e (<= 1e-6)\n",
                name.c_str(), shape.name.c_str(), seen[0], seen[1], seen[2], worst);
    EXPECT_GT(seen[0], 20);
    if (carries_at_rest(law)) {
      EXPECT_GT(seen[1], 20) << name << shape.name;
    }
    if (!std::holds_alternative<Sticking>(law.law)) {
      EXPECT_GT(seen[2], 20) << name << shape.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLaw,
                         InterfaceTangent,
                         testing::Combine(testing::Range(0, static_cast<int>(every_law().size())),
                                          testing::Range(0, 4)));

} // namespace
} // namespace billet::contact::interface_tangent_test
