// Every flow law the program knows. Adding a law means adding its name to this list.

#pragma once

#include "mechanics/materials/elastic.h"
#include "mechanics/materials/flow_table.h"
#include "mechanics/materials/linear.h"
#include "mechanics/materials/ludwik.h"
#include "mechanics/materials/perfect.h"
#include "mechanics/materials/swift.h"
#include "mechanics/materials/voce.h"

#include <variant>

namespace billet::mechanics {

template <FlowLaw... Laws> using OneOfFlowLaws = std::variant<Laws...>;

using AnyFlowLaw = OneOfFlowLaws<Elastic, Perfect, Linear, Swift, Ludwik, Voce, FlowTable>;

} // namespace billet::mechanics
