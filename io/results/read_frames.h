// Reads back the frames that a run has written: which files make up a frame, and what is in them.
//
// Files are read as `vtk_writer.h` writes them. A run that is going on lists a frame once all its
// files are there; of one that was cleaned up or damaged since, frames that lack their workpiece
// are left out.

#pragma once

#include "io/results/vtk_writer.h"
#include "mechanics/mesh/mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

/// The files of one frame.
struct FrameFiles {
  double time = 0.0; ///< [s]; at a remeshing two frames have the same
  std::filesystem::path workpiece;
  std::optional<std::filesystem::path> contact;
  std::vector<std::pair<std::string, std::filesystem::path>> tools; ///< by name
};

/// What a list of frames (.pvd) in the folder names and is there, in the order of the list; empty:
/// there is no list, or more than one.
/// @throws Error  (Fault::input_output) if the list cannot be read
[[nodiscard]] std::vector<FrameFiles> frames_in(const std::filesystem::path& folder);

/// A plane of symmetry: the part lies on one side of it.
struct SymmetryPlane {
  int axis = 0;       ///< its normal: 0: x, 1: y, 2: z
  double value = 0.0; ///< [mm]

  bool operator==(const SymmetryPlane&) const = default;
};

/// The workpiece of a frame.
struct StoredWorkpiece {
  double time = 0.0;         ///< [s]
  mechanics::Mesh mesh;      ///< places as they were then [mm]
  std::vector<Field> points; ///< fields at nodes
  std::vector<Field> cells;  ///< fields of elements
  /// Without those that are opposite to each other, the ends of a slice: images would prolong it.
  std::vector<SymmetryPlane> symmetry;
};

/// @throws Error  for a file that cannot be read or that this program has not written
[[nodiscard]] StoredWorkpiece read_workpiece(const std::filesystem::path& file);

/// A tool or the contact faces of a frame; without notes.
/// @throws Error  for a file that cannot be read or that this program has not written
[[nodiscard]] SurfaceFrame read_surface(const std::filesystem::path& file);

} // namespace billet::io
