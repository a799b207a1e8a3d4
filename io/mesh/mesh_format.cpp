#include "io/mesh/mesh_format.h"

#include "geometry/base/error.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace billet::io {

namespace {

struct Beginning {
  std::string_view text;
  MeshFormat format;
};
constexpr std::array beginnings{
    Beginning{"$MeshFormat", MeshFormat::gmsh}, Beginning{"$Comments", MeshFormat::gmsh},
    Beginning{"$NOD", MeshFormat::gmsh},        Beginning{"*", MeshFormat::abaqus},
    Beginning{"<?xml", MeshFormat::vtu},        Beginning{"<VTKFile", MeshFormat::vtu}};

struct Suffix {
  std::string_view text;
  MeshFormat format;
};
constexpr std::array suffixes{Suffix{".msh", MeshFormat::gmsh}, Suffix{".vtu", MeshFormat::vtu},
                              Suffix{".inp", MeshFormat::abaqus}};

/// By the first characters that are not blank.
std::optional<MeshFormat> format_of(std::string_view text) {
  if (text.starts_with(byte_order_mark))
    text.remove_prefix(byte_order_mark.size());
  text = trimmed(text);
  for (const Beginning& beginning : beginnings)
    if (text.starts_with(beginning.text))
      return beginning.format;
  return std::nullopt;
}

} // namespace

MeshFormat mesh_format(const std::filesystem::path& path) {
  require_readable(path);
  constexpr std::size_t enough = 4096;
  std::array<char, enough> first{};
  std::ifstream stream(path, std::ios::binary);
  stream.read(first.data(), first.size());
  const std::string_view text(first.data(), static_cast<std::size_t>(stream.gcount()));
  if (const std::optional<MeshFormat> format = format_of(text))
    return *format;
  const std::string suffix = in_small_letters(path.extension().string());
  for (const Suffix& known : suffixes)
    if (known.text == suffix)
      return known.format;
  throw Error(Fault::geometry, path.string(),
              fmt::format("meshes with the suffix \"{}\" are not read", suffix),
              "known are .msh (Gmsh), .vtu (VTK) and .inp (Abaqus, CalculiX), and files under any "
              "name that begin as those do",
              error_code::mesh_file);
}

} // namespace billet::io
