#include "contact/self/wall_groups.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace billet::contact {

namespace {

/// Faces that hang together, by the lowest of them.
class Groups {
public:
  explicit Groups(Index n) : parent_(idx(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index of(Index face) {
    while (parent_[idx(face)] != face) {
      parent_[idx(face)] = parent_[idx(parent_[idx(face)])];
      face = parent_[idx(face)];
    }
    return face;
  }
  void join(Index a, Index b) {
    const Index first = of(a), second = of(b);
    parent_[idx(std::max(first, second))] = std::min(first, second);
  }

private:
  std::vector<Index> parent_;
};

} // namespace

std::vector<Index> wall_groups(const ContactSurface& surface, const SelfContactState& state) {
  const auto own = [&](std::size_t k) { return static_cast<Index>(k / idx(surface.points())); };
  Groups groups(surface.n_faces());
  std::map<Index, Index> face_at; // of a node, one that touches
  const auto touches = [&](Index face) {
    for (const Index node : surface.scatter().nodes(face)) {
      const auto [known, is_new] = face_at.try_emplace(node, face);
      if (!is_new)
        groups.join(known->second, face);
    }
  };
  for (std::size_t k = 0; k < state.points.size(); ++k)
    if (const SelfPoint& point = state.points[k]; point.closed()) {
      touches(own(k));
      touches(point.face);
      groups.join(own(k), point.face);
    }
  std::vector<Index> of_points(state.points.size(), -1);
  for (std::size_t k = 0; k < state.points.size(); ++k)
    if (state.points[k].closed())
      of_points[k] = groups.of(own(k));
  return of_points;
}

} // namespace billet::contact
