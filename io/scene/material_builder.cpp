#include "io/scene/material_builder.h"

#include <optional>
#include <variant>

namespace billet::io {

namespace {

mechanics::Perfect law_of(const PerfectFlow& f) { return {f.yield}; }
mechanics::Linear law_of(const LinearFlow& f) { return {f.yield, f.hardening}; }
mechanics::Swift law_of(const SwiftFlow& f) { return {f.K, f.eps0, f.n}; }
mechanics::Ludwik law_of(const LudwikFlow& f) { return {f.yield, f.K, f.n}; }
mechanics::Voce law_of(const VoceFlow& f) { return {f.yield, f.saturation, f.rate}; }
mechanics::FlowTable law_of(const TableFlow& f) { return {f.points}; }
mechanics::NortonHoff law_of(const NortonHoffFlow& f) { return {f.K, f.m, f.n, f.eps0, f.yield}; }
mechanics::Perzyna law_of(const PerzynaFlow& f) {
  return {
      std::visit([](const auto& base) -> mechanics::AnyStaticLaw { return law_of(base); }, f.base),
      f.eta, f.m};
}
mechanics::JohnsonCook law_of(const JohnsonCookFlow& f) {
  return {f.A, f.B, f.n, f.C, f.rate0, f.m, f.T_room, f.T_melt};
}
mechanics::HanselSpittel law_of(const HanselSpittelFlow& f) {
  mechanics::HanselSpittel law{f.A, f.m1, f.m2, f.m3, f.m4, f.m5, f.m7, f.m8, f.m9, f.eps_min};
  if (f.eps_max > 0.0)
    law.eps_max = f.eps_max;
  return law;
}

mechanics::AnyFlowLaw flow_law(const std::optional<FlowLaw>& flow) {
  if (!flow)
    return mechanics::Elastic{};
  return std::visit([](const auto& f) -> mechanics::AnyFlowLaw { return law_of(f); }, *flow);
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
