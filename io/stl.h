// STL files: triangles without units, ASCII or binary.
//
// `read_stl` tells the two kinds apart by content, not by the word "solid" (many binary files start
// with it), and reports every damage with its place. `tool_mesh` turns the triangles into a surface
// fit for a tool, or says at which coordinates it is not one.
//
// Units   an STL has none: the caller gives the factor to the units of the case.

#pragma once

#include "geometry/base/error.h"
#include "geometry/base/vector.h"
#include "geometry/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {

/// What an STL file holds, as it stands there.
struct StlFile {
  std::filesystem::path path;
  bool binary = false;
  std::vector<std::string> solids;         ///< names, in order; binary: the header text
  std::vector<std::array<Vec3, 3>> facets; ///< corners, file units
  std::int64_t opposed_normals = 0;        ///< facets whose stated normal contradicts their corners
  std::vector<Complaint> doubts;           ///< why the file may be truncated
};

/// @throws Error(Fault::geometry) naming file and line (ASCII) or facet (binary)
[[nodiscard]] StlFile read_stl(const std::filesystem::path& path);

/// Writes a binary STL; coordinates are rounded to single precision.
///
/// @throws Error(Fault::input_output)
void write_stl(const std::filesystem::path& path,
               const geometry::TriangleMesh& mesh,
               const std::string& header = "billet");

} // namespace billet::io
