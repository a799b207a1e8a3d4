// Which things belong together when pairs of them are joined one after the other (union-find).
//
// Internal to geometry/.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace billet::geometry {

class DisjointSets {
public:
  /// n things, each on its own.
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest number of the set that holds i.
  [[nodiscard]] std::int32_t root(std::int32_t i) {
    while (at(i) != i) {
      at(i) = at(at(i));
      i = at(i);
    }
    return i;
  }

  void join(std::int32_t i, std::int32_t j) {
    const std::int32_t a = root(i), b = root(j);
    at(std::max(a, b)) = std::min(a, b);
  }

private:
  std::int32_t& at(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<std::int32_t> parent_;
};

} // namespace billet::geometry
