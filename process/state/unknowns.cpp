#include "process/state/unknowns.h"

#include "process/scene/scene.h"
#include "process/state/run.h"

#include <cstddef>
#include <map>
#include <vector>

namespace billet::process {

mechanics::Prescribed prescribed(const Run& run, double time) {
  std::map<Index, double> wanted;
  const int dim = run.mesh().dimension();
  for (const Support& support : run.part().supports)
    for (const Index node : support.nodes) {
      const Index i = node * dim + support.component;
      wanted[i] = run.state.origins[idx(i)] + support.displacement(time);
    }
  mechanics::Prescribed result;
  for (const auto& [unknown, position] : wanted) {
    result.unknowns.push_back(unknown);
    result.positions.push_back(position);
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
