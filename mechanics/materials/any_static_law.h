// Every flow law that knows no rate: what an overstress law may build on. Adding such a law means
// adding its name to this list.

#pragma once

#include "mechanics/materials/flow_table.h"
#include "mechanics/materials/hockett_sherby.h"
#include "mechanics/materials/linear.h"
#include "mechanics/materials/ludwik.h"
#include "mechanics/materials/perfect.h"
#include "mechanics/materials/swift.h"
#include "mechanics/materials/voce.h"

#include <variant>

namespace billet::mechanics {

template <FlowLaw... Laws> using OneOfStaticLaws = std::variant<Laws...>;

using AnyStaticLaw =
    OneOfStaticLaws<Perfect, Linear, Swift, Ludwik, Voce, HockettSherby, FlowTable>;

/// Yield stress and slope of whichever law it is.
[[nodiscard]] inline FlowStress static_stress(const AnyStaticLaw& any, double plastic_strain) {
  return std::visit([&](const auto& law) { return law.flow_stress(plastic_strain); }, any);
}

} // namespace billet::mechanics
