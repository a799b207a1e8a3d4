// How much, how fast and how long a part is compressed or drawn as a whole, from prescribed
// motions; a detail of io/advice.
//
// Of the part as it lies at the start: tools that press in from both ends of an axis, or supports
// that move an end, change its height, and height over time gives nominal strain and rate. Local
// strains are larger. Rolls, loads that drive tools, and ends that nothing holds give none: there
// nobody knows before the run.

#pragma once

#include "process/scene/scene.h"

#include <optional>
#include <vector>

namespace billet::io {

struct NominalFlow {
  int axis = 0;              ///< along which the height changes most
  double height = 0.0;       ///< at the start, as meshed [mm]
  double strain = 0.0;       ///< ln(height / least height), of drawing ln(most / height) [-]
  bool compresses = false;   ///< else it is drawn
  double duration = 0.0;     ///< while the height changes [s]
  double contact_time = 0.0; ///< from the first touch of a tool to when the last one leaves [s]
  double rate = 0.0;         ///< largest rate of strain [1/s]
  double speed = 0.0;        ///< largest speed of the ends towards each other [mm/s]
  double width = 0.0;        ///< smallest across, of the whole part where planes of symmetry cut it
                             ///< [mm]; infinite: both sides are held
  double thickness = 0.0;    ///< the smaller of width and whole height [mm]
  std::vector<std::size_t> pressing; ///< the tools that press
  double deepest = 0.0;              ///< when they are deepest [s]
};

/// @return none: nothing changes the height of a part that is held, or nobody knows
[[nodiscard]] std::optional<NominalFlow> nominal_flow(const process::Scene& scene);

/// Smallest extent across an axis, of the whole part where planes of symmetry cut it [mm];
/// infinite: both sides are held.
[[nodiscard]] double width_across(const process::Part& part, int axis);

} // namespace billet::io
