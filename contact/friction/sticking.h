// No sliding at all.

#pragma once

#include "contact/friction/friction_law.h"

#include <limits>
#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = infinity, bounded by the cone (F.3) that every law obeys.
struct Sticking {
  static constexpr std::string_view name = "sticking";
  static constexpr std::tuple<> parameters{};

  bool operator==(const Sticking&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint&) const noexcept {
    return {std::numeric_limits<double>::infinity(), 0.0};
  }
};

} // namespace billet::contact
