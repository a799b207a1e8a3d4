#include "io/results/largest_force.h"

namespace billet::io {

void note_largest_forces(const process::Run& run, double time, std::vector<LargestForce>& largest) {
  largest.resize(run.tools().size());
  for (std::size_t t = 0; t < largest.size(); ++t) {
    const Vec3& force = run.contact()->loads()[t].force;
    if (force.norm() > largest[t].force.norm())
      largest[t] = {force, time};
  }
}

} // namespace billet::io
