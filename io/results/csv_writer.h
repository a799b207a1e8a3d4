// A table of numbers that grows by whole rows: history.csv, iterations.csv.
//
// Values have 17 significant digits, so reading them gives the same bits. Each row is handed to the
// system at once: a killed run leaves only whole rows.

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace billet::io {

/// Writes a header row, then one row at a time.
class CsvWriter {
public:
  /// Starts the table anew.
  /// @throws Error  (Fault::input_output)
  CsvWriter(std::filesystem::path path, const std::vector<std::string>& columns);

  /// Goes on with a table after a checkpoint: keeps its first `rows` rows, drops the rest.
  /// @throws Error  (Fault::input_output) if the table is not there, has other columns or fewer
  /// rows
  [[nodiscard]] static CsvWriter
  resume(std::filesystem::path path, const std::vector<std::string>& columns, std::size_t rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&& other) noexcept;
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  ~CsvWriter();

  /// Appends a row and hands it to the system.
  /// @throws Error  (Fault::input_output), e.g. on a full disk; the rows before it stay whole
  /// @pre values.size() is the number of columns
  void row(std::span<const double> values);

private:
  CsvWriter(std::filesystem::path path, std::size_t columns, int file);

  std::filesystem::path path_;
  std::size_t columns_ = 0;
  int file_ = -1;
};

} // namespace billet::io
