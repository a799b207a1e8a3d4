#include "process/measures/support_forces.h"

#include "process/state/wall.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::process {

namespace {

/// The force of a name, added where there is none yet.
Vec3& force_of(std::vector<SupportForce>& forces, const std::string& name) {
  const auto known = std::find_if(forces.begin(), forces.end(),
                                  [&](const SupportForce& force) { return force.name == name; });
  return known != forces.end() ? known->force
                               : forces.emplace_back(SupportForce{name, Vec3::Zero()}).force;
}

/// Whether a support is the plane that a wall stands for.
bool is_plane_of(const Run& run, const Support& support, const Wall& wall) {
  constexpr double rounding = 1e-6; // of the size of the part
  if (wall.axis || support.component != wall.component || support.nodes.empty())
    return false;
  const Vec3 on_it =
      mechanics::node_position(run.state.x, run.mesh().dimension(), support.nodes[0]);
  return std::abs(on_it[wall.component] - wall.at) <= rounding * body_size(run.mesh());
}

} // namespace

std::vector<SupportForce> support_forces(const Run& run) {
  const auto dim = static_cast<std::size_t>(run.mesh().dimension());
  std::vector<SupportForce> forces;
  std::vector<char> taken(run.state.reactions.size(), 0);
  for (const Support& support : run.part().supports) {
    const auto take = [&](Index node) {
      const std::size_t i = idx(node) * dim + static_cast<std::size_t>(support.component);
      const bool first = taken[i] == 0;
      taken[i] = 1;
      return first ? -run.state.reactions[i] : 0.0; // reactions act on the workpiece
    };
    double sum = 0.0;
    for (const Index node : support.nodes)
      sum += take(node);
    if (support.name.empty())
      continue;
    for (const Wall& wall : run.state.walls)
      if (is_plane_of(run, support, wall))
        for (const Index node : wall.held)
          sum += take(node);
    force_of(forces, support.name)[support.component] += sum;
  }
  return forces;
}

} // namespace billet::process
