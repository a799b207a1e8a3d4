// How deep a point of space lies in the workpiece.
//
// Units   mm. Theory: docs/theory/process.md (P.40).

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/triangles/box_tree.h"
#include "mechanics/elements/mesh_locator.h"
#include "process/setup/drawing.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::process {

using mechanics::Index;

/// Where a point is in, or out of, the workpiece.
struct PlaceInPart {
  double depth = 0.0; ///< distance from the nearest candidate face, outside less than 0 [mm]
  Index face = -1;    ///< that face; -1: out of reach
};

/// Box of the nodes of a mesh at positions x, shape (n_dofs) or more [mm].
[[nodiscard]] Box box_of_nodes(const mechanics::Mesh& mesh, std::span<const double> x);

class PartDepth {
public:
  /// @param x  positions of the nodes, shape (n_dofs) or more [mm]
  /// @pre mesh, surface and what x refers to outlive it
  PartDepth(const mechanics::Mesh& mesh,
            const contact::ContactSurface& surface,
            std::span<const double> x);

  /// @param reach  farther outside it need not be known how far [mm]
  [[nodiscard]] PlaceInPart at(const Vec3& point, double reach);
  /// Box of the nodes [mm].
  [[nodiscard]] const Box& bounds() const { return bounds_; }

private:
  /// The candidate faces in facets, in a tree; made when a point is found to be near.
  struct Facets {
    DrawnWorkpiece drawing;
    geometry::BoxTree tree;
  };
  /// The candidate face that is nearest to a point, if it is within reach, and its distance.
  [[nodiscard]] PlaceInPart nearest_face(const Vec3& point, double reach);
  void draw();

  const contact::ContactSurface* surface_;
  std::span<const double> x_;
  mechanics::MeshLocator locator_;
  Box bounds_;
  double rounding_ = 0.0; ///< distance below which a point is inside [mm]
  std::optional<Facets> facets_;
};

} // namespace billet::process
