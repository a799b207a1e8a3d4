#include "io/tools/stl.h"

#include "geometry/base/error.h"
#include "io/text/text.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

namespace billet::io {

namespace {

// The binary format: 80 bytes of text, a count, and 50 bytes a facet, little-endian.
constexpr std::size_t header_bytes = 80;
constexpr std::size_t first_facet = header_bytes + 4;
constexpr std::size_t facet_bytes = 50;
static_assert(std::endian::native == std::endian::little);

// Every corner gets a 32-bit number.
constexpr std::size_t most_facets = std::numeric_limits<std::int32_t>::max() / 3;

[[noreturn]] void refuse(const std::string& place, std::string message, std::string remedy = {}) {
  throw Error(Fault::geometry, place, std::move(message), std::move(remedy),
              error_code::surface_file);
}

std::string contents(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw Error(Fault::geometry, path.string(), "there is no such file", "", error_code::file);
  std::ifstream stream(path, std::ios::binary);
  std::string text(std::filesystem::file_size(path, error), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream || error)
    refuse(path.string(), "cannot be read");
  if (text.empty())
    refuse(path.string(), "the file is empty");
  return text;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

void note_normal(FacetFile& file, const Vec3& stated) {
  const std::array<Vec3, 3>& f = file.facets.back();
  if (stated.dot((f[1] - f[0]).cross(f[2] - f[0])) < 0.0)
    ++file.opposed_normals;
}

// --- binary

template <class Number> Number number_at(const std::string& bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Vec3 vector_at(const std::string& bytes, std::size_t offset) {
  return {static_cast<double>(number_at<float>(bytes, offset)),
          static_cast<double>(number_at<float>(bytes, offset + 4)),
          static_cast<double>(number_at<float>(bytes, offset + 8))};
}

std::size_t promised_size(const std::string& bytes) {
  return first_facet + facet_bytes * number_at<std::uint32_t>(bytes, header_bytes);
}

void read_binary(const std::string& bytes, FacetFile& file) {
  const std::string place = file.path.string();
  if (bytes.size() < first_facet)
    refuse(place,
           fmt::format("neither ASCII nor binary STL: {} bytes, a binary file has at least {}",
                       bytes.size(), first_facet));
  const std::size_t promised = number_at<std::uint32_t>(bytes, header_bytes);
  const std::size_t whole = (bytes.size() - first_facet) / facet_bytes;
  if (bytes.size() != promised_size(bytes)) {
    const std::string message =
        fmt::format("the header promises {} facets ({} bytes), the file has {} bytes, enough for "
                    "{}",
                    promised, promised_size(bytes), bytes.size(), whole);
    const std::string remedy = "the file is truncated or not an STL; export it again";
    if (bytes.size() != first_facet + whole * facet_bytes)
      refuse(place, message, remedy);
    file.doubts.push_back({place, message, remedy});
  }
  const std::size_t count = whole;
  file.format = FacetFormat::binary_stl;
  const std::string_view header(bytes.data(), std::min(header_bytes, std::strlen(bytes.c_str())));
  file.solids = {std::string(trimmed(header))};
  file.facets.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = first_facet + i * facet_bytes;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = vector_at(bytes, at + 12 * (k + 1));
      if (!corners[k].allFinite())
        refuse(place,
               fmt::format("corner {} of facet {} is ({}, {}, {}); coordinates must be finite",
                           k + 1, i + 1, corners[k].x(), corners[k].y(), corners[k].z()));
    }
    file.facets.push_back(corners);
    note_normal(file, vector_at(bytes, at));
  }
}

// --- ASCII

// The words of a text with the number of the line each stands on.
class Words {
public:
  Words(std::string_view text, const std::filesystem::path& path) : rest_(text), path_(path) {}

  [[nodiscard]] std::string place() const { return fmt::format("{}:{}", path_.string(), line_); }

  /// The next word, empty at the end of the file.
  std::string_view next() {
    skip_space();
    std::size_t n = 0;
    while (n < rest_.size() && !is_blank(rest_[n]))
      ++n;
    const std::string_view word = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return word;
  }

  /// What is left of this line.
  std::string_view line() {
    const std::size_t n = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view text = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return trimmed(text);
  }

  void expect(std::string_view wanted) {
    const std::string_view word = next();
    if (!same_word(word, wanted))
      refuse(place(), word.empty()
                          ? fmt::format("the file ends where '{}' is expected", wanted)
                          : fmt::format("found '{}' where '{}' is expected", word, wanted));
  }

  double number() {
    const std::string_view word = next();
    const bool plus = word.starts_with('+'); // legal here, unknown to from_chars
    double value = 0.0;
    const char* end = word.data() + word.size();
    const auto [last, error] = std::from_chars(word.data() + (plus ? 1 : 0), end, value);
    if (word.empty())
      refuse(place(), "the file ends where a number is expected");
    if (error != std::errc() || last != end || !std::isfinite(value))
      refuse(place(), fmt::format("found '{}' where a finite number is expected", word));
    return value;
  }

  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

private:
  void skip_space() {
    std::size_t n = 0;
    for (; n < rest_.size() && is_blank(rest_[n]); ++n)
      line_ += rest_[n] == '\n' ? 1 : 0;
    rest_.remove_prefix(n);
  }

  std::string_view rest_;
  const std::filesystem::path& path_;
  std::int64_t line_ = 1;
};

// The stated normal is a comment: the order of the corners decides. Some writers leave "nan" or
// words there for facets without area, so it may be anything.
Vec3 stated_normal(std::string_view text) {
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    text = trimmed(text);
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), normal[i]);
    if (error != std::errc())
      return Vec3::Zero();
    text.remove_prefix(static_cast<std::size_t>(last - text.data()));
  }
  return normal.allFinite() ? normal : Vec3::Zero();
}

void read_facet(Words& words, FacetFile& file) {
  words.expect("normal");
  const Vec3 normal = stated_normal(words.line());
  words.expect("outer");
  words.expect("loop");
  std::array<Vec3, 3> corners;
  for (Vec3& corner : corners) {
    words.expect("vertex");
    corner = words.vector();
  }
  words.expect("endloop");
  words.expect("endfacet");
  file.facets.push_back(corners);
  note_normal(file, normal);
}

void read_ascii(std::string_view text, FacetFile& file) {
  Words words(text, file.path);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (!same_word(word, "solid"))
      refuse(words.place(), fmt::format("found '{}' where 'solid' is expected", word));
    const std::string_view name = words.line();
    file.solids.emplace_back(name);
    for (word = words.next(); same_word(word, "facet"); word = words.next())
      read_facet(words, file);
    if (word.empty()) {
      file.doubts.push_back(
          {words.place(),
           fmt::format("the file ends within solid '{}', after facet {}", name, file.facets.size()),
           "the file is truncated; if it is whole, add a line 'endsolid'"});
      return;
    }
    if (!same_word(word, "endsolid"))
      refuse(words.place(),
             fmt::format("found '{}' where 'facet' or 'endsolid' is expected", word));
    words.line();
  }
}

bool is_ascii(const std::string& bytes) {
  // A binary file may start with "solid" too, but its size tells what its header promises.
  if (bytes.size() >= first_facet && bytes.size() == promised_size(bytes))
    return false;
  const std::string_view start = trimmed(std::string_view(bytes).substr(0, 1024));
  return same_word(start.substr(0, 5), "solid") && start.find('\0') == std::string_view::npos;
}

void put(std::string& bytes, const Vec3& v) {
  for (int i = 0; i < 3; ++i) {
    const auto value = static_cast<float>(v[i]);
    bytes.append(std::bit_cast<std::array<char, 4>>(value).data(), 4);
  }
}

} // namespace

FacetFile read_stl(const std::filesystem::path& path) {
  FacetFile file;
  file.path = path;
  std::string bytes = contents(path);
  if (bytes.starts_with(byte_order_mark))
    bytes.erase(0, byte_order_mark.size());
  if (is_ascii(bytes))
    read_ascii(bytes, file);
  else
    read_binary(bytes, file);
  if (file.facets.empty())
    refuse(path.string(), "the file has no facets");
  if (file.facets.size() > most_facets)
    refuse(path.string(),
           fmt::format("{} facets; at most {} can be used", file.facets.size(), most_facets));
  return file;
}

void write_stl(const std::filesystem::path& path,
               const geometry::TriangleMesh& mesh,
               const std::string& header) {
  std::string bytes = header.substr(0, header_bytes);
  bytes.resize(header_bytes, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  bytes.append(std::bit_cast<std::array<char, 4>>(count).data(), 4);
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = mesh.points[static_cast<std::size_t>(t[k])];
    put(bytes, (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized());
    for (const Vec3& corner : corners)
      put(bytes, corner);
    bytes.append(2, '\0');
  }
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream)
    throw Error(Fault::input_output, path.string(), "cannot be written");
}

} // namespace billet::io
