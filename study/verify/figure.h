// A figure of a verification and its reference.
//
// The reference is a closed form, evaluated by the problem that gives the figure. Only what two
// runs must agree on (restart, invariance) is compared with a run of the program itself.

#pragma once

#include <string>
#include <vector>

namespace billet::study {

/// How a figure is held against its reference.
enum class Criterion {
  relative, ///< |value - reference| <= tolerance |reference|
  absolute, ///< |value - reference| <= tolerance
  at_most,  ///< value <= reference (1 + tolerance): the reference is an upper bound
  at_least, ///< value >= reference (1 - tolerance): the reference is a lower bound
};

/// One line of the table.
struct Figure {
  std::string name; ///< what it is, and where
  std::string unit; ///< of value and reference; "-" for none
  double value = 0.0;
  double reference = 0.0;
  double tolerance = 0.0; ///< relative, or in the figure's unit: see the criterion
  Criterion criterion = Criterion::relative;
  std::string source = {}; ///< of the reference; empty: that of the problem
};

/// A figure that may differ from its reference by a share of it.
[[nodiscard]] Figure
relative(std::string name, std::string unit, double value, double reference, double tolerance);
/// A figure that may differ from its reference by an amount in its unit.
[[nodiscard]] Figure
absolute(std::string name, std::string unit, double value, double reference, double tolerance);
/// A figure that may not be above a bound.
[[nodiscard]] Figure
at_most(std::string name, std::string unit, double value, double bound, double tolerance);
/// A figure that may not be below a bound.
[[nodiscard]] Figure
at_least(std::string name, std::string unit, double value, double bound, double tolerance);

/// Value less reference, over the reference unless the criterion is absolute. Infinite where that
/// has no meaning.
[[nodiscard]] double deviation(const Figure& figure);

/// Whether the figure keeps its criterion; what is not a number does not.
[[nodiscard]] bool within_tolerance(const Figure& figure);

} // namespace billet::study
