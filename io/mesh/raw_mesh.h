// What a mesh file holds, before the body is chosen from it; and the readers that fill it.
//
// Every reader turns node numbers of the file into positions from 0 and the order of nodes within a
// cell into VTK's. A type of cell the solver does not know is counted, so that a message can name
// it.

#pragma once

#include "geometry/base/vector.h"
#include "io/mesh/included_lines.h"
#include "mechanics/mesh/mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace billet::io {

/// All cells of one type.
struct CellBlock {
  int dimension = 0;                          ///< of the cells: 0 to 3
  std::optional<mechanics::ElementKind> kind; ///< empty: not a cell the solver knows
  std::size_t count = 0;                      ///< number of cells
  std::vector<mechanics::Index> nodes;        ///< shape (count, nodes), VTK's order; if known
  std::vector<std::int64_t> labels;           ///< shape (count), of known cells; empty: none
};

/// The content of a file.
struct RawMesh {
  std::vector<Vec3> points;                                       ///< as in the file
  std::vector<std::int64_t> labels;                               ///< of points; empty: none
  std::map<std::string, CellBlock> blocks;                        ///< by name of the type
  std::map<std::string, std::vector<mechanics::Index>> node_sets; ///< in any order, with repeats
  std::vector<std::string> notes;
  std::string unit_system = {}; ///< that a frame of results names; empty: it is none
  std::string type = {}; ///< of solid elements as an .inp calls it, "CAX8R"; empty: none says one
};

/// Positions of the nodes by their number in the file.
class NodeNumbers {
public:
  /// Gives the next position to a number; false if it has one already.
  [[nodiscard]] bool add(std::int64_t number) {
    return positions_.try_emplace(number, static_cast<mechanics::Index>(positions_.size())).second;
  }
  /// Position of a number, or -1.
  [[nodiscard]] mechanics::Index find(std::int64_t number) const {
    const auto found = positions_.find(number);
    return found == positions_.end() ? -1 : found->second;
  }

private:
  std::unordered_map<std::int64_t, mechanics::Index> positions_;
};

/// Readers by format.
/// @throws Error  (Fault::geometry), whatever the file holds
[[nodiscard]] RawMesh read_gmsh(const std::filesystem::path& path);
[[nodiscard]] RawMesh read_vtu(const std::filesystem::path& path);
[[nodiscard]] RawMesh read_abaqus(const std::filesystem::path& path, const IncludeBounds& bounds);

} // namespace billet::io
