// Richardson's extrapolation of a quantity over refinements, and how far off it may be.
//
// phi(h) = phi_0 + alpha h^p, fitted by least squares; the uncertainty after Eca and Hoekstra,
// "A procedure for the estimation of the numerical uncertainty of CFD calculations based on grid
// refinement studies", J. Comput. Phys. 262 (2014) 104.

#pragma once

#include <span>
#include <string>
#include <vector>

namespace billet::study {

struct Extrapolation {
  enum class Range {
    asymptotic,  ///< the order is between 1/2 and 2.1
    too_fast,    ///< the order is above 2: as of first or second order, whichever fits
    too_slow,    ///< the order is below 1/2: as of first or second order or both
    no_monotony, ///< values go up and down: nothing to extrapolate
    constant     ///< all values are the same
  };
  Range range = Range::no_monotony;
  double order = 0.0;              ///< observed, p; 0: none
  double limit = 0.0;              ///< phi_0; without monotony the finest value
  std::vector<double> uncertainty; ///< of each value: the exact one lies so near, as a rule of 95 %
};

/// @param sizes   of what is refined, relative [-]
/// @param values  of the quantity at those sizes, shape (n >= 3)
[[nodiscard]] Extrapolation extrapolate(std::span<const double> sizes,
                                        std::span<const double> values);

/// For a table: "asymptotic", "not in the asymptotic range (order above 2)", ...
[[nodiscard]] std::string in_words(Extrapolation::Range range);

} // namespace billet::study
