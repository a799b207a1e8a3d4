// A polynomial through scattered points, weighted towards the place where it is wanted.
//
// Moving least squares with a complete quadratic, or a linear polynomial where the points do not
// determine it. Values are bounded by those nearby, the tighter the less the polynomial explains
// them. Theory: docs/theory/mechanics.md (M.34)-(M.36).

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::mechanics {

/// The points that a fit uses and what it makes of values given there. Reused from place to place.
class LocalFit {
public:
  /// @param dim  2 or 3
  explicit LocalFit(int dim) : dim_(dim) {}

  /// Candidates that suffice.
  [[nodiscard]] static std::size_t enough(int dim) { return dim == 2 ? 18 : 36; }

  /// Chooses the points around a place.
  ///
  /// @param candidates  numbers of points, ascending; at least one
  /// @param positions   of all points [mm]
  void set(const Vec3& place, std::span<const Index> candidates, std::span<const Vec3> positions);

  /// Weighs the points and fits; without it `evaluate` gives the value of the nearest one.
  void weigh();

  [[nodiscard]] Index nearest() const { return near_.front().point; }
  /// True when the nearest point lies in the place itself.
  [[nodiscard]] bool coincides() const { return coincides_; }

  /// Value at the place of a quantity of out.size() <= 6 components.
  ///
  /// @param values  component c of point p is values[p * stride + c]
  /// @return whether the bounds acted
  bool evaluate(std::span<const double> values, std::size_t stride, std::span<double> out) const;

private:
  static constexpr std::size_t max_terms = 10;
  struct Near {
    double distance2; ///< in the metric of the surroundings [-]
    Index point;
    Vec3 offset; ///< from the place, in the same metric [-]
  };

  /// Offsets in the metric in which the candidates scatter alike in all directions; false when
  /// they lie in a plane or on a line.
  bool
  measure(const Vec3& place, std::span<const Index> candidates, std::span<const Vec3> positions);
  /// Terms of the polynomial at the points, times the roots of the weights.
  void write_terms();
  /// Orthonormal terms from them; those that depend on the ones before are left out.
  void orthogonalise();
  [[nodiscard]] std::size_t linear_terms() const { return static_cast<std::size_t>(dim_) + 1; }
  /// Share of the scatter of values at the points that the polynomial leaves, 0 to 1.
  [[nodiscard]] double unexplained(std::span<const double> values, std::size_t terms) const;
  /// The part of what the fit adds along a direction that the values along it allow. (M.36)
  [[nodiscard]] double
  bound(std::span<const double> along, double wanted, double rounding, bool& limited) const;

  int dim_;
  bool spread_ = false; ///< whether the candidates span the space
  bool coincides_ = false;
  double radius_ = 0.0;       ///< within which points are used, in the metric
  std::vector<Near> near_;    ///< the nearest first, then all within the radius
  std::size_t n_inner_ = 0;   ///< the first ones, whose values bound the result
  std::size_t n_terms_ = 0;   ///< of the polynomial; 1: the value of the nearest point
  std::vector<double> root_;  ///< square roots of the weights
  std::vector<double> basis_; ///< orthonormal polynomials at the points, shape (terms, points)
  std::array<double, max_terms> at_place_{}; ///< their values at the place
  std::vector<double> influence_;            ///< d value / d value of each point
  mutable std::vector<double> along_;
};

} // namespace billet::mechanics
