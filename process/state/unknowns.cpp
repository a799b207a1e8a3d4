#include "process/state/unknowns.h"

#include "process/scene/scene.h"
#include "process/state/run.h"

#include <cstddef>
#include <map>
#include <vector>

namespace billet::process {

mechanics::Prescribed prescribed_by_supports(const Run& run, double time) {
  std::map<Index, double> wanted;
  const int dim = run.mesh().dimension();
  for (const Support& support : run.part().supports)
    for (const Index node : support.nodes) {
      const Index i = node * dim + support.component;
      wanted[i] = run.state.origins[idx(i)] + support.displacement(time);
    }
  for (const Wall& wall : run.state.walls)
    for (const Index node : wall.held)
      wanted[node * dim + wall.component] =
          wall.axis ? run.state.x[idx(node * dim + wall.component)] : wall.at;
  mechanics::Prescribed result;
  for (const auto& [unknown, position] : wanted) {
    result.unknowns.push_back(unknown);
    result.positions.push_back(position);
  }
  return result;
}

mechanics::Prescribed prescribed(const Run& run, double time) {
  mechanics::Prescribed result = prescribed_by_supports(run, time);
  for (const LedPress& press : run.attempt.led) {
    result.unknowns.push_back(static_cast<Index>(press.unknown));
    result.positions.push_back(press.at(time));
  }
  return result;
}

std::vector<double> predicted(const Run& run, double dt) {
  std::vector<double> x = run.attempt.x; // driven tools go on only if they have moved in this stage
  for (std::size_t i = 0; i < run.state.velocity.size(); ++i)
    x[i] = run.state.x[i] + dt * run.state.velocity[i];
  return x;
}

} // namespace billet::process
