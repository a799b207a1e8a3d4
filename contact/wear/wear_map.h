// Where a tool is worn: its surface cut into cells that collect the volume worn away.
//
// The cells begin as the tool's drawn mesh: the triangles of an STL, the facets or chords that
// other shapes are drawn with. Where contact slides they are cut in two, across their longest
// diagonal, until that is half as long as the piece of the workpiece that a contact point stands
// for; elsewhere they stay coarse. What a point wears away is shared among the cells that its piece
// covers on its way, in proportion to the area covered, so that the sum over the cells is the sum
// over the points, whatever the mesh and the increments.
//
// Frame   of the tool: cells move and turn with it.
// Units   mm; volumes are those of the full turn in axisymmetry, per thickness in plane strain.
// Theory  docs/theory/contact.md (W.5), (W.6).

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/base/box.h"
#include "geometry/collision/convex_polygon.h"
#include "geometry/rigid_surface.h"
#include "geometry/triangles/box_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// What one contact point wears away in an increment, tool frame.
struct WornPatch {
  Footprint footprint;        ///< when the increment ends
  Vec3 foot = Vec3::Zero();   ///< of the point on the tool then [mm]
  Vec3 normal = Vec3::Zero(); ///< of the tool there [-]
  Vec3 way = Vec3::Zero();    ///< of the point along the tool in the increment [mm]
  double volume = 0.0;        ///< [mm^3], >= 0
  Vec3 turn = Vec3::Zero();   ///< of the piece against the tool in the increment, a vector [rad]
  Vec3 centre = Vec3::Zero(); ///< about a line through this [mm]
};

/// A piece of the tool's surface and what is worn off it.
struct WearCell {
  geometry::ConvexPolygon shape; ///< tool frame; in the plane a line [mm]
  double depth = 0.0;            ///< [mm]
};

class WearMap {
public:
  /// @param body  the workpiece at the start, tool frame: a shape without end is cut off at a
  ///              million times its size [mm]
  WearMap(const geometry::RigidSurface& surface, mechanics::Analysis analysis, const Box& body);

  void add(const WornPatch& patch);

  /// All cells, those without wear as well.
  [[nodiscard]] std::vector<WearCell> cells() const;
  /// The most worn of them; none: there is no wear.
  [[nodiscard]] std::optional<WearCell> deepest() const;
  /// Worn away in all [mm^3].
  [[nodiscard]] double volume() const;

  template <class Archive> void fields(Archive& archive) { archive(corners_, nodes_); }

private:
  /// A cell, or one that has been cut in two.
  struct Node {
    std::size_t first; ///< of its corners, out of `corners_`
    std::size_t n_corners;
    double volume = 0.0;        ///< worn off it; of no meaning if it has been cut
    std::int32_t children = -1; ///< first of two that follow each other; -1: it is a cell

    template <class Archive> void fields(Archive& archive) {
      archive(first, n_corners, volume, children);
    }
  };
  /// Half of space that a footprint, drawn out along the normal, lies in.
  struct HalfSpace {
    Vec3 point;
    Vec3 inward;
  };
  /// A place of a patch on its way, and how finely cells have to be cut there.
  struct Imprint {
    std::array<HalfSpace, 5> sides;
    std::size_t n_sides;
    Vec3 centre;    ///< the foot
    Vec3 normal;    ///< of the tool
    double radius2; ///< square of how far from the foot a cell can be covered [mm^2]
    double longest; ///< diagonal of a cell [mm]
  };
  struct Share {
    std::int32_t node;
    double area; ///< covered [mm^2]
  };

  void set_roots(const geometry::RigidSurface& surface, const Box& window);
  /// A line as it lies on the tool, without what of it lies beyond the axis.
  [[nodiscard]] geometry::ConvexPolygon
  line(const geometry::RigidSurface& surface, Vec3 a, Vec3 b, double reach) const;
  void add_node(const geometry::ConvexPolygon& shape, double volume);
  [[nodiscard]] std::span<const Vec3> corners(const Node& node) const {
    return std::span(corners_).subspan(node.first, node.n_corners);
  }
  [[nodiscard]] geometry::ConvexPolygon shape(const Node& node) const {
    return geometry::ConvexPolygon(corners(node));
  }
  [[nodiscard]] double area(const geometry::ConvexPolygon& shape) const;
  [[nodiscard]] double depth(const Node& node) const { return node.volume / area(shape(node)); }
  /// @param size  of its footprint [mm]
  [[nodiscard]] static Imprint imprint(const WornPatch& patch, double size);
  [[nodiscard]] double covered(geometry::ConvexPolygon shape, const Imprint& imprint) const;
  void press(const Imprint& imprint, double volume);
  void gather(std::int32_t node, const Imprint& imprint, std::vector<Share>& shares);
  void cut_in_two(std::int32_t node);
  [[nodiscard]] std::int32_t nearest(const Vec3& x) const;
  void nearest_below(std::int32_t node, const Vec3& x, double& limit2, std::int32_t& best) const;

  mechanics::Analysis analysis_;
  std::vector<Vec3> corners_; ///< of all nodes
  std::vector<Node> nodes_;   ///< the roots first
  geometry::BoxTree roots_;
};

} // namespace billet::contact
