#include "io/mesh/scanner.h"

#include "geometry/base/error.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

namespace billet::io {

namespace {

/// What was found, short enough for a message and without unprintable characters.
std::string shown(std::string_view text) {
  std::string clean(text.substr(0, 40));
  std::replace_if(
      clean.begin(), clean.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return clean;
}

template <class Number> bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-')
    text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

} // namespace

void require_readable(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw Error(Fault::geometry, path.string(), "the mesh file does not exist", "",
                error_code::file);
  if (!std::filesystem::is_regular_file(status))
    throw Error(Fault::geometry, path.string(), "the mesh is not a file but a folder or device", "",
                error_code::file);
}

std::string read_content(const std::filesystem::path& path) {
  require_readable(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string content(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad())
    throw Error(Fault::geometry, path.string(),
                fmt::format("the mesh file cannot be read: {}", std::strerror(errno)), "",
                error_code::mesh_file);
  return content;
}

bool parse_real(std::string_view text, double& value) {
  if (parse_whole(text, value))
    return std::isfinite(value);
  std::string with_e(text.substr(0, 100));
  std::replace_if(
      with_e.begin(), with_e.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  return parse_whole(std::string_view(with_e), value) && std::isfinite(value);
}

bool parse_integer(std::string_view text, std::int64_t& value) { return parse_whole(text, value); }

Scanner::Scanner(const std::filesystem::path& path)
    : file_(path.string()), content_(read_content(path)) {}

void Scanner::skip_blanks() {
  for (; at_ < content_.size() && is_blank(content_[at_]); ++at_)
    if (content_[at_] == '\n')
      ++next_line_;
}

std::string_view Scanner::word() {
  skip_blanks();
  line_ = next_line_;
  const std::size_t first = at_;
  while (at_ < content_.size() && !is_blank(content_[at_]))
    ++at_;
  return std::string_view(content_).substr(first, at_ - first);
}

std::string_view Scanner::line() {
  line_ = next_line_;
  const std::size_t first = at_;
  const std::size_t end = std::min(content_.find('\n', at_), content_.size());
  at_ = std::min(end + 1, content_.size());
  ++next_line_;
  return trimmed(std::string_view(content_).substr(first, end - first));
}

double Scanner::real() {
  const std::string_view text = word();
  double value = 0.0;
  if (text.empty())
    fail("the file ends where a number is expected");
  if (!parse_real(text, value))
    fail(fmt::format("\"{}\" is not a finite number", shown(text)));
  return value;
}

std::int64_t Scanner::integer() {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (text.empty())
    fail("the file ends where a whole number is expected");
  if (!parse_integer(text, value))
    fail(fmt::format("\"{}\" is not a whole number", shown(text)));
  return value;
}

std::size_t Scanner::count(const char* what, std::size_t least_bytes) {
  const std::int64_t n = integer();
  if (n < 0)
    fail(fmt::format("{} {} are announced", n, what));
  require_room(static_cast<std::uint64_t>(n), what, least_bytes);
  return static_cast<std::size_t>(n);
}

void Scanner::require_room(std::uint64_t n, const char* what, std::size_t least_bytes) const {
  if (n > remaining() / least_bytes + 1)
    fail(fmt::format("{} {} are announced, but only {} bytes follow", n, what, remaining()),
         "the file may have been cut short");
}

void Scanner::copy_bytes(unsigned char* to, std::size_t n, bool swapped) {
  binary_ = true;
  if (remaining() < n)
    fail("the file ends in the middle of its data", "the file may have been cut short");
  std::memcpy(to, content_.data() + at_, n);
  at_ += n;
  if (swapped)
    std::reverse(to, to + n);
}

void Scanner::fail(const std::string& message, const std::string& remedy) const {
  if (binary_)
    throw Error(Fault::geometry, file_, fmt::format("{} (near byte {})", message, at_), remedy,
                error_code::mesh_file);
  throw Error(Fault::geometry, fmt::format("{}:{}", file_, line_), message, remedy,
              error_code::mesh_file);
}

} // namespace billet::io
