#include "geometry/box_tree.h"

#include <algorithm>
#include <numeric>

namespace billet::geometry {

// Not inlined, so that the compiler contracts it to fused multiply-adds in one way only.
[[gnu::noinline]] double distance2(const Box& box, const Vec3& x) {
  const auto outside = [&](int i) {
    return std::max({box.low[i] - x[i], x[i] - box.high[i], 0.0});
  };
  const double dx = outside(0), dy = outside(1), dz = outside(2);
  return dx * dx + dy * dy + dz * dz;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty())
    return;
  std::vector<std::int32_t> numbers(boxes_.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  nodes_.reserve(2 * boxes_.size());
  build(numbers);
}

// Halves at the median of the middles, along the longest side; equal middles by number.
std::int32_t BoxTree::build(std::span<std::int32_t> numbers) {
  Node node{{}, -1, numbers.front()};
  Box middles;
  for (const std::int32_t i : numbers) {
    node.box.add(box(i).low);
    node.box.add(box(i).high);
    middles.add(0.5 * (box(i).low + box(i).high));
  }
  if (numbers.size() > 1) {
    Eigen::Index axis = 0;
    (middles.high - middles.low).maxCoeff(&axis);
    const std::size_t half = numbers.size() / 2;
    const auto before = [&](std::int32_t i, std::int32_t j) {
      const double p = box(i).low[axis] + box(i).high[axis];
      const double q = box(j).low[axis] + box(j).high[axis];
      return p < q || (p == q && i < j);
    };
    std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half),
                     numbers.end(), before);
    node.left = build(numbers.first(half));
    node.right = build(numbers.subspan(half));
  }
  nodes_.push_back(node);
  return static_cast<std::int32_t>(nodes_.size()) - 1;
}

} // namespace billet::geometry
