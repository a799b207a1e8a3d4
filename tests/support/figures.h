// Prints computed figures next to their references, so that the log of a test shows both.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string_view>

namespace billet::support {

/// One line: what was computed, what it should be, and the relative difference.
inline void show(std::string_view id, std::string_view what, double value, double reference) {
  const double scale = reference != 0.0 ? std::abs(reference) : 1.0;
  fmt::print("[{}] {} = {:.9g}  reference {:.9g}  difference {:.2e}\n", id, what, value, reference,
             (value - reference) / scale);
}

/// One line: an error that must stay below a bound.
inline void show_error(std::string_view id, std::string_view what, double error, double allowed) {
  fmt::print("[{}] {}: error {:.2e}  allowed {:.0e}\n", id, what, error, allowed);
}

} // namespace billet::support
