#include "geometry/size_field.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace billet::geometry {

namespace {

constexpr std::uint32_t leaf = 8;

} // namespace

template <class Point>
FieldOfSizes<Point>::FieldOfSizes(std::vector<SizeSample> samples, double max, double growth)
    : samples_(std::move(samples)), max_(max), growth_(growth) {
  std::erase_if(samples_, [max](const SizeSample& sample) { return sample.size >= max; });
  if (!samples_.empty())
    divide(0, static_cast<std::uint32_t>(samples_.size()));
}

template <class Point> void FieldOfSizes<Point>::divide(std::uint32_t begin, std::uint32_t end) {
  const std::size_t number = nodes_.size();
  Node node{Point::Constant(std::numeric_limits<double>::infinity()),
            Point::Constant(-std::numeric_limits<double>::infinity()),
            max_,
            begin,
            end,
            0};
  for (std::uint32_t i = begin; i < end; ++i) {
    node.low = node.low.cwiseMin(samples_[i].at);
    node.high = node.high.cwiseMax(samples_[i].at);
    node.least = std::min(node.least, samples_[i].size);
  }
  nodes_.push_back(node);
  if (end - begin <= leaf)
    return;
  const Point extent = node.high - node.low;
  Eigen::Index axis = 0;
  for (Eigen::Index i = 1; i < extent.size(); ++i)
    axis = extent[i] > extent[axis] ? i : axis;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      samples_.begin() + begin, samples_.begin() + middle, samples_.begin() + end,
      [axis](const SizeSample& p, const SizeSample& q) { return p.at[axis] < q.at[axis]; });
  divide(begin, middle);
  nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
  divide(middle, end);
}

template <class Point> double FieldOfSizes<Point>::operator()(const Point& x) const {
  double least = max_;
  const auto bound = [&](const Node& node) {
    return node.least + growth_ * (x - x.cwiseMax(node.low).cwiseMin(node.high)).norm();
  };
  std::array<std::uint32_t, 64> stack; // halves: one more node a level
  std::size_t size = 0;
  if (!nodes_.empty())
    stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t number = stack[--size];
    const Node& node = nodes_[number];
    if (bound(node) >= least)
      continue;
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        least = std::min(least, samples_[i].size + growth_ * (x - samples_[i].at).norm());
      continue;
    }
    const bool left_first = bound(nodes_[number + 1]) <= bound(nodes_[node.right]);
    stack[size++] = left_first ? node.right : number + 1;
    stack[size++] = left_first ? number + 1 : node.right;
  }
  return least;
}

template class FieldOfSizes<Vec2>;
template class FieldOfSizes<Vec3>;

} // namespace billet::geometry
