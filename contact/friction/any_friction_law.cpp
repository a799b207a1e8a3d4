#include "contact/friction/any_friction_law.h"

#include <tuple>

namespace billet::contact {

namespace {

/// Strengths are told by the type of a law's members.
template <class Parameter, class Law>
void add_strength(const Parameter& parameter, const Law& law, std::optional<Strength>& into) {
  const auto add = [&](const ShearStrength& strength) {
    if (const auto* const followed = std::get_if<Strength>(&strength))
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

std::optional<Strength> followed_strength(const AnyFrictionLaw& law) {
  std::optional<Strength> followed;
  const auto look = [&](const auto& one) {
    std::apply([&](const auto&... parameters) { (add_strength(parameters, one, followed), ...); },
               one.parameters);
  };
  std::visit(look, law);
  return followed;
}

} // namespace billet::contact
