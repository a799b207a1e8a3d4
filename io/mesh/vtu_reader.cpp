// VTK's .vtu through VTK's own reader; what it hands over is checked before it is used.

#include "geometry/base/error.h"
#include "io/mesh/raw_mesh.h"
#include "io/mesh/scanner.h"
#include "io/mesh/vtu_content.h"
#include "io/mesh/vtu_guard.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

struct VtkType {
  int number;
  int n_nodes; ///< in the file
  ElementKind kind;
};

constexpr std::array vtk_types{
    VtkType{9, 4, ElementKind::quad4},   VtkType{23, 8, ElementKind::quad8},
    VtkType{28, 9, ElementKind::quad8}, // biquadratic
    VtkType{22, 6, ElementKind::tri6},   VtkType{12, 8, ElementKind::hex8},
    VtkType{25, 20, ElementKind::hex20}, VtkType{29, 27, ElementKind::hex20}, // triquadratic
    VtkType{24, 10, ElementKind::tet10},
};

[[noreturn]] void refuse(const std::filesystem::path& path,
                         const std::string& message,
                         const std::string& remedy = {}) {
  throw Error(Fault::geometry, path.string(), message, remedy, error_code::mesh_file);
}

const VtkType* find_type(int number) {
  for (const VtkType& known : vtk_types)
    if (known.number == number)
      return &known;
  return nullptr;
}

/// Where each cell begins among the point numbers, checked against their count.
const std::vector<std::int64_t>& checked_offsets(const VtuContent& content,
                                                 const std::filesystem::path& path) {
  const std::vector<std::int64_t>& begin = content.offsets;
  if (!content.has_offsets || content.types.empty())
    refuse(path, "the file has no cells");
  if (begin.size() != content.types.size() + 1)
    refuse(path, fmt::format("there are {} cell types, but {} cells", content.types.size(),
                             static_cast<std::int64_t>(begin.size()) - 1));
  if (begin.front() != 0 || begin.back() != static_cast<std::int64_t>(content.nodes.size()) ||
      !std::is_sorted(begin.begin(), begin.end()))
    refuse(path, "the offsets of the cells do not fit their point numbers");
  return begin;
}

void read_points(const VtuContent& content, const std::filesystem::path& path, RawMesh& mesh) {
  if (content.points.empty())
    refuse(path, "the file has no points");
  for (std::size_t i = 0; i < content.points.size(); i += 3) {
    const Vec3 point(content.points[i], content.points[i + 1], content.points[i + 2]);
    if (!point.allFinite())
      refuse(path, fmt::format("a coordinate of point {} is not a finite number", i / 3));
    mesh.points.push_back(point);
  }
}

/// The block of cells that the solver does not know.
CellBlock& unknown_block(const VtuContent& content, int number, RawMesh& mesh) {
  const auto type = std::find_if(content.known_types.begin(), content.known_types.end(),
                                 [number](const VtuType& t) { return t.number == number; });
  CellBlock& block = mesh.blocks[type->name];
  block.dimension = type->dimension;
  return block;
}

void read_cells(const VtuContent& content, const std::filesystem::path& path, RawMesh& mesh) {
  const std::vector<std::int64_t>& begin = checked_offsets(content, path);
  for (std::size_t i = 0; i < content.types.size(); ++i) {
    const int number = content.types[i];
    const VtkType* type = find_type(number);
    if (type == nullptr) {
      ++unknown_block(content, number, mesh).count;
      continue;
    }
    if (begin[i + 1] - begin[i] != type->n_nodes)
      refuse(path, fmt::format("cell {} of type {} has {} points, not {}", i, number,
                               begin[i + 1] - begin[i], type->n_nodes));
    CellBlock& block = mesh.blocks[std::string(mechanics::name(type->kind))];
    block.dimension = mechanics::dimension(type->kind);
    block.kind = type->kind;
    ++block.count;
    for (int k = 0; k < mechanics::nodes_per_element(type->kind); ++k) {
      const double node = content.nodes[static_cast<std::size_t>(begin[i] + k)];
      if (!(node >= 0.0) || node >= static_cast<double>(mesh.points.size()))
        refuse(path, fmt::format("cell {} has point {}; points are numbered 0 to {}", i, node,
                                 mesh.points.size() - 1));
      block.nodes.push_back(static_cast<Index>(node));
    }
  }
}

/// Point data of integer type with nothing but 0 and 1 are sets.
void read_sets(const VtuContent& content, RawMesh& mesh) {
  for (const auto& [full_name, values] : content.arrays) {
    if (!std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0 || v == 1.0; }))
      continue;
    std::vector<Index> set;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k] == 1.0)
        set.push_back(static_cast<Index>(k));
    const std::string_view name = full_name;
    mesh.node_sets[std::string(name.starts_with("set:") ? name.substr(4) : name)] = set;
  }
}

} // namespace

RawMesh read_vtu(const std::filesystem::path& path) {
  require_plausible_vtu(read_content(path), path);
  const VtuContent content = vtu_content(path);
  if (content.exceeds_memory)
    refuse(path, "the file asks for more memory than there is", "it may be damaged");
  if (!content.complaint.empty())
    refuse(path, fmt::format("VTK cannot read the file: {}", trimmed(content.complaint)),
           "it may be damaged or cut short");
  RawMesh mesh;
  read_points(content, path, mesh);
  read_cells(content, path, mesh);
  read_sets(content, mesh);
  mesh.unit_system = content.unit_system;
  return mesh;
}

} // namespace billet::io
