// Metal that has folded over until the walls of the crease meet: a lap.
//
// Units   those of the case. Theory: docs/theory/geometry.md (G.54), (G.55).

#pragma once

#include "geometry/mesh2d/closed_creases.h"
#include "geometry/mesh2d/closed_folds.h"

#include <string>

namespace billet::process {

struct Lap {
  Vec3 at = Vec3::Zero(); ///< where the walls met [mm]
  std::string place;      ///< the same, as messages say it
  double depth = 0.0;     ///< of the crease [mm]
  /// No more than the root of a crease whose walls go on touching each other. (G.54a)
  bool root = false;

  template <class Archive> void fields(Archive& archive) { archive(at, place, depth, root); }
};

/// What is said of a fold, or of a crease, that has closed.
[[nodiscard]] Lap lap(const geometry::ClosedFold& fold);
[[nodiscard]] Lap lap(const geometry::ClosedCrease& crease);

} // namespace billet::process
