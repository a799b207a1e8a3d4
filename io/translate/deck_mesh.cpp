#include "io/translate/deck_mesh.h"

#include "geometry/base/error.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using Numbers = std::vector<DeckNumber>;

/// A kind of a case by letters and number of nodes of a deck's; none: not available as it is.
std::string kind_of(const DeckElement& element) {
  const std::size_t n = element.nodes.size();
  if (is_plane_type(element.type))
    return n == 8 ? "quad8" : n == 4 ? "quad4" : n == 6 ? "tri6" : "";
  return n == 20 ? "hex20" : n == 8 ? "hex8" : n == 10 ? "tet10" : "";
}

bool is_solid_type(const std::string& type) {
  return type.starts_with("C3D") || type.starts_with("CPE") || type.starts_with("CPS") ||
         type.starts_with("CAX");
}

/// With incompatible modes: C3D8I, CPE4I.
bool bends(const DeckElement& element) { return element.type.ends_with('I'); }

/// Fewer than the element has where it collapses.
std::set<DeckNumber> distinct_corners(const Deck& deck, const DeckElement& element) {
  std::set<DeckNumber> corners;
  for (const DeckFace& face : faces_of(deck, element, ""))
    corners.insert(face.corners.begin(), face.corners.end());
  return corners;
}

DeckMesh::Edge edge_between(DeckNumber a, DeckNumber b) { return std::minmax(a, b); }

/// Makes the mesh of elements of another kind than the deck's.
class Converter {
public:
  Converter(const Deck& deck, const DeckBody& body, ElementKind kind) : deck_(deck), kind_(kind) {
    for (const auto& [number, point] : deck.nodes)
      next_ = std::max(next_, number + 1);
    for (const DeckNumber number : body.elements)
      learn_middles(deck.elements.at(number));
  }

  void add(const DeckElement& element) {
    const std::size_t corners = corner_count();
    if (faces_of(deck_, element, "").size() == (corners == 8   ? 6
                                                : corners == 3 ? 3
                                                               : 4) &&
        distinct_corners(deck_, element).size() == corners)
      take(Numbers(element.nodes.begin(),
                   element.nodes.begin() + static_cast<std::ptrdiff_t>(corners)));
    else if (corners == 3)
      divide_in_plane(element);
    else
      divide(element);
  }

  DeckMesh mesh() {
    std::map<Numbers, std::pair<Numbers, int>> sides;
    for (const auto& [number, nodes] : mesh_.elements) {
      for (const DeckNumber node : nodes)
        if (!mesh_.nodes.contains(node))
          mesh_.nodes[node] = deck_point(deck_, node);
      for (const std::vector<int>& side : mechanics::face_nodes(kind_)) {
        Numbers corners;
        for (const int node : side)
          if (static_cast<std::size_t>(node) < corner_count())
            corners.push_back(nodes[static_cast<std::size_t>(node)]);
        Numbers key = corners;
        std::sort(key.begin(), key.end());
        auto& [face, uses] = sides[key];
        face = std::move(corners);
        ++uses;
      }
    }
    for (auto& [key, side] : sides)
      if (side.second == 1)
        mesh_.boundary.push_back(std::move(side.first));
    mesh_.middles = std::move(middles_);
    return std::move(mesh_);
  }

private:
  [[nodiscard]] std::size_t corner_count() const {
    return static_cast<std::size_t>(mechanics::corners_per_element(kind_));
  }

  /// The deck's own nodes in the middles of edges stay.
  void learn_middles(const DeckElement& element) {
    for (const DeckFace& face : faces_of(deck_, element, ""))
      for (std::size_t i = 0; i < face.middles.size(); ++i)
        middles_[edge_between(face.corners[i], face.corners[(i + 1) % face.corners.size()])] =
            face.middles[i];
  }

  DeckNumber middle(DeckNumber a, DeckNumber b) {
    const DeckMesh::Edge edge = edge_between(a, b);
    if (const auto known = middles_.find(edge); known != middles_.end())
      return known->second;
    const DeckNumber node = next_++;
    mesh_.nodes[node] = 0.5 * (deck_point(deck_, a) + deck_point(deck_, b));
    middles_[edge] = node;
    mesh_.added[edge] = node;
    return node;
  }

  void take(Numbers nodes) {
    for (const auto& [a, b] : mechanics::element_edges(kind_))
      nodes.push_back(
          middle(nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]));
    mesh_.elements.emplace_back(static_cast<DeckNumber>(mesh_.elements.size() + 1),
                                std::move(nodes));
  }

  /// Into tetrahedra from the corner with the lowest number, and faces into triangles from theirs:
  /// so neighbours divide the face between them in the same way.
  void divide(const DeckElement& element) {
    const DeckNumber apex = *distinct_corners(deck_, element).begin();
    for (const DeckFace& face : faces_of(deck_, element, "")) {
      Numbers corners;
      for (const DeckNumber corner : face.corners)
        if (std::find(corners.begin(), corners.end(), corner) == corners.end())
          corners.push_back(corner);
      if (corners.size() < 3 || std::find(corners.begin(), corners.end(), apex) != corners.end())
        continue;
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        Numbers tetrahedron{corners[0], corners[i], corners[i + 1], apex};
        if (volume(tetrahedron) < 0.0)
          std::swap(tetrahedron[1], tetrahedron[2]);
        take(std::move(tetrahedron));
      }
    }
  }

  void divide_in_plane(const DeckElement& element) {
    const DeckNumber apex = *distinct_corners(deck_, element).begin();
    for (const DeckFace& side : faces_of(deck_, element, "")) {
      const DeckNumber a = side.corners[0], b = side.corners[1];
      if (a != b && a != apex && b != apex)
        take({apex, a, b}); // the body is on the side's left
    }
  }

  [[nodiscard]] double volume(const Numbers& corners) const {
    const Vec3& a = deck_point(deck_, corners[0]);
    return (deck_point(deck_, corners[1]) - a)
        .cross(deck_point(deck_, corners[2]) - a)
        .dot(deck_point(deck_, corners[3]) - a);
  }

  const Deck& deck_;
  ElementKind kind_;
  DeckNumber next_ = 1;
  std::map<DeckMesh::Edge, DeckNumber> middles_;
  DeckMesh mesh_;
};

/// The types of a body's elements, and whether they are of one shape and one available kind.
struct Census {
  std::set<std::string> types, kinds;
  std::set<std::size_t> n_corners; ///< that are distinct
  bool bend = false;

  Census(const Deck& deck, const DeckBody& body) {
    for (const DeckNumber number : body.elements) {
      const DeckElement& element = deck.elements.at(number);
      types.insert(element.type);
      kinds.insert(kind_of(element));
      n_corners.insert(distinct_corners(deck, element).size());
      bend = bend || bends(element);
    }
  }
  [[nodiscard]] bool is_available() const {
    if (kinds.size() != 1 || bend)
      return false;
    const std::string& kind = *kinds.begin();
    return all_have(kind.starts_with("hex") ? 8 : kind.starts_with("tri") ? 3 : 4) && !kind.empty();
  }
  /// The kind that all become.
  [[nodiscard]] ElementKind becomes(bool plane) const {
    if (plane)
      return all_have(4) ? ElementKind::quad8 : ElementKind::tri6;
    return all_have(8) ? ElementKind::hex20 : ElementKind::tet10;
  }
  /// Elements are divided, not only given more nodes.
  [[nodiscard]] bool is_divided(ElementKind kind) const {
    return !all_have(static_cast<std::size_t>(mechanics::corners_per_element(kind)));
  }

private:
  [[nodiscard]] bool all_have(std::size_t corners) const { return n_corners == std::set{corners}; }
};

/// @throws Error (Fault::geometry)
void require_solids(const Deck& deck, const DeckBody& body) {
  const DeckElement& first = deck.elements.at(body.elements.front());
  for (const DeckNumber number : body.elements) {
    const std::string& type = deck.elements.at(number).type;
    if (!is_solid_type(type) || type.substr(0, 3) != first.type.substr(0, 3))
      throw Error(Fault::geometry, "",
                  fmt::format("the workpiece has elements of type {}, which are not available{}",
                              type, is_solid_type(type) ? " together with others" : ""),
                  "mesh it with C3D, CPE or CAX elements alone");
  }
}

std::string remark_on(const Census& census, ElementKind kind) {
  const std::string types = fmt::format("elements of type {}", fmt::join(census.types, ", "));
  const std::string_view name = mechanics::name(kind);
  if (census.is_divided(kind))
    return fmt::format("{} are divided into {}: a case has elements of one kind, and no wedges",
                       types, name);
  if (census.bend)
    return fmt::format("{} become {}, which bends without incompatible modes: nodes are added in "
                       "the middles of edges",
                       types, name);
  return fmt::format("{} become {}: nodes are added in the middles of edges", types, name);
}

} // namespace

std::vector<DeckNumber> DeckMesh::set_of(const std::vector<DeckNumber>& wanted) const {
  std::set<DeckNumber> members;
  for (const DeckNumber node : wanted)
    if (nodes.contains(node))
      members.insert(node);
  if (added.empty())
    return {members.begin(), members.end()};
  const auto is_member = [&](DeckNumber node) { return members.contains(node); };
  std::set<DeckNumber> of_faces, of_edges;
  for (const std::vector<DeckNumber>& face : boundary) {
    const bool is_whole = std::all_of(face.begin(), face.end(), is_member);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const DeckNumber a = face[i], b = face[(i + 1) % face.size()];
      const auto middle = added.find(edge_between(a, b));
      if (middle == added.end() || !is_member(a) || !is_member(b))
        continue;
      of_edges.insert(middle->second);
      if (is_whole)
        of_faces.insert(middle->second);
    }
  }
  const std::set<DeckNumber>& more = of_faces.empty() ? of_edges : of_faces;
  members.insert(more.begin(), more.end());
  return {members.begin(), members.end()};
}

std::vector<std::vector<DeckNumber>>
DeckMesh::sets_of_faces(const std::vector<std::set<DeckNumber>>& faces) const {
  using Set = std::set<DeckNumber>;
  std::map<DeckNumber, std::vector<std::size_t>> at_node; // faces of the surface
  for (std::size_t i = 0; i < boundary.size(); ++i)
    for (const DeckNumber node : boundary[i])
      at_node[node].push_back(i);
  std::map<DeckNumber, std::vector<const Set*>> asked_at;
  for (const Set& face : faces)
    for (const DeckNumber node : face)
      asked_at[node].push_back(&face);
  const auto is_asked_for = [&](const std::vector<DeckNumber>& face) {
    const auto around = asked_at.find(face.front());
    return around != asked_at.end() &&
           std::any_of(around->second.begin(), around->second.end(), [&](const Set* asked) {
             return std::all_of(face.begin(), face.end(),
                                [&](DeckNumber node) { return asked->contains(node); });
           });
  };
  std::vector<char> wanted(boundary.size());
  for (std::size_t i = 0; i < boundary.size(); ++i)
    wanted[i] = is_asked_for(boundary[i]) ? 1 : 0;
  // Whether a set with a face's nodes would hold a face of the surface that is not asked for.
  const auto takes_another = [&](const Set& set, const Set& face) {
    const auto is_in = [&](DeckNumber node) { return set.contains(node) || face.contains(node); };
    return std::any_of(face.begin(), face.end(), [&](DeckNumber node) {
      const auto around = at_node.find(node);
      return around != at_node.end() &&
             std::any_of(around->second.begin(), around->second.end(), [&](std::size_t i) {
               return wanted[i] == 0 && std::all_of(boundary[i].begin(), boundary[i].end(), is_in);
             });
    });
  };
  std::vector<Set> sets;
  for (const Set& face : faces) {
    auto place = std::find_if(sets.begin(), sets.end(),
                              [&](const Set& set) { return !takes_another(set, face); });
    if (place == sets.end())
      place = sets.insert(sets.end(), Set{});
    place->insert(face.begin(), face.end());
  }
  std::vector<std::vector<DeckNumber>> lists;
  lists.reserve(sets.size());
  for (Set& set : sets) {
    Set with_middles = set;
    for (std::size_t i = 0; i < boundary.size(); ++i)
      if (const std::vector<DeckNumber>& face = boundary[i]; std::all_of(
              face.begin(), face.end(), [&](DeckNumber node) { return set.contains(node); }))
        for (std::size_t c = 0; c < face.size(); ++c)
          if (const auto middle = middles.find(edge_between(face[c], face[(c + 1) % face.size()]));
              middle != middles.end())
            with_middles.insert(middle->second);
    lists.emplace_back(with_middles.begin(), with_middles.end());
  }
  return lists;
}

DeckMesh mesh_of(const Deck& deck, const DeckBody& body) {
  require_solids(deck, body);
  const Census census(deck, body);
  const DeckElement& first = deck.elements.at(body.elements.front());
  if (census.is_available()) {
    DeckMesh mesh;
    mesh.element = *census.kinds.begin();
    mesh.type = first.type;
    for (const DeckNumber node : body.nodes)
      mesh.nodes[node] = deck_point(deck, node);
    for (const DeckNumber number : body.elements) {
      const DeckElement& element = deck.elements.at(number);
      mesh.elements.emplace_back(number, element.nodes);
      for (const DeckFace& face : faces_of(deck, element, ""))
        for (std::size_t i = 0; i < face.middles.size(); ++i)
          mesh.middles[edge_between(face.corners[i], face.corners[(i + 1) % face.corners.size()])] =
              face.middles[i];
    }
    for (const DeckFace& face : boundary_of(deck, body))
      mesh.boundary.push_back(face.corners);
    return mesh;
  }
  const bool plane = is_plane_type(first.type);
  const ElementKind kind = census.becomes(plane);
  Converter converter(deck, body, kind);
  for (const DeckNumber number : body.elements)
    converter.add(deck.elements.at(number));
  DeckMesh mesh = converter.mesh();
  mesh.element = mechanics::name(kind);
  mesh.type = first.type.substr(0, 3) + std::to_string(mechanics::nodes_per_element(kind));
  mesh.remark = remark_on(census, kind);
  return mesh;
}

} // namespace billet::io
