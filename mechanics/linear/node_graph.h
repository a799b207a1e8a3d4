// The graph of coupled nodes, and what METIS makes of it: an order of elimination, parts.

#pragma once

#include "mechanics/linear/sparse_matrix.h"

#include <vector>

namespace billet::mechanics {

/// Edges of every node to the others that it is coupled with.
struct NodeGraph {
  std::vector<Index> start; ///< shape (n_nodes + 1)
  std::vector<Index> ends;
};

[[nodiscard]] NodeGraph node_graph(const BlockPattern& pattern);

/// Order of elimination with little fill: the nodes, the first to be eliminated first.
///
/// @throws std::bad_alloc, std::runtime_error
[[nodiscard]] std::vector<Index> nested_dissection(NodeGraph graph);

/// The part that each node belongs to, 0 .. parts - 1: parts with about the same number of edges,
/// and few edges between them.
///
/// @throws std::bad_alloc, std::runtime_error
[[nodiscard]] std::vector<Index> partition(NodeGraph graph, int parts);

} // namespace billet::mechanics
