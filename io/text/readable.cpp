#include "io/text/readable.h"

#include <cmath>

namespace billet::io {

Readable readable(double largest, std::string_view unit) {
  constexpr double kilo = 1e3, mega = 1e6, many = 1e4; // five digits before the point are too many
  largest = std::abs(largest);
  if (unit == "N" && largest >= many * kilo)
    return {1.0 / mega, "MN"};
  if (unit == "N" && largest >= many)
    return {1.0 / kilo, "kN"};
  if (unit == "m" && largest < 1.0)
    return {kilo, "mm"};
  return {1.0, std::string(unit)};
}

} // namespace billet::io
