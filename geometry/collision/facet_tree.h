// A search tree over triangles: how far two bodies are apart, and which of their triangles cut.
//
// FCL's. What it needs is said in plain numbers, for the library that holds FCL is compiled for any
// processor (geometry/CMakeLists.txt).

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace billet::geometry {

class FacetTree {
public:
  /// Rotation, row by row, and translation.
  using Place = std::array<double, 12>;
  using Triangle = std::array<std::int32_t, 3>;
  /// A triangle of one body and one of another.
  using Pair = std::array<int, 2>;

  FacetTree() = default;
  FacetTree(const FacetTree&) = delete;
  FacetTree& operator=(const FacetTree&) = delete;
  virtual ~FacetTree() = default;

  /// Smallest distance to another body; 0 or less if they cut.
  [[nodiscard]] virtual double
  distance(const Place& own, const FacetTree& other, const Place& place) const = 0;
  /// Triangles that cut, or touch to rounding.
  [[nodiscard]] virtual std::vector<Pair>
  cuts(const Place& own, const FacetTree& other, const Place& place) const = 0;
};

/// @param points  shape (n, 3)
/// @throws std::bad_alloc
[[nodiscard]] std::unique_ptr<const FacetTree>
make_facet_tree(std::span<const double> points, std::span<const FacetTree::Triangle> triangles);

} // namespace billet::geometry
