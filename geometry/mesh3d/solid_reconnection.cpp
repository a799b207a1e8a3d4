#include "geometry/mesh3d/solid_reconnection.h"

#include "geometry/base/index.h"
#include "geometry/mesh3d/solid_quality.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace billet::geometry {

namespace {

using Tetrahedron = SolidStars::Tetrahedron;

constexpr double least_gain = 1e-3;     ///< of quality that is worth a change
constexpr std::size_t longest_ring = 8; ///< of tetrahedra around an edge that may go

bool has(const Tetrahedron& corners, std::int32_t node) {
  return std::find(corners.begin(), corners.end(), node) != corners.end();
}

/// Corners in another order that turns the same way round: a and b first.
Tetrahedron with_edge_first(const Tetrahedron& corners, std::int32_t a, std::int32_t b) {
  Tetrahedron sorted = corners;
  const auto bring = [&](std::int32_t node, std::size_t to) {
    const auto at =
        static_cast<std::size_t>(std::find(sorted.begin(), sorted.end(), node) - sorted.begin());
    if (at == to)
      return;
    // Two swaps keep the sense; the second one is of corners not yet placed.
    std::swap(sorted[at], sorted[to]);
    std::swap(sorted[2], sorted[3]);
  };
  bring(a, 0);
  bring(b, 1);
  return sorted;
}

/// Tetrahedra around an edge and the nodes of the ring they make, in the sense of the edge's turn.
struct Ring {
  std::vector<std::size_t> tetrahedra;
  std::vector<std::int32_t> nodes;
};

/// None for an edge of the boundary, or if the ring is too long.
std::optional<Ring> ring_around(const SolidStars& stars, std::int32_t a, std::int32_t b) {
  Ring ring;
  std::vector<std::array<std::int32_t, 2>> sides;
  for (const std::size_t e : stars.around(a))
    if (has(stars[e], b)) {
      ring.tetrahedra.push_back(e);
      const Tetrahedron corners = with_edge_first(stars[e], a, b);
      sides.push_back({corners[2], corners[3]});
    }
  if (sides.size() < 3 || sides.size() > longest_ring)
    return std::nullopt;
  std::int32_t node = sides.front()[0];
  for (std::size_t i = 0; i < sides.size(); ++i) {
    ring.nodes.push_back(node);
    const auto next =
        std::find_if(sides.begin(), sides.end(), [&](const auto& side) { return side[0] == node; });
    if (next == sides.end())
      return std::nullopt;
    node = (*next)[1];
  }
  if (node != ring.nodes.front())
    return std::nullopt;
  return ring;
}

double worst_of(const SolidStars& stars, const std::vector<std::size_t>& tetrahedra) {
  double worst = std::numeric_limits<double>::infinity();
  for (const std::size_t e : tetrahedra)
    worst = std::min(worst, stars.quality(e));
  return worst;
}

/// Triangles over a ring of nodes, each the base of a tetrahedron to either end of the edge: those
/// with the best worst tetrahedron. (Klincsek 1980; G.52)
class RingTriangles {
public:
  RingTriangles(const SolidStars& stars,
                const std::vector<std::int32_t>& ring,
                std::int32_t a,
                std::int32_t b)
      : ring_(ring), a_(a), b_(b) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      best_[i][i + 1] = std::numeric_limits<double>::infinity();
    for (std::size_t length = 2; length < n; ++length)
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        best_[i][j] = -std::numeric_limits<double>::infinity();
        for (std::size_t k = i + 1; k < j; ++k) {
          double worst = std::min(best_[i][k], best_[k][j]);
          if (worst <= best_[i][j])
            continue;
          for (const Tetrahedron& corners : pair(i, k, j))
            worst = std::min(worst, stars.quality(corners));
          if (worst > best_[i][j]) {
            best_[i][j] = worst;
            top_[i][j] = k;
          }
        }
      }
  }

  [[nodiscard]] double worst() const { return best_[0][ring_.size() - 1]; }
  [[nodiscard]] std::vector<Tetrahedron> tetrahedra() const {
    std::vector<Tetrahedron> result;
    add(0, ring_.size() - 1, result);
    return result;
  }

private:
  [[nodiscard]] std::array<Tetrahedron, 2> pair(std::size_t i, std::size_t k, std::size_t j) const {
    return {{{ring_[i], ring_[k], ring_[j], b_}, {ring_[i], ring_[j], ring_[k], a_}}};
  }

  void add(std::size_t i, std::size_t j, std::vector<Tetrahedron>& to) const {
    if (j < i + 2)
      return;
    const std::size_t k = top_[i][j];
    for (const Tetrahedron& corners : pair(i, k, j))
      to.push_back(corners);
    add(i, k, to);
    add(k, j, to);
  }

  const std::vector<std::int32_t>& ring_;
  std::int32_t a_, b_;
  std::array<std::array<double, longest_ring>, longest_ring> best_{};
  std::array<std::array<std::size_t, longest_ring>, longest_ring> top_{};
};

std::optional<Reconnection>
without_edge(const SolidStars& stars, std::int32_t a, std::int32_t b, double at_least) {
  const std::optional<Ring> ring = ring_around(stars, a, b);
  if (!ring)
    return std::nullopt;
  at_least = std::max(at_least, worst_of(stars, ring->tetrahedra) + least_gain);
  const RingTriangles triangles(stars, ring->nodes, a, b);
  if (!(triangles.worst() > at_least))
    return std::nullopt;
  return Reconnection{ring->tetrahedra, triangles.tetrahedra(), triangles.worst()};
}

/// Two tetrahedra at a face give way to three around an edge from one tip to the other.
std::optional<Reconnection>
without_face(const SolidStars& stars, std::size_t e, std::size_t tip, double at_least) {
  constexpr std::array<std::array<std::size_t, 3>, 4> opposite{
      {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
  std::array<std::int32_t, 3> face{};
  for (std::size_t i = 0; i < 3; ++i)
    face[i] = stars[e][opposite[tip][i]];
  for (const std::size_t other : stars.around(face[0])) {
    if (other == e || !has(stars[other], face[1]) || !has(stars[other], face[2]))
      continue;
    std::int32_t beyond = -1;
    for (const std::int32_t node : stars[other])
      if (std::find(face.begin(), face.end(), node) == face.end())
        beyond = node;
    Reconnection result{{e, other}, {}, std::numeric_limits<double>::infinity()};
    at_least = std::max(at_least, worst_of(stars, result.old) + least_gain);
    for (std::size_t i = 0; i < 3; ++i) {
      result.fresh.push_back({face[i], face[(i + 1) % 3], beyond, stars[e][tip]});
      result.worst = std::min(result.worst, stars.quality(result.fresh.back()));
      if (!(result.worst > at_least))
        return std::nullopt;
    }
    return result;
  }
  return std::nullopt; // a face of the boundary
}

} // namespace

SolidStars::SolidStars(SolidMesh& mesh) : mesh_(mesh), around_(mesh.points.size()) {
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
    for (const std::int32_t node : mesh.tetrahedra[e])
      around_[idx(node)].push_back(e);
}

double SolidStars::quality(std::size_t e) const { return quality(mesh_.tetrahedra[e]); }

double SolidStars::quality(const Tetrahedron& corners) const {
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    x[i] = mesh_.points[idx(corners[i])];
  return shape_quality(x);
}

void SolidStars::replace(const std::vector<std::size_t>& old,
                         const std::vector<Tetrahedron>& fresh) {
  for (const std::size_t e : old) {
    for (const std::int32_t node : mesh_.tetrahedra[e])
      std::erase(around_[idx(node)], e);
    mesh_.tetrahedra[e].fill(-1);
  }
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const std::size_t e = i < old.size() ? old[i] : mesh_.tetrahedra.size();
    if (e == mesh_.tetrahedra.size())
      mesh_.tetrahedra.emplace_back();
    mesh_.tetrahedra[e] = fresh[i];
    for (const std::int32_t node : fresh[i])
      around_[idx(node)].push_back(e);
  }
}

void SolidStars::close() {
  std::erase_if(mesh_.tetrahedra, [](const Tetrahedron& corners) { return corners[0] < 0; });
}

std::optional<Reconnection> reconnection(const SolidStars& stars, std::size_t e) {
  std::optional<Reconnection> best;
  const auto take = [&](std::optional<Reconnection> next) {
    if (next)
      best = std::move(next);
  };
  const auto at_least = [&] {
    return best ? best->worst : -std::numeric_limits<double>::infinity();
  };
  const Tetrahedron corners = stars[e];
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      take(without_edge(stars, corners[j], corners[i], at_least()));
  for (std::size_t tip = 0; tip < 4; ++tip)
    take(without_face(stars, e, tip, at_least()));
  return best;
}

} // namespace billet::geometry
