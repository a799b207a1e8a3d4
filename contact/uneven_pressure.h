// What the pressures of a face's points have that those of the faces around it do not. (C.45)
//
// A face has more contact points than it adds nodes: two for two on quadratic lines, where one more
// would be needed, four for three and three for two in space. A pressure that is high and low in
// turn along the faces of a contact therefore puts next to no force on the nodes, and nothing but
// the penalty holds it: small errors of the elements' forces at corner nodes add up along the
// contact until every second point has lost the tool.

#pragma once

#include "contact/contact_surface.h"

#include <span>
#include <vector>

namespace billet::contact {

/// Pressure of each point less the mean of its face and what those of the faces around let it rise
/// by: zero where pressure is uniform or rises evenly, in sum zero on a face. At the end of a
/// contact, beside faces that do not lie on the tool, pressure may be as uneven as it likes.
///
/// @param lying      whether a face lies on the tool with all its points, or would but for uneven
///                   pressure, shape (n_faces)
/// @param history    shape (n_points)
/// @param positions  of the points, shape (n_points) [mm]
/// @param areas      that the points stand for, shape (n_points) [mm^2]
/// @return shape (n_points) [MPa]
[[nodiscard]] std::vector<double> uneven_pressure(const ContactSurface& surface,
                                                  std::span<const char> lying,
                                                  std::span<const PointHistory> history,
                                                  std::span<const Vec3> positions,
                                                  std::span<const double> areas);

} // namespace billet::contact
