#include "io/translate/deck_bodies.h"

#include "geometry/base/error.h"
#include "geometry/triangles/disjoint_sets.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>

namespace billet::io {

namespace {

/// Sides of an element by the places of their corners in its list of nodes.
using Sides = std::vector<std::vector<std::size_t>>;

struct ElementShape {
  std::size_t corners;
  Sides sides;
  Sides edges; ///< in the order of the nodes in their middles
};

/// Decks number the nodes of bricks and tetrahedra as we do.
Sides edges_of(mechanics::ElementKind kind) {
  Sides edges;
  for (const auto& [a, b] : mechanics::element_edges(kind))
    edges.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b)});
  return edges;
}

const ElementShape& hexahedron() {
  static const ElementShape shape{
      8,
      {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}},
      edges_of(mechanics::ElementKind::hex20)};
  return shape;
}

const ElementShape& wedge() {
  static const ElementShape shape{
      6,
      {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
      {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
  return shape;
}

const ElementShape& tetrahedron() {
  static const ElementShape shape{
      4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, edges_of(mechanics::ElementKind::tet10)};
  return shape;
}

const ElementShape& polygon(std::size_t n, bool is_facet) {
  static const ElementShape triangle{3, {{0, 1}, {1, 2}, {2, 0}}, {{0, 1}, {1, 2}, {2, 0}}};
  static const ElementShape quadrilateral{
      4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static const ElementShape facet3{3, {{0, 1, 2}}, {{0, 1}, {1, 2}, {2, 0}}};
  static const ElementShape facet4{4, {{0, 1, 2, 3}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  if (is_facet)
    return n == 3 ? facet3 : facet4;
  return n == 3 ? triangle : quadrilateral;
}

const ElementShape& line() {
  static const ElementShape shape{2, {{0, 1}}, {{0, 1}}};
  return shape;
}

bool starts_with_any(const std::string& type, std::initializer_list<const char*> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char* beginning) { return type.starts_with(beginning); });
}

bool is_facet_type(const std::string& type) {
  return starts_with_any(type, {"R3D", "M3D", "S3", "S4", "S6", "S8", "SFM3D"});
}

/// None: what has no faces.
const ElementShape* shape_of(const DeckElement& element) {
  const std::size_t n = element.nodes.size();
  if (element.type.starts_with("C3D"))
    return n == 8 || n == 20 || n == 27 ? &hexahedron()
           : n == 6 || n == 15          ? &wedge()
           : n == 4 || n == 10          ? &tetrahedron()
                                        : nullptr;
  if (starts_with_any(element.type, {"R2D2", "RAX2"}))
    return &line();
  const std::size_t corners = n == 3 || n == 6 ? 3 : 4;
  if (is_facet_type(element.type))
    return &polygon(corners, true);
  return is_plane_type(element.type) ? &polygon(corners, false) : nullptr;
}

Vec3 centre_of(const Deck& deck, const std::vector<DeckNumber>& nodes, std::size_t n) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i)
    sum += deck_point(deck, nodes[i]);
  return sum / static_cast<double>(n);
}

/// Turns the face round, middles with it.
void reverse_face(DeckFace& face) {
  std::reverse(face.corners.begin(), face.corners.end());
  if (face.middles.size() > 1)
    std::reverse(face.middles.begin(), face.middles.end() - 1);
}

/// Whether the element lies on the outer side of the face.
bool looks_inward(const Deck& deck, const DeckElement& element, const DeckFace& face) {
  const ElementShape& shape = *shape_of(element);
  const Vec3 inside = centre_of(deck, element.nodes, shape.corners);
  const Vec3 a = deck_point(deck, face.corners[0]), b = deck_point(deck, face.corners[1]);
  if (face.corners.size() == 2) { // the body on the left
    const Vec3 along = b - a, to = inside - a;
    return along.x() * to.y() - along.y() * to.x() < 0.0;
  }
  const Vec3 c = deck_point(deck, face.corners[2]);
  return (b - a).cross(c - a).dot(inside - a) > 0.0;
}

DeckFace
face_of(const Deck& deck, const DeckElement& element, const std::vector<std::size_t>& side) {
  const ElementShape& shape = *shape_of(element);
  DeckFace face;
  for (const std::size_t corner : side)
    face.corners.push_back(element.nodes[corner]);
  if (element.nodes.size() >= shape.corners + shape.edges.size()) // more: inside of faces
    for (std::size_t i = 0; i < (side.size() == 2 ? 1 : side.size()); ++i) {
      const std::size_t from = side[i], to = side[(i + 1) % side.size()];
      for (std::size_t e = 0; e < shape.edges.size(); ++e)
        if ((shape.edges[e][0] == from && shape.edges[e][1] == to) ||
            (shape.edges[e][0] == to && shape.edges[e][1] == from))
          face.middles.push_back(element.nodes[shape.corners + e]);
    }
  const bool has_inside = side.size() != shape.corners;
  if (has_inside && looks_inward(deck, element, face))
    reverse_face(face);
  return face;
}

/// Takes out corners that are given twice, of elements that collapse. False: nothing is left.
bool clean(DeckFace& face) {
  const std::size_t least = face.corners.size() == 2 ? 2 : 3;
  std::vector<DeckNumber> corners;
  for (const DeckNumber corner : face.corners)
    if (std::find(corners.begin(), corners.end(), corner) == corners.end())
      corners.push_back(corner);
  if (corners.size() != face.corners.size())
    face.middles.clear();
  face.corners = std::move(corners);
  return face.corners.size() >= least;
}

/// One node for all that lie on each other: meshes of parts that were joined without merging.
std::map<DeckNumber, DeckNumber> merged_nodes(const Deck& deck, const DeckBody& body) {
  constexpr double same = 1e-7; // of the body's size
  Vec3 low = deck_point(deck, *body.nodes.begin()), high = low;
  for (const DeckNumber node : body.nodes) {
    low = low.cwiseMin(deck_point(deck, node));
    high = high.cwiseMax(deck_point(deck, node));
  }
  const double step = std::max(same * (high - low).maxCoeff(), std::numeric_limits<double>::min());
  std::map<std::array<std::int64_t, 3>, DeckNumber> by_place;
  std::map<DeckNumber, DeckNumber> merged;
  for (const DeckNumber node : body.nodes) {
    const Vec3 at = (deck_point(deck, node) - low) / step;
    const std::array<std::int64_t, 3> place{std::llround(at[0]), std::llround(at[1]),
                                            std::llround(at[2])};
    merged[node] = by_place.try_emplace(place, node).first->second;
  }
  return merged;
}

bool holds_all(const std::vector<DeckNumber>& set, const std::vector<DeckNumber>& members) {
  std::vector<DeckNumber> sorted = set;
  std::sort(sorted.begin(), sorted.end());
  return std::includes(sorted.begin(), sorted.end(), members.begin(), members.end());
}

/// The smallest set of elements that holds a body.
std::string name_of_body(const Deck& deck, const DeckBody& body, std::size_t number) {
  std::string best = "body-" + std::to_string(number + 1);
  std::size_t smallest = deck.elements.size() + 1;
  for (const auto& [key, members] : deck.element_sets)
    if (members.size() >= body.elements.size() && members.size() < smallest &&
        holds_all(members, body.elements)) {
      smallest = members.size();
      const auto written = deck.names.find(key);
      best = written == deck.names.end() ? key : written->second;
    }
  return smallest == body.elements.size() ? best : "body-" + std::to_string(number + 1);
}

/// @throws Error (Fault::geometry) for an element with fewer nodes than corners, or without its
/// nodes
void require_corners(const Deck& deck) {
  for (const auto& [number, element] : deck.elements) {
    const ElementShape* const shape = shape_of(element);
    if (shape == nullptr)
      continue;
    if (element.nodes.size() < shape->corners)
      throw Error(Fault::geometry, "",
                  fmt::format("element {} of type {} has {} nodes, its corners are {}", number,
                              element.type, element.nodes.size(), shape->corners));
    for (const DeckNumber node : element.nodes)
      if (!deck.nodes.contains(node))
        throw Error(Fault::geometry, "",
                    fmt::format("element {} names node {}, which is not there", number, node));
  }
}

const DeckRigidBody* rigid_body_of(const Deck& deck, const DeckBody& body) {
  for (const DeckRigidBody& rigid : deck.rigid_bodies) {
    if (!rigid.elements.empty() && holds_all(deck.elements_of(rigid.elements), body.elements))
      return &rigid;
    const std::vector<DeckNumber> nodes(body.nodes.begin(), body.nodes.end());
    if (!rigid.nodes.empty() && holds_all(deck.nodes_of(rigid.nodes), nodes))
      return &rigid;
  }
  return nullptr;
}

/// Facets that surfaces in contact name by one of their sides, "SPOS" or "SNEG".
std::set<DeckNumber> facets_by_side(const Deck& deck, const std::string& side) {
  std::set<DeckNumber> facets;
  for (const DeckPair& pair : deck.pairs)
    for (const std::string& name : {pair.slave, pair.master})
      if (const auto surface = deck.surfaces.find(name); surface != deck.surfaces.end())
        for (const auto& [elements, label] : surface->second.members)
          if (label == side)
            for (const DeckNumber number : deck.elements_of(elements))
              facets.insert(number);
  return facets;
}

/// The side of facets that is in contact; of both, the positive one.
void find_sides(const Deck& deck, std::vector<DeckBody>& bodies) {
  const std::set<DeckNumber> positive = facets_by_side(deck, "SPOS");
  for (const DeckNumber number : facets_by_side(deck, "SNEG"))
    for (DeckBody& body : bodies)
      if (std::binary_search(body.elements.begin(), body.elements.end(), number)) {
        if (positive.contains(number))
          body.two_sided = true;
        else
          body.negative.insert(number);
      }
}

} // namespace

const Vec3& deck_point(const Deck& deck, DeckNumber node) {
  const auto found = deck.nodes.find(node);
  if (found == deck.nodes.end())
    throw Error(Fault::geometry, "", fmt::format("node {} is not there", node));
  return found->second;
}

bool has_faces(const DeckElement& element) { return shape_of(element) != nullptr; }

bool is_plane_type(const std::string& type) {
  return starts_with_any(type, {"CPE", "CPS", "CAX", "R2D2", "RAX2"});
}

std::vector<DeckBody> deck_bodies(const Deck& deck) {
  require_corners(deck);
  std::map<DeckNumber, std::int32_t> places;
  for (const auto& [number, point] : deck.nodes)
    places.emplace(number, static_cast<std::int32_t>(places.size()));
  geometry::DisjointSets groups(places.size());
  for (const auto& [number, element] : deck.elements)
    if (has_faces(element))
      for (const DeckNumber node : element.nodes)
        groups.join(places.at(node), places.at(element.nodes.front()));
  std::map<std::int32_t, DeckBody> by_group;
  for (const auto& [number, element] : deck.elements)
    if (has_faces(element)) {
      DeckBody& body = by_group[groups.root(places.at(element.nodes.front()))];
      body.elements.push_back(number);
      body.nodes.insert(element.nodes.begin(), element.nodes.end());
    }
  std::vector<DeckBody> bodies;
  for (auto& [group, body] : by_group) {
    body.name = name_of_body(deck, body, bodies.size());
    if (const auto material = deck.material_of.find(body.elements.front());
        material != deck.material_of.end())
      body.material = material->second;
    body.rigid = rigid_body_of(deck, body);
    bodies.push_back(std::move(body));
  }
  find_sides(deck, bodies);
  return bodies;
}

std::vector<DeckFace>
faces_of(const Deck& deck, const DeckElement& element, const std::string& label) {
  const ElementShape* const shape = shape_of(element);
  std::vector<DeckFace> faces;
  if (shape == nullptr)
    return faces;
  const bool is_numbered = label.size() == 2 && label[0] == 'S' && label[1] >= '1';
  for (std::size_t i = 0; i < shape->sides.size(); ++i)
    if (!is_numbered || shape->sides.size() == 1 || static_cast<std::size_t>(label[1] - '1') == i)
      faces.push_back(face_of(deck, element, shape->sides[i]));
  return faces;
}

std::vector<DeckFace> boundary_of(const Deck& deck, const DeckBody& body) {
  const std::map<DeckNumber, DeckNumber> merged = merged_nodes(deck, body);
  std::map<std::vector<DeckNumber>, std::pair<DeckFace, int>> all;
  for (const DeckNumber number : body.elements)
    for (DeckFace& face : faces_of(deck, deck.elements.at(number), "")) {
      for (auto* nodes : {&face.corners, &face.middles})
        for (DeckNumber& node : *nodes)
          node = merged.at(node);
      if (!clean(face))
        continue;
      if (face.corners.size() > 2 && body.negative.contains(number))
        reverse_face(face);
      std::vector<DeckNumber> key = face.corners;
      std::sort(key.begin(), key.end());
      auto& entry = all[key];
      entry.first = std::move(face);
      ++entry.second;
    }
  std::vector<DeckFace> faces;
  for (auto& [key, entry] : all)
    if (entry.second == 1)
      faces.push_back(std::move(entry.first));
  return faces;
}

} // namespace billet::io
