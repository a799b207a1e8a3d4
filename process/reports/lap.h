// Metal that has folded over until the walls of the crease meet: a lap.
//
// Units   those of the case. Theory: docs/theory/geometry.md (G.54), (G.55).

#pragma once

#include "geometry/mesh2d/closed_creases.h"
#include "geometry/mesh2d/closed_folds.h"

#include <string>

namespace billet::process {

struct Lap {
  std::string place; ///< where the walls met, as messages say it
  double depth;      ///< of the crease [mm]
  /// No more than the root of a crease whose walls go on touching each other. (G.54a)
  bool root = false;

  template <class Archive> void fields(Archive& archive) { archive(place, depth, root); }
};

/// What is said of a fold, or of a crease, that has closed.
[[nodiscard]] Lap lap(const geometry::ClosedFold& fold);
[[nodiscard]] Lap lap(const geometry::ClosedCrease& crease);

} // namespace billet::process
