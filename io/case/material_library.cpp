#include "io/case/material_library.h"

#include <algorithm>
#include <array>
#include <string>

namespace billet::io {

namespace {

/// Of curves measured at room temperature, without what heating by the work itself adds.
constexpr MaterialRange cold{1.0, 0.0, 200.0};

constexpr std::array all_materials{
    LibraryMaterial{
        "c15-cold", R"(
elastic = { young = "206 GPa", poisson = 0.3 }
density = "7850 kg/m^3"
heat_capacity = "460 J/kg/K"
flow = { law = "swift", K = "530 MPa", eps0 = 0.01, n = 0.26 }
)",
        "low-carbon steel (1018, C15), annealed, cold: K and n of Kalpakjian and Schmid, "
        "Manufacturing Engineering and Technology, table 2.3; strain to 1, quasi-static, "
        "20 degC; eps0 is ours",
        cold},
    LibraryMaterial{
        "c45-cold", R"(
elastic = { young = "206 GPa", poisson = 0.3 }
density = "7850 kg/m^3"
heat_capacity = "470 J/kg/K"
flow = { law = "swift", K = "965 MPa", eps0 = 0.005, n = 0.14 }
)",
        "1045 (C45), hot rolled, cold: K and n of Kalpakjian and Schmid, table 2.3; strain "
        "to 1, quasi-static, 20 degC; eps0 is ours",
        cold},
    LibraryMaterial{"c45",
                    R"(
elastic = { young = "206 GPa", poisson = 0.3 }
density = "7850 kg/m^3"
heat_capacity = "470 J/kg/K"
flow = { law = "johnson-cook", A = "553.1 MPa", B = "600.8 MPa", n = 0.234, C = 0.0134, rate0 = 1.0, m = 1.0, T_room = 20.0, T_melt = 1460.0 }
)",
                    "1045 (C45): Jaspers and Dautzenberg, J. Mater. Process. Technol. 122 (2002) "
                    "322-330; strain to 0.3, rates to 7500 /s, 20 to 600 degC",
                    {0.3, 20.0, 600.0}},
    LibraryMaterial{
        "c45-hot",
        R"(
elastic = { young = "120 GPa", poisson = 0.33 }
density = "7850 kg/m^3"
heat_capacity = "620 J/kg/K"
flow = { law = "hansel-spittel", A = "3268.49 MPa", m1 = -0.00267855, m2 = 0.34446, m4 = 0.000551814, m5 = -0.00132042, m7 = 0.0166334, m8 = 0.000149907, eps_min = 0.05, eps_max = 1.0 }
)",
        "C45, hot: Hensel and Spittel's form as in PyRolL (TU Freiberg), plugin "
        "freiberg-flow-stress, which adds 0.1 to strain and rate; strain 0.1 to 1, rate "
        "1 to 100 /s, 800 to 1200 degC; elastic and thermal values typical",
        {1.0, 800.0, 1200.0}},
    LibraryMaterial{
        "42crmo4-cold", R"(
elastic = { young = "206 GPa", poisson = 0.3 }
density = "7850 kg/m^3"
heat_capacity = "470 J/kg/K"
flow = { law = "swift", K = "1015 MPa", eps0 = 0.005, n = 0.17 }
)",
        "Cr-Mo steel, annealed, cold: K and n of 4135 in Kalpakjian and Schmid, table 2.3, "
        "typical of 42CrMo4; strain to 1, quasi-static, 20 degC; eps0 is ours",
        cold},
    LibraryMaterial{
        "4340",
        R"(
elastic = { young = "206 GPa", poisson = 0.3 }
density = "7830 kg/m^3"
heat_capacity = "477 J/kg/K"
flow = { law = "johnson-cook", A = "792 MPa", B = "510 MPa", n = 0.26, C = 0.014, rate0 = 1.0, m = 1.03, T_room = 20.0, T_melt = "1793 K" }
)",
        "AISI 4340, Rc 30 (near 42CrMo4, quenched and tempered): Johnson and Cook, 7th Int. "
        "Symp. on Ballistics, The Hague (1983) 541-547; strain to 0.5, rates to 650 /s, 20 "
        "to 800 degC",
        {0.5, 20.0, 800.0}},
    LibraryMaterial{
        "aa6082-t6",
        R"(
elastic = { young = "70 GPa", poisson = 0.33 }
density = "2700 kg/m^3"
heat_capacity = "900 J/kg/K"
flow = { law = "johnson-cook", A = "428.5 MPa", B = "327.7 MPa", n = 1.008, C = 0.00747, rate0 = 1.0, m = 1.31, T_room = 20.0, T_melt = 582.0 }
)",
        "AlMgSi1 (AA6082), T6: Jaspers and Dautzenberg, J. Mater. Process. Technol. 122 "
        "(2002) 322-330; strain to 0.3, rates to 6000 /s, 20 to 400 degC",
        {0.3, 20.0, 400.0}},
    LibraryMaterial{
        "almgsi-cold", R"(
elastic = { young = "69 GPa", poisson = 0.33 }
density = "2700 kg/m^3"
heat_capacity = "900 J/kg/K"
flow = { law = "swift", K = "205 MPa", eps0 = 0.005, n = 0.2 }
)",
        "AlMgSi, soft annealed, cold: K and n of 6061-O in Kalpakjian and Schmid, table 2.3; "
        "strain to 1, quasi-static, 20 degC; eps0 is ours",
        cold},
    LibraryMaterial{
        "ofhc-copper",
        R"(
elastic = { young = "124 GPa", poisson = 0.34 }
density = "8960 kg/m^3"
heat_capacity = "383 J/kg/K"
flow = { law = "johnson-cook", A = "90 MPa", B = "292 MPa", n = 0.31, C = 0.025, rate0 = 1.0, m = 1.09, T_room = 20.0, T_melt = "1356 K" }
)",
        "OFHC copper, annealed: Johnson and Cook, 7th Int. Symp. on Ballistics, The Hague "
        "(1983) 541-547; strain to 0.5, rates to 450 /s, 20 to 800 degC",
        {0.5, 20.0, 800.0}},
    LibraryMaterial{
        "rail-steel-hot",
        R"(
elastic = { young = "110 GPa", poisson = 0.33 }
density = "7850 kg/m^3"
heat_capacity = "630 J/kg/K"
flow = { law = "hansel-spittel", A = "6022.9 MPa", m1 = -0.00337646736, m2 = 0.33712534, m3 = 0.036758, m7 = -0.8721164, m8 = 0.00011175, eps_min = 0.02, eps_max = 0.7 }
)",
        "rail steel with 0.75 % C (R260), hot: fit, within 3.5 %, to Shida's formula, J. "
        "JSTP 10 (1969) 610-617; strain 0.05 to 0.7, rate 0.1 to 100 /s, 850 to 1150 degC; "
        "elastic and thermal values typical",
        {0.7, 850.0, 1150.0}},
};

/// Every node of what the library gives stands where the case names it.
void put(Node& node, const TextPlace& place) {
  node.place = place;
  if (Table* const table = node.as<Table>())
    for (Entry& entry : table->entries) {
      entry.place = place;
      put(entry.node, place);
    }
}

/// Adds the entries that a table does not have.
void complete(Table& table, const Table& from) {
  for (const Entry& entry : from.entries) {
    Node* const own = table.find(entry.key);
    if (own == nullptr) {
      table.entries.push_back(entry);
      continue;
    }
    Table* const inner = own->as<Table>();
    const Table* const given = entry.node.as<Table>();
    if (inner != nullptr && given != nullptr && inner->find("law") == nullptr)
      complete(*inner, *given);
  }
}

} // namespace

std::span<const LibraryMaterial> material_library() { return all_materials; }

const LibraryMaterial* find_library_material(std::string_view name) {
  const auto* const found =
      std::find_if(all_materials.begin(), all_materials.end(),
                   [&](const LibraryMaterial& material) { return material.name == name; });
  return found == all_materials.end() ? nullptr : found;
}

std::optional<Node> with_library(const Node& section) {
  const Table* const table = section.as<Table>();
  const Node* const name = table != nullptr ? table->find("library") : nullptr;
  const auto* const text = name != nullptr ? name->as<std::string>() : nullptr;
  const LibraryMaterial* const material = text != nullptr ? find_library_material(*text) : nullptr;
  if (material == nullptr)
    return std::nullopt;
  Node given = parse_document(material->text, "the library of materials");
  put(given, name->place);
  Node whole = section;
  complete(*whole.as<Table>(), *given.as<Table>());
  return whole;
}

} // namespace billet::io
