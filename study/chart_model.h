// A charted law between the values that were run: monotone cubics along parameters and stations.

#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "study/identify.h"

namespace billet::study {

/// A curve through points that has no extremes but theirs. (Fritsch and Carlson, SIAM J. Numer.
/// Anal. 17 (1980) 238)
/// @param x   increasing
/// @param at  between the first and the last
[[nodiscard]] double
monotone_cubic(std::span<const double> x, std::span<const double> y, double at);

/// What a law says at the places of some measurements.
class ChartModel {
public:
  /// Values of a single parameter whose runs did not reach all places are left out.
  /// @throws Error (Fault::case_file) for a place outside of the chart, or one that too few runs
  ///         reached
  ChartModel(const Chart& chart, const ChartedLaw& law, std::span<const Measured> data);

  [[nodiscard]] std::size_t n_parameters() const { return grids_.size(); }
  [[nodiscard]] double low(std::size_t parameter) const { return grids_[parameter].front(); }
  [[nodiscard]] double high(std::size_t parameter) const { return grids_[parameter].back(); }

  /// Values of the parameter that are left out.
  [[nodiscard]] const std::vector<double>& left_out() const { return left_out_; }

  /// Values at the places. @param parameters  within the chart
  [[nodiscard]] Eigen::VectorXd values(std::span<const double> parameters) const;
  /// F of the covariance F F^T of the model's errors at the places: of the mesh, of what is
  /// uncertain, and of the spacing of the parameters that were run. Shape (n_places, n).
  [[nodiscard]] Eigen::MatrixXd error_factors(std::span<const double> parameters) const;
  /// The smallest and the largest value at a place, over all parameters that were run.
  [[nodiscard]] std::array<double, 2> span(std::size_t place) const;
  /// Those of what is uncertain whose change is not known for all parameters.
  [[nodiscard]] const std::vector<std::size_t>& partly_known() const { return partly_known_; }

private:
  /// A figure at every point of the grid, shape (n_points, n_places).
  using Grid = std::vector<std::vector<double>>;
  void leave_out_unreached();
  /// Takes the nearest that is known of a figure where it is not known itself; zero: none is.
  /// @return whether all were known
  bool fill_unknown(Grid& grid) const;
  /// What may lie between the parameters that were run, told by how far two curves are apart.
  void add_errors_of_spacing();
  [[nodiscard]] Eigen::VectorXd between(const Grid& grid, std::span<const double> parameters) const;

  std::vector<std::vector<double>> grids_; ///< values of each parameter that were run
  Grid values_, errors_;                   ///< of the model, half the width of an interval of 95 %
  std::vector<Grid> changes_;              ///< by what is uncertain
  std::vector<double> left_out_;
  std::vector<std::size_t> partly_known_;
  std::vector<std::size_t> quantities_; ///< of the places
};

} // namespace billet::study
