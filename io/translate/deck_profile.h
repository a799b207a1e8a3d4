// Profiles of analytical rigid surfaces: lines and arcs in the plane.

#pragma once

#include "io/deck/deck.h"

#include <cstddef>
#include <string>
#include <vector>

namespace billet::io {

/// A piece of a profile in the plane.
struct ProfileStep {
  Vec3 to;
  double radius = 0.0; ///< of an arc, positive: turning left; 0: a line
  Vec3 centre = Vec3::Zero();
};

struct DeckProfile {
  Vec3 start = Vec3::Zero();
  std::vector<ProfileStep> pieces;
};

/// The lines and arcs of a surface; a parabola becomes lines, with a remark.
[[nodiscard]] DeckProfile profile_of(const DeckSurface& surface, std::vector<std::string>& remarks);

/// Point i of the frame that an analytical surface is given in.
[[nodiscard]] Vec3 frame_point(const DeckSurface& surface, std::size_t i, const Vec3& otherwise);

} // namespace billet::io
