#include "mechanics/linear/distributed/node_parts.h"

#include "mechanics/linear/node_graph.h"

#include <cstddef>
#include <numeric>

namespace billet::mechanics {

NodeParts node_parts(const BlockPattern& pattern, int parts) {
  const std::vector<Index> part = partition(node_graph(pattern), parts);
  NodeParts result{std::vector<Index>(part.size()), std::vector<Index>(idx(parts) + 1)};
  for (const Index p : part)
    ++result.start[idx(p) + 1];
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<Index> next = result.start;
  for (std::size_t a = 0; a < part.size(); ++a)
    result.order[idx(next[idx(part[a])]++)] = static_cast<Index>(a);
  return result;
}

} // namespace billet::mechanics
