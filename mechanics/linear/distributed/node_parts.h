// Which process owns which nodes: compact parts of the same size, with few couplings between them.

#pragma once

#include "mechanics/linear/sparse_matrix.h"

#include <vector>

namespace billet::mechanics {

/// Nodes by process: part p holds order[start[p] .. start[p + 1]), sorted.
struct NodeParts {
  std::vector<Index> order; ///< shape (n_nodes)
  std::vector<Index> start; ///< shape (parts + 1)
};

/// By METIS, rows weighed by their entries. The same for the same pattern.
[[nodiscard]] NodeParts node_parts(const BlockPattern& pattern, int parts);

} // namespace billet::mechanics
