#include "process/state/run.h"

#include "geometry/base/stopwatch.h"
#include "process/scene/scene.h"
#include "process/state/model.h"

#include <memory>
#include <utility>
#include <vector>

namespace billet::process {

Run::Run(Scene prepared)
    : scene(std::move(prepared)), state(scene.tools.size()), model(scene.tools) {
  clock.started = seconds_now();
  state.part = std::make_shared<const Part>(scene.part);
  state.origins = mechanics::node_positions(mesh());
  state.x = state.origins;
  state.x.resize(n_nodal() + contact::drive_unknowns(model.tools).size(), 0.0);
  attempt.x = state.x;
  state.velocity.assign(n_nodal(), 0.0);
  state.reactions.assign(n_nodal(), 0.0);
  build(model, scene, part(), state.x);
  state.plastic_rate.assign(model.bulk->states().size(), 0.0);
  state.energy.nothing = negligible_work(model);
}

void rebuild(Run& run, Part part, std::vector<double> x) {
  take_times(run); // of what goes with the old mesh
  run.clock.earlier = run.clock.times;
  run.clock.earlier_work = run.solver_work();
  // The model refers to the old part until it is built anew.
  const auto old = std::exchange(run.state.part, std::make_shared<const Part>(std::move(part)));
  run.state.x = std::move(x);
  build(run.model, run.scene, run.part(), run.state.x);
  run.clock.analysis_before = run.model.newton->solver_work().analysis;
  run.state.plastic_rate.assign(run.model.bulk->states().size(), 0.0);
  run.state.energy.nothing = negligible_work(run.model);
}

void take_times(Run& run) {
  const mechanics::SolverWork work = run.model.newton->solver_work();
  const double search = run.model.contact ? run.model.contact->times().search : 0.0;
  const double contact = run.model.contact ? run.model.contact->times().elements : 0.0;
  const double elements = run.model.bulk->assembly_time();
  run.clock.times.search = run.clock.earlier.search + search;
  run.clock.times.contact = run.clock.earlier.contact + contact;
  run.clock.times.elements = run.clock.earlier.elements + elements;
  run.clock.times.assembly =
      run.clock.earlier.assembly + run.model.newton->times().assembly - elements - search - contact;
  run.clock.times.analysis = run.clock.earlier.analysis + work.analysis;
  run.clock.times.factorization = run.clock.earlier.factorization + work.factorization;
  run.clock.times.solve = run.clock.earlier.solve + run.model.newton->times().solve -
                          work.factorization - (work.analysis - run.clock.analysis_before);
}

} // namespace billet::process
