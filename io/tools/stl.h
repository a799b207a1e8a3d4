// STL files: triangles without units, ASCII or binary.
//
// `read_stl` tells the two kinds apart by content, not by the word "solid" (many binary files start
// with it), and reports every damage with its place. `tool_mesh` turns the triangles into a surface
// fit for a tool, or says at which coordinates it is not one.
//
// Units   an STL has none: the caller gives the factor to the units of the case.

#pragma once

#include "geometry/triangles/triangle_mesh.h"
#include "io/tools/facet_file.h"

#include <filesystem>
#include <string>

namespace billet::io {

/// @throws Error(Fault::geometry) naming file and line (ASCII) or facet (binary)
[[nodiscard]] FacetFile read_stl(const std::filesystem::path& path);

/// Writes a binary STL; coordinates are rounded to single precision.
///
/// @throws Error(Fault::input_output)
void write_stl(const std::filesystem::path& path,
               const geometry::TriangleMesh& mesh,
               const std::string& header = "billet");

} // namespace billet::io
