#include "mechanics/elements/mesh_check.h"

#include "geometry/base/box.h"
#include "geometry/base/pieces.h"
#include "mechanics/elements/mesh_jacobian.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace billet::mechanics {

namespace {

/// A cell flatter than this counts as having no volume; relative to its size.
constexpr double flat = 1e-14;

/// Gathers complaints; of each sort only the first ten are spelled out.
class Complaints {
public:
  explicit Complaints(std::string place) : place_(std::move(place)) {}

  void add(std::string message, const std::string& remedy = {}) {
    if (++count_ <= 10)
      list_.push_back({place_, std::move(message), remedy, error_code::mesh_elements});
  }

  /// Ends a sort: says how many more of it there are.
  void close(const char* what) {
    if (count_ > 10)
      list_.push_back({place_,
                       fmt::format("and {} more {}", count_ - 10, what),
                       {},
                       error_code::mesh_elements});
    count_ = 0;
  }

  [[nodiscard]] bool none() const { return list_.empty(); }
  [[nodiscard]] std::vector<Complaint> take() { return std::move(list_); }

private:
  std::string place_;
  std::vector<Complaint> list_;
  std::size_t count_ = 0;
};

std::vector<Vec3> places(const Mesh& mesh, std::span<const Vec3> points, Index element) {
  std::vector<Vec3> nodes;
  for (const Index node : mesh.cell(element))
    nodes.push_back(points[static_cast<std::size_t>(node)]);
  return nodes;
}

std::string text(const Vec3& p, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", p.x(), p.y())
                        : fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

/// What an element is called and where to look for it.
std::string describe(const Mesh& mesh, Index element, const MeshLabels& labels) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& point : places(mesh, mesh.points, element))
    centre += point;
  centre /= nodes_per_element(mesh.kind);
  const std::string what =
      fmt::format("{}, centre {}", name(mesh.kind), text(centre, mesh.dimension()));
  return labels.elements.empty()
             ? fmt::format("element number {} (counted from 0, {})", element, what)
             : fmt::format("{} ({})", labels.element(element), what);
}

void check_numbers(const Mesh& mesh, Complaints& complaints) {
  if (mesh.points.empty() || mesh.cells.empty())
    complaints.add("the mesh has no elements");
  if (mesh.cells.size() % static_cast<std::size_t>(nodes_per_element(mesh.kind)) != 0)
    complaints.add(fmt::format("{} node numbers do not make whole {} elements", mesh.cells.size(),
                               name(mesh.kind)));
  complaints.close("");
  const auto valid = [&](Index node) { return node >= 0 && node < mesh.n_points(); };
  for (Index element = 0; element < mesh.n_elements(); ++element)
    for (const Index node : mesh.cell(element))
      if (!valid(node))
        complaints.add(fmt::format("{} names node {}; nodes are numbered 0 to {}",
                                   MeshLabels{}.element(element), node, mesh.n_points() - 1));
  complaints.close("invalid node numbers");
  for (const auto& [set, nodes] : mesh.node_sets)
    if (!std::all_of(nodes.begin(), nodes.end(), valid))
      complaints.add(fmt::format("the node set \"{}\" names nodes that do not exist", set));
  complaints.close("such sets");
}

void check_points(const Mesh& mesh,
                  bool axisymmetric,
                  const MeshLabels& labels,
                  Complaints& complaints) {
  for (Index node = 0; node < mesh.n_points(); ++node)
    if (!mesh.points[static_cast<std::size_t>(node)].allFinite())
      complaints.add(fmt::format("a coordinate of {} is not a number", labels.node(node)));
  complaints.close("such nodes");
  Box box;
  for (const Vec3& point : mesh.points)
    box.add(point);
  const double margin = 1e-9 * box.size();
  for (Index node = 0; node < mesh.n_points(); ++node) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
    if (mesh.dimension() == 2 && std::abs(p.z()) > margin)
      complaints.add(
          fmt::format("{} at {} is not in the plane z = 0", labels.node(node), text(p, 3)),
          "a plane mesh lies in the x-y plane");
    else if (axisymmetric && p.x() < -margin)
      complaints.add(fmt::format("{} at {} has a negative radius", labels.node(node), text(p, 2)),
                     "in an axisymmetric scene x is the radius: move the mesh to x >= 0");
  }
  complaints.close("such nodes");
}

void check_use(const Mesh& mesh, const MeshLabels& labels, Complaints& complaints) {
  std::vector<char> used(mesh.points.size(), 0);
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const auto cell = mesh.cell(element);
    std::vector<Index> sorted(cell.begin(), cell.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      complaints.add(
          fmt::format("{} has {} twice", describe(mesh, element, labels), labels.node(*twice)),
          "degenerate elements are not supported: mesh without collapsed sides");
    for (const Index node : cell)
      used[static_cast<std::size_t>(node)] = 1;
  }
  complaints.close("such elements");
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused > 0)
    complaints.add(fmt::format("{} nodes belong to no element", unused));
  complaints.close("");
}

void check_shapes(const Mesh& mesh, const MeshLabels& labels, Complaints& complaints) {
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const std::vector<Vec3> nodes = places(mesh, mesh.points, element);
    const double smallest = smallest_jacobian(mesh.kind, nodes);
    if (smallest > flat)
      continue;
    const double measure = element_measure(mesh.kind, nodes);
    const char* what = mesh.dimension() == 2 ? "area" : "volume";
    complaints.add(
        fmt::format("{} is {}: its {} is {:.4g}, its smallest Jacobian {:.3g} (relative)",
                    describe(mesh, element, labels),
                    smallest < -flat ? "turned inside out" : "collapsed", what, measure, smallest),
        is_quadratic(mesh.kind) && measure > 0.0
            ? "a mid-side node may stand beyond the quarter of its edge, or an angle be 180 degrees"
            : "the nodes of an element turn counter-clockwise (seen from outside its top)");
  }
  complaints.close("such elements");
}

/// A node's part in the tangent of an edge.
struct TangentPart {
  std::size_t node;
  double weight; ///< [-]
};

/// What a corner of the reference cell needs for the quality there.
struct ReferenceCorner {
  /// Of the edges that leave it, right-handed. Only nodes of the edge take part.
  std::vector<std::vector<TangentPart>> tangents;
  bool straight;                   ///< the edges are their chords, and so are the tangents
  std::vector<std::size_t> others; ///< corner at the far end of each
};

ReferenceCorner reference_corner(ElementKind kind, int corner) {
  const std::span<const Vec3> corners = reference_corners(kind);
  const Vec3& at = corners[static_cast<std::size_t>(corner)];
  ReferenceCorner result;
  result.straight = !is_quadratic(kind);
  for (const auto& [a, b] : element_edges(kind))
    if (a == corner || b == corner)
      result.others.push_back(static_cast<std::size_t>(a == corner ? b : a));
  Mat3 directions = Mat3::Identity();
  const auto set_directions = [&] {
    for (std::size_t k = 0; k < result.others.size(); ++k)
      directions.col(static_cast<Eigen::Index>(k)) = corners[result.others[k]] - at;
  };
  set_directions();
  if (directions.determinant() < 0.0) {
    std::swap(result.others[0], result.others[1]);
    set_directions();
  }
  const std::vector<Vec3> gradients = shape_gradients(kind, at);
  constexpr double none = 1e-12;
  for (std::size_t k = 0; k < result.others.size(); ++k) {
    std::vector<TangentPart>& tangent = result.tangents.emplace_back();
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      const double weight = gradients[i].dot(directions.col(static_cast<Eigen::Index>(k)));
      if (std::abs(weight) > none)
        tangent.push_back({i, weight});
    }
  }
  return result;
}

/// Those of a kind of element; made once, for they are asked for in every increment.
const std::vector<ReferenceCorner>& corners_for_quality(ElementKind kind) {
  static const std::map<ElementKind, std::vector<ReferenceCorner>> all = [] {
    std::map<ElementKind, std::vector<ReferenceCorner>> corners;
    for (const ElementKind each :
         {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6, ElementKind::hex8,
          ElementKind::hex20, ElementKind::tet4, ElementKind::tet10})
      for (int corner = 0; corner < corners_per_element(each); ++corner)
        corners[each].push_back(reference_corner(each, corner));
    return corners;
  }();
  return all.at(kind);
}

/// Columns of the Jacobian at a corner, each with the length it is measured against.
struct CornerFrame {
  Mat3 tangents;   ///< along the edges that leave the corner [mm]
  Vec3 references; ///< max(length of the tangent, length of the chord) [mm]
};

CornerFrame
corner_frame(const ReferenceCorner& reference, std::span<const Vec3> points, std::size_t corner) {
  CornerFrame frame{Mat3::Identity(), Vec3::Ones()}; // in the plane the third edge is z
  for (std::size_t k = 0; k < reference.others.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Vec3 chord = points[reference.others[k]] - points[corner];
    if (reference.straight) {
      frame.tangents.col(column) = chord;
      frame.references[column] = chord.norm();
      continue;
    }
    Vec3 tangent = Vec3::Zero();
    for (const auto& [node, weight] : reference.tangents[k])
      tangent += weight * points[node];
    frame.tangents.col(column) = tangent;
    frame.references[column] = std::max(tangent.norm(), chord.norm());
  }
  return frame;
}

/// Determinant of three unit edges at a corner of the ideal cell.
double ideal_determinant(ElementKind kind) {
  switch (kind) {
  case ElementKind::tri6:
    return std::sqrt(3.0) / 2.0;
  case ElementKind::tet4:
  case ElementKind::tet10:
    return std::sqrt(0.5);
  default:
    return 1.0;
  }
}

} // namespace

double element_quality(ElementKind kind, std::span<const Vec3> points) {
  double quality = 1.0;
  const std::vector<ReferenceCorner>& corners = corners_for_quality(kind);
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const CornerFrame frame = corner_frame(corners[corner], points, corner);
    const double scale = frame.references.prod() * ideal_determinant(kind);
    const double scaled = scale == 0.0 ? 0.0 : frame.tangents.determinant() / scale;
    if (!std::isfinite(scaled))
      return -1.0;
    quality = std::min(quality, scaled);
  }
  // An obtuse inverted simplex can pass -1 by the factor of the ideal cell.
  return std::max(quality, -1.0);
}

std::vector<double> element_qualities(const Mesh& mesh, std::span<const Vec3> points) {
  std::vector<double> qualities(idx(mesh.n_elements()));
  for_pieces(qualities.size(), 512, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3> nodes;
    for (std::size_t element = begin; element < end; ++element) {
      nodes.clear();
      for (const Index node : mesh.cell(static_cast<Index>(element)))
        nodes.push_back(points[idx(node)]);
      qualities[element] = element_quality(mesh.kind, nodes);
    }
  });
  return qualities;
}

double element_aspect(ElementKind kind, std::span<const Vec3> points) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (const auto& [a, b] : element_edges(kind)) {
    const double length =
        (points[static_cast<std::size_t>(b)] - points[static_cast<std::size_t>(a)]).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return shortest > 0.0 ? longest / shortest : std::numeric_limits<double>::infinity();
}

double largest_aspect(const Mesh& mesh, std::span<const Vec3> points) {
  double largest = 1.0;
  for (Index element = 0; element < mesh.n_elements(); ++element)
    largest = std::max(largest, element_aspect(mesh.kind, places(mesh, points, element)));
  return largest;
}

double element_measure(ElementKind kind, std::span<const Vec3> points) {
  double measure = 0.0;
  for (const Sample& sample : measuring_points(kind))
    measure += sample.weight * jacobian(kind, points, sample.xi).determinant();
  return measure;
}

double smallest_jacobian(ElementKind kind, std::span<const Vec3> points) {
  Box box;
  for (const Vec3& point : points)
    box.add(point);
  const double size = box.size();
  if (!(size > 0.0))
    return 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : reference_corners(kind))
    smallest = std::min(smallest, jacobian(kind, points, corner).determinant());
  for (const Sample& sample : measuring_points(kind))
    smallest = std::min(smallest, jacobian(kind, points, sample.xi).determinant());
  return smallest / std::pow(size, dimension(kind));
}

std::vector<Complaint> check_mesh(const Mesh& mesh,
                                  const std::string& place,
                                  bool axisymmetric,
                                  const MeshLabels& labels) {
  Complaints complaints(place);
  check_numbers(mesh, complaints);
  if (complaints.none())
    check_points(mesh, axisymmetric, labels, complaints);
  if (complaints.none())
    check_use(mesh, labels, complaints);
  if (complaints.none())
    check_shapes(mesh, labels, complaints);
  return complaints.take();
}

void require_sound_mesh(const Mesh& mesh,
                        const std::string& place,
                        bool axisymmetric,
                        const MeshLabels& labels) {
  std::vector<Complaint> complaints = check_mesh(mesh, place, axisymmetric, labels);
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
}

std::vector<Index> cells_in_single_file(const Mesh& mesh, std::span<const char> held) {
  if (mesh.kind != ElementKind::hex20)
    return {};
  std::map<Index, std::vector<Face>> free_faces; // of a cell
  for (Face& face : boundary_faces(mesh)) {
    const bool is_held = std::all_of(face.nodes.begin(), face.nodes.end(),
                                     [&](Index node) { return held[idx(node)] != 0; });
    if (!is_held)
      free_faces[face.element].push_back(std::move(face));
  }
  const auto are_opposite = [](const Face& a, const Face& b) {
    return std::find_first_of(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end()) ==
           a.nodes.end();
  };
  std::vector<Index> cells;
  for (const auto& [cell, faces] : free_faces) {
    int opposite = 0;
    for (std::size_t a = 0; a < faces.size(); ++a)
      for (std::size_t b = a + 1; b < faces.size(); ++b)
        opposite += are_opposite(faces[a], faces[b]) ? 1 : 0;
    if (opposite >= 2)
      cells.push_back(cell);
  }
  return cells;
}

Index drop_unused_points(Mesh& mesh) {
  std::vector<Index> number(mesh.points.size(), -1);
  for (const Index node : mesh.cells)
    number[static_cast<std::size_t>(node)] = 0;
  Index kept = 0;
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] == 0) {
      mesh.points[static_cast<std::size_t>(kept)] = mesh.points[node];
      number[node] = kept++;
    }
  const Index dropped = mesh.n_points() - kept;
  mesh.points.resize(static_cast<std::size_t>(kept));
  for (Index& node : mesh.cells)
    node = number[static_cast<std::size_t>(node)];
  for (auto& [set, nodes] : mesh.node_sets) {
    for (Index& node : nodes)
      node = number[static_cast<std::size_t>(node)];
    std::erase(nodes, -1);
  }
  return dropped;
}

} // namespace billet::mechanics
