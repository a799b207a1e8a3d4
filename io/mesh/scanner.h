// Reads words, numbers and bytes from the content of a file, and knows the line for complaints.
//
// Every failure is an `Error` (Fault::geometry) at "file:line", or at "file" with the byte once
// bytes were read. Numbers that are not finite are failures.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace billet::io {

/// @throws Error  (Fault::geometry) if there is no such file, or if it is none that can be read
void require_readable(const std::filesystem::path& path);

/// The whole content of a regular file.
/// @throws Error  (Fault::geometry) if it cannot be read
[[nodiscard]] std::string read_content(const std::filesystem::path& path);

/// A number written in text; Fortran's exponent D is understood.
/// False if the text as a whole is not a finite number.
[[nodiscard]] bool parse_real(std::string_view text, double& value);
[[nodiscard]] bool parse_integer(std::string_view text, std::int64_t& value);

/// A place in a text that moves forward only.
class Scanner {
public:
  explicit Scanner(const std::filesystem::path& path);

  [[nodiscard]] bool at_end() const { return at_ >= content_.size(); }
  [[nodiscard]] std::size_t remaining() const { return content_.size() - at_; }

  /// Next word between blanks, over line ends.
  std::string_view word();
  /// The rest of the line, without its end.
  std::string_view line();
  double real();
  std::int64_t integer();
  /// A number of items of which each takes at least `least_bytes` of the rest of the file.
  std::size_t count(const char* what, std::size_t least_bytes);
  /// Fails if there cannot be `n` items of at least `least_bytes` in the rest of the file.
  void require_room(std::uint64_t n, const char* what, std::size_t least_bytes) const;

  /// Bytes as they stand in memory; `swapped`: of a machine of the other byte order.
  template <class Number> Number raw(bool swapped) {
    Number value{};
    copy_bytes(reinterpret_cast<unsigned char*>(&value), sizeof(Number), swapped);
    return value;
  }

  [[nodiscard]] const std::string& file() const { return file_; }
  /// Number of the line at which the last word or line began, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_; }
  [[noreturn]] void fail(const std::string& message, const std::string& remedy = {}) const;

private:
  void copy_bytes(unsigned char* to, std::size_t n, bool swapped);
  void skip_blanks();

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;      ///< of the last item
  std::size_t next_line_ = 1; ///< at `at_`
  bool binary_ = false;
};

} // namespace billet::io
