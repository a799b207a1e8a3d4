// Which format a mesh file is in: by how it begins, for suffixes are shared. (cgx writes meshes of
// Abaqus' format that end in .msh.)

#pragma once

#include <filesystem>

namespace billet::io {

enum class MeshFormat { gmsh, vtu, abaqus };

/// The format by the first line that is not blank: "$..." is Gmsh's, "*..." Abaqus', "<..." VTK's;
/// where that tells nothing, by the suffix.
///
/// @throws Error(Fault::geometry) if neither tells, or if the file cannot be read
[[nodiscard]] MeshFormat mesh_format(const std::filesystem::path& path);

} // namespace billet::io
