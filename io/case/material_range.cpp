#include "io/case/material_range.h"

#include "io/case/material_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace billet::io {

namespace {

/// The data of a flow law.
struct Data {
  std::string whose; ///< in words
  MaterialRange range;
};

/// Whether the stress stays what it is where the table ends.
bool ends_flat(const mechanics::FlowTable& table) {
  const std::size_t n = table.points.size();
  return n < 2 || table.points[n - 1].second == table.points[n - 2].second;
}

/// None: nothing is known about them.
std::optional<Data> data_of(const Material& material) {
  if (!material.flow)
    return std::nullopt;
  if (const auto* table = std::get_if<mechanics::FlowTable>(&*material.flow); table != nullptr) {
    if (ends_flat(*table))
      return std::nullopt;
    return Data{"its table", {table->points.back().first, -HUGE_VAL, HUGE_VAL}};
  }
  const LibraryMaterial* known = find_library_material(material.library);
  const auto name = std::visit([](const auto& law) { return law.name; }, *material.flow);
  const std::string said = fmt::format("law = \"{}\"", name); // else the case has a law of its own
  if (known == nullptr || known->text.find(said) == std::string_view::npos)
    return std::nullopt;
  return Data{fmt::format("'{}'", known->name), known->range};
}

} // namespace

std::optional<std::string> outside_range(const Material& material, double temperature) {
  const std::optional<Data> data = data_of(material);
  constexpr double margin = 5.0; // degC
  if (!data ||
      (temperature >= data->range.coldest - margin && temperature <= data->range.hottest + margin))
    return std::nullopt;
  return fmt::format("warning: [material-range] the workpiece has {:.4g} degC, and the data of {} "
                     "reach from {:.4g} to {:.4g} degC: its flow stress there is a guess",
                     temperature, data->whose, data->range.coldest, data->range.hottest);
}

std::optional<std::string> left_range(const Material& material, const mechanics::Bulk& bulk) {
  constexpr double unseen = 0.05; // of the volume
  const std::optional<Data> data = data_of(material);
  if (!data)
    return std::nullopt;
  double whole = 0.0, strained = 0.0, heated = 0.0, largest = 0.0, hottest = -HUGE_VAL;
  for (std::size_t k = 0; k < bulk.states().size(); ++k) {
    const double volume = bulk.volumes()[k], strain = bulk.states()[k].plastic_strain;
    whole += volume;
    strained += strain > data->range.strain ? volume : 0.0;
    largest = std::max(largest, strain);
    if (!bulk.temperatures().empty()) {
      heated += bulk.temperature(k) > data->range.hottest ? volume : 0.0;
      hottest = std::max(hottest, bulk.temperature(k));
    }
  }
  std::string text;
  if (strained > unseen * whole)
    text = fmt::format("{:.0f} % of the part has plastic strains above {:.3g}, the largest {:.3g}",
                       100.0 * strained / whole, data->range.strain, largest);
  if (heated > unseen * whole)
    text += fmt::format("{}{:.0f} % of the part is hotter than {:.4g} degC, at most {:.4g}",
                        text.empty() ? "" : ", and ", 100.0 * heated / whole, data->range.hottest,
                        hottest);
  if (text.empty())
    return std::nullopt;
  return fmt::format("warning: [material-range] {}, where the data of {} end: the flow stress "
                     "there is a guess",
                     text, data->whose);
}

} // namespace billet::io
