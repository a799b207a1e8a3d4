#include "io/scene/material_builder.h"

#include <optional>
#include <variant>

namespace billet::io {

namespace {

mechanics::AnyFlowLaw flow_law(const std::optional<FlowLaw>& flow) {
  if (!flow)
    return mechanics::Elastic{};
  return std::visit([](const auto& f) -> mechanics::AnyFlowLaw { return f; }, *flow);
}

} // namespace

mechanics::Material material_of(const Case& content) {
  const Material& m = content.materials.at(content.workpiece.material);
  mechanics::Material material{{m.elastic.young, m.elastic.poisson}, flow_law(m.flow)};
  if (content.temperature)
    material.temperature = *content.temperature;
  if (m.heating)
    material.heating = *m.heating / (*m.density * *m.heat_capacity);
  return material;
}

} // namespace billet::io
