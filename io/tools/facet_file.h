// What a file of triangles holds, as it stands there.

#pragma once

#include "geometry/base/error.h"
#include "geometry/base/vector.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

enum class FacetFormat { ascii_stl, binary_stl, step };

/// In words: "binary STL".
[[nodiscard]] constexpr std::string_view name(FacetFormat format) {
  switch (format) {
  case FacetFormat::ascii_stl:
    return "ASCII STL";
  case FacetFormat::binary_stl:
    return "binary STL";
  case FacetFormat::step:
    return "STEP";
  }
  return "";
}

struct FacetFile {
  std::filesystem::path path;
  FacetFormat format = FacetFormat::ascii_stl;
  std::vector<std::string> solids;         ///< names, in order; binary STL: the header text
  std::vector<std::array<Vec3, 3>> facets; ///< corners, file units; STEP: mm
  std::int64_t opposed_normals = 0;        ///< facets whose stated normal contradicts their corners
  std::vector<Complaint> doubts;           ///< why the file may be truncated
};

} // namespace billet::io
