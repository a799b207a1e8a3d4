// One workpiece material for each flow law the program knows.

#pragma once

#include "mechanics/materials/j2_hencky.h"

#include <string>
#include <vector>

namespace billet::support {

struct NamedMaterial {
  std::string name;
  mechanics::Material material;
};

inline constexpr mechanics::Elasticity steel{200e3, 0.3};

/// AISI 4340 after Johnson and Cook (1983); the reference rate is below those of the tests.
inline constexpr mechanics::JohnsonCook steel_4340{792.0, 510.0, 0.26, 0.014,
                                                   1e-3,  1.03,  20.0, 1520.0};
/// C45, hot (docs/guide/materials.md).
inline constexpr mechanics::HanselSpittel hot_steel{
    3268.49,     -0.00267855, 0.34446,     0.0, 0.000551814,
    -0.00132042, 0.0166334,   0.000149907, 0.0, 0.02};

/// Every flow law, yielding at a few hundred MPa; the table also softens. Rate laws do so at a few
/// per second, Johnson-Cook warm and Hansel-Spittel hot.
inline std::vector<NamedMaterial> every_material() {
  using namespace mechanics;
  std::vector<NamedMaterial> list{
      {"", {steel, Elastic{}}},
      {"", {steel, Perfect{300.0}}},
      {"", {steel, Linear{300.0, 500.0}}},
      {"", {steel, Swift{700.0, 0.01, 0.2}}},
      {"", {steel, Ludwik{250.0, 600.0, 0.4}}},
      {"", {steel, Voce{250.0, 450.0, 12.0}}},
      {"", {steel, HockettSherby{250.0, 600.0, 3.0, 0.6}}},
      {"", {steel, FlowTable{{{0.0, 300.0}, {0.05, 380.0}, {0.2, 420.0}, {1.0, 340.0}}}}},
      {"", {steel, NortonHoff{100.0, 0.15, 0.1, 0.01, 50.0}}},
      {"", {steel, Perzyna{Swift{700.0, 0.01, 0.2}, 0.02, 0.3}}},
      {"", {steel, steel_4340, 300.0}},
      {"", {steel, hot_steel, 900.0}},
  };
  for (NamedMaterial& entry : list)
    entry.name =
        std::visit([](const auto& law) { return std::string(law.name); }, entry.material.flow);
  return list;
}

inline bool yields(const mechanics::Material& material) {
  return !std::holds_alternative<mechanics::Elastic>(material.flow);
}

} // namespace billet::support
