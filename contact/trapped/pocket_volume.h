// How a pocket's volume changes with the metal and the tool around it.
//
// The volume between a chain of faces and a tool is an integral along the line around it. As the
// tool is rigid and the ends of the chain slide along it, the change follows from the faces alone,
// seen from the tool: that between two places of the chain and the ways of its ends.
//
// Units   plane strain: areas and volumes are those of a slice of unit thickness; axisymmetric: of
//         the full turn.
// Theory: docs/theory/contact.md (C.58), (C.59).

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/motion.h"

#include <span>
#include <vector>

namespace billet::contact {

/// Integral along a straight line that adds up to the area or volume to the left of a closed one.
/// (C.58)
[[nodiscard]] double line_moment(mechanics::Analysis analysis, const Vec3& from, const Vec3& to);

/// A chain of faces in a configuration.
struct Chain {
  std::vector<Index> nodes;   ///< in turn
  std::vector<Vec3> areas;    ///< outward area vector that each node stands for, in space [mm^2]
  double moment = 0.0;        ///< along the chain, seen from the tool [mm^3]
  double area = 0.0;          ///< [mm^2]
  double length = 0.0;        ///< of the line [mm]
  Vec3 centre = Vec3::Zero(); ///< in space [mm]
  Vec3 first = Vec3::Zero();  ///< where it begins, seen from the tool [mm]
  Vec3 last = Vec3::Zero();   ///< where it ends, seen from the tool [mm]
};

/// @param faces  in turn
/// @param x      positions of the nodes, shape (n_dofs) or more [mm]
/// @param pose   of the tool
[[nodiscard]] Chain chain_of(const ContactSurface& surface,
                             std::span<const Index> faces,
                             std::span<const double> x,
                             const geometry::Pose& pose);

/// By how much the volume on the right of a chain has grown. (C.59) [mm^3]
[[nodiscard]] double
volume_change(mechanics::Analysis analysis, const Chain& old, const Chain& now);

/// Its derivative by the positions of the nodes of `now`, in space, shape (nodes) [mm^2].
[[nodiscard]] std::vector<Vec3> volume_gradient(mechanics::Analysis analysis,
                                                const Chain& old,
                                                const Chain& now,
                                                const geometry::Pose& pose);

} // namespace billet::contact
