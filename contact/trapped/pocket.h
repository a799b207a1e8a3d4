// A pocket: a part of the free surface that is closed off by a tool on both of its ends, or by a
// tool and a plane of symmetry. Plain values.

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/base/vector.h"

#include <cstddef>
#include <vector>

namespace billet::contact {

/// Where a pocket lies on a mesh.
struct PocketPlace {
  std::vector<Index> faces;   ///< of the contact surface, in turn, the part on their left
  std::size_t tool = 0;       ///< that closes it
  double volume = 0.0;        ///< between metal and tool [mm^3]
  double area = 0.0;          ///< of its faces [mm^2]
  double length = 0.0;        ///< of the line that they make [mm]
  Vec3 centre = Vec3::Zero(); ///< of its faces [mm]
  /// What the mesh cannot tell from nothing: the unevenness of contact leaves as much [mm^3].
  double dead_volume = 0.0;

  /// Dead volumes are those of gaps as wide as this share of the parent elements' depth.
  static constexpr double least_depth = 0.005;

  /// Whether the mesh is fine enough to tell it from an uneven contact.
  [[nodiscard]] bool resolved() const {
    constexpr std::size_t least_faces = 2;
    constexpr double least_volume = 4.0; // of the dead one
    return faces.size() >= least_faces && volume > least_volume * dead_volume;
  }
  /// Whether so much of it is left that what is in it may press.
  [[nodiscard]] bool left() const { return volume > dead_volume; }

  template <class Archive> void fields(Archive& archive) {
    archive(faces, tool, volume, area, length, centre, dead_volume);
  }
};

/// A pocket and what is trapped in it.
struct Pocket {
  PocketPlace place;
  double volume = 0.0;      ///< that it has [mm^3]
  double rest_volume = 0.0; ///< at which its content would have the pressure of the surroundings
  double dead_volume = 0.0; ///< that is added to both [mm^3]
  double pressure = 0.0;    ///< above that of the surroundings [MPa]
  double since = 0.0;       ///< closed since then [s]

  template <class Archive> void fields(Archive& archive) {
    archive(place, volume, rest_volume, dead_volume, pressure, since);
  }
};

/// All pockets of a part, at the end of an increment.
struct TrappedState {
  std::vector<Pocket> pockets;
  double work = 0.0;    ///< done on the workpiece so far [N mm]
  double highest = 0.0; ///< pressure in any of them so far [MPa]
  int n_closed = 0;     ///< pockets that have been closed off
  int n_vented = 0;     ///< of these, such as have opened again
  int n_filled = 0;     ///< of these, such as metal has filled

  template <class Archive> void fields(Archive& archive) {
    archive(pockets, work, highest, n_closed, n_vented, n_filled);
  }
};

} // namespace billet::contact
