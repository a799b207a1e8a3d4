// Where contact of the workpiece with itself stands: plain values.
//
// A point of the surface that touches another face remembers the place of that face, and what it
// needs to know in axes that move with it, so that a rigid motion of both changes nothing.

#pragma once

#include "contact/law/interface_law.h"
#include "contact/surface/contact_surface.h"
#include "contact/term/contact_work.h"
#include "geometry/base/vector.h"

#include <cstddef>
#include <vector>

namespace billet::contact {

/// What a point of the surface that touches another face is at the end of an increment.
struct SelfPoint {
  Index face = -1;            ///< that it touches; -1: it is open
  Vec2 xi = Vec2::Zero();     ///< place there
  Vec3 offset = Vec3::Zero(); ///< of the point from that place, in axes of the place [mm]
  Vec3 shear = Vec3::Zero();  ///< on the point, in those axes [MPa]
  PointHistory history;       ///< normal in space; position is not used
  double since = 0.0;         ///< touches since then [s]
  double shear_yield = 0.0;   ///< k of the parent element when the increment begins [MPa]
  int lap = -1;               ///< that its wall is part of; -1: it has met no other

  [[nodiscard]] bool closed() const { return face >= 0; }

  template <class Archive> void fields(Archive& archive) {
    archive(face, xi, offset, shear, history, since, shear_yield, lap);
  }
};

/// What a closed point is in space: what a new mesh takes over from it.
struct SelfPointInSpace {
  PointHistory history; ///< its shear in space
  bool closed = false;
  double since = 0.0;       ///< [s]
  double shear_yield = 0.0; ///< [MPa]
  int lap = -1;

  template <class Archive> void fields(Archive& archive) {
    archive(history, closed, since, shear_yield, lap);
  }
};

/// What a term on another mesh of the same part needs to go on.
struct SelfContactSnapshot {
  std::vector<SelfPointInSpace> points; ///< shape (n_points); empty: nothing touches or has met
  std::vector<double> laps_since;       ///< [s]
  ContactWork work;

  template <class Archive> void fields(Archive& archive) { archive(points, laps_since, work); }
};

struct SelfContactState {
  std::vector<SelfPoint> points; ///< committed, shape (n_points)
  /// Faces that each point may meet in the next increment, shape (n_points).
  std::vector<std::vector<Index>> ahead;
  bool any_ahead = false;         ///< any point may meet any
  double way = 0.0;               ///< of the last increment, relative to what all go together [mm]
  bool looked = false;            ///< `ahead` is that of the committed state
  double look_ahead = 0.0;        ///< as far as faces have been looked for [mm]
  ContactWork work;               ///< since the start
  double area = 0.0;              ///< where the part touches itself, of one of both sides [mm^2]
  double depth = 0.0;             ///< of the deepest point [mm]
  std::vector<double> laps_since; ///< of each lap the time at which its first walls met [s]

  template <class Archive> void fields(Archive& archive) {
    archive(points, ahead, any_ahead, way, looked, look_ahead, work, area, depth, laps_since);
  }
};

} // namespace billet::contact
