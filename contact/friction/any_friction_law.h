// Every friction law the program knows. Adding a law means adding its name to this list.

#pragma once

#include "contact/friction/asperity.h"
#include "contact/friction/coulomb.h"
#include "contact/friction/frictionless.h"
#include "contact/friction/levanov.h"
#include "contact/friction/shaw.h"
#include "contact/friction/sticking.h"
#include "contact/friction/thick_film.h"
#include "contact/friction/tresca.h"
#include "contact/friction/viscoplastic.h"

#include <optional>
#include <variant>

namespace billet::contact {

template <FrictionLaw... Laws> using OneOfFrictionLaws = std::variant<Laws...>;

using AnyFrictionLaw = OneOfFrictionLaws<Frictionless,
                                         Sticking,
                                         Coulomb,
                                         Tresca,
                                         Levanov,
                                         Shaw,
                                         Asperity,
                                         ThickFilm,
                                         Viscoplastic>;

/// The slip limit of whichever law it is.
[[nodiscard]] inline SlipLimit slip_limit(const AnyFrictionLaw& law, const InterfacePoint& at) {
  return std::visit([&](const auto& one) { return one.slip_limit(at); }, law);
}

/// What a law takes the shear yield stress of the parent element from; none: it does not ask for
/// it.
[[nodiscard]] std::optional<FollowedStress> followed_stress(const AnyFrictionLaw& law);

/// Whether a law asks for the shear yield stress of the parent element.
[[nodiscard]] inline bool follows_material(const AnyFrictionLaw& law) {
  return followed_stress(law).has_value();
}

/// Whether the limit depends on how fast the point slides.
[[nodiscard]] inline bool creeps(const AnyFrictionLaw& law) {
  return std::visit(
      []<class Law>(const Law&) {
        return requires { requires Law::creeps; };
      },
      law);
}

} // namespace billet::contact
