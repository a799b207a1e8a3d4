// Boxes in a tree with eight children a node, for the nearest thing to a point. Internal to
// geometry/.
//
// The boxes of the children lie side by side in single precision, rounded outwards, so that one
// node is tested with a few wide instructions and a million boxes take 40 MB.
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.12).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

/// Square of the distance from x to the box; 0 inside. The same bits wherever it is called.
[[nodiscard]] double distance2(const Box& box, const Vec3& x);

class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `visit(i)`, which returns the new limit, for every box that is not farther than the
  /// limit, nearer ones first where that is cheap to tell.
  ///
  /// @param limit2  square of the largest distance of interest [mm^2]; what `visit` returns must
  ///                not be less than the square of the distance to a box that matters
  template <class Visit> void walk(const Vec3& x, double limit2, Visit visit) const;

private:
  static constexpr std::size_t width = 8;

  struct alignas(64) Node {
    std::array<std::array<float, width>, 3> low;  ///< of the children, from `centre_`; +inf: none
    std::array<std::array<float, width>, 3> high; ///< likewise; -inf: none
    std::array<std::int32_t, width> child;        ///< number of a node, or -1 - number of a box
  };
  struct Item {
    double distance2; ///< less than or equal to that of every box below
    std::int32_t child;
  };
  struct Middle {
    Vec3 twice; ///< the middle of a box, from the origin, times two
    std::int32_t number;
  };
  static constexpr std::size_t deepest = 11; // nodes on a branch: 8^11 > 2^31

  std::int32_t build(const std::vector<Box>& boxes, std::span<Middle> middles);
  static void
  divide(std::span<Middle> middles, std::size_t capacity, std::vector<std::span<Middle>>& parts);
  void set_child(Node& node, std::size_t lane, std::int32_t child, const Box& box) const;
  /// Squares of the distances to the boxes of the children; x from `centre_`.
  [[nodiscard]] static std::array<double, width> distances2(const Node& node, const Vec3& x);

  Vec3 centre_ = Vec3::Zero();
  std::vector<Node> nodes_; ///< the first one is the root
};

template <class Visit> void BoxTree::walk(const Vec3& x, double limit2, Visit visit) const {
  // Rounding of the squares of distances: a box counts as near though it seems a little farther.
  constexpr double slack = 1.0 + 1e-14;
  std::array<Item, deepest * width> stack;
  std::size_t size = 0;
  const Vec3 from_centre = x - centre_;
  if (!nodes_.empty())
    stack[size++] = {0.0, 0};
  while (size > 0) {
    const Item item = stack[--size];
    if (item.distance2 > limit2 * slack)
      continue;
    if (item.child < 0) {
      limit2 = visit(-1 - item.child);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(item.child)];
    const std::array<double, width> distances = distances2(node, from_centre);
    const std::size_t first = size;
    for (std::size_t lane = 0; lane < width; ++lane) {
      if (distances[lane] > limit2 * slack)
        continue;
      std::size_t at = size++; // sorted: the nearest on top
      for (; at > first && stack[at - 1].distance2 < distances[lane]; --at)
        stack[at] = stack[at - 1];
      stack[at] = {distances[lane], node.child[lane]};
    }
  }
}

} // namespace billet::geometry
