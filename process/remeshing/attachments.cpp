#include "process/remeshing/attachments.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace billet::process {

namespace {

using mechanics::Face;
using Lists = std::vector<const std::vector<Index>*>;

Lists lists_of_supports(const Part& part) {
  Lists lists;
  for (const Support& support : part.supports)
    lists.push_back(&support.nodes);
  return lists;
}

Lists lists_of_sets(const Part& part) {
  Lists lists;
  for (const auto& [name, nodes] : part.mesh.node_sets)
    lists.push_back(&nodes);
  return lists;
}

/// Which nodes are in each of several lists.
std::vector<std::vector<char>> flags(const Lists& lists, std::size_t n) {
  std::vector<std::vector<char>> result;
  for (const std::vector<Index>* list : lists) {
    result.emplace_back(n, char{0});
    for (const Index node : *list)
      result.back()[idx(node)] = 1;
  }
  return result;
}

bool same_nodes(const Face& a, const Face& b) { return a.nodes == b.nodes; }

} // namespace

NodeFlags node_flags(const Part& part) {
  const std::size_t n = part.mesh.points.size();
  return {flags(lists_of_supports(part), n), flags(lists_of_sets(part), n)};
}

std::vector<char> on_all(const std::vector<std::vector<char>>& flags,
                         std::span<const Index> nodes) {
  std::vector<char> result;
  result.reserve(flags.size());
  for (const std::vector<char>& each : flags)
    result.push_back(static_cast<char>(
        std::all_of(nodes.begin(), nodes.end(), [&](Index a) { return each[idx(a)] != 0; })));
  return result;
}

Attachments::Attachments(const Part& part, std::span<const int> touching)
    : part_(&part), nodes_(node_flags(part)) {
  for (std::size_t f = 0; f < part.contact_faces.size(); ++f)
    touching_[part.contact_faces[f].nodes] = touching[f];
}

Attachment Attachments::of(const Face& face) const {
  Attachment result{on_all(nodes_.supports, face.nodes), {}, on_all(nodes_.sets, face.nodes)};
  for (const LoadSpec& load : part_->loads) {
    const std::vector<Face>& faces = faces_of(load);
    result.loads.push_back(static_cast<char>(std::any_of(
        faces.begin(), faces.end(), [&](const Face& f) { return same_nodes(f, face); })));
  }
  const auto touched = touching_.find(face.nodes);
  result.contact = touched != touching_.end();
  if (result.contact)
    result.tool = touched->second;
  return result;
}

NodeLists::NodeLists(Lists old, Index n_old, Index n_new)
    : old_(std::move(old)), lists_(old_.size()) {
  for (std::size_t s = 0; s < old_.size(); ++s)
    if (static_cast<Index>(old_[s]->size()) == n_old) // the whole part
      for (Index node = 0; node < n_new; ++node)
        lists_[s].insert(node);
}

void NodeLists::add(const std::vector<char>& flags, std::span<const Index> nodes) {
  for (std::size_t s = 0; s < lists_.size(); ++s)
    if (flags[s] != 0)
      lists_[s].insert(nodes.begin(), nodes.end());
}

void NodeLists::add_corner(Index old_node, Index node) {
  for (std::size_t s = 0; s < lists_.size(); ++s)
    if (std::find(old_[s]->begin(), old_[s]->end(), old_node) != old_[s]->end())
      lists_[s].insert(node);
}

std::vector<Index> NodeLists::operator[](std::size_t s) const {
  return {lists_[s].begin(), lists_[s].end()};
}

NodeLists support_lists(const Part& part, Index n_new) {
  return {lists_of_supports(part), part.mesh.n_points(), n_new};
}

NodeLists set_lists(const Part& part, Index n_new) {
  return {lists_of_sets(part), part.mesh.n_points(), n_new};
}

std::vector<LoadSpec> loads_without_faces(const Part& part) {
  std::vector<LoadSpec> loads = part.loads;
  for (LoadSpec& load : loads)
    faces_of(load).clear();
  return loads;
}

} // namespace billet::process
