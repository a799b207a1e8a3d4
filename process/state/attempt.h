// An attempt at an increment: a trial that is solved for, looked at, and accepted or dropped.

#pragma once

#include "contact/term/contact_term.h"

#include <cstddef>
#include <vector>

namespace billet::process {

/// A press that strikes, led along the way that it has taken before.
struct LedPress {
  std::size_t unknown = 0;   ///< its travel
  double from = 0.0;         ///< [s]
  double travel = 0.0;       ///< at that time [mm]
  double speed = 0.0;        ///< at that time [mm/s]
  double acceleration = 0.0; ///< [mm/s^2]

  [[nodiscard]] double at(double time) const {
    const double since = time - from;
    return travel + since * (speed + 0.5 * acceleration * since);
  }
};

/// The last attempt, and what was found about it. Dropped where an increment is refused; where one
/// is accepted its unknowns become those of the state.
struct Attempt {
  std::vector<double> x;            ///< of the nodes, then of driven tools: (n_dofs + n_extra) [mm]
  contact::Penetration penetration; ///< of the last one that was looked at
  double narrow_radius = -1.0;      ///< of the tool where it is the deepest; < 0: not narrow [mm]
  double quality = 1.0;             ///< of the worst element of the last one that was looked at [-]
  int iterations = 0;               ///< of the last one that could be accepted
  double residual = 0.0;            ///< of the last one that was solved, relative [-]
  bool none = true;                 ///< none has been made since the last increment was accepted
  bool too_deep = false;            ///< refused: a tool lies deeper in the part than is allowed
  bool inside_out = false;          ///< refused: an element turns inside out
  bool moves_away = false;          ///< refused: nothing holds the part
  bool friction_lagged = false;     ///< solved with friction of the pressure before (F.3a)
  bool hardly_touches = false;      ///< forces count as none in it
  /// Points that kept changing in the last one that had any.
  std::vector<contact::ChatteringPoint> chattering;
  std::vector<LedPress> led; ///< while a way is gone again on a new mesh; else empty
  long systems_before = 0;   ///< linear systems solved before it

  /// What a run that is stored between increments goes on with.
  template <class Archive> void fields(Archive& archive) {
    archive(x, penetration, narrow_radius, quality, iterations, residual);
  }
};

} // namespace billet::process
