// Every flow law the program knows. Adding a law means adding its name to this list, or to that of
// any_static_law.h if it knows no rate.

#pragma once

#include "mechanics/materials/any_static_law.h"
#include "mechanics/materials/elastic.h"
#include "mechanics/materials/hansel_spittel.h"
#include "mechanics/materials/johnson_cook.h"
#include "mechanics/materials/norton_hoff.h"
#include "mechanics/materials/perzyna.h"

#include <variant>

namespace billet::mechanics {

template <class Law>
concept AnyKindOfFlowLaw = FlowLaw<Law> || RateFlowLaw<Law>;

/// The laws of a list, and more after them.
template <class List, AnyKindOfFlowLaw... More> struct Longer;
template <class... Laws, AnyKindOfFlowLaw... More> struct Longer<std::variant<Laws...>, More...> {
  using List = std::variant<Laws..., More...>;
  using ListWithElastic = std::variant<Elastic, Laws..., More...>;
};

using FlowLaws = Longer<AnyStaticLaw, NortonHoff, Perzyna, JohnsonCook, HanselSpittel>;

using AnyPlasticLaw = FlowLaws::List;         ///< how metal flows
using AnyFlowLaw = FlowLaws::ListWithElastic; ///< or that it does not

/// Whether the flow stress depends on how fast the metal flows.
[[nodiscard]] inline bool follows_rate(const AnyFlowLaw& flow) {
  return std::visit([]<class Law>(const Law&) { return RateFlowLaw<Law>; }, flow);
}

} // namespace billet::mechanics
