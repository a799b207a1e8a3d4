// What contact says of itself: its points, its tools, what did not converge.

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::contact {

/// Contact results of one point, summed over the tools it touches, in space.
struct PointResult {
  double gap = 0.0;          ///< smallest known signed distance [mm]; +inf: out of reach
  double pressure = 0.0;     ///< [MPa]
  Vec3 shear = Vec3::Zero(); ///< [MPa]
  Status status = Status::open;
  double sliding = 0.0; ///< sliding distance so far [mm]
};

/// Of all points, in the committed state, shape (n_points).
[[nodiscard]] std::vector<PointResult> point_results(const ContactView& contact);

/// A contact point that keeps changing between open, stick and slip.
struct ChatteringPoint {
  std::size_t tool;
  Vec3 position; ///< in space [mm]
  int changes;   ///< of its status in this try
};

/// Changes of status that make a point chattering: on its way to contact or to slip it changes once
/// or twice.
constexpr int chattering_changes = 4;

/// Points that have changed in many evaluations of this try, the most chattering first.
[[nodiscard]] std::vector<ChatteringPoint> chattering(const ContactView& contact);

/// Whether the shear of points whose friction lags is off their law in the last trial, by more than
/// a hundredth of the friction of a tool in all. (F.3a)
[[nodiscard]] bool friction_lags(const ContactView& contact);

/// Whether a point is closed on a tool in the committed state.
[[nodiscard]] bool closed_on(const ContactView& contact, std::size_t tool, std::size_t point);

/// How deep its pressure needs a point to lie in a tool, in the committed state [mm].
[[nodiscard]] double
depth_of_pressure(const ContactView& contact, std::size_t tool, std::size_t point);

/// What a point bears on a tool in the last trial, in the tool's frame.
[[nodiscard]] const Traction&
trial_traction(const ContactView& contact, std::size_t tool, std::size_t point);

/// What the corners of a tool press on in the committed state. (C.46)
[[nodiscard]] std::span<const CornerState> corners(const ContactView& contact, std::size_t tool);

/// Area in contact of the last committed trial with what corners stand for: nothing only where
/// nothing bears any force [mm^2].
[[nodiscard]] double bearing_area(const ContactView& contact);

/// A tool's forces at one end of an increment.
struct ForcesOfTool {
  double sum = 0.0;  ///< of the magnitudes at all points [N]
  double work = 0.0; ///< over its way in the increment [N mm]
};

/// Those at the beginning and at the end of the increment of the last trial.
[[nodiscard]] std::array<ForcesOfTool, 2>
forces_of_tool(const ContactView& contact, std::size_t tool, const mechanics::Trial& trial);

/// Whether a point lies on a tool, or on a corner of it, in the committed state, with or without
/// pressure.
[[nodiscard]] bool lies_on(const ContactView& contact, std::size_t tool);

/// Whether a tool bears, in the last trial, on a face or on one that shares a node with it.
[[nodiscard]] bool bears_near(const ContactView& contact, std::size_t tool, Index face);

/// Whether a tool's surface has begun to draw back.
[[nodiscard]] bool draws_back(const ContactView& contact, std::size_t tool);

/// Whether a tool touches in the committed state but will not act at `time`.
[[nodiscard]] bool leaves(const ContactView& contact, std::size_t tool, double time);

} // namespace billet::contact
