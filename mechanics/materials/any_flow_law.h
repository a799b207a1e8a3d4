// Every flow law the program knows. Adding a law means adding its name to this list.

#pragma once

#include "mechanics/materials/elastic.h"
#include "mechanics/materials/flow_table.h"
#include "mechanics/materials/hansel_spittel.h"
#include "mechanics/materials/johnson_cook.h"
#include "mechanics/materials/linear.h"
#include "mechanics/materials/ludwik.h"
#include "mechanics/materials/norton_hoff.h"
#include "mechanics/materials/perfect.h"
#include "mechanics/materials/perzyna.h"
#include "mechanics/materials/swift.h"
#include "mechanics/materials/voce.h"

#include <variant>

namespace billet::mechanics {

template <class Law>
concept AnyKindOfFlowLaw = FlowLaw<Law> || RateFlowLaw<Law>;

template <AnyKindOfFlowLaw... Laws> using OneOfFlowLaws = std::variant<Laws...>;

using AnyFlowLaw = OneOfFlowLaws<Elastic,
                                 Perfect,
                                 Linear,
                                 Swift,
                                 Ludwik,
                                 Voce,
                                 FlowTable,
                                 NortonHoff,
                                 Perzyna,
                                 JohnsonCook,
                                 HanselSpittel>;

/// Whether the flow stress depends on how fast the metal flows.
[[nodiscard]] inline bool follows_rate(const AnyFlowLaw& flow) {
  return std::visit([]<class Law>(const Law&) { return RateFlowLaw<Law>; }, flow);
}

} // namespace billet::mechanics
