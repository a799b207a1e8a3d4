// Flights: spans of time in which nothing acts on the workpiece anew, however far its tools travel.
//
// A tool on its way through the air, a part that its supports carry to the next tool, a pusher that
// takes a free part along: until something touches, or a load changes, the part is in equilibrium
// as it is, and one increment goes there. When that is, the facets of both tell, as for tools that
// are brought to touch.
//
// Units: mm, s. Theory: docs/theory/process.md (P.31).

#pragma once

#include "contact/term/contact_term.h"
#include "process/scene/scene.h"

#include <array>
#include <optional>
#include <span>

namespace billet::process {

/// What moves a part as a whole.
struct Carrier {
  std::array<std::optional<TimeFunction>, 3> supports; ///< that hold a component [mm]
  std::optional<geometry::Motion> pusher;              ///< of a tool that moves the others
  std::optional<std::size_t> pushing_tool;             ///< that one

  /// Between two times [mm].
  [[nodiscard]] Vec3 shift(double from, double to) const;

  template <class Archive> void fields(Archive& archive) { archive(supports, pushing_tool); }
};

/// A span of time from now on in which the part stays as it is, or goes along with its carrier.
struct Flight {
  double until = 0.0; ///< just before something touches, or a load changes [s]
  Carrier carrier;

  template <class Archive> void fields(Archive& archive) { archive(until, carrier); }
};

/// The state of a run in which a flight may begin.
struct Departure {
  const Part& part;
  std::span<const contact::Tool> tools;
  const Stage& stage;
  const contact::ContactTerm* contact;    ///< null: there are no tools
  const contact::ContactSurface* surface; ///< null: there are no tools
  std::span<const double> x;              ///< committed unknowns, shape (n_dofs + n_extra) [mm]
  std::span<const double> last_step;      ///< of the last increment, same shape [mm]; empty: none
  double time;                            ///< [s]
  double last_dt;                         ///< [s]
};

/// The flight that begins now; none: it would be shorter than `least` [s], or nothing moves.
[[nodiscard]] std::optional<Flight> flight_from(const Departure& now, double least);

} // namespace billet::process
