// Frames of the results as VTK files: the workpiece (.vtu), tools and contact faces (.vtp).
//
// Inline base64 with 64-bit headers, compressed where frames are large, float64: read by ParaView,
// VTK and meshio with every version of expat. Cells keep their true, quadratic type.
// VTK writes them (docs/decisions/0023-results-by-vtk.md).
// Arrays name their components, and carry their unit as VTK's UNITS_LABEL.
// The field data of each file hold `TimeValue` and texts: the `notes` and the units of the fields.
// A text is the *name* of an array with one number, "configuration: current coordinates" or
// "unit of von_mises: MPa", because meshio refuses files with string arrays.

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

/// Values at points or cells.
struct Field {
  std::string name;   ///< as a person reading ParaView expects it: "von_mises"
  int components = 1; ///< 1, 3 (vector X, Y, Z) or 6 (symmetric tensor XX, YY, ZZ, XY, YZ, XZ)
  std::vector<double> values; ///< shape (n, components)
  std::string unit;           ///< "MPa"; empty: none is written
};

/// Facts about a frame, stored by name: {"configuration", "current coordinates"}.
using Notes = std::vector<std::pair<std::string, std::string>>;

/// The workpiece at one time.
struct WorkpieceFrame {
  double time = 0.0;                                           ///< [s]
  mechanics::ElementKind kind = mechanics::ElementKind::quad4; ///< of every cell
  std::span<const Vec3> points;                                ///< current places [mm]
  std::span<const mechanics::Index> cells;                     ///< shape (n, nodes)
  std::vector<Field> point_fields;
  std::vector<Field> cell_fields;
  Notes notes;
};

/// A tool or the contact faces at one time: lines or polygons; cell data in that order.
struct SurfaceFrame {
  double time = 0.0;                                ///< [s]
  std::vector<Vec3> points;                         ///< current places [mm]
  std::vector<std::vector<mechanics::Index>> lines; ///< each two points or more
  std::vector<std::vector<mechanics::Index>> polygons;
  std::vector<Field> point_fields;
  std::vector<Field> cell_fields;
  Notes notes;
};

/// Adds a face (corners first, then mid-sides, see mechanics::Face) to a frame: a line through its
/// nodes in the plane, in space a polygon through corners and mid-side nodes in turn.
void add_face(SurfaceFrame& frame, std::span<const mechanics::Index> nodes, int dimension);

/// Writes the workpiece, all at once (see atomic_file.h).
/// @throws Error  (Fault::input_output)
/// @pre every field has as many values as its points or cells ask for
void write_vtu(const std::filesystem::path& path, const WorkpieceFrame& frame);

/// Writes a surface, all at once (see atomic_file.h).
/// @throws Error  (Fault::input_output)
/// @pre every field has as many values as its points or cells ask for
void write_vtp(const std::filesystem::path& path, const SurfaceFrame& frame);

} // namespace billet::io
