// The lines of a deck as keywords and their data, what is included in its place.

#pragma once

#include "io/mesh/included_lines.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// A keyword with its parameters and data lines.
struct DeckKeyword {
  std::string name;    ///< in capitals, without the star and without blanks: "SOLIDSECTION"
  std::string written; ///< as it stands in the deck, without the star: "Solid Section"
  std::map<std::string, std::string> parameters; ///< names in capitals, without blanks
  std::vector<std::vector<std::string>> data;    ///< fields of each line, trimmed
  std::vector<std::string> places;               ///< of the data lines
  std::string place;                             ///< "job.inp:12"

  [[nodiscard]] bool has(const char* parameter) const { return parameters.contains(parameter); }
  /// The value of a parameter; empty: it is not given.
  [[nodiscard]] std::string value(const char* parameter) const;
  /// The same in capitals and without blanks: "JOHNSONCOOK".
  [[nodiscard]] std::string word(const char* parameter) const;
  /// A field of a data line; empty: there is none.
  [[nodiscard]] std::string field(std::size_t line, std::size_t i) const;
  /// A number in a field; none: it is empty.
  /// @throws Error (Fault::geometry) if it is no number
  [[nodiscard]] std::optional<double> number(std::size_t line, std::size_t i) const;
  /// @throws Error (Fault::geometry) if the field is no whole number
  [[nodiscard]] std::int64_t whole(std::size_t line, std::size_t i) const;
};

class DeckLines {
public:
  DeckLines(const std::filesystem::path& file, const IncludeBounds& bounds)
      : lines_(file, bounds) {}

  /// The next keyword with its data; none at the end.
  [[nodiscard]] std::optional<DeckKeyword> next();

private:
  bool next_line();
  DeckKeyword keyword_of_line();

  IncludedLines lines_;
  bool has_line_ = false; ///< one that is read and not used yet
};

} // namespace billet::io
