#include "contact/self/lap_depth.h"

#include "contact/self/face_place.h"
#include "geometry/base/box.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

namespace billet::contact {

namespace {

/// A way along the surface.
struct Way {
  double walls = 0.0; ///< of it along walls of the lap [mm]
  double free = 0.0;  ///< and along the surface beyond them [mm]

  [[nodiscard]] double length() const { return walls + free; }
};

/// So far along the surface, in extents of the lap, its walls may hang together.
constexpr double farthest = 4.0;

/// The shortest ways from some nodes to all others, found nearest first.
class ShortestWays {
public:
  explicit ShortestWays(std::size_t n_nodes) : best_(n_nodes, HUGE_VAL) {}

  void offer(Index node, const Way& way) {
    if (way.length() >= best_[idx(node)])
      return;
    best_[idx(node)] = way.length();
    queue_.push({way, node});
  }
  /// The nearest node that has not been taken yet; none: all that can be reached are.
  [[nodiscard]] std::optional<std::pair<Way, Index>> take() {
    while (!queue_.empty()) {
      const Entry next = queue_.top();
      queue_.pop();
      if (next.first.length() <= best_[idx(next.second)])
        return next;
    }
    return std::nullopt;
  }

private:
  using Entry = std::pair<Way, Index>;
  struct Farther {
    bool operator()(const Entry& a, const Entry& b) const {
      return std::pair(a.first.length(), a.second) > std::pair(b.first.length(), b.second);
    }
  };
  std::vector<double> best_;
  std::priority_queue<Entry, std::vector<Entry>, Farther> queue_;
};

} // namespace

/// The faces of a lap.
struct LapDepth::Walls {
  int lap = 0;
  std::vector<double> shares; ///< of each face, the part of it that is a wall [-]
  std::vector<Index> faces;   ///< with a share
  double extent = 0.0;        ///< diagonal of a box around the walls [mm]

  [[nodiscard]] double share(Index face) const { return shares[idx(face)]; }
};

LapDepth::LapDepth(const ContactSurface& surface,
                   const SelfContactState& state,
                   std::span<const double> x)
    : surface_(&surface), state_(&state), nodes_(x.size() / 3), points_(surface.n_points()),
      faces_(nodes_.size()) {
  surface.positions(x, points_);
  for (Index face = 0; face < surface.n_faces(); ++face)
    for (const Index node : surface.scatter().nodes(face)) {
      nodes_[idx(node)] = Eigen::Map<const Vec3>(&x[3 * idx(node)]);
      faces_[idx(node)].push_back(face);
    }
}

LapDepth::Walls LapDepth::walls(int lap) const {
  Walls walls{lap, std::vector<double>(idx(surface_->n_faces()), 0.0), {}, 0.0};
  const auto points = idx(surface_->points());
  Box box;
  for (std::size_t k = 0; k < state_->points.size(); ++k)
    if (state_->points[k].lap == lap) {
      walls.shares[k / points] += 1.0 / static_cast<double>(points);
      box.add(points_[k]);
    }
  for (Index face = 0; face < surface_->n_faces(); ++face)
    if (walls.share(face) > 0.0)
      walls.faces.push_back(face);
  walls.extent = box.size();
  return walls;
}

/// Half of the way from a point of a wall to the place that it touches, where that way leads
/// through the root and not around the part: most of it is wall.
double LapDepth::folded(const Walls& walls) const {
  const auto at_the_edge = [&](Index face) {
    const std::span<const Index> nodes = surface_->scatter().nodes(face);
    return walls.share(face) < 1.0 || std::any_of(nodes.begin(), nodes.end(), [&](Index node) {
             const std::vector<Index>& around = faces_[idx(node)];
             return std::any_of(around.begin(), around.end(),
                                [&](Index other) { return !(walls.share(other) > 0.0); });
           });
  };
  const auto along = [&](Index face, const Vec3& from, const Vec3& to) {
    const double length = (to - from).norm();
    return Way{walls.share(face) * length, (1.0 - walls.share(face)) * length};
  };
  const auto plus = [](const Way& a, const Way& b) {
    return Way{a.walls + b.walls, a.free + b.free};
  };
  const auto way_to_partner = [&](std::size_t k) {
    const SelfPoint& point = state_->points[k];
    const Index own = static_cast<Index>(k / idx(surface_->points()));
    std::vector<Vec3> corners;
    for (const Index node : surface_->scatter().nodes(point.face))
      corners.push_back(nodes_[idx(node)]);
    const FaceShapes shapes(surface_->kind(), point.xi);
    const Vec3 place = shapes.sum(shapes.N, corners);
    ShortestWays ways(nodes_.size());
    for (const Index node : surface_->scatter().nodes(own))
      ways.offer(node, along(own, points_[k], nodes_[idx(node)]));
    Way best{0.0, HUGE_VAL};
    while (const auto next = ways.take()) {
      const auto& [way, node] = *next;
      if (way.length() >= std::min(best.length(), farthest * walls.extent))
        break;
      for (const Index face : faces_[idx(node)]) {
        if (face == point.face)
          if (const Way there = plus(way, along(face, nodes_[idx(node)], place));
              there.length() < best.length())
            best = there;
        for (const Index other : surface_->scatter().nodes(face))
          ways.offer(other, plus(way, along(face, nodes_[idx(node)], nodes_[idx(other)])));
      }
    }
    return best;
  };
  double depth = 0.0;
  for (const Index face : walls.faces)
    if (at_the_edge(face))
      for (std::size_t k = idx(face) * idx(surface_->points());
           k < idx(face + 1) * idx(surface_->points()); ++k)
        if (state_->points[k].lap == walls.lap && state_->points[k].closed())
          if (const Way way = way_to_partner(k); way.free <= way.walls)
            depth = std::max(depth, 0.5 * way.walls);
  return depth;
}

/// The largest distance of a place of the walls from where free surface begins, along the walls.
double LapDepth::from_the_mouth(const Walls& walls) const {
  ShortestWays ways(nodes_.size());
  for (const Index face : walls.faces)
    for (const Index node : surface_->scatter().nodes(face))
      for (const Index other : faces_[idx(node)])
        if (!(walls.share(other) > 0.0))
          ways.offer(node, {});
  double farthest_yet = 0.0;
  while (const auto next = ways.take()) {
    const auto& [way, node] = *next;
    farthest_yet = std::max(farthest_yet, way.walls);
    for (const Index face : faces_[idx(node)])
      if (walls.share(face) > 0.0)
        for (const Index other : surface_->scatter().nodes(face))
          ways.offer(other, {way.walls + walls.share(face) *
                                             (nodes_[idx(other)] - nodes_[idx(node)]).norm(),
                             0.0});
  }
  return farthest_yet;
}

/// In how many pieces the walls are.
std::size_t LapDepth::pieces(const Walls& walls) const {
  std::vector<char> seen(idx(surface_->n_faces()), 0);
  std::size_t found = 0;
  for (const Index first : walls.faces) {
    if (seen[idx(first)] != 0)
      continue;
    ++found;
    std::vector<Index> front{first};
    seen[idx(first)] = 1;
    while (!front.empty()) {
      const Index face = front.back();
      front.pop_back();
      for (const Index node : surface_->scatter().nodes(face))
        for (const Index other : faces_[idx(node)])
          if (walls.share(other) > 0.0 && std::exchange(seen[idx(other)], 1) == 0)
            front.push_back(other);
    }
  }
  return found;
}

double LapDepth::of(int lap) const {
  const Walls its = walls(lap);
  const double through_the_root = folded(its);
  const double from_mouth = from_the_mouth(its);
  if (through_the_root > 0.0 || pieces(its) == 1)
    return std::max(through_the_root, from_mouth);
  // Open on both sides: from mouth to mouth. Without a mouth at all: as far as it goes.
  return from_mouth > 0.0 ? 2.0 * from_mouth : its.extent;
}

} // namespace billet::contact
