// A figure of the part's shape that a run follows.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

#include <cstddef>
#include <optional>
#include <string>

namespace billet::process {

/// What is measured, of the part as it is at the end of an increment. Radii are distances from a
/// line; places are along a direction.
struct Measure {
  enum class Kind {
    equator_radius, ///< largest radius of the surface [mm]
    contact_radius, ///< largest radius at which the surface touches a tool; none: 0 [mm]
    barrelling,     ///< equator radius over contact radius; without contact 1 [-]
    bore,           ///< smallest radius of the surface [mm]
    height,         ///< from the first to the last place of the surface [mm]
    reach,          ///< the last place of the surface [mm]
    filling         ///< metal in a box over what tools leave of the box [-]
  };

  std::string name; ///< of the column in history.csv
  Kind kind = Kind::height;
  Vec3 point = Vec3::Zero();           ///< on the line of radii [mm]
  Vec3 axis = Vec3::UnitY();           ///< of radii, unit vector
  Vec3 direction = Vec3::UnitY();      ///< of height and reach, unit vector
  std::size_t tool = 0;                ///< that is touched, where the kind asks for one
  std::optional<double> touching = {}; ///< gap up to which the surface touches [mm]
  std::optional<Box> within =
      std::nullopt; ///< what counts of the surface, or the cavity's box [mm]
};

} // namespace billet::process
