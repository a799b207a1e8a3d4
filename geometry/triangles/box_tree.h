// Boxes in a tree with eight children a node, for the nearest thing to a point. Internal to
// geometry/.
//
// The boxes of the children lie side by side in single precision, rounded outwards, so that one
// node is tested with a few wide instructions and a million boxes take 40 MB. Boxes along the axes
// say little of a slanted surface that is farther off than they are large: what is in them may lie
// between two parallel planes as well, much closer to each other. (G.51)
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.12).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace billet::geometry {

/// Square of the distance from x to the box; 0 inside. The same bits wherever it is called.
[[nodiscard]] double distance2(const Box& box, const Vec3& x);

/// A triangle, and how far what it stands for leaves it. [mm]
struct SlabFacet {
  std::array<Vec3, 3> corners;
  double rise = 0.0;
};

class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);
  /// With slabs as well.
  ///
  /// @param facet  of each box: what is in it lies within its rise of its triangle
  BoxTree(const std::vector<Box>& boxes, const std::function<SlabFacet(std::int32_t)>& facet);

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
    std::array<std::array<float, width>, 3> high; ///< of the children, from `centre_`; -inf: none
    std::array<std::int32_t, width> child;        ///< number of a node, or -1 - number of a box
  };
  /// Between which planes the children lie, from `centre_`.
  struct alignas(64) Slabs {
    std::array<std::array<double, width>, 3> normal; ///< unit
    std::array<double, width> low;                   ///< along it, from `centre_`
    std::array<double, width> high;                  ///< along it, from `centre_`
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

  using FacetOf = std::function<SlabFacet(std::int32_t)>;

  void plant(const std::vector<Box>& boxes, const FacetOf& facet);
  std::int32_t
  build(const std::vector<Box>& boxes, const FacetOf& facet, std::span<Middle> middles);
  void
  set_slab(Slabs& slabs, std::size_t lane, std::span<Middle> middles, const FacetOf& facet) const;
  static void
  divide(std::span<Middle> middles, std::size_t capacity, std::vector<std::span<Middle>>& parts);
  void set_child(Node& node, std::size_t lane, std::int32_t child, const Box& box) const;
  /// Squares of the distances to the boxes of the children; x from `centre_`.
  [[nodiscard]] static std::array<double, width> distances2(const Node& node, const Vec3& x);
  /// A bound from below of the distance to a child, by its slab; x from `centre_`.
  [[nodiscard]] static double outside_slab(const Slabs& slabs, std::size_t lane, const Vec3& x) {
    const double at =
        slabs.normal[0][lane] * x[0] + slabs.normal[1][lane] * x[1] + slabs.normal[2][lane] * x[2];
    return std::max({slabs.low[lane] - at, at - slabs.high[lane], 0.0});
  }

  /// Slabs cost as much as boxes: asked when a walk has become long, and as long as they help.
  struct Patience {
    static constexpr int short_walk = 16; ///< nodes
    int nodes = 0;
    int asked = 0; ///< children whose slab was looked at
    int cut = 0;   ///< of them those that it showed to be too far

    [[nodiscard]] bool asks() { return ++nodes > short_walk && asked <= 8 * cut + 512; }
  };

  /// Raises the distances of children within the limit to those from their slabs.
  static void narrow(const Slabs& slabs,
                     const Vec3& x,
                     double rounding,
                     double limit2,
                     std::array<double, width>& distances2,
                     Patience& patience) {
    for (std::size_t lane = 0; lane < width; ++lane)
      if (distances2[lane] <= limit2) {
        const double outside = std::max(0.0, outside_slab(slabs, lane, x) - rounding);
        distances2[lane] = std::max(distances2[lane], outside * outside);
        ++patience.asked;
        patience.cut += distances2[lane] > limit2 ? 1 : 0;
      }
  }

  Vec3 centre_ = Vec3::Zero();
  std::vector<Node> nodes_;  ///< the first one is the root
  std::vector<Slabs> slabs_; ///< of each node; empty: without
  double rounding_ = 0.0;    ///< of coordinates along normals [mm]
};

template <class Visit> void BoxTree::walk(const Vec3& x, double limit2, Visit visit) const {
  // Rounding of the squares of distances: a box counts as near though it seems a little farther.
  constexpr double slack = 1.0 + 1e-14;
  std::array<Item, deepest * width> stack;
  std::size_t size = 0;
  const Vec3 from_centre = x - centre_;
  const double rounding = rounding_ + 1e-15 * from_centre.lpNorm<1>();
  Patience patience;
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
    std::array<double, width> distances = distances2(node, from_centre);
    if (!slabs_.empty() && patience.asks())
      narrow(slabs_[static_cast<std::size_t>(item.child)], from_centre, rounding, limit2 * slack,
             distances, patience);
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
