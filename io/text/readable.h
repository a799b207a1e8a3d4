// The unit in which a quantity reads better than in that of the case: 304 kN for 303572 N.

#pragma once

#include <string>
#include <string_view>

namespace billet::io {

/// Numbers times the factor are in the unit.
struct Readable {
  double factor = 1.0;
  std::string unit;
};

/// For numbers up to `largest` in magnitude: kN from 10 000 N on, MN from 10 000 kN on, mm in place
/// of less than a metre; any other unit stays.
[[nodiscard]] Readable readable(double largest, std::string_view unit);

} // namespace billet::io
