// The largest force on each tool over a run: what a press has to bear.

#pragma once

#include "process/loop/process.h"

#include <vector>

namespace billet::io {

/// Of the workpiece on a tool, and when.
struct LargestForce {
  Vec3 force = Vec3::Zero(); ///< as in history.csv [N]
  double time = 0.0;         ///< at the end of that increment [s]

  template <class Archive> void fields(Archive& archive) { archive(force, time); }
};

/// Takes an increment in that has just been accepted; of equal forces the first stays.
void note_largest_forces(const process::Run& run, double time, std::vector<LargestForce>& largest);

} // namespace billet::io
