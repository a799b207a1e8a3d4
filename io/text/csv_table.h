// Tables in text, one row per line, cells between commas: history.csv, measured values of a user.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// A header row and what stands below it. Cells may be in double quotes; lines that begin with #
/// are comments.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows; ///< each as long as columns; "" where nothing is

  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;
  /// The numbers of a column, shape (n_rows); not a number where a cell holds none.
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
};

/// @throws Error (Fault::input_output) for a file that cannot be read or has no header, and for a
/// line
///         with more cells than the header has
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& file);

/// A cell of a table: in quotes where its text needs them.
[[nodiscard]] std::string csv_cell(std::string_view text);

} // namespace billet::io
