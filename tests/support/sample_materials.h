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

/// Every flow law, yielding at a few hundred MPa; the table also softens.
inline std::vector<NamedMaterial> every_material() {
  using namespace mechanics;
  std::vector<NamedMaterial> list{
      {"", {steel, Elastic{}}},
      {"", {steel, Perfect{300.0}}},
      {"", {steel, Linear{300.0, 500.0}}},
      {"", {steel, Swift{700.0, 0.01, 0.2}}},
      {"", {steel, Ludwik{250.0, 600.0, 0.4}}},
      {"", {steel, Voce{250.0, 450.0, 12.0}}},
      {"", {steel, FlowTable{{{0.0, 300.0}, {0.05, 380.0}, {0.2, 420.0}, {1.0, 340.0}}}}},
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
