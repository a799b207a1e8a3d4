// Elements and their neighbours across nodes.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace billet::mechanics {

class ElementRings {
public:
  explicit ElementRings(const Mesh& mesh);

  /// The element and all that share a corner with it, ascending.
  [[nodiscard]] std::span<const Index> first(Index element) const;
  /// Those and their neighbours in turn, ascending.
  [[nodiscard]] std::vector<Index> second(Index element) const;

private:
  std::vector<std::size_t> start_; ///< of each element's ring, shape (n_elements + 1)
  std::vector<Index> members_;
};

} // namespace billet::mechanics
