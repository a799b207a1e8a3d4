// Surfaces drawn in facets, and how two of them lie to each other.
//
// A facet body is a tool or the workpiece as triangles in space or as segments in the plane. It
// answers what a search for closest points cannot: a tip of one against the middle of a facet of
// the other, and edge across edge. Triangles are searched by FCL; what it says is used where it is
// right (the distance of bodies apart, which pairs of triangles cut), and the depth of a cut and
// its place are ours. Segments are ours.
//
// A surface of triangles has no inside: a body within another one is apart from it.
//
// Units   lengths in mm. Theory: docs/theory/geometry.md (G.29), (G.30).

#pragma once

#include "geometry/collision/facet_tree.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <memory>
#include <optional>

namespace billet::geometry {

class FacetBody {
public:
  /// @param drawing  triangles or lines; without either the body is empty and far from all others
  /// @param size     of the scene, the same for all bodies that are compared [mm], > 0: FCL 0.7 has
  ///                 tolerances with a dimension and is given lengths in millionths of it
  FacetBody(DisplayMesh drawing, double size);

  /// As given [mm].
  [[nodiscard]] const DisplayMesh& drawing() const { return drawing_; }

  /// Of the scene [mm].
  [[nodiscard]] double size() const { return size_; }
  /// The search tree over the triangles; none for lines.
  [[nodiscard]] const FacetTree* tree() const { return tree_.get(); }

private:
  DisplayMesh drawing_;
  double size_;
  std::unique_ptr<const FacetTree> tree_;
};

/// Whether every edge (in the plane: every end) belongs to two facets, so that there is an inside.
[[nodiscard]] bool closed(const DisplayMesh& drawing);

/// A body somewhere.
struct PlacedBody {
  const FacetBody& body;
  Pose pose;
};

/// Smallest distance between the facets of two bodies [mm]; 0 if they cut, +inf if one is empty.
/// (G.29)
[[nodiscard]] double clearance(const PlacedBody& a, const PlacedBody& b);

/// Two facets that cut.
struct Cut {
  double depth = 0.0;        ///< how far one would have to move for both to come apart [mm]
  Vec3 place = Vec3::Zero(); ///< where, in space [mm]
};

/// The deepest of all pairs of facets that cut; none if the bodies are apart or only touch. (G.30)
[[nodiscard]] std::optional<Cut> deepest_cut(const PlacedBody& a, const PlacedBody& b);

} // namespace billet::geometry
