#include "io/translate/face_turns.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/disjoint_sets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace billet::io {

namespace {

constexpr double flat_turn =
    0.2;                        ///< below it faces lie in one plane, to the rounding of a deck [°]
constexpr double alike = 2.5;   ///< turns whose ratio is not larger are alike
constexpr double as_wide = 4.0; ///< as that of the faces to the sides of an edge
constexpr double far_side = -0.34; ///< cosine between an edge and one across the face, both in turn

/// An edge as a face runs along it, with the body on its left.
struct Side {
  std::size_t face;
  std::size_t other; ///< the face beyond
  Vec3 from;
  Vec3 along;  ///< unit
  double turn; ///< to the other face, positive: convex [degrees]
};

class TurnFinder {
public:
  TurnFinder(const Deck& deck, const std::vector<DeckFace>& faces) : faces_(faces), deck_(deck) {
    for (const DeckFace& face : faces_)
      normals_.push_back(normal_of(face));
    pair_sides();
    find_planes();
  }

  [[nodiscard]] FaceTurns turns() {
    std::vector<char> inner(sides_.size());
    for (std::size_t i = 0; i < sides_.size(); i += 2)
      inner[i] = inner[i + 1] = static_cast<char>(is_inner(i));
    FaceTurns found;
    std::vector<double> curved, alone;
    for (std::size_t i = 0; i < sides_.size(); i += 2) {
      const double turn = std::abs(sides_[i].turn);
      if (turn < flat_turn || turn > sharp_turn)
        continue;
      const auto leads_to_inner = [&](std::size_t side) {
        const std::vector<std::size_t> next = continuations(side);
        return std::any_of(next.begin(), next.end(), [&](std::size_t k) { return inner[k] != 0; });
      };
      const bool is_curved = inner[i] != 0 || leads_to_inner(i) || leads_to_inner(i + 1);
      (is_curved ? curved : alone).push_back(turn);
    }
    if (!alone.empty())
      found.alone = *std::min_element(alone.begin(), alone.end());
    constexpr double margin = 0.8; // a curved part turns by less than this share of an edge
    for (const double turn : curved)
      if (found.alone == 0.0 || turn < margin * found.alone)
        found.curved = std::max(found.curved, turn);
    return found;
  }

private:
  [[nodiscard]] const Vec3& corner(const DeckFace& face, std::size_t i) const {
    return deck_point(deck_, face.corners[i % face.corners.size()]);
  }

  /// Of a quadrilateral: across both diagonals.
  [[nodiscard]] Vec3 normal_of(const DeckFace& face) const {
    const Vec3 a = corner(face, 2) - corner(face, 0);
    const Vec3 b = face.corners.size() > 3 ? Vec3(corner(face, 3) - corner(face, 1))
                                           : Vec3(corner(face, 2) - corner(face, 1));
    return a.cross(b).normalized();
  }

  /// Edges of two faces, seen from each: sides 2 k and 2 k + 1.
  void pair_sides() {
    using Use = std::pair<std::size_t, std::size_t>; // face, corner
    std::map<std::pair<DeckNumber, DeckNumber>, std::vector<Use>> uses;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const std::vector<DeckNumber>& corners = faces_[f].corners;
      for (std::size_t i = 0; i < corners.size(); ++i)
        uses[std::minmax(corners[i], corners[(i + 1) % corners.size()])].emplace_back(f, i);
    }
    for (const auto& [ends, both] : uses)
      if (both.size() == 2)
        add_pair(both[0].first, both[0].second, both[1].first, both[1].second);
  }

  void add_pair(std::size_t face, std::size_t i, std::size_t other, std::size_t k) {
    const bool same_way = faces_[face].corners[i] == faces_[other].corners[k];
    const Vec3 beyond = (same_way ? -1.0 : 1.0) * normals_[other];
    const Vec3 from = corner(faces_[face], i);
    const Vec3 along = (corner(faces_[face], i + 1) - from).normalized();
    const Vec3 across = normals_[face].cross(beyond);
    const double turn = std::atan2(across.dot(along), normals_[face].dot(beyond)) / degree;
    sides_.push_back({face, other, from, along, turn});
    sides_.push_back({other, face, from, same_way ? along : Vec3(-along), same_way ? -turn : turn});
  }

  /// Neighbours that do not turn make a plane.
  void find_planes() {
    geometry::DisjointSets planes(faces_.size());
    for (const Side& side : sides_)
      if (std::abs(side.turn) < flat_turn)
        planes.join(static_cast<std::int32_t>(side.face), static_cast<std::int32_t>(side.other));
    members_.resize(faces_.size());
    rims_.resize(faces_.size());
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      plane_.push_back(static_cast<std::size_t>(planes.root(static_cast<std::int32_t>(face))));
      members_[plane_.back()].push_back(face);
    }
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (std::abs(sides_[i].turn) >= flat_turn)
        rims_[plane_[sides_[i].face]].push_back(i);
  }

  /// Edges on the far side of the plane that a side belongs to, with a turn like its own.
  [[nodiscard]] std::vector<std::size_t> continuations(std::size_t side) const {
    const Side& own = sides_[side];
    std::vector<std::size_t> found;
    for (const std::size_t next : rims_[plane_[own.face]]) {
      const double ratio = sides_[next].turn / own.turn;
      if (next / 2 != side / 2 && ratio > 1.0 / alike && ratio < alike &&
          sides_[next].along.dot(own.along) < far_side)
        found.push_back(next);
    }
    return found;
  }

  /// How far the plane that a side belongs to reaches from it.
  [[nodiscard]] double width(const Side& side) const {
    double width = 0.0;
    for (const std::size_t face : members_[plane_[side.face]])
      for (const DeckNumber node : faces_[face].corners)
        width = std::max(width, (deck_point(deck_, node) - side.from).cross(side.along).norm());
    return width;
  }

  [[nodiscard]] bool is_inner(std::size_t side) const {
    const Side &one = sides_[side], &other = sides_[side + 1];
    if (std::abs(one.turn) < flat_turn || std::abs(one.turn) > sharp_turn ||
        continuations(side).empty() || continuations(side + 1).empty())
      return false;
    const double a = width(one), b = width(other);
    return a < as_wide * b && b < as_wide * a;
  }

  const std::vector<DeckFace>& faces_;
  const Deck& deck_;
  std::vector<Vec3> normals_;
  std::vector<Side> sides_;
  std::vector<std::size_t> plane_;                ///< of each face
  std::vector<std::vector<std::size_t>> members_; ///< faces of each plane
  std::vector<std::vector<std::size_t>> rims_;    ///< sides around each plane
};

} // namespace

double FaceTurns::feature_angle() const {
  return alone == 0.0 ? sharp_turn : 0.5 * (curved + alone);
}

FaceTurns turns_between(const Deck& deck, const std::vector<DeckFace>& faces) {
  return TurnFinder(deck, faces).turns();
}

} // namespace billet::io
