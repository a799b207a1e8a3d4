// A quantity of interest: one number of a run, read off its tables.

#pragma once

#include "io/text/csv_table.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace billet::study {

/// What is read off the results of a run.
struct Quantity {
  /// Of the values that `of` takes over the run.
  enum class Take { end, at, largest, smallest, mean };

  std::string name = {};
  std::string of = {};       ///< an expression of columns of history.csv and of summary.json
  std::string over = "time"; ///< the same: what `at`, `from` and `to` are values of
  Take take = Take::end;
  std::optional<double> at = {};            ///< of `over`
  std::optional<double> from = {}, to = {}; ///< of `over`; none: the whole run
  std::optional<double> scale = {};         ///< of errors; none: the reference's value
  std::string expression = {};              ///< of quantities before, in place of `of`; or empty
};

/// Results of a run as quantities see them.
class Results {
public:
  /// @throws Error (Fault::input_output) if history.csv or summary.json is not there
  explicit Results(const std::filesystem::path& folder);

  /// Values of an expression, shape (n_increments): columns by their names, numbers of summary.json
  /// as `summary.energy.plastic_work`.
  /// @throws Error (Fault::case_file) for a name that is neither
  [[nodiscard]] std::vector<double> values(const std::string& expression) const;

  /// A number of summary.json; none: it is not there.
  [[nodiscard]] std::optional<double> summary(const std::string& path) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
  std::filesystem::path folder_;
  io::CsvTable history_;
  std::map<std::string, double> summary_; ///< numbers by their path
};

/// A curve between points, straight from one to the next.
/// @param x  not decreasing, or not increasing, where the curve is asked
/// @return none: x does not reach there
[[nodiscard]] std::optional<double>
curve_at(std::span<const double> x, std::span<const double> y, double at);

/// Mean of a curve over a window of x, its ends included where the curve reaches them; not a number
/// where it has no point there.
[[nodiscard]] double
mean_between(std::span<const double> x, std::span<const double> y, double from, double to);

/// The value of a quantity.
/// @param before  quantities that its expression may name
/// @throws Error (Fault::case_file) with what cannot be read off
[[nodiscard]] double evaluate(const Quantity& quantity,
                              const Results& results,
                              const std::map<std::string, double>& before);

} // namespace billet::study
