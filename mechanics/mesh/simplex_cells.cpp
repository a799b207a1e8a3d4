#include "mechanics/mesh/simplex_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace billet::mechanics {

namespace {

/// The order in which corners are cut from.
class Order {
public:
  explicit Order(std::span<const int> rank) : rank_(rank) {}

  [[nodiscard]] bool operator()(Index a, Index b) const {
    const int first = rank_.empty() ? 0 : rank_[static_cast<std::size_t>(a)];
    const int second = rank_.empty() ? 0 : rank_[static_cast<std::size_t>(b)];
    return first != second ? first < second : a < b;
  }

private:
  std::span<const int> rank_;
};

using Triangle = std::array<Index, 3>;
using Quadrilateral = std::array<Index, 4>;

/// The two halves of a quadrilateral, cut from its lowest corner and turning as it does.
std::array<Triangle, 2> halves(const Quadrilateral& corners, const Order& order) {
  Quadrilateral q = corners;
  std::rotate(q.begin(), std::min_element(q.begin(), q.end(), order), q.end());
  return {{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}};
}

/// Adds the six tetrahedra of a hexahedron.
void cut_hexahedron(std::span<const Index> cell, const Order& order, std::vector<Index>& out) {
  const Index lowest = *std::min_element(cell.begin(), cell.end(), order);
  for (const std::vector<int>& face : face_nodes(ElementKind::hex8)) {
    Quadrilateral side{};
    std::transform(face.begin(), face.end(), side.begin(),
                   [&](int corner) { return cell[static_cast<std::size_t>(corner)]; });
    if (std::find(side.begin(), side.end(), lowest) != side.end())
      continue;
    // Sides turn counter-clockwise seen from outside, a tetrahedron's first three seen from its
    // fourth.
    for (const auto& [a, b, c] : halves(side, order))
      out.insert(out.end(), {a, c, b, lowest});
  }
}

} // namespace

std::vector<Index>
cut_into_simplices(int dimension, std::span<const Index> corners, std::span<const int> rank) {
  const Order order(rank);
  const std::size_t n = dimension == 2 ? 4 : 8;
  std::vector<Index> out;
  out.reserve(corners.size() / n * (dimension == 2 ? 6 : 24));
  for (std::size_t first = 0; first < corners.size(); first += n) {
    const auto cell = corners.subspan(first, n);
    if (dimension == 3)
      cut_hexahedron(cell, order, out);
    else
      for (const Triangle& half : halves({cell[0], cell[1], cell[2], cell[3]}, order))
        out.insert(out.end(), half.begin(), half.end());
  }
  return out;
}

} // namespace billet::mechanics
