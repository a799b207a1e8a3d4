#include "io/case/initial_yield.h"
#include "io/case/material_library.h"
#include "io/case/read_law.h"
#include "io/case/read_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::io {

namespace {

std::optional<double> default_hardness(const FlowLaw& flow) {
  const double yield = initial_yield(flow);
  return yield > 0.0 ? std::optional(3.0 * yield) : std::nullopt;
}

std::optional<ElasticConstants> as_elastic(const At& at) {
  TableReader table(at);
  ElasticConstants elastic;
  table.required("young", elastic.young, as_number, positive_stress);
  table.required("poisson", elastic.poisson, as_number,
                 Number{quantity::number, {-1.0, 0.5, true, true}});
  table.finish();
  return elastic;
}

std::optional<FlowLaw> as_flow(const At& at) {
  if (!at.is_table()) {
    at.complain_found("a table such as { law = \"perfect\", yield = \"300 MPa\" }");
    return std::nullopt;
  }
  TableReader table(at);
  FlowLaw flow;
  if (read_law(table, flow))
    table.finish();
  return flow;
}

std::optional<std::string> as_library_name(const At& at) {
  std::vector<std::string> names;
  for (const LibraryMaterial& known : material_library())
    names.emplace_back(known.name);
  const std::optional<std::size_t> index = as_word_index(at, names);
  return index ? std::optional(names[*index]) : std::nullopt;
}

/// Heating asks for what turns work into a rise of temperature.
void check_heating(TableReader& table, const Material& material) {
  const std::optional<At> at = table.find("heating");
  if (!at || !material.heating)
    return;
  for (const auto& [key, given] : {std::pair("density", material.density.has_value()),
                                   std::pair("heat_capacity", material.heat_capacity.has_value())})
    if (!given && !table.find(key)) // one that could not be read is reported already
      at->complain(fmt::format("heating needs the {} of the metal", key),
                   fmt::format("give {} in the same section", key));
  if (!material.flow)
    at->complain("an elastic body has no plastic work that could heat it");
}

std::optional<Material> read_material(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Material material;
  const bool has_library = table.has("library");
  if (has_library)
    table.required("library", material.library, as_library_name);
  if (has_library && at.inquiry() != nullptr)
    at.inquiry()->require_nothing(); // the library has the rest
  const bool unknown = has_library && find_library_material(material.library) == nullptr;
  if (!unknown || table.has("elastic") || at.inquiry() != nullptr) // else the library's is missing
    table.required("elastic", material.elastic, as_elastic);
  table.optional("flow", material.flow, as_flow);
  table.optional("hardness", material.hardness, as_number, positive_stress);
  table.optional("density", material.density, as_number, Number{quantity::density, positive});
  table.optional("heat_capacity", material.heat_capacity, as_number,
                 Number{quantity::heat_capacity, positive});
  table.optional("heating", material.heating, as_number,
                 Number{quantity::number, {0.0, 1.0, true, false}});
  check_heating(table, material);
  table.finish();
  if (!material.hardness && material.flow)
    material.hardness = default_hardness(*material.flow);
  return material;
}

} // namespace

std::optional<Material> as_material(const At& at) {
  const std::optional<Node> whole = with_library(at.node);
  return read_material(whole ? At{*whole, at.path, at.context} : at);
}

} // namespace billet::io
