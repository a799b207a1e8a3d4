// Every friction law the program knows. Adding a law means adding its name to this list.

#pragma once

#include "contact/friction/coulomb.h"
#include "contact/friction/frictionless.h"
#include "contact/friction/sticking.h"
#include "contact/friction/tresca.h"

#include <variant>

namespace billet::contact {

template <FrictionLaw... Laws> using OneOfFrictionLaws = std::variant<Laws...>;

using AnyFrictionLaw = OneOfFrictionLaws<Frictionless, Sticking, Coulomb, Tresca>;

/// The slip limit of whichever law it is.
[[nodiscard]] inline SlipLimit slip_limit(const AnyFrictionLaw& law, const InterfacePoint& at) {
  return std::visit([&](const auto& one) { return one.slip_limit(at); }, law);
}

} // namespace billet::contact
