#include "tests/geometry/sample_meshes.h"
#include "tests/io/stl_zoo.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cctype>
#include <limits>

namespace billet::io {

namespace {

using geometry::cube;
using geometry::TriangleMesh;

constexpr std::size_t facets_at = 84, facet_size = 50;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::size_t any(Random& random, std::size_t low, std::size_t high) {
  return std::uniform_int_distribution<std::size_t>(low, high)(random);
}

template <class Value> void put(std::string& bytes, std::size_t at, Value value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

std::string good_ascii(Random& random) { return ascii_stl(posed(cube(), random)); }
std::string good_binary(Random& random) { return binary_stl(posed(cube(), random)); }

std::string with_count(std::string bytes, std::uint32_t count) {
  put(bytes, facets_at - 4, count);
  return bytes;
}

// A number of a random facet: the normal for number 0 to 2, then the corners.
std::string with_number(std::string bytes, Random& random, std::size_t first, float value) {
  const std::size_t facet = any(random, 0, (bytes.size() - facets_at) / facet_size - 1);
  put(bytes, facets_at + facet_size * facet + 4 * any(random, first, first == 0 ? 2 : 11), value);
  return bytes;
}

std::string with_normals(std::string bytes, float value) {
  for (std::size_t at = facets_at; at < bytes.size(); at += facet_size)
    for (std::size_t i = 0; i < 3; ++i)
      put(bytes, at + 4 * i, value);
  return bytes;
}

std::string with_turned_normal(std::string bytes) {
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<char, 4> raw{};
    std::copy_n(bytes.begin() + facets_at + 4 * static_cast<std::ptrdiff_t>(i), 4, raw.begin());
    put(bytes, facets_at + 4 * i, -std::bit_cast<float>(raw));
  }
  return bytes;
}

std::string coloured(std::string bytes, Random& random) {
  for (std::size_t at = facets_at + 48; at < bytes.size(); at += facet_size)
    put(bytes, at, static_cast<std::uint16_t>(any(random, 0, 65535)));
  return bytes;
}

std::string noise(Random& random, std::size_t size, char low, char high) {
  std::string bytes(size, ' ');
  for (char& c : bytes)
    c = static_cast<char>(
        any(random, static_cast<unsigned char>(low), static_cast<unsigned char>(high)));
  return bytes;
}

std::string cut_in_a_facet(std::string bytes, Random& random) {
  const std::size_t facet = any(random, 0, (bytes.size() - facets_at) / facet_size - 1);
  bytes.resize(facets_at + facet_size * facet + any(random, 1, facet_size - 1));
  return bytes;
}

std::string cut_between_facets(std::string bytes, Random& random) {
  bytes.resize(facets_at +
               facet_size * any(random, 1, (bytes.size() - facets_at) / facet_size - 1));
  return bytes;
}

std::string cut_anywhere(std::string text, Random& random) {
  text.resize(any(random, text.find("facet"), text.rfind("endfacet")));
  return text;
}

std::vector<ZooKind> good_files() {
  const auto solids = [](Random& random) {
    const TriangleMesh mesh = posed(cube(), random);
    return ascii_stl(mesh, 9, "first") + ascii_stl(moved(mesh, {500, 0, 0}), 9, "facet normal 2");
  };
  const auto minus_zero = [](Random&) {
    return replaced(ascii_stl(cube()), "vertex 0", "vertex -0.0");
  };
  return {
      {"ascii", Verdict::sound, "ASCII", good_ascii, true},
      {"ascii_crlf", Verdict::sound, "",
       [](Random& r) { return replaced(good_ascii(r), "\n", "\r\n"); }, true},
      {"ascii_cr", Verdict::sound, "",
       [](Random& r) { return replaced(good_ascii(r), "\n", "\r"); }, true},
      {"ascii_upper_case", Verdict::sound, "", [](Random& r) { return upper(good_ascii(r)); },
       true},
      {"ascii_byte_order_mark", Verdict::sound, "",
       [](Random& r) { return "\xEF\xBB\xBF" + good_ascii(r); }, true},
      {"ascii_tabs_and_blank_lines", Verdict::sound, "",
       [](Random& r) { return "\n\n" + replaced(good_ascii(r), " vertex", "\n\t\tvertex\t"); },
       true},
      {"ascii_several_solids", Verdict::sound, "2 parts", solids, true},
      {"ascii_minus_zero", Verdict::sound, "", minus_zero, true},
      {"ascii_four_digits", Verdict::sound, "",
       [](Random& r) { return ascii_stl(posed(cube(), r), 4); }, true},
      {"ascii_normals_of_words", Verdict::sound, "",
       [](Random& r) { return replaced(good_ascii(r), "normal 0 0 0", "normal nan -nan(ind) x"); },
       true},
      {"binary", Verdict::sound, "binary", good_binary, true},
      {"binary_that_begins_with_solid", Verdict::sound, "binary",
       [](Random& r) { return binary_stl(posed(cube(), r), "solid made by a scanner"); }, true},
      {"binary_with_colours", Verdict::sound, "",
       [](Random& r) { return coloured(good_binary(r), r); }, true},
      {"binary_with_a_coloured_header", Verdict::sound, "",
       [](Random& r) {
         return coloured(binary_stl(posed(cube(), r), "COLOR=\x01\x02\x03\xFF"), r);
       },
       true},
      {"binary_normals_zero", Verdict::sound, "",
       [](Random& r) { return with_normals(good_binary(r), 0.0F); }, true},
      {"binary_normals_nan", Verdict::sound, "",
       [](Random& r) {
         return with_normals(good_binary(r), std::numeric_limits<float>::quiet_NaN());
       },
       true},
      {"binary_of_many_facets", Verdict::sound, "",
       [](Random& r) { return binary_stl(posed(geometry::sphere_mesh(80), r)); }, true},
  };
}

std::vector<ZooKind> forgiven_files() {
  return {
      {"ascii_without_endsolid", Verdict::noted, "nothing is missing",
       [](Random& r) { return replaced(good_ascii(r), "endsolid zoo\n", ""); }, true},
      {"binary_count_too_large", Verdict::noted, "promises 13 facets",
       [](Random& r) { return with_count(good_binary(r), 13); }, true},
      {"binary_count_too_small", Verdict::noted, "promises 7 facets",
       [](Random& r) { return with_count(good_binary(r), 7); }, true},
      {"binary_count_zero", Verdict::noted, "promises 0 facets",
       [](Random& r) { return with_count(good_binary(r), 0); }, true},
      {"binary_count_all_ones", Verdict::noted, "promises 4294967295 facets",
       [](Random& r) { return with_count(good_binary(r), 0xFFFFFFFFU); }, true},
      {"binary_stated_normal_turned", Verdict::noted, "1 stated normals",
       [](Random& r) { return with_turned_normal(good_binary(r)); }, true},
  };
}

std::vector<ZooKind> hopeless_files() {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto text = [](std::string bytes) { return [bytes](Random&) { return bytes; }; };
  const auto edited = [](const std::string& what, const std::string& by) {
    return [=](Random& r) {
      std::string bytes = good_ascii(r);
      const std::size_t at = bytes.find(what, any(r, 0, bytes.size() / 2));
      return bytes.replace(at, what.size(), by);
    };
  };
  const auto open_sheet = [](Random& r) {
    return binary_stl(posed(geometry::sheet(3, [](double x, double) { return x * x; }), r));
  };
  return {
      {"empty", Verdict::refused, "empty", text("")},
      {"one_byte", Verdict::refused, "neither", text("s")},
      {"binary_header_only", Verdict::refused, "neither", text(std::string(80, ' '))},
      {"binary_of_no_facets", Verdict::refused, "no facets", text(std::string(84, '\0'))},
      {"ascii_of_no_facets", Verdict::refused, "no facets", text("solid a\nendsolid a\n")},
      {"binary_cut_in_a_facet", Verdict::refused, "promises 12 facets",
       [](Random& r) { return cut_in_a_facet(good_binary(r), r); }},
      {"binary_cut_between_facets", Verdict::refused, "promises 12 facets",
       [](Random& r) { return cut_between_facets(good_binary(r), r); }},
      {"binary_open_of_wrong_count", Verdict::refused, "promises 0 facets",
       [=](Random& r) { return with_count(open_sheet(r), 0); }},
      {"binary_followed_by_text", Verdict::refused, "promises 12 facets",
       [](Random& r) { return good_binary(r) + "end of file"; }},
      {"ascii_cut_anywhere", Verdict::refused, "",
       [](Random& r) { return cut_anywhere(good_ascii(r), r) + "\n"; }},
      {"ascii_followed_by_text", Verdict::refused, "where 'solid' is expected",
       [](Random& r) { return good_ascii(r) + "rubbish\n"; }},
      {"noise", Verdict::refused, "",
       [](Random& r) { return noise(r, any(r, 1, 4000), '\0', '\xFF'); }},
      {"noise_of_letters", Verdict::refused, "",
       [](Random& r) { return "solid " + noise(r, any(r, 1, 4000), ' ', '~'); }},
      {"binary_at_nan", Verdict::refused, "must be finite",
       [](Random& r) { return with_number(good_binary(r), r, 3, nan); }},
      {"binary_at_infinity", Verdict::refused, "must be finite",
       [](Random& r) { return with_number(good_binary(r), r, 3, infinite); }},
      {"ascii_at_nan", Verdict::refused, "where a finite number", edited("vertex ", "vertex nan ")},
      {"ascii_beyond_doubles", Verdict::refused, "where a finite number",
       edited("vertex ", "vertex 1e999 ")},
      {"ascii_decimal_commas", Verdict::refused, "where a finite number", edited(".", ",")},
      {"ascii_misspelt", Verdict::refused, "found 'vertx'", edited("vertex", "vertx")},
      {"ascii_four_corners", Verdict::refused, "where 'endloop' is expected",
       edited("endloop", "vertex 0 0 0\nendloop")},
      {"ascii_two_corners_only", Verdict::refused, "where 'vertex' is expected",
       edited("vertex", "endloop vertex")},
  };
}

} // namespace

std::vector<ZooKind> zoo_of_files() {
  std::vector<ZooKind> all = good_files();
  for (const auto& more : {forgiven_files(), hopeless_files()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

} // namespace billet::io
