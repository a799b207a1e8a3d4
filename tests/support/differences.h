// Derivatives against central differences, over several decades of the step.
//
// A right derivative has one decade in which truncation and rounding are both small; a wrong one
// has none. Hence the best error over all steps is what counts.

#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace billet::support {

/// Smallest relative error of `derivative` against (f(h) - f(-h)) / 2h, h = 1e-2 ... 1e-8 times
/// `scale`.
///
/// @param f      vector function of the step along one direction
/// @param floor  size below which differences do not count
template <class Function>
double best_difference_error(const Function& f,
                             const Eigen::VectorXd& derivative,
                             double scale,
                             double floor = 0.0) {
  double best = std::numeric_limits<double>::infinity();
  for (double h = 1e-2 * scale; h > 0.5e-8 * scale; h *= 0.1) {
    const Eigen::VectorXd difference = (f(h) - f(-h)) / (2.0 * h);
    if (!difference.allFinite())
      continue;
    const double size = std::max({difference.norm(), derivative.norm(), floor});
    const double error = (difference - derivative).norm();
    best = std::min(best, size > 0.0 ? error / size : error);
  }
  return best;
}

} // namespace billet::support
