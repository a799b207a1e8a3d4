#include "io/mesh/read_mesh.h"

#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/raw_mesh.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_connections.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;

RawMesh read_raw(const std::filesystem::path& path, const IncludeBounds& bounds) {
  switch (mesh_format(path)) {
  case MeshFormat::gmsh:
    return read_gmsh(path);
  case MeshFormat::vtu:
    return read_vtu(path);
  case MeshFormat::abaqus:
    break;
  }
  return read_abaqus(path, bounds);
}

// --- choice of the body --------------------------------------------------------------------------

std::string remedy_for(const std::string& type) {
  if (type == "tri3" || type == "tet4" || type == "vtkTriangle" || type == "vtkTetra" ||
      type.starts_with("C3D4") || type.ends_with('3'))
    return "mesh with second order elements: triangles with 6, tetrahedra with 10 nodes";
  return "known are quad4, quad8 and tri6 in the plane, hex8, hex20 and tet10 in space";
}

/// The cells of the highest dimension, which must be of one known kind.
CellBlock body(RawMesh& raw, const std::string& file) {
  int dimension = 0;
  for (const auto& [type, block] : raw.blocks)
    dimension = std::max(dimension, block.dimension);
  if (dimension < 2)
    throw Error(Fault::geometry, file, "the file has no plane and no solid elements",
                "in Gmsh, save all elements or put the body into a physical group",
                error_code::mesh_file);
  std::string found;
  std::vector<std::string> names;
  for (const auto& [type, block] : raw.blocks)
    if (block.dimension == dimension) {
      found += fmt::format("{}{} {}", found.empty() ? "" : ", ", block.count, type);
      names.push_back(type);
    }
  if (names.size() > 1)
    throw Error(Fault::geometry, file,
                fmt::format("the elements are of more than one kind: {}", found),
                "a workpiece is meshed with one kind of element (in Gmsh: recombine all, or none)",
                error_code::mesh_file);
  CellBlock& block = raw.blocks.at(names.front());
  if (!block.kind)
    throw Error(Fault::geometry, file, fmt::format("elements of the kind {} are not known", found),
                remedy_for(names.front()), error_code::mesh_file);
  return std::move(block);
}

/// Removes cells with the nodes of an earlier one, whichever the first; Gmsh 2.2 repeats a cell for
/// each group.
std::size_t drop_repeated_cells(Mesh& mesh, std::vector<std::int64_t>& labels) {
  std::vector<std::int64_t> kept_labels;
  std::set<std::vector<Index>> seen;
  std::vector<Index> kept;
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const auto cell = mesh.cell(element);
    std::vector<Index> nodes(cell.begin(), cell.end());
    std::sort(nodes.begin(), nodes.end());
    if (!seen.insert(std::move(nodes)).second)
      continue;
    kept.insert(kept.end(), cell.begin(), cell.end());
    if (!labels.empty())
      kept_labels.push_back(labels[static_cast<std::size_t>(element)]);
  }
  labels = std::move(kept_labels);
  const auto n = static_cast<std::size_t>(nodes_per_element(mesh.kind));
  const std::size_t dropped = (mesh.cells.size() - kept.size()) / n;
  mesh.cells = std::move(kept);
  return dropped;
}

/// Those of nodes that cells use.
void keep_used_labels(const Mesh& mesh, std::vector<std::int64_t>& labels) {
  if (labels.empty())
    return;
  std::vector<char> used(mesh.points.size(), 0);
  for (const Index node : mesh.cells)
    used[static_cast<std::size_t>(node)] = 1;
  std::vector<std::int64_t> kept;
  for (std::size_t node = 0; node < used.size(); ++node)
    if (used[node] != 0)
      kept.push_back(labels[node]);
  labels = std::move(kept);
}

// --- orientation ---------------------------------------------------------------------------------

/// Local nodes of a cell whose numbering turns the other way.
std::vector<std::size_t> mirrored_order(ElementKind kind) {
  const auto edges = mechanics::element_edges(kind);
  const auto n_corners = static_cast<std::size_t>(mechanics::corners_per_element(kind));
  std::vector<std::size_t> order(n_corners);
  std::iota(order.begin(), order.end(), 0U);
  if (n_corners == 8)
    std::rotate(order.begin(), order.begin() + 4, order.end());
  else
    std::swap(order[1], order[n_corners == 4 && mechanics::dimension(kind) == 2 ? 3 : 2]);
  if (!mechanics::is_quadratic(kind))
    return order;
  for (const auto& [a, b] : edges) {
    const std::size_t from = order[static_cast<std::size_t>(a)];
    const std::size_t to = order[static_cast<std::size_t>(b)];
    const auto same = std::find_if(edges.begin(), edges.end(), [&](const std::array<int, 2>& edge) {
      const auto p = static_cast<std::size_t>(edge[0]);
      const auto q = static_cast<std::size_t>(edge[1]);
      return (p == from && q == to) || (p == to && q == from);
    });
    order.push_back(n_corners + static_cast<std::size_t>(same - edges.begin()));
  }
  return order;
}

std::vector<Vec3> places(const Mesh& mesh, Index element) {
  std::vector<Vec3> nodes;
  for (const Index node : mesh.cell(element))
    nodes.push_back(mesh.points[static_cast<std::size_t>(node)]);
  return nodes;
}

void mirror_cells(Mesh& mesh) {
  const std::vector<std::size_t> order = mirrored_order(mesh.kind);
  std::vector<Index> cells;
  cells.reserve(mesh.cells.size());
  for (Index element = 0; element < mesh.n_elements(); ++element)
    for (const std::size_t node : order)
      cells.push_back(mesh.cell(element)[node]);
  mesh.cells = std::move(cells);
}

void orient(MeshFile& result, const std::string& file) {
  Mesh& mesh = result.mesh;
  Index n_negative = 0;
  Index first = -1;
  for (Index element = 0; element < mesh.n_elements(); ++element)
    if (element_measure(mesh.kind, places(mesh, element)) < 0.0) {
      first = n_negative == 0 ? element : first;
      ++n_negative;
    }
  if (n_negative == 0)
    return;
  if (n_negative < mesh.n_elements()) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& point : places(mesh, first))
      centre += point / nodes_per_element(mesh.kind);
    throw Error(Fault::geometry, file,
                fmt::format("{} of {} elements turn the wrong way round; the first is {}, "
                            "with its centre at ({:.6g}, {:.6g}, {:.6g})",
                            n_negative, mesh.n_elements(), result.labels.element(first), centre.x(),
                            centre.y(), centre.z()),
                "give the nodes of every element in the same sense", error_code::mesh_elements);
  }
  mirror_cells(mesh);
  result.notes.push_back(
      fmt::format("all {} elements turn clockwise in the file and were mirrored", n_negative));
}

/// A plane mesh must lie in a plane z = constant; it is moved to z = 0.
void flatten(MeshFile& result, const std::string& file) {
  Box box;
  for (const Vec3& point : result.mesh.points)
    box.add(point);
  const double margin = 1e-9 * box.size();
  if (box.high.z() - box.low.z() > margin)
    throw Error(Fault::geometry, file,
                fmt::format("the elements are plane, but z goes from {:.6g} to {:.6g}", box.low.z(),
                            box.high.z()),
                "a plane mesh lies in the x-y plane; a solid one needs hexahedra or tetrahedra",
                error_code::mesh_file);
  if (std::max(std::abs(box.low.z()), std::abs(box.high.z())) > margin)
    result.notes.push_back(fmt::format("the mesh was moved from z = {:.6g} to 0", box.low.z()));
  for (Vec3& point : result.mesh.points)
    point.z() = 0.0;
}

void tidy_sets(MeshFile& result) {
  auto& sets = result.mesh.node_sets;
  for (auto set = sets.begin(); set != sets.end();) {
    std::vector<Index>& nodes = set->second;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty())
      result.notes.push_back(fmt::format("the set \"{}\" has no node of the mesh", set->first));
    set = nodes.empty() ? sets.erase(set) : std::next(set);
  }
}

} // namespace

MeshFile
read_mesh(const std::filesystem::path& path, double length_factor, const IncludeBounds& bounds) {
  assert(length_factor > 0.0 && std::isfinite(length_factor));
  const std::string file = path.string();
  RawMesh raw = read_raw(path, bounds);
  CellBlock block = body(raw, file);
  MeshFile result{.mesh = {.kind = *block.kind,
                           .points = std::move(raw.points),
                           .cells = std::move(block.nodes),
                           .node_sets = std::move(raw.node_sets)},
                  .notes = std::move(raw.notes),
                  .type = std::move(raw.type),
                  .unit_system = std::move(raw.unit_system),
                  .labels = {std::move(raw.labels), std::move(block.labels)}};
  Mesh& mesh = result.mesh;
  for (Vec3& point : mesh.points)
    point *= length_factor;
  keep_used_labels(mesh, result.labels.nodes);
  if (const Index unused = drop_unused_points(mesh); unused > 0)
    result.notes.push_back(fmt::format("{} nodes that no element uses were left out", unused));
  if (const std::size_t repeated = drop_repeated_cells(mesh, result.labels.elements); repeated > 0)
    result.notes.push_back(fmt::format("{} elements given twice were kept once", repeated));
  tidy_sets(result);
  if (mesh.dimension() == 2)
    flatten(result, file);
  orient(result, file);
  if (!mechanics::check_mesh(mesh, file, false, result.labels).empty())
    return result; // said where the part is put in its place
  if (std::vector<Complaint> flaws = mechanics::check_connections(mesh, file, result.labels);
      !flaws.empty())
    throw Error(Fault::geometry, std::move(flaws));
  for (const std::string& loose : mechanics::loose_connections(mesh, result.labels))
    result.notes.push_back("warning: [loose-mesh] " + loose);
  return result;
}

} // namespace billet::io
