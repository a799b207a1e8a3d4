// A block that slides on a floor, once for each friction law.
//
// All nodes of the block are moved along the floor and the floor is pressed on it by a force: the
// pressure is that force over an area that does not change, whatever the law. In the steady slide
// the force along the way is the law's shear times the area. The laws are written out once more
// here, from their papers. "The paper" is Cescotto, Oudin, Charlier, Bricout and Ravalard.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "study/verify/friction_block.h"
#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

constexpr double block_k = block_yield / std::numbers::sqrt3; // shear yield stress [MPa]

/// alpha of asperities that share the metal under them (Bay 1987, after Wanheim and Bay).
/// @param p  pressure over sigma_0 [-]
double real_contact_of_bay(double p, double f) {
  const double root = std::sqrt(1.0 - f);
  const double alpha = (1.0 - root) / f;
  const double limit = (1.0 + 0.5 * std::numbers::pi + std::acos(f) + std::sqrt(1.0 - f * f)) /
                       (std::numbers::sqrt3 * (1.0 + root));
  const double x = p / limit;
  return x <= 1.0 ? alpha * x : 1.0 - (1.0 - alpha) * std::exp(-alpha / (1.0 - alpha) * (x - 1.0));
}

/// alpha by the hardness, p / H with H = 3 sigma_0 (the paper, below its eq 1).
double real_contact_of_hardness(double p) { return std::min(1.0, p / 3.0); }

/// Von Mises stress of the block, which its supports keep from widening: uniaxial strain under a
/// pressure [MPa]. The stress is Kirchhoff's, as the flow stress is.
double von_mises_of_block(double pressure) {
  const double shear = block_young / (2.0 * (1.0 + block_poisson));
  const double bulk = block_young / (3.0 * (1.0 - 2.0 * block_poisson));
  double strain = 0.0; // logarithmic, of the height; J = exp(strain)
  for (int i = 0; i < 50; ++i)
    strain = -pressure * std::exp(strain) / (bulk + 4.0 / 3.0 * shear);
  return 2.0 * shear * std::abs(strain);
}

} // namespace

std::vector<Figure> frictionless_block(const CaseBench& bench) {
  std::vector<Figure> figures =
      block_figures(bench, {"frictionless", R"({ law = "frictionless" })", {{200.0, 1.0}}},
                    [](const BlockStep&) { return 0.0; });
  figures[0].criterion = Criterion::absolute;
  return figures;
}

std::vector<Figure> sticking_block(const CaseBench& bench) {
  // It does not slide: over a way of 0.0005 mm the shear is the stick stiffness times the way,
  // below the pressure, which bounds it (F.3).
  constexpr double speed = 2.5e-4;
  const SlidingBlock block{"sticking", R"({ law = "sticking" })", {{200.0, speed}}};
  return block_figures(bench, block, [&](const BlockStep&) {
    return block_stick_stiffness * speed * block.duration();
  });
}

std::vector<Figure> coulomb_block(const CaseBench& bench) {
  return block_figures(
      bench,
      {"coulomb", R"({ law = "coulomb", mu = 0.15 })", {{20.0, 1.0}, {200.0, 1.0}, {900.0, 1.0}}},
      [](const BlockStep& at) { return 0.15 * at.pressure; });
}

std::vector<Figure> capped_coulomb_block(const CaseBench& bench) {
  return block_figures(
      bench,
      {"coulomb-capped",
       R"({ law = "coulomb", mu = 0.15, threshold = 100, mu2 = 1e-4, cap = "shear-yield" })",
       {{60.0, 1.0}, {300.0, 1.0}, {600.0, 1.0}, {1000.0, 1.0}}},
      [](const BlockStep& at) {
        const double q = std::max(0.0, at.pressure - 100.0);
        return std::min(0.15 * q + 1e-4 * q * q, block_k);
      });
}

std::vector<Figure> tresca_block(const CaseBench& bench) {
  std::vector<Figure> figures = block_figures(
      bench, {"tresca", R"({ law = "tresca", m = 0.12 })", {{100.0, 1.0}, {600.0, 1.0}}},
      [](const BlockStep&) { return 0.12 * block_k; });
  for (Figure& figure : block_figures(
           bench, {"tresca-k", R"({ law = "tresca", m = 0.12, k = 250 })", {{300.0, 1.0}}},
           [](const BlockStep&) { return 0.12 * 250.0; }))
    figures.push_back(std::move(figure));
  return figures;
}

std::vector<Figure> von_mises_block(const CaseBench& bench) {
  return block_figures(bench,
                       {"tresca-von-mises",
                        R"({ law = "tresca", m = 0.12, k = "von-mises" })",
                        {{300.0, 1.0}, {900.0, 1.0}}},
                       [](const BlockStep& at) {
                         return 0.12 * von_mises_of_block(at.pressure) / std::numbers::sqrt3;
                       });
}

std::vector<Figure> levanov_block(const CaseBench& bench) {
  return block_figures(
      bench,
      {"levanov", R"({ law = "levanov", m = 0.5 })", {{30.0, 1.0}, {300.0, 1.0}, {1000.0, 1.0}}},
      [](const BlockStep& at) {
        return 0.5 * block_k * (1.0 - std::exp(-1.25 * at.pressure / block_yield));
      });
}

std::vector<Figure> shaw_block(const CaseBench& bench) {
  std::vector<Figure> figures =
      block_figures(bench,
                    {"shaw",
                     R"({ law = "shaw", k = "shear-yield", f = 0.4 })",
                     {{100.0, 1.0}, {500.0, 1.0}, {1000.0, 1.0}}},
                    [](const BlockStep& at) {
                      return real_contact_of_bay(at.pressure / block_yield, 0.4) * block_k;
                    });
  for (Figure& figure :
       block_figures(bench,
                     {"shaw-hardness",
                      R"({ law = "shaw", k = "shear-yield", real_contact = "bowden-tabor" })",
                      {{300.0, 1.0}, {1000.0, 1.0}}},
                     [](const BlockStep& at) {
                       return real_contact_of_hardness(at.pressure / block_yield) * block_k;
                     }))
    figures.push_back(std::move(figure));
  return figures;
}

std::vector<Figure> asperity_block(const CaseBench& bench) {
  return block_figures(bench,
                       {"asperity",
                        R"({ law = "asperity", m_local = 0.6, k = "shear-yield", f = 0.6 })",
                        {{100.0, 1.0}, {500.0, 1.0}, {1000.0, 1.0}}},
                       [](const BlockStep& at) {
                         return 0.6 * real_contact_of_bay(at.pressure / block_yield, 0.6) * block_k;
                       });
}

std::vector<Figure> thick_film_block(const CaseBench& bench) {
  return block_figures(bench,
                       {"thick-film",
                        R"({ law = "thick-film", viscosity = 1e-6, film = 0.005 })",
                        {{200.0, 1000.0}, {200.0, 20000.0}}},
                       [](const BlockStep& at) { return 1e-6 * at.speed / 0.005; });
}

std::vector<Figure> viscoplastic_block(const CaseBench& bench) {
  return block_figures(bench,
                       {"viscoplastic",
                        R"({ law = "viscoplastic", beta = 30, v0 = 10, mv = 0.15 })",
                        {{200.0, 1.0}, {200.0, 10.0}, {200.0, 100.0}}},
                       [](const BlockStep& at) { return 30.0 * std::pow(at.speed / 10.0, 0.15); });
}

std::vector<Figure> table_block(const CaseBench& bench) {
  return block_figures(
      bench,
      {"table",
       R"({ law = "coulomb", table = { pressure = [0, 400], speed = [0, 10], values = [[0.2, 0.1], [0.1, 0.05]] } })",
       {{100.0, 2.0}, {300.0, 5.0}, {600.0, 20.0}}},
      [](const BlockStep& at) {
        const double x = std::min(1.0, at.pressure / 400.0), y = std::min(1.0, at.speed / 10.0);
        const double mu = (1.0 - x) * (0.2 - 0.1 * y) + x * (0.1 - 0.05 * y);
        return mu * at.pressure;
      });
}

std::vector<Figure> evolution_block(const CaseBench& bench) {
  // Three steps of 100 mm each: the factor rises from 1 at 100 mm to 3 at 250 mm and stays there.
  // What a growing shear stores is no sliding: the way that counts lags behind by some multiple of
  // 0.005 of the element's depth (C.17). Found were 0.06 to 0.19 mm; on 0.15 mm the factor at 200
  // mm, 7/3, changes by 0.09 %.
  constexpr double of_elastic_slip = 2e-3;
  return block_figures(
      bench,
      {"evolution",
       R"({ law = "coulomb", mu = 0.05, evolution = [[0, 1], [100, 1], [250, 3]] })",
       {{200.0, 50.0}, {200.0, 50.0}, {200.0, 50.0}},
       of_elastic_slip},
      [](const BlockStep& at) {
        const double grown = std::clamp((at.way - 100.0) / 150.0, 0.0, 1.0);
        return 0.05 * (1.0 + 2.0 * grown) * at.pressure;
      });
}

} // namespace billet::study
