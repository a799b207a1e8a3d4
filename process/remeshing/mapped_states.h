// The states of a run on a new mesh. (P.16), (P.19)

#pragma once

#include "process/remeshing/part_boundary.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <vector>

namespace billet::process {

/// Integrals over the fields of a part.
struct FieldIntegrals {
  double volume = 0.0;       ///< [mm^3]
  double plastic_work = 0.0; ///< that the plastic strain stands for [N mm]
  double mean_strain = 0.0;  ///< plastic, over the volume [-]
  double largest_strain = 0.0;
};

/// A state on a new mesh; its contact is still that of the old one.
struct MappedState {
  Snapshot state;
  FieldIntegrals before; ///< on the old mesh
  int returned = 0;      ///< points put back onto the yield surface
};

/// Where the run is, on a new mesh, and where it was some increments ago.
struct MappedStates {
  MappedState now;
  /// Those where the new elements had a shape, the earliest first; may be empty.
  std::vector<MappedState> begun;
  std::vector<contact::PointSource> sources; ///< of the new contact points
  std::vector<double> origins;               ///< of the material at the nodes [mm]
};

/// Integrals over the fields of a state that may not be the bulk's own.
[[nodiscard]] FieldIntegrals field_integrals(const mechanics::Bulk& bulk, const Snapshot& at);

/// The states of the run on a new mesh, without the sources of its contact points.
[[nodiscard]] MappedStates map_states(const Run& run, const RemeshedPart& part);

} // namespace billet::process
