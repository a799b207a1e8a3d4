#include "mechanics/bulk/element_rings.h"

#include "mechanics/mesh/mesh_edges.h"

#include <algorithm>

namespace billet::mechanics {

namespace {

void make_ascending_set(std::vector<Index>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

} // namespace

ElementRings::ElementRings(const Mesh& mesh) {
  const auto n_corners = idx(corners_per_element(mesh.kind));
  std::vector<std::vector<Index>> around(mesh.points.size());
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (const Index node : mesh.cell(e).first(n_corners))
      around[idx(node)].push_back(e);
  start_.push_back(0);
  std::vector<Index> ring;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    ring.clear();
    for (const Index node : mesh.cell(e).first(n_corners))
      ring.insert(ring.end(), around[idx(node)].begin(), around[idx(node)].end());
    make_ascending_set(ring);
    members_.insert(members_.end(), ring.begin(), ring.end());
    start_.push_back(members_.size());
  }
}

std::span<const Index> ElementRings::first(Index element) const {
  const std::size_t begin = start_[idx(element)];
  return std::span(members_).subspan(begin, start_[idx(element) + 1] - begin);
}

std::vector<Index> ElementRings::second(Index element) const {
  std::vector<Index> ring;
  for (const Index e : first(element))
    ring.insert(ring.end(), first(e).begin(), first(e).end());
  make_ascending_set(ring);
  return ring;
}

} // namespace billet::mechanics
