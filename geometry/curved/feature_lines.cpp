#include "geometry/curved/feature_lines.h"

#include "geometry/base/index.h"
#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

/// A chain that turns by more at a point has a corner there.
constexpr double line_corner_turn = std::numbers::pi / 4.0;

/// An edge that stays.
struct Marked {
  std::array<std::int32_t, 2> ends; ///< the smaller number first
  std::int32_t triangle, side;
  std::vector<std::int32_t> triangles; ///< adjacent to it
  bool crease;                         ///< stays only because it is sharp
  bool used = false;
};

class LineFinder {
public:
  LineFinder(const SolidBoundary& boundary, const CornerNormals& normals, double short_crease)
      : boundary_(boundary), short_crease_(short_crease), edges_at_(boundary.mesh.points.size()) {
    mark(normals);
    drop_short_creases();
  }

  [[nodiscard]] FeatureLines find() && {
    find_patches();
    // Chains between corners first; what is left then are loops.
    for (std::size_t p = 0; p < edges_at_.size(); ++p)
      if (is_corner(static_cast<std::int32_t>(p)))
        for (const std::size_t edge : live(static_cast<std::int32_t>(p)))
          if (!marked_[edge].used)
            walk(static_cast<std::int32_t>(p), edge);
    for (std::size_t edge = 0; edge < marked_.size(); ++edge)
      if (!dropped_[edge] && !marked_[edge].used)
        walk(marked_[edge].ends[0], edge);
    for (std::size_t p = 0; p < edges_at_.size(); ++p)
      if (boundary_.keep[p] != 0 && live(static_cast<std::int32_t>(p)).empty())
        lines_.lone_corners.push_back(static_cast<std::int32_t>(p));
    return std::move(lines_);
  }

private:
  void mark(const CornerNormals& normals) {
    const std::set<std::array<std::int32_t, 2>> wanted(boundary_.lines.begin(),
                                                       boundary_.lines.end());
    uses_ = edge_uses(boundary_.mesh);
    for_each_edge(uses_, [&](std::span<const EdgeUse> uses) {
      const EdgeUse& first = uses[0];
      std::set<std::int32_t> parts;
      std::vector<std::int32_t> triangles;
      for (const EdgeUse& use : uses) {
        parts.insert(boundary_.part[idx(use.triangle)]);
        triangles.push_back(use.triangle);
      }
      const bool sharp = normals.is_sharp[idx(first.triangle)][idx(first.side)] != 0;
      const bool asked = parts.size() > 1 || wanted.contains({first.low, first.high});
      if (!sharp && !asked)
        return;
      for (const std::int32_t end : {first.low, first.high})
        edges_at_[idx(end)].push_back(marked_.size());
      marked_.push_back(
          {{first.low, first.high}, first.triangle, first.side, std::move(triangles), !asked});
    });
    dropped_.assign(marked_.size(), 0);
  }

  [[nodiscard]] std::vector<std::size_t> live(std::int32_t point) const {
    std::vector<std::size_t> result;
    for (const std::size_t edge : edges_at_[idx(point)])
      if (!dropped_[edge])
        result.push_back(edge);
    return result;
  }

  [[nodiscard]] double length(std::size_t edge) const {
    const auto& [a, b] = marked_[edge].ends;
    return (boundary_.mesh.points[idx(a)] - boundary_.mesh.points[idx(b)]).norm();
  }

  [[nodiscard]] std::int32_t beyond(std::size_t edge, std::int32_t point) const {
    return marked_[edge].ends[marked_[edge].ends[0] == point ? 1 : 0];
  }

  /// Creases that begin nowhere, up to the next branching, if they are short.
  void drop_short_creases() {
    bool dropped = true;
    while (dropped) {
      dropped = false;
      for (std::size_t p = 0; p < edges_at_.size(); ++p) {
        auto point = static_cast<std::int32_t>(p);
        if (boundary_.keep[p] != 0 || live(point).size() != 1)
          continue;
        std::vector<std::size_t> crease;
        double way = 0.0;
        for (std::vector<std::size_t> next = live(point);;) {
          const std::size_t edge = next.front();
          if (!marked_[edge].crease)
            break;
          crease.push_back(edge);
          way += length(edge);
          point = beyond(edge, point);
          next = live(point);
          if (next.size() != 2 || boundary_.keep[idx(point)] != 0)
            break;
          if (next.front() == edge)
            std::swap(next[0], next[1]);
        }
        if (crease.empty() || way >= short_crease_)
          continue;
        for (const std::size_t edge : crease)
          dropped_[edge] = 1;
        dropped = true;
      }
    }
  }

  [[nodiscard]] bool is_corner(std::int32_t point) const {
    const std::vector<std::size_t> edges = live(point);
    if (edges.empty())
      return false;
    if (edges.size() != 2 || boundary_.keep[idx(point)] != 0)
      return true;
    const Vec3& x = boundary_.mesh.points[idx(point)];
    const Vec3 in = x - boundary_.mesh.points[idx(beyond(edges[0], point))];
    const Vec3 out = boundary_.mesh.points[idx(beyond(edges[1], point))] - x;
    return in.dot(out) < std::cos(line_corner_turn) * in.norm() * out.norm();
  }

  void find_patches() {
    DisjointSets sets(boundary_.mesh.triangles.size());
    std::set<std::array<std::int32_t, 2>> cuts;
    for (std::size_t edge = 0; edge < marked_.size(); ++edge)
      if (!dropped_[edge])
        cuts.insert(marked_[edge].ends);
    for_each_edge(uses_, [&](std::span<const EdgeUse> uses) {
      if (!cuts.contains({uses[0].low, uses[0].high}))
        for (const EdgeUse& use : uses)
          sets.join(uses[0].triangle, use.triangle);
    });
    std::map<std::int32_t, std::int32_t> numbers;
    for (std::size_t t = 0; t < boundary_.mesh.triangles.size(); ++t)
      lines_.patch.push_back(numbers
                                 .try_emplace(sets.root(static_cast<std::int32_t>(t)),
                                              static_cast<std::int32_t>(numbers.size()))
                                 .first->second);
    lines_.n_patches = static_cast<std::int32_t>(numbers.size());
  }

  void walk(std::int32_t from, std::size_t edge) {
    std::vector<LinePiece> chain;
    std::int32_t point = from;
    for (;;) {
      Marked& marked = marked_[edge];
      marked.used = true;
      const std::int32_t next = beyond(edge, point);
      chain.push_back({{point, next}, marked.triangle, marked.side});
      point = next;
      if (is_corner(point) || point == from)
        break;
      const std::vector<std::size_t> edges = live(point);
      edge = edges[0] == edge ? edges[1] : edges[0];
    }
    // A loop from corner to the same corner is parted: its end has to be another one.
    if (point == from && is_corner(from) && chain.size() > 1) {
      const auto half = chain.begin() + static_cast<std::ptrdiff_t>(chain.size() / 2);
      add({chain.begin(), half});
      add({half, chain.end()});
    } else {
      add(std::move(chain));
    }
  }

  void add(std::vector<LinePiece> chain) {
    std::set<std::int32_t> patches;
    for (const LinePiece& piece : chain) {
      const auto [low, high] = std::minmax(piece.ends[0], piece.ends[1]);
      for (const std::size_t edge : edges_at_[idx(low)])
        if (marked_[edge].ends[1] == high || marked_[edge].ends[0] == high)
          for (const std::int32_t triangle : marked_[edge].triangles)
            patches.insert(lines_.patch[idx(triangle)]);
    }
    lines_.patches.emplace_back(patches.begin(), patches.end());
    lines_.chains.push_back(std::move(chain));
  }

  const SolidBoundary& boundary_;
  double short_crease_;
  std::vector<EdgeUse> uses_;
  std::vector<Marked> marked_;
  std::vector<char> dropped_;
  std::vector<std::vector<std::size_t>> edges_at_; ///< marked edges at each point
  FeatureLines lines_;
};

} // namespace

FeatureLines
feature_lines(const SolidBoundary& boundary, const CornerNormals& normals, double short_crease) {
  return LineFinder(boundary, normals, short_crease).find();
}

} // namespace billet::geometry
