#include "io/mesh/vtu_guard.h"

#include "geometry/base/error.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace billet::io {

namespace {

/// The file, and what its first element says about the data in it.
struct File {
  std::string_view content;
  std::string_view head; ///< the XML before appended data
  std::string place;
  std::size_t word = 4; ///< bytes of a number in the headers of data
  bool big_endian = false;
  bool compressed = false;

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Fault::geometry, place, message, "the file may be damaged", error_code::mesh_file);
  }
};

/// Value of an attribute among those of an element; empty if it is not there.
std::string_view attribute(std::string_view element, std::string_view name) {
  for (std::size_t at = element.find(name); at != std::string_view::npos;
       at = element.find(name, at + 1)) {
    const std::string_view rest = element.substr(at + name.size());
    const bool is_whole = at > 0 && (element[at - 1] == ' ' || element[at - 1] == '\n');
    if (!is_whole || rest.size() < 3 || rest[0] != '=' || (rest[1] != '"' && rest[1] != '\''))
      continue;
    const std::size_t end = rest.find(rest[1], 2);
    return end == std::string_view::npos ? std::string_view() : rest.substr(2, end - 2);
  }
  return {};
}

File describe(std::string_view content, const std::filesystem::path& path) {
  File file{.content = content,
            .head = content.substr(0, content.find("<AppendedData")),
            .place = path.string()};
  const std::size_t at = content.find("<VTKFile");
  if (at == std::string_view::npos || content.find("UnstructuredGrid") == std::string_view::npos)
    throw Error(Fault::geometry, file.place, "the file is not a VTK UnstructuredGrid",
                "a .vtu file begins with <VTKFile ...>", error_code::mesh_file);
  const std::string_view element = content.substr(at, content.find('>', at) - at);
  file.word = attribute(element, "header_type") == "UInt64" ? 8 : 4;
  file.big_endian = attribute(element, "byte_order") == "BigEndian";
  file.compressed = !attribute(element, "compressor").empty();
  return file;
}

void require_possible_counts(const File& file) {
  // Compression by deflate gains a factor of 1032 at most.
  const double most = 1100.0 * static_cast<double>(file.content.size());
  for (const std::string_view key :
       {"NumberOfPoints=", "NumberOfCells=", "NumberOfTuples=", "NumberOfComponents="})
    for (std::size_t at = file.head.find(key); at != std::string_view::npos;
         at = file.head.find(key, at)) {
      at += key.size();
      const std::string_view rest = file.head.substr(at, 40);
      const char quote = rest.empty() ? ' ' : rest.front();
      const std::size_t end = rest.find(quote, 1);
      double value = 0.0;
      if ((quote != '"' && quote != '\'') || end == std::string_view::npos ||
          !parse_real(trimmed(rest.substr(1, end - 1)), value) || value < 0.0 || value > most)
        file.fail(
            fmt::format("the file says {}{}, which it cannot hold", key, rest.substr(0, end)));
    }
}

void require_known_type(const File& file, std::string_view element) {
  constexpr std::array<std::string_view, 12> known{"Int8",    "UInt8",   "Int16",  "UInt16",
                                                   "Int32",   "UInt32",  "Int64",  "UInt64",
                                                   "Float32", "Float64", "String", "Bit"};
  if (std::find(known.begin(), known.end(), attribute(element, "type")) == known.end())
    file.fail(fmt::format("an array has no known type: {}", element.substr(0, 60)));
}

/// The first `n` bytes of base64; fewer if it ends before.
std::vector<std::uint8_t> decoded(std::string_view text, std::size_t n) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    const std::size_t value = letters.find(c);
    if (value == std::string_view::npos || bytes.size() == n)
      break;
    bits = (bits << 6U) | static_cast<std::uint32_t>(value);
    n_bits += 6;
    if (n_bits >= 8) {
      n_bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(n_bits)));
    }
  }
  return bytes;
}

std::uint64_t number(const File& file, const std::vector<std::uint8_t>& bytes, std::size_t i) {
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < file.word; ++k) {
    const std::size_t at = i * file.word + (file.big_endian ? k : file.word - 1 - k);
    value = (value << 8U) | bytes[at];
  }
  return value;
}

/// The data of an array: text, or the bytes themselves.
struct Data {
  std::string_view content;
  bool base64 = true;

  /// The first `n` bytes; fewer if the data end before.
  [[nodiscard]] std::vector<std::uint8_t> first(std::size_t n) const {
    if (base64)
      return decoded(content, n);
    return {content.begin(),
            content.begin() + static_cast<std::ptrdiff_t>(std::min(n, content.size()))};
  }
};

/// The header of compressed data: number of blocks, size of a block, size of the last one, and the
/// compressed size of each.
void require_sound_header(const File& file, const Data& data) {
  constexpr std::uint64_t largest_block = std::uint64_t{1} << 32U;
  const std::vector<std::uint8_t> bytes = data.first(3 * file.word);
  if (bytes.size() < file.word || number(file, bytes, 0) == 0)
    return; // an empty array; VTK finds it if it should not be
  if (bytes.size() < 3 * file.word)
    file.fail("the data of an array are cut short");
  const std::uint64_t n_blocks = number(file, bytes, 0);
  const std::uint64_t block = number(file, bytes, 1);
  if (n_blocks > file.content.size() || block == 0 || block > largest_block ||
      number(file, bytes, 2) > block)
    file.fail("the header of compressed data makes no sense");
  const std::vector<std::uint8_t> header = data.first((3 + n_blocks) * file.word);
  if (header.size() < (3 + n_blocks) * file.word)
    file.fail("the data of an array are cut short");
  for (std::size_t i = 0; i < n_blocks; ++i)
    if (number(file, header, 3 + i) > file.content.size())
      file.fail("a block of compressed data is larger than the file");
}

/// The data of an array; empty if they are not binary.
Data data_of(const File& file, std::string_view element, std::size_t behind) {
  if (attribute(element, "format") == "binary")
    return {trimmed(file.head.substr(behind, file.head.find('<', behind) - behind))};
  std::int64_t offset = 0;
  if (attribute(element, "format") != "appended" ||
      !parse_integer(attribute(element, "offset"), offset) || offset < 0)
    return {};
  const std::string_view appended = file.content.substr(file.head.size());
  const std::size_t end = appended.find('>');
  const std::size_t mark = end == std::string_view::npos ? end : appended.find('_', end);
  if (mark == std::string_view::npos ||
      static_cast<std::uint64_t>(offset) >= appended.size() - mark - 1)
    file.fail("the data of an array lie behind the end of the file");
  return {appended.substr(mark + 1 + static_cast<std::size_t>(offset)),
          attribute(appended.substr(0, end), "encoding") == "base64"};
}

} // namespace

void require_plausible_vtu(std::string_view content, const std::filesystem::path& path) {
  const File file = describe(content, path);
  require_possible_counts(file);
  for (const std::string_view tag : {"<DataArray", "<Array"})
    for (std::size_t at = file.head.find(tag); at != std::string_view::npos;
         at = file.head.find(tag, at + 1)) {
      const std::size_t end = std::min(file.head.find('>', at), file.head.size() - 1);
      const std::string_view element = file.head.substr(at, end - at);
      require_known_type(file, element);
      if (file.compressed)
        require_sound_header(file, data_of(file, element, end + 1));
    }
}

} // namespace billet::io
