#include "contact/friction/any_friction_law.h"

#include <tuple>

namespace billet::contact {

namespace {

/// Shear yield stresses are told by the type of a law's members.
template <class Parameter, class Law>
void add_followed(const Parameter& parameter, const Law& law, std::optional<FollowedStress>& into) {
  const auto add = [&](const ShearYieldStress& shear_yield) {
    if (const auto* const followed = std::get_if<FollowedStress>(&shear_yield))
      into = *followed;
  };
  if constexpr (requires { add(law.*parameter.member); })
    add(law.*parameter.member);
  else if constexpr (requires { add(*(law.*parameter.member)); }) {
    if (law.*parameter.member)
      add(*(law.*parameter.member));
  }
}

} // namespace

std::optional<FollowedStress> followed_stress(const AnyFrictionLaw& law) {
  std::optional<FollowedStress> followed;
  const auto look = [&](const auto& one) {
    std::apply([&](const auto&... parameters) { (add_followed(parameters, one, followed), ...); },
               one.parameters);
  };
  std::visit(look, law);
  return followed;
}

} // namespace billet::contact
