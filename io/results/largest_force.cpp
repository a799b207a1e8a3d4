#include "io/results/largest_force.h"

namespace billet::io {

void note_largest_forces(const process::Process& process,
                         double time,
                         std::vector<LargestForce>& largest) {
  largest.resize(process.scene().tools.size());
  for (std::size_t t = 0; t < largest.size(); ++t) {
    const Vec3& force = process.contact()->loads()[t].force;
    if (force.norm() > largest[t].force.norm())
      largest[t] = {force, time};
  }
}

} // namespace billet::io
