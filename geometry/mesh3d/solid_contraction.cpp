#include "geometry/mesh3d/solid_contraction.h"

#include "geometry/base/index.h"
#include "geometry/mesh3d/solid_reconnection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

using Tetrahedron = SolidStars::Tetrahedron;
using Facet = PatchedSolid::Facet;

constexpr int most_rounds_of_contraction = 8; ///< through all poor tetrahedra
constexpr double worth_it = 1e-3;             ///< of quality, that a change must gain
constexpr double most_length =
    1.4; ///< of an edge that may come of a contraction, over the size there
constexpr double least_turn = 0.8;          ///< cosine of the angle by which facets may turn
constexpr double least_turn_of_line = 0.95; ///< the same for a line, at a node that moves along it

bool among(const auto& corners, std::int32_t node) {
  return std::find(corners.begin(), corners.end(), node) != corners.end();
}

class Tidier {
public:
  Tidier(PatchedSolid& solid,
         const std::vector<Vec3>& corners,
         const SpaceSize& size,
         double wanted)
      : solid_(solid), size_(size), wanted_(wanted), stars_(solid.mesh),
        facets_at_(solid.mesh.points.size()), edges_at_(solid.mesh.points.size()),
        stays_(solid.mesh.points.size(), 0) {
    for (std::size_t node = 0; node < stays_.size(); ++node)
      if (std::find(corners.begin(), corners.end(), solid.mesh.points[node]) != corners.end())
        stays_[node] = 1;
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
      for (const std::int32_t node : solid.facets[f].corners)
        facets_at_[idx(node)].push_back(f);
    for (std::size_t i = 0; i < solid.edges.size(); ++i)
      for (const std::int32_t node : solid.edges[i].corners)
        edges_at_[idx(node)].push_back(i);
  }

  void run() {
    bool better = true;
    for (int round = 0; round < most_rounds_of_contraction && better; ++round) {
      better = false;
      for (std::size_t e = 0; e < stars_.size(); ++e)
        if (stars_.is_there(e) && stars_.quality(e) < wanted_)
          better = reconnect(e) || contract_one_of(e) || better;
    }
    stars_.close();
    std::erase_if(solid_.facets, [](const Facet& facet) { return facet.corners[0] < 0; });
    forget_lost_nodes();
  }

private:
  struct Contraction {
    std::int32_t from, to;
    double worst;
  };

  [[nodiscard]] const Vec3& at(std::int32_t node) const { return solid_.mesh.points[idx(node)]; }

  bool reconnect(std::size_t e) {
    const std::optional<Reconnection> better = reconnection(stars_, e);
    if (better)
      stars_.replace(better->old, better->fresh);
    return better.has_value();
  }

  bool contract_one_of(std::size_t e) {
    std::optional<Contraction> best;
    for (const std::int32_t from : stars_[e])
      for (const std::int32_t to : stars_[e])
        if (from != to)
          if (const auto next = contraction(from, to); next && (!best || next->worst > best->worst))
            best = next;
    if (best)
      contract(*best);
    return best.has_value();
  }

  /// None if it may not be or makes nothing better.
  [[nodiscard]] std::optional<Contraction> contraction(std::int32_t from, std::int32_t to) const {
    const bool inside = facets_at_[idx(from)].empty();
    if (stays_[idx(from)] != 0 || !(inside || (keeps_line(from, to) && keeps_patches(from, to))))
      return std::nullopt;
    double before = std::numeric_limits<double>::infinity();
    for (const std::size_t e : stars_.around(from))
      before = std::min(before, stars_.quality(e));
    Contraction result{from, to, std::numeric_limits<double>::infinity()};
    for (const std::size_t e : stars_.around(from)) {
      if (among(stars_[e], to))
        continue;
      Tetrahedron corners = stars_[e];
      std::replace(corners.begin(), corners.end(), from, to);
      result.worst = std::min(result.worst, stars_.quality(corners));
      if (!(result.worst > before + worth_it) || is_too_long(corners, to))
        return std::nullopt;
    }
    return result;
  }

  [[nodiscard]] bool is_too_long(const Tetrahedron& corners, std::int32_t to) const {
    return std::any_of(corners.begin(), corners.end(), [&](std::int32_t node) {
      return (at(node) - at(to)).norm() > most_length * size_(0.5 * (at(node) + at(to)));
    });
  }

  [[nodiscard]] Vec3 area(const std::array<std::int32_t, 3>& corners) const {
    return (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0]));
  }

  [[nodiscard]] std::int32_t other_end(std::size_t edge, std::int32_t node) const {
    const auto& [a, b] = solid_.edges[edge].corners;
    return a == node ? b : a;
  }

  /// Whether a node is on no line, or goes along the only one that it is on, and neither from its
  /// end nor from where it turns.
  [[nodiscard]] bool keeps_line(std::int32_t from, std::int32_t to) const {
    const std::vector<std::size_t>& edges = edges_at_[idx(from)];
    if (edges.empty())
      return true;
    if (edges.size() != 2 || solid_.edges[edges[0]].line != solid_.edges[edges[1]].line)
      return false;
    const std::int32_t a = other_end(edges[0], from), b = other_end(edges[1], from);
    const Vec3 before = at(from) - at(a), after = at(b) - at(from);
    return (to == a || to == b) && before.normalized().dot(after.normalized()) > least_turn_of_line;
  }

  /// Whether a node of the boundary goes along an edge of it, and patches stay surfaces that turn
  /// little; of a node on a line those to either side.
  [[nodiscard]] bool keeps_patches(std::int32_t from, std::int32_t to) const {
    std::map<std::int32_t, Vec3> normals;
    int beside = 0;
    std::set<std::int32_t> around;
    for (const std::size_t f : facets_at_[idx(from)]) {
      const Facet& facet = solid_.facets[f];
      normals.try_emplace(facet.patch, Vec3::Zero()).first->second += area(facet.corners);
      beside += among(facet.corners, to) ? 1 : 0;
      around.insert(facet.corners.begin(), facet.corners.end());
    }
    const std::size_t most_patches = edges_at_[idx(from)].empty() ? 1 : 2;
    if (beside != 2 || normals.size() > most_patches || shared_neighbours(from, to, around) != 2)
      return false;
    for (const std::size_t f : facets_at_[idx(from)]) {
      std::array<std::int32_t, 3> corners = solid_.facets[f].corners;
      if (among(corners, to))
        continue;
      std::replace(corners.begin(), corners.end(), from, to);
      const Vec3 normal = normals.at(solid_.facets[f].patch).normalized();
      if (!(area(corners).normalized().dot(normal) > least_turn))
        return false;
    }
    return true;
  }

  /// Nodes of the boundary that have an edge with both; more than two: it would touch itself.
  [[nodiscard]] std::size_t shared_neighbours(std::int32_t from,
                                              std::int32_t to,
                                              const std::set<std::int32_t>& around) const {
    std::set<std::int32_t> shared;
    for (const std::size_t f : facets_at_[idx(to)])
      for (const std::int32_t node : solid_.facets[f].corners)
        if (node != from && node != to && around.contains(node))
          shared.insert(node);
    return shared.size();
  }

  void contract(const Contraction& way) {
    const std::vector<std::size_t> old = stars_.around(way.from);
    std::vector<Tetrahedron> fresh;
    for (const std::size_t e : old)
      if (!among(stars_[e], way.to)) {
        fresh.push_back(stars_[e]);
        std::replace(fresh.back().begin(), fresh.back().end(), way.from, way.to);
      }
    stars_.replace(old, fresh);
    contract_line(way);
    for (const std::size_t f : std::exchange(facets_at_[idx(way.from)], {})) {
      std::array<std::int32_t, 3>& corners = solid_.facets[f].corners;
      if (among(corners, way.to)) {
        for (const std::int32_t node : corners)
          std::erase(facets_at_[idx(node)], f);
        corners.fill(-1);
      } else {
        std::replace(corners.begin(), corners.end(), way.from, way.to);
        facets_at_[idx(way.to)].push_back(f);
      }
    }
  }

  void contract_line(const Contraction& way) {
    for (const std::size_t edge : std::exchange(edges_at_[idx(way.from)], {})) {
      std::array<std::int32_t, 2>& corners = solid_.edges[edge].corners;
      if (among(corners, way.to)) {
        std::erase(edges_at_[idx(way.to)], edge);
        corners.fill(-1);
      } else {
        const std::int32_t other = other_end(edge, way.from);
        corners = {std::min(other, way.to), std::max(other, way.to)};
        edges_at_[idx(way.to)].push_back(edge);
      }
    }
  }

  void forget_lost_nodes() {
    std::vector<std::int32_t> number(solid_.mesh.points.size(), -1);
    std::int32_t n = 0;
    for (std::size_t node = 0; node < number.size(); ++node)
      if (!stars_.around(static_cast<std::int32_t>(node)).empty()) {
        solid_.mesh.points[idx(n)] = solid_.mesh.points[node];
        number[node] = n++;
      }
    solid_.mesh.points.resize(idx(n));
    const auto renumber = [&](auto& corners) {
      for (std::int32_t& node : corners)
        node = number[idx(node)];
    };
    for (Tetrahedron& corners : solid_.mesh.tetrahedra)
      renumber(corners);
    for (Facet& facet : solid_.facets)
      renumber(facet.corners);
    std::erase_if(solid_.edges,
                  [](const PatchedSolid::LineEdge& edge) { return edge.corners[0] < 0; });
    for (PatchedSolid::LineEdge& edge : solid_.edges)
      renumber(edge.corners);
    std::sort(solid_.edges.begin(), solid_.edges.end(),
              [](const auto& p, const auto& q) { return p.corners < q.corners; });
  }

  PatchedSolid& solid_;
  const SpaceSize& size_;
  double wanted_;
  SolidStars stars_;
  std::vector<std::vector<std::size_t>> facets_at_; ///< of the boundary, by their nodes
  std::vector<std::vector<std::size_t>> edges_at_;  ///< on lines, by their nodes
  std::vector<char> stays_;                         ///< of the nodes
};

} // namespace

void tidy(PatchedSolid& solid,
          const std::vector<Vec3>& corners,
          const SpaceSize& size,
          double wanted) {
  Tidier(solid, corners, size, wanted).run();
}

} // namespace billet::geometry
