// Where a corner of a tool meets the faces of the workpiece in a plane scene. (C.46)

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/rigid_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// A corner of a tool in space.
struct PlacedCorner {
  Vec2 centre; ///< [mm]
  double radius;
  Vec2 from, to; ///< normals of the tool on both sides
};

/// A place of the workpiece's boundary that a corner is inside of.
struct CornerFoot {
  Index face;
  double xi;     ///< on the face, in [-1, 1]; at an end the node is the closest place
  Vec2 normal;   ///< out of the tool, into the workpiece [-]
  double depth;  ///< of the corner in the workpiece [mm]
  double facing; ///< 1: the normal is one of the corner's; less on its two sides, 0 beyond [-]

  template <class Archive> void fields(Archive& archive) {
    archive(face, xi, normal, depth, facing);
  }
};

/// The contact point of the face that is closest to the corner's foot.
[[nodiscard]] inline std::size_t nearest_point(const ContactSurface& surface,
                                               const CornerFoot& foot) {
  const int points = surface.points();
  const double i = std::round(0.5 * (foot.xi + 1.0) * points - 0.5); // at equal steps, nearly
  return static_cast<std::size_t>(foot.face) * static_cast<std::size_t>(points) +
         static_cast<std::size_t>(std::clamp(i, 0.0, points - 1.0));
}

/// How far a corner has taken over from the adjacent side where the angle between their normals
/// has this sine: a half where there is none.
template <class Scalar> [[nodiscard]] Scalar taken_over(const Scalar& sine) {
  constexpr double width = 0.02;
  if (sine <= -width)
    return Scalar(0.0);
  if (sine >= width)
    return Scalar(1.0);
  const Scalar u = (sine + width) / (2.0 * width);
  return u * u * (3.0 - 2.0 * u);
}

/// The closed polygon or chain that the faces make, and their neighbours on it.
class CornerSearch {
public:
  CornerSearch() = default;
  explicit CornerSearch(const ContactSurface& surface);

  /// The place closest to the corner, of those that it faces; none if the corner is outside, or so
  /// deep inside that it is not this boundary that it has come through.
  ///
  /// @param x      shape (n_dofs) [mm]
  /// @param slack  how far outside it may be [mm]
  [[nodiscard]] std::optional<CornerFoot> find(const ContactSurface& surface,
                                               std::span<const double> x,
                                               const PlacedCorner& corner,
                                               double slack) const;

  /// Depth of the parent elements at both ends of a face, in the mean of the two there [mm].
  [[nodiscard]] const std::array<double, 2>& depths(Index face) const {
    return depths_[static_cast<std::size_t>(face)];
  }

private:
  std::vector<std::array<double, 2>> depths_;
  std::vector<std::array<Index, 2>> neighbours_; ///< of a face, at its ends; -1: none
};

} // namespace billet::contact
