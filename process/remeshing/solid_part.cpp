#include "process/remeshing/solid_part.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/nearest_in_triangle.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/equilibrium/faces.h"
#include "mechanics/mesh/domain_meshes.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <variant>

namespace billet::process {

namespace {

using mechanics::Face;

/// How a face is cut into triangles: numbers of its nodes, one more for its middle.
struct FaceCut {
  std::vector<Vec2> coordinates; ///< of the nodes and the middle, on the reference face
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<double> middle; ///< its weights of the nodes; empty: not needed
  std::size_t n_corners;
};

FaceCut face_cut(std::size_t n_nodes) {
  if (n_nodes == 6)
    return {{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}},
            {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
            {},
            3};
  if (n_nodes == 4)
    return {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, 0}},
            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
            {0.25, 0.25, 0.25, 0.25},
            4};
  return {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}},
          {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}},
          {-0.25, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 0.5},
          4};
}

double volume_of(const mechanics::Mesh& mesh, std::span<const double> x) {
  double volume = 0.0;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Vec3> points;
    for (const Index node : mesh.cell(e))
      points.emplace_back(x[idx(3 * node)], x[idx(3 * node + 1)], x[idx(3 * node + 2)]);
    volume += mechanics::element_measure(mesh.kind, points);
  }
  return volume;
}

/// Flags that are not in any of several.
std::vector<char> beyond(std::vector<char> flags, std::span<const std::vector<char>* const> given) {
  for (const std::vector<char>* each : given)
    for (std::size_t s = 0; s < flags.size(); ++s)
      if ((*each)[s] != 0)
        flags[s] = 0;
  return flags;
}

/// A boundary that turns by more at an edge may have a crease there, 30 degrees.
constexpr double sharp_turn = std::numbers::pi / 6.0;

bool any(const std::vector<char>& flags) {
  return std::any_of(flags.begin(), flags.end(), [](char flag) { return flag != 0; });
}

/// Cuts the faces of a scene's boundary and finds what hangs on them.
class Cutter {
public:
  Cutter(const Part& part, std::span<const double> x, std::span<const int> touching)
      : part_(part), x_(x), attachments_(part, touching),
        faces_(mechanics::boundary_faces(part.mesh)), number_(part.mesh.points.size(), -1) {
    for (std::size_t f = 0; f < part.contact_faces.size(); ++f)
      contact_face_[part.contact_faces[f].nodes] = static_cast<Index>(f);
  }

  [[nodiscard]] SolidPart part(std::span<const std::string> keep) && {
    for (const Face& face : faces_)
      add(face);
    result_.boundary.creases.emplace();
    find_edges();
    std::sort(result_.boundary.creases->begin(), result_.boundary.creases->end());
    result_.boundary.keep.assign(result_.boundary.mesh.points.size(), 0);
    find_corners(keep);
    result_.volume = volume_of(part_.mesh, x_);
    return std::move(result_);
  }

private:
  [[nodiscard]] Vec3 place(Index node) const {
    return {x_[idx(3 * node)], x_[idx(3 * node + 1)], x_[idx(3 * node + 2)]};
  }

  Index point(Index node) {
    if (number_[idx(node)] < 0) {
      number_[idx(node)] = add_point(place(node));
      result_.node.back() = node;
    }
    return number_[idx(node)];
  }

  Index add_point(const Vec3& x) {
    result_.boundary.mesh.points.push_back(x);
    result_.node.push_back(-1);
    return static_cast<Index>(result_.boundary.mesh.points.size()) - 1;
  }

  void add(const Face& face) {
    Attachment attached = attachments_.of(face);
    const bool held = attached.tool >= 0 || any(attached.supports);
    attached.tool = -1;
    const auto [part, is_new] =
        parts_.try_emplace(attached, static_cast<Index>(result_.attachments.size()));
    if (is_new)
      result_.attachments.push_back(attached);
    part_of_face_.push_back(part->second);
    const FaceCut cut = face_cut(face.nodes.size());
    std::vector<Index> points;
    for (const Index node : face.nodes)
      points.push_back(point(node));
    if (!cut.middle.empty()) {
      Vec3 middle = Vec3::Zero();
      for (std::size_t a = 0; a < face.nodes.size(); ++a)
        middle += cut.middle[a] * place(face.nodes[a]);
      points.push_back(add_point(middle));
    }
    const auto candidate = contact_face_.find(face.nodes);
    for (const auto& [a, b, c] : cut.triangles) {
      result_.boundary.mesh.triangles.push_back({points[a], points[b], points[c]});
      result_.boundary.part.push_back(part->second);
      result_.boundary.hold.push_back(static_cast<char>(held));
      result_.coordinates.push_back({cut.coordinates[a], cut.coordinates[b], cut.coordinates[c]});
      result_.contact_face.push_back(candidate != contact_face_.end() ? candidate->second : -1);
    }
  }

  struct EdgeOfFace {
    std::size_t face, edge; ///< from that corner to the next
  };

  /// Edges that are sharp or carry what no adjacent face does.
  void find_edges() {
    struct Edge {
      std::vector<Index> nodes; ///< two corners, and the middle if there is one
      std::vector<EdgeOfFace> faces;
    };
    std::map<std::pair<Index, Index>, Edge> edges;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const std::vector<Index>& nodes = faces_[f].nodes;
      const std::size_t n = face_cut(nodes.size()).n_corners;
      for (std::size_t i = 0; i < n; ++i) {
        const Index a = nodes[i], b = nodes[(i + 1) % n];
        Edge& edge = edges[std::minmax(a, b)];
        edge.nodes = {a, b};
        if (nodes.size() > n)
          edge.nodes.push_back(nodes[n + i]);
        edge.faces.push_back({f, i});
      }
    }
    for (const auto& [ends, edge] : edges) {
      std::vector<const std::vector<char>*> supports, sets;
      if (is_sharp(edge.faces))
        add_crease(edge.nodes);
      for (const EdgeOfFace& of : edge.faces) {
        const Attachment& attached = result_.attachments[idx(part_of_face_[of.face])];
        supports.push_back(&attached.supports);
        sets.push_back(&attached.sets);
      }
      const SolidPart::EdgeFlags own{
          beyond(on_all(attachments_.nodes().supports, edge.nodes), supports),
          beyond(on_all(attachments_.nodes().sets, edge.nodes), sets)};
      if (!any(own.supports) && !any(own.sets))
        continue;
      const Index a = point(edge.nodes[0]), b = point(edge.nodes[1]);
      if (edge.nodes.size() == 2) {
        keep_edge(a, b, own);
      } else {
        keep_edge(a, point(edge.nodes[2]), own);
        keep_edge(point(edge.nodes[2]), b, own);
      }
    }
  }

  void add_crease(const std::vector<Index>& nodes) {
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      // Corner, middle, corner; or both corners.
      const std::size_t a = i, b = nodes.size() - 1;
      const Index first = point(nodes[a]), second = point(nodes[b]);
      const auto [low, high] = std::minmax(first, second);
      result_.boundary.creases->push_back({low, high});
    }
  }

  [[nodiscard]] Vec3 normal(const Face& face, const Vec2& at) const {
    return mechanics::visit_face(part_.mesh.kind, [&](auto shape) -> Vec3 {
      using Shape = decltype(shape);
      if constexpr (Shape::dim == 2) {
        std::vector<double> x;
        for (const Index node : face.nodes)
          for (Index i = 0; i < 3; ++i)
            x.push_back(x_[idx(3 * node + i)]);
        return mechanics::FacePoint<Shape>(part_.analysis, x.data(), {at.x(), at.y()}, 1.0)
            .area.stableNormalized();
      } else {
        return Vec3::Zero();
      }
    });
  }

  /// Whether the boundary turns at an edge by more than 30 degrees, and by more than the adjacent
  /// faces do from there to their far side.
  [[nodiscard]] bool is_sharp(const std::vector<EdgeOfFace>& beside) const {
    if (beside.size() != 2)
      return true;
    std::array<Vec3, 2> at_edge;
    double most = sharp_turn;
    for (std::size_t k = 0; k < 2; ++k) {
      const Face& face = faces_[beside[k].face];
      const FaceCut cut = face_cut(face.nodes.size());
      const std::size_t i = beside[k].edge, n = cut.n_corners;
      const Vec2 middle = 0.5 * (cut.coordinates[i] + cut.coordinates[(i + 1) % n]);
      const Vec2 far = n == 3 ? cut.coordinates[(i + 2) % 3] : Vec2(-middle);
      at_edge[k] = normal(face, middle);
      most = std::max(most, angle_between(at_edge[k], normal(face, far)));
    }
    return angle_between(at_edge[0], at_edge[1]) > most;
  }

  void keep_edge(Index a, Index b, const SolidPart::EdgeFlags& own) {
    const auto [low, high] = std::minmax(a, b);
    result_.boundary.lines.push_back({low, high});
    result_.edges[{low, high}] = own;
  }

  /// Corners of faces that carry what neither an adjacent face nor an adjacent edge does.
  void find_corners(std::span<const std::string> keep) {
    std::vector<char> kept(part_.mesh.points.size(), 0);
    for (const std::string& name : keep)
      for (const Index node : part_.mesh.node_sets.at(name))
        kept[idx(node)] = 1;
    std::map<Index, std::vector<std::size_t>> faces_at;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const std::vector<Index>& nodes = faces_[f].nodes;
      for (std::size_t i = 0; i < face_cut(nodes.size()).n_corners; ++i)
        faces_at[nodes[i]].push_back(f);
    }
    std::map<Index, std::vector<const SolidPart::EdgeFlags*>> edges_at;
    for (const auto& [ends, own] : result_.edges)
      for (const Index end : ends)
        edges_at[end].push_back(&own);
    for (const auto& [node, faces] : faces_at) {
      const Index point = number_[idx(node)];
      std::vector<const std::vector<char>*> supports, sets;
      for (const std::size_t f : faces) {
        supports.push_back(&result_.attachments[idx(part_of_face_[f])].supports);
        sets.push_back(&result_.attachments[idx(part_of_face_[f])].sets);
      }
      for (const SolidPart::EdgeFlags* own : edges_at[point]) {
        supports.push_back(&own->supports);
        sets.push_back(&own->sets);
      }
      const std::span<const Index> alone(&node, 1);
      const bool lone = any(beyond(on_all(attachments_.nodes().supports, alone), supports)) ||
                        any(beyond(on_all(attachments_.nodes().sets, alone), sets));
      result_.boundary.keep[idx(point)] = static_cast<char>(lone || kept[idx(node)] != 0);
    }
  }

  const Part& part_;
  std::span<const double> x_;
  Attachments attachments_;
  std::vector<Face> faces_;
  std::vector<Index> number_; ///< of each node's point on the boundary
  std::vector<Index> part_of_face_;
  std::map<Attachment, Index> parts_;
  std::map<std::vector<Index>, Index> contact_face_;
  SolidPart result_;
};

/// Barycentric mean of three values.
template <class Value>
Value mean(const std::array<double, 3>& l, const std::array<Value, 3>& values) {
  return l[0] * values[0] + l[1] * values[1] + l[2] * values[2];
}

} // namespace

SolidPart solid_part(const Part& part,
                     std::span<const double> x,
                     std::span<const int> touching,
                     std::span<const std::string> keep) {
  return Cutter(part, x, touching).part(keep);
}

RemeshedPart remesh_part(const Part& old,
                         const SolidPart& part,
                         const geometry::SolidSizes& sizes,
                         const geometry::SnapSolid& snap) {
  const geometry::RemeshedSolid solid =
      geometry::remesh_solid(part.boundary, sizes, part.volume, snap);
  RemeshedPart result;
  result.mesh = mechanics::tetrahedron_mesh(solid);
  result.old_measure = part.volume;
  result.measure = solid.volume;
  NodeLists supports = support_lists(old, result.mesh.n_points());
  NodeLists sets = set_lists(old, result.mesh.n_points());
  result.loads = loads_without_faces(old);

  std::map<std::array<Index, 3>, Index> part_of; // by the corners, the smallest first
  const auto key = [](std::array<Index, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  for (const geometry::RemeshedSolid::Facet& facet : solid.facets)
    part_of[key(facet.corners)] = facet.part;
  std::map<std::array<Index, 2>, Index> middle_of;
  for (const Face& face : mechanics::boundary_faces(result.mesh)) {
    const Attachment& attached =
        part.attachments[idx(part_of.at(key({face.nodes[0], face.nodes[1], face.nodes[2]})))];
    supports.add(attached.supports, face.nodes);
    sets.add(attached.sets, face.nodes);
    for (std::size_t l = 0; l < result.loads.size(); ++l)
      if (attached.loads[l] != 0)
        faces_of(result.loads[l]).push_back(face);
    if (attached.contact)
      result.contact_faces.push_back(face);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(face.nodes[i], face.nodes[(i + 1) % 3]);
      middle_of[{low, high}] = face.nodes[3 + i];
    }
  }
  for (const auto& [edge, line] : solid.on_lines) {
    const auto own = part.edges.find(line);
    if (own == part.edges.end())
      continue;
    const auto& [a, b] = solid.edges[edge].corners;
    const std::array nodes{a, b, middle_of.at({a, b})};
    supports.add(own->second.supports, nodes);
    sets.add(own->second.sets, nodes);
  }
  for (const auto& [corner, point] : solid.kept)
    if (const Index node = part.node[idx(point)]; node >= 0) {
      supports.add_corner(node, corner);
      sets.add_corner(node, corner);
    }
  for (std::size_t s = 0; s < old.supports.size(); ++s)
    result.supports.push_back({supports[s], old.supports[s].component, old.supports[s].displacement,
                               old.supports[s].name});
  std::size_t s = 0;
  for (const auto& [name, nodes] : old.mesh.node_sets)
    result.mesh.node_sets[name] = sets[s++];
  return result;
}

ContactNeighbours::ContactNeighbours(const SolidPart& part, std::vector<Vec2> coordinates)
    : points_(std::move(coordinates)) {
  const geometry::TriangleMesh& mesh = part.boundary.mesh;
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (part.contact_face[t] < 0)
      continue;
    Triangle triangle{{}, part.coordinates[t], part.contact_face[t]};
    Box& box = boxes.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.corners[i] = mesh.points[idx(mesh.triangles[t][i])];
      box.add(triangle.corners[i]);
    }
    triangles_.push_back(triangle);
  }
  tree_ = geometry::BoxTree(boxes);
}

contact::PointSource ContactNeighbours::around(const Vec3& x) const {
  double least = std::numeric_limits<double>::infinity();
  Index nearest = -1;
  std::array<double, 3> at{};
  tree_.walk(x, least, [&](Index i) {
    const Triangle& t = triangles_[idx(i)];
    const std::array<double, 3> l =
        geometry::nearest_in_triangle(t.corners[0], t.corners[1], t.corners[2], x);
    const double distance2 = (mean(l, t.corners) - x).squaredNorm();
    if (distance2 < least || (distance2 == least && i < nearest)) {
      least = distance2;
      nearest = i;
      at = l;
    }
    return least;
  });
  if (nearest < 0) // no face that a tool may touch: there are no points
    return contact::PointSource::between(0, 0, 0.0);
  const Triangle& t = triangles_[idx(nearest)];
  return on_face(t.face, mean(at, t.coordinates));
}

contact::PointSource ContactNeighbours::on_face(Index face, const Vec2& at) const {
  std::vector<std::size_t> order(points_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return (points_[i] - at).squaredNorm() < (points_[j] - at).squaredNorm();
  });
  const auto twice_area = [&](std::size_t k) {
    const Vec2 a = points_[order[1]] - points_[order[0]], b = points_[order[k]] - points_[order[0]];
    return std::abs(a.x() * b.y() - a.y() * b.x());
  };
  constexpr double in_line = 1e-6;
  std::size_t third = 2;
  while (third + 1 < order.size() && twice_area(third) < in_line)
    ++third;
  const std::array<std::size_t, 3> chosen{order[0], order[1], order[third]};
  contact::PointSource source;
  source.weights =
      geometry::nearest_in_triangle(in_space(points_[chosen[0]]), in_space(points_[chosen[1]]),
                                    in_space(points_[chosen[2]]), in_space(at));
  for (std::size_t i = 0; i < 3; ++i)
    source.points[i] = idx(face) * points_.size() + chosen[i];
  return source;
}

} // namespace billet::process
