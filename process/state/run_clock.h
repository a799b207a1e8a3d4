// Where the time of a run goes: of this process, and of those that it was resumed from.

#pragma once

#include "mechanics/linear/linear_solver.h"
#include "process/reports/phase_times.h"

namespace billet::process {

struct RunClock {
  PhaseTimes times;
  PhaseTimes earlier;                 ///< on earlier meshes
  mechanics::SolverWork earlier_work; ///< on earlier meshes
  double analysis_before = 0.0;       ///< of the unknowns' order, outside the iteration [s]
  double started = 0.0;               ///< on the machine's clock [s]
  double before = 0.0;                ///< of the run before it was resumed [s]
};

} // namespace billet::process
