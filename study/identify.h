// Coefficients of laws from measured values, by a chart.
//
// Maximum likelihood with normal errors: those of the measurements, and with all measurements at
// once those of the model (mesh and increments) and of what else is uncertain (the flow curve).
// Intervals are those of the profile likelihood (Venzon and Moolgavkar, Appl. Statist. 37 (1988)
// 87). docs/guide/friction-tests.md

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/chart.h"

namespace billet::study {

/// One measured value.
struct Measured {
  std::size_t quantity = 0; ///< of the chart
  double x = 0.0;
  double value = 0.0;
  double standard = 0.0; ///< uncertainty; 0: not known
};

/// Reads a table with the chart's x, its quantities, and for each of these NAME_standard (a
/// standard uncertainty) or NAME_uncertainty (half the width of a 95 % interval), or neither.
/// @throws Error (Fault::case_file) with all complaints
[[nodiscard]] std::vector<Measured> read_measurements(const std::filesystem::path& file,
                                                      const Chart& chart);

/// A parameter as it was found.
struct Found {
  std::string name;
  double value = 0.0;
  double low = 0.0, high = 0.0;          ///< of 95 %
  bool from_end = false, to_end = false; ///< the interval goes on beyond the chart
};

/// A law fitted to measurements.
struct FittedLaw {
  std::string name;
  std::vector<Found> parameters;
  double deviance = 0.0;    ///< -2 ln of the likelihood [-]
  double chi_squared = 0.0; ///< of what is left [-]
  int degrees = 0;          ///< of freedom
  /// Of as much being left by chance [-]; none where uncertainties are not known, or nothing is
  /// left to tell by.
  std::optional<double> p;
};

/// Whether the data prefer a law to another one.
enum class Comparison { preferred, undecided, told_apart };

struct Identification {
  std::vector<FittedLaw> laws;         ///< as in the chart
  std::size_t best = 0;                ///< largest likelihood
  std::vector<Comparison> comparisons; ///< of each law with the best
  std::vector<std::string> warnings;
  std::vector<std::string> advice; ///< on further measurements
};

/// @throws Error (Fault::case_file) if the measurements are too few, or lie outside of the chart
[[nodiscard]] Identification identify(const Chart& chart, const std::vector<Measured>& data);

/// For a person.
[[nodiscard]] std::string in_words(const Identification& found);
/// identification.json
[[nodiscard]] std::string json_text(const Identification& found);

} // namespace billet::study
