// No friction.

#pragma once

#include "contact/friction/friction_law.h"

#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = 0.
struct Frictionless {
  static constexpr std::string_view name = "frictionless";
  static constexpr std::tuple<> parameters{};

  bool operator==(const Frictionless&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint&) const noexcept { return {0.0, 0.0}; }
};

} // namespace billet::contact
