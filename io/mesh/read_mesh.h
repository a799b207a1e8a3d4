// A workpiece mesh from a file: Gmsh .msh (2.2 and 4.1, text and binary), VTK .vtu, Abaqus and
// CalculiX .inp with what it includes.
//
// The cells of the highest dimension in the file are the body and must be of one kind; others only
// serve to name sets of nodes. Sets: Gmsh's physical groups, Abaqus' *NSET and *ELSET (the nodes of
// the elements), VTU point data of integer type that hold only 0 and 1.
// Files are not trusted: whatever they hold, the outcome is a mesh or an `Error` (Fault::geometry).

#pragma once

#include "io/mesh/included_lines.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/mesh/mesh_labels.h"

#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {

/// A mesh as read, and what the user should know about how it was read.
struct MeshFile {
  mechanics::Mesh mesh;              ///< only nodes that cells use; numbers from 0 in file order
  std::vector<std::string> notes;    ///< e.g. "3 nodes that no element uses were left out"
  std::string type = {};             ///< of its elements, as an .inp calls it: "CAX8R"
  std::string unit_system = {};      ///< that a frame of results names; empty: it is none
  mechanics::MeshLabels labels = {}; ///< what a .msh or .inp calls its nodes and elements
};

/// Reads a mesh; the format follows from how the file begins (mesh_format.h).
///
/// Cells whose nodes all turn the wrong way round are mirrored (and noted); a mixture is an error.
/// Soundness beyond that is `mechanics::check_mesh`'s business.
///
/// @param length_factor  multiplies the coordinates (unit of the file / unit of the case)
/// @param bounds         where files that it includes may lie
/// @throws Error  place "file:line" or "file"
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path,
                                 double length_factor = 1.0,
                                 const IncludeBounds& bounds = {});

} // namespace billet::io
