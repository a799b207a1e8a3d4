// What becomes of an increment that has been solved: accepted, tried again shorter or in parts, or
// preceded by a new mesh.

#pragma once

#include "process/increment/commit.h"
#include "process/remeshing/remeshing.h"
#include "process/state/run.h"

#include <string>

namespace billet::process {

struct Verdict {
  enum class Action {
    accept,
    take_length, ///< again, as long as said
    cut_back,    ///< again, half as long
    in_parts,    ///< again, up to a place and on from there
    new_mesh     ///< again, on a new mesh
  };
  Action action = Action::accept;
  std::string why;     ///< of what is to be said of it; empty: nothing
  double length = 0.0; ///< to take [s]
  double share = 0.0;  ///< of the increment that the first part has [-]
  FirstTouch touch;    ///< that the new mesh is for
};

/// @param dt        of the increment [s]
/// @param length    of the stage [s]
/// @param shortest  increment that is allowed [s]
[[nodiscard]] Verdict judge(const Run& run, double dt, double length, double shortest);

} // namespace billet::process
