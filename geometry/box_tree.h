// Boxes in a binary tree, for the nearest thing to a point. Internal to geometry/.
//
// Units   lengths in mm.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace billet::geometry {

/// Square of the distance from x to the box; 0 inside. Monotone in rounding: never more for a box
/// that holds another.
[[nodiscard]] double distance2(const Box& box, const Vec3& x);

class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  [[nodiscard]] const Box& box(std::int32_t i) const { return boxes_[static_cast<std::size_t>(i)]; }

  /// Calls `visit(i)`, which returns the new limit, for every box that is not farther than the
  /// limit, nearer ones first where that is cheap to tell.
  ///
  /// @param limit2  square of the largest distance of interest [mm^2]
  template <class Visit> void walk(const Vec3& x, double limit2, Visit visit) const;

private:
  struct Node {
    Box box;
    std::int32_t left;  ///< child; -1: a leaf
    std::int32_t right; ///< child; of a leaf: the number of its box
  };
  std::int32_t build(std::span<std::int32_t> numbers);

  std::vector<Box> boxes_;
  std::vector<Node> nodes_; ///< the last one is the root
};

template <class Visit> void BoxTree::walk(const Vec3& x, double limit2, Visit visit) const {
  struct Item {
    std::int32_t node;
    double distance2;
  };
  constexpr std::size_t deepest = 80; // halving splits: more than the logarithm of any count
  Item stack[deepest];
  std::size_t size = 0;
  if (!nodes_.empty()) {
    const auto root = static_cast<std::int32_t>(nodes_.size()) - 1;
    stack[size++] = {root, distance2(nodes_.back().box, x)};
  }
  while (size > 0) {
    const Item item = stack[--size];
    if (item.distance2 > limit2)
      continue;
    const Node& node = nodes_[static_cast<std::size_t>(item.node)];
    if (node.left < 0) {
      limit2 = visit(node.right);
      continue;
    }
    Item near{node.left, distance2(nodes_[static_cast<std::size_t>(node.left)].box, x)};
    Item far{node.right, distance2(nodes_[static_cast<std::size_t>(node.right)].box, x)};
    if (far.distance2 < near.distance2)
      std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
}

} // namespace billet::geometry
