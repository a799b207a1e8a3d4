// The sagitta offsets of linear faces on a curved tool. (C.43)
//
// A linear face, which is straight, whose nodes lie on a convex tool is inside it by its sagitta,
// which is proportional to the square of its length. Of the two points of a face next to a longer
// one, one would be off the tool by more than a penalty lets the other sink: half of the contact
// would be open and carry no friction. So gaps are counted from where the faces around a node
// agree.

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <span>
#include <vector>

namespace billet::contact {

/// What is added to the gap of each contact point: the sagitta of its face over the mean of those
/// around its nodes. Zero on quadratic faces, on a flat tool, next to edges of the tool and where
/// it is curved too sharply for the face.
///
/// @param x     shape (n_dofs) [mm]
/// @param pose  of the tool
/// @param feet  of the points, those not found: too far to count, shape (n_points)
/// @return shape (n_points) [mm]
[[nodiscard]] std::vector<double> sagitta_offsets(const ContactSurface& surface,
                                                  std::span<const double> x,
                                                  const geometry::Pose& pose,
                                                  std::span<const geometry::Projection> feet);

} // namespace billet::contact
