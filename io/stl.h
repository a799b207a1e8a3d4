// STL files: triangles without units, ASCII or binary.
//
// `read_stl` tells the two kinds apart by content, not by the word "solid" (many binary files start
// with it), and reports every damage with its place. `tool_mesh` turns the triangles into a surface
// fit for a tool, or says at which coordinates it is not one.
//
// Units   an STL has none: the caller gives the factor to the units of the case.

#pragma once

#include "geometry/mesh_health.h"
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
};

/// @throws Error(Fault::geometry) naming file and line (ASCII) or facet (binary)
[[nodiscard]] StlFile read_stl(const std::filesystem::path& path);

/// Writes a binary STL; coordinates are rounded to single precision.
///
/// @throws Error(Fault::input_output)
void write_stl(const std::filesystem::path& path,
               const geometry::TriangleMesh& mesh,
               const std::string& header = "billet");

/// Triangles ready for `make_triangle_surface`, and what was found and done on the way.
struct StlTool {
  geometry::TriangleMesh mesh;
  geometry::CleanUp clean_up;
  geometry::MeshHealth health; ///< after the clean-up
};

/// Welds, drops degenerate triangles, scales and checks.
///
/// @param scale  factor from the units of the file to those of the case, > 0
/// @param flip   turns the surface inside out
/// @throws Error(Fault::geometry) for a non-manifold or inconsistently oriented surface
[[nodiscard]] StlTool tool_mesh(const StlFile& file, double scale, bool flip);

/// One paragraph for the log: triangles, size, closed or open, volume, what was dropped.
[[nodiscard]] std::string report(const StlFile& file, const StlTool& mesh);

} // namespace billet::io
