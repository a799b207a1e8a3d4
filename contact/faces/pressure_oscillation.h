// What the pressures of a face's points have that those of the faces around it do not. (C.45)
//
// A face has more contact points than it adds nodes: two for two on quadratic lines, where one more
// would be needed, four for three and three for two in space. A pressure that is high and low in
// turn along the faces of a contact therefore puts next to no force on the nodes, and nothing but
// the penalty holds it: small errors of the elements' forces at corner nodes add up along the
// contact until every second point has lost the tool.

#pragma once

#include "contact/surface/contact_surface.h"

#include <span>
#include <vector>

namespace billet::contact {

/// The pressures that the means of faces tell: shapes (n_faces), (n_points).
struct SmoothedPressure {
  std::vector<char> known;  ///< whether a face and all around it lie on the tool
  std::vector<double> mean; ///< of the face of a point, 0 where not known [MPa]
  std::vector<double> rise; ///< of a point above it, in sum zero on a face, 0 where not known [MPa]
};

/// What the pressure rises by along each face, as the means of the faces around it tell. At the end
/// of a contact, next to faces that do not lie on the tool, nothing is known: pressure may
/// oscillate there.
///
/// @param lying      whether a face lies on the tool with all its points, or would but for
///                   pressure oscillation, shape (n_faces)
/// @param history    shape (n_points)
/// @param positions  of the points, shape (n_points) [mm]
/// @param areas      that the points stand for, shape (n_points) [mm^2]
[[nodiscard]] SmoothedPressure smoothed_pressure(const ContactSurface& surface,
                                                 std::span<const char> lying,
                                                 std::span<const PointHistory> history,
                                                 std::span<const Vec3> positions,
                                                 std::span<const double> areas);

/// Pressure of each point less what the means tell of it, shape (n_points); 0 where they tell
/// nothing [MPa].
[[nodiscard]] std::vector<double> pressure_oscillation(const SmoothedPressure& smoothed,
                                                       std::span<const PointHistory> history);

} // namespace billet::contact
