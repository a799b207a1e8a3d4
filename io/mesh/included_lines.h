// The lines of an input file, those of the files it includes in their places.
//
// Files are not trusted: what may be included lies in certain folders, how deep, how often and how
// much is bounded, and none includes itself. Failures are `Error`s (Fault::geometry) at "file:line"
// of the file that the line stands in.

#pragma once

#include "io/mesh/scanner.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// Where included files may be, in addition to the folder of the file that is read.
struct IncludeBounds {
  std::filesystem::path folder = {}; ///< or below; empty: nowhere else
  bool anywhere = false;
};

class IncludedLines {
public:
  /// Before the first line of a file.
  IncludedLines(const std::filesystem::path& file, IncludeBounds bounds);

  /// Moves to the next line; false at the end of the first file.
  bool next();
  /// The line without blanks at its ends.
  [[nodiscard]] std::string_view line() const { return line_; }

  /// Goes on with the lines of another file, and with those after this one at its end.
  ///
  /// @param name  relative to the folder of the first file; a backslash parts folders as well
  void include(std::string_view name);

  /// "file:line" of the last line.
  [[nodiscard]] std::string place() const;
  /// The same for a note on the first file: "line 7" or "included.inp:7".
  [[nodiscard]] std::string place_in_note() const;
  [[noreturn]] void fail(const std::string& message, const std::string& remedy = {}) const;

private:
  struct Source {
    Scanner scanner;
    std::filesystem::path real; ///< links followed
  };

  void require_allowed(const std::filesystem::path& path, std::string_view name) const;
  void require_budget(const std::filesystem::path& path);

  IncludeBounds bounds_;
  std::filesystem::path folder_; ///< of the first file
  std::vector<Source> sources_;  ///< the first file, the one it includes, ...
  std::string line_;
  std::size_t n_included_ = 0;
  std::uintmax_t n_bytes_ = 0; ///< of all included files
};

} // namespace billet::io
