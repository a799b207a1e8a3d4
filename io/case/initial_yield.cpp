#include "io/case/initial_yield.h"

#include <variant>

namespace billet::io {

namespace {

template <mechanics::FlowLaw Law> double yield_of(const Law& law) {
  return law.flow_stress(0.0).stress;
}

/// That of laws that know the temperature depends on the case's: check_whole.cpp.
template <mechanics::RateFlowLaw Law> double yield_of(const Law& law) {
  if constexpr (requires { law.asks_temperature(); })
    return 0.0;
  else
    return law.flow_stress({0.0, 0.0, 0.0}).stress;
}

} // namespace

double initial_yield(const FlowLaw& flow) {
  return std::visit([](const auto& law) { return yield_of(law); }, flow);
}

} // namespace billet::io
