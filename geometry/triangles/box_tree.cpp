#include "geometry/triangles/box_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace billet::geometry {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

// Two steps outwards: one for the rounding to single precision, one for that of the shift to the
// centre.
float below(double value) {
  return std::nextafter(std::nextafter(static_cast<float>(value), -infinite), -infinite);
}
float above(double value) { return -below(-value); }

} // namespace

// Not inlined, so that the compiler contracts it to fused multiply-adds in one way only.
[[gnu::noinline]] double distance2(const Box& box, const Vec3& x) {
  const auto outside = [&](int i) {
    return std::max({box.low[i] - x[i], x[i] - box.high[i], 0.0});
  };
  const double dx = outside(0), dy = outside(1), dz = outside(2);
  return dx * dx + dy * dy + dz * dz;
}

BoxTree::BoxTree(const std::vector<Box>& boxes) { plant(boxes, {}); }

BoxTree::BoxTree(const std::vector<Box>& boxes, const FacetOf& facet) { plant(boxes, facet); }

void BoxTree::plant(const std::vector<Box>& boxes, const FacetOf& facet) {
  if (boxes.empty())
    return;
  Box all;
  std::vector<Middle> middles;
  middles.reserve(boxes.size());
  for (const Box& box : boxes) {
    all.add(box.low);
    all.add(box.high);
    middles.push_back({box.low + box.high, static_cast<std::int32_t>(middles.size())});
  }
  centre_ = 0.5 * (all.low + all.high);
  nodes_.reserve(boxes.size() / 4 + 1);
  if (facet)
    slabs_.reserve(nodes_.capacity());
  rounding_ = 1e-15 * (all.high - all.low).lpNorm<1>();
  build(boxes, facet, middles);
}

// Normal to the triangles together: where they turn to all sides the slab is as thick as the box.
void BoxTree::set_slab(Slabs& slabs,
                       std::size_t lane,
                       std::span<Middle> middles,
                       const FacetOf& facet) const {
  Vec3 normal = Vec3::Zero();
  for (const Middle& m : middles) {
    const auto [a, b, c] = facet(m.number).corners;
    normal += (b - a).cross(c - a);
  }
  normal = normal.stableNormalized();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Middle& m : middles) {
    const SlabFacet of = facet(m.number);
    for (const Vec3& corner : of.corners) {
      const double at = normal.dot(corner - centre_);
      low = std::min(low, at - of.rise);
      high = std::max(high, at + of.rise);
    }
  }
  for (std::size_t i = 0; i < 3; ++i)
    slabs.normal[i][lane] = normal[static_cast<Eigen::Index>(i)];
  slabs.low[lane] = low;
  slabs.high[lane] = high;
}

void BoxTree::set_child(Node& node, std::size_t lane, std::int32_t child, const Box& box) const {
  const Vec3 low = box.low - centre_, high = box.high - centre_;
  for (std::size_t i = 0; i < 3; ++i) {
    node.low[i][lane] = below(low[static_cast<Eigen::Index>(i)]);
    node.high[i][lane] = above(high[static_cast<Eigen::Index>(i)]);
  }
  node.child[lane] = child;
}

// A node over these boxes, of which every subtree but the last is full.
std::int32_t
BoxTree::build(const std::vector<Box>& boxes, const FacetOf& facet, std::span<Middle> middles) {
  const auto number = nodes_.size();
  Node node;
  for (std::size_t i = 0; i < 3; ++i) {
    node.low[i].fill(infinite);
    node.high[i].fill(-infinite);
  }
  node.child.fill(0);
  nodes_.push_back(node);
  if (facet)
    slabs_.emplace_back();
  std::size_t capacity = 1; // of a child
  while (capacity * width < middles.size())
    capacity *= width;
  std::vector<std::span<Middle>> parts;
  divide(middles, capacity, parts);
  for (std::size_t lane = 0; lane < parts.size(); ++lane) {
    Box box;
    for (const Middle& m : parts[lane]) {
      box.add(boxes[static_cast<std::size_t>(m.number)].low);
      box.add(boxes[static_cast<std::size_t>(m.number)].high);
    }
    const std::int32_t child = parts[lane].size() == 1 ? -1 - parts[lane].front().number
                                                       : build(boxes, facet, parts[lane]);
    set_child(nodes_[number], lane, child, box);
    if (facet)
      set_slab(slabs_[number], lane, parts[lane], facet);
  }
  return static_cast<std::int32_t>(number);
}

// Halves across the longest side of the middles until no part is larger than `capacity`.
void BoxTree::divide(std::span<Middle> middles,
                     std::size_t capacity,
                     std::vector<std::span<Middle>>& parts) {
  if (middles.size() <= capacity) {
    parts.push_back(middles);
    return;
  }
  Box extent;
  for (const Middle& m : middles)
    extent.add(m.twice);
  Eigen::Index axis = 0;
  (extent.high - extent.low).maxCoeff(&axis);
  const std::size_t pieces = (middles.size() + capacity - 1) / capacity;
  const std::size_t half = (pieces + 1) / 2 * capacity;
  std::nth_element(middles.begin(), middles.begin() + static_cast<std::ptrdiff_t>(half),
                   middles.end(), [axis](const Middle& a, const Middle& b) {
                     return a.twice[axis] < b.twice[axis] ||
                            (a.twice[axis] == b.twice[axis] && a.number < b.number);
                   });
  divide(middles.first(half), capacity, parts);
  divide(middles.subspan(half), capacity, parts);
}

// In the compiler's vectors: left to itself it takes the lanes one by one.
std::array<double, BoxTree::width> BoxTree::distances2(const Node& node, const Vec3& x) {
  using Floats [[gnu::vector_size(width * sizeof(float))]] = float;
  using Doubles [[gnu::vector_size(width * sizeof(double))]] = double;
  const Doubles zero{};
  Doubles sum = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = x[static_cast<Eigen::Index>(i)];
    // In expressions, not by functions: for a processor without such registers the call of one that
    // returns a vector is an error.
    const Doubles low = __builtin_convertvector(__builtin_bit_cast(Floats, node.low[i]), Doubles);
    const Doubles high = __builtin_convertvector(__builtin_bit_cast(Floats, node.high[i]), Doubles);
    const Doubles under = low - at, over = at - high;
    const Doubles beyond = under > over ? under : over;
    const Doubles distance = zero > beyond ? zero : beyond;
    sum += distance * distance;
  }
  return std::bit_cast<std::array<double, width>>(sum);
}

} // namespace billet::geometry
