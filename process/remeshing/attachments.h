// What hangs on the boundary of a part: supports, loads, named sets, contact; and the lists of a
// scene on a new mesh.
//
// Theory: docs/theory/process.md (P.14).

#pragma once

#include "process/scene/scene.h"

#include <map>
#include <set>
#include <span>
#include <vector>

namespace billet::process {

/// What hangs on a side or face, each as flags in the order of the scene.
struct Attachment {
  std::vector<char> supports; ///< its nodes are held by the support
  std::vector<char> loads;    ///< the load acts on it
  std::vector<char> sets;     ///< its nodes are in the set
  bool contact = false;       ///< a candidate face
  int tool = -1;              ///< that touches it; -1: none

  auto operator<=>(const Attachment&) const = default;
};

/// What each node carries: flags in the order of the scene, shape (supports or sets, n_points).
struct NodeFlags {
  std::vector<std::vector<char>> supports;
  std::vector<std::vector<char>> sets;
};

/// What the nodes of a part carry.
[[nodiscard]] NodeFlags node_flags(const Part& part);

/// Which of the flags all the nodes have.
[[nodiscard]] std::vector<char> on_all(const std::vector<std::vector<char>>& flags,
                                       std::span<const Index> nodes);

/// Finds what hangs on the faces of a scene's boundary.
class Attachments {
public:
  /// @param touching  the tool that touches each of the part's contact faces; -1: none
  Attachments(const Part& part, std::span<const int> touching);

  [[nodiscard]] Attachment of(const mechanics::Face& face) const;
  [[nodiscard]] const NodeFlags& nodes() const { return nodes_; }

private:
  const Part* part_;
  NodeFlags nodes_;
  std::map<std::vector<Index>, int> touching_;
};

/// The node lists of a scene on its new mesh.
class NodeLists {
public:
  NodeLists(std::vector<const std::vector<Index>*> old, Index n_old, Index n_new);

  void add(const std::vector<char>& flags, std::span<const Index> nodes);
  /// The new node that stands for a kept corner is in the lists that this one was in.
  void add_corner(Index old_node, Index node);

  [[nodiscard]] std::vector<Index> operator[](std::size_t s) const;

private:
  std::vector<const std::vector<Index>*> old_;
  std::vector<std::set<Index>> lists_;
};

/// The supports of a scene, or its mesh's sets, as lists on a mesh with so many nodes.
[[nodiscard]] NodeLists support_lists(const Part& part, Index n_new);
[[nodiscard]] NodeLists set_lists(const Part& part, Index n_new);

/// The scene's loads without the faces on which they act.
[[nodiscard]] std::vector<LoadSpec> loads_without_faces(const Part& part);

} // namespace billet::process
