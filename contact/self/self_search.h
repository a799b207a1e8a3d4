// Which faces of the part a point of its surface may meet, and where.
//
// A face lies ahead of a point if it turns its outer side to it and the point is outside it: so a
// wall's other side is never met through the wall, however thin it is, nor is a neighbour on a
// smooth surface. Boxes of faces find the pairs. (C.54)

#pragma once

#include "contact/self/self_state.h"
#include "contact/self/self_traction.h"
#include "contact/surface/contact_surface.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// Finds the faces ahead of each point within a distance, where everything is.
///
/// @param x      shape (n_dofs) [mm]
/// @param first  on this mesh: it may be off by a little, and walls lie in each other
void look_ahead(const ContactSurface& surface,
                std::span<const double> x,
                double distance,
                bool first,
                SelfContactState& state);

/// The place, of the faces ahead, that a point lies above or below; the closest of several.
///
/// @param x  shape (n_dofs) [mm]
[[nodiscard]] SelfFoot find_foot(const ContactSurface& surface,
                                 std::span<const double> x,
                                 const std::vector<Index>& ahead,
                                 const Vec3& point);

/// A point that has gone through a face within an increment which it was not known to meet.
struct SelfPassage {
  Vec3 place = Vec3::Zero(); ///< [mm]
};

/// Looks farther than `look_ahead` did: for moves that are larger than was expected.
///
/// @param distance  as far as points and faces may have come near each other [mm]
[[nodiscard]] std::optional<SelfPassage> find_passage(const ContactSurface& surface,
                                                      std::span<const double> x_old,
                                                      std::span<const double> x,
                                                      double distance,
                                                      const SelfContactState& state);

/// The farthest that any point of the surface has gone, but for what all go together [mm].
[[nodiscard]] double relative_way(const ContactSurface& surface,
                                  std::span<const double> x_old,
                                  std::span<const double> x);

} // namespace billet::contact
