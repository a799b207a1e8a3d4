// Values with a unit: "210 GPa", "25 mm/s", "7850 kg/m^3", "1150 degC".
//
// A unit is a product, quotient and whole power of named units. It is reduced to exponents of
// length, force, time, temperature and angle and a factor, mantissa * 10^power, so that decimal
// conversions are exact to rounding. Temperatures alone are affine (degC, degF, K); in a product
// they are differences.

#pragma once

#include "geometry/base/outcome.h"
#include "geometry/base/quantity.h"
#include "io/case/case.h"

#include <span>
#include <string_view>

namespace billet::io {

/// The unit systems a case may use; the first is the default.
[[nodiscard]] std::span<const UnitSystem> unit_systems();

/// The value of a text such as "25 mm/s" in the units of `system`.
///
/// A text without a unit, of the wrong dimension or with an unknown unit gives a Failure whose
/// reason completes the sentence "KEY: found "25 mm", ...".
[[nodiscard]] Outcome<double>
converted(std::string_view text, const Quantity& measured, const UnitSystem& system);

/// Factor from numbers in `unit` to lengths of `system`; a Failure as for `converted`.
[[nodiscard]] Outcome<double> length_factor(std::string_view unit, const UnitSystem& system);

} // namespace billet::io
