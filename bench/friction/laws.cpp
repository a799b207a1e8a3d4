// Prints the slip limits of every friction law, for gnuplot: one block a law, "x tau" a line.
//
// Usage: bench-friction pressure | speed | sliding

#include "contact/friction/friction.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace billet::contact;
using Curves = std::vector<std::pair<const char*, Friction>>;

constexpr double k = 300.0; // [MPa]

Curves over_pressure() {
  return {{"coulomb, eq 3", Coulomb{0.15}},
          {"coulomb, eq 4", Coulomb{0.15, 100.0, k}},
          {"coulomb, eq 5", Coulomb{0.15, 100.0, k, 2e-4}},
          {"tresca, eq 7", Tresca{0.12, k}},
          {"shaw, eq 6, f = 0.3", Shaw{k, 0.3}},
          {"shaw, eq 6, Bowden-Tabor", Shaw{k, 0.0, Flattening::bowden_tabor}},
          {"asperity, eq 8, m = f = 0.6", Asperity{0.6, k, 0.6}}};
}

Curves over_speed() {
  return {{"thick-film, eq 9", ThickFilm{0.05e-3, 0.002}},
          {"viscoplastic, eq 10, m_v = 0.15", Viscoplastic{30.0, 10.0, 0.15}},
          {"viscoplastic, eq 10, m_v = 0.6", Viscoplastic{30.0, 10.0, 0.6}}};
}

Curves over_sliding() {
  Friction evolving = Coulomb{0.06};
  evolving.evolution = {{{{}, {}, {0.0, 800.0, 1000.0, 1100.0}}}, {1.0, 1.3, 2.0, 5.0}};
  return {{"coulomb with evolution to pick-up", evolving}};
}

template <class Limit>
void print(const Curves& curves, const std::vector<double>& at, const Limit& limit) {
  for (const auto& [name, friction] : curves) {
    fmt::print("\"{}\"\n", name);
    for (const double x : at)
      fmt::print("{} {}\n", x, limit(friction, x));
    fmt::print("\n\n");
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::string_view by = argc == 2 ? argv[1] : "";
  std::vector<double> steps;
  for (int i = 0; i <= 400; ++i)
    steps.push_back(i / 400.0);
  if (by == "pressure") {
    for (double& x : steps)
      x *= 2500.0;
    print(over_pressure(), steps, [](const Friction& f, double p) {
      return limit_at(f, {p, k}, 0.0).shear;
    });
  } else if (by == "speed") {
    for (double& x : steps)
      x = std::pow(10.0, -5.0 + 8.0 * x);
    print(over_speed(), steps, [](const Friction& f, double v) {
      return limit_at(f, {1e3, k}, v).shear;
    });
  } else if (by == "sliding") {
    for (double& x : steps)
      x *= 1200.0;
    print(over_sliding(), steps, [](const Friction& f, double s) {
      return limit_at(f, {1e3, k, s}, 0.0).shear;
    });
  } else {
    fmt::print(stderr, "usage: bench-friction pressure | speed | sliding\n");
    return 2;
  }
  return 0;
}
