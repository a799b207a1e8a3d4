// A run: its scene, its state, the model built on its part, and the last attempt at an increment.
//
// Whatever looks at a run, as observers and checks do, takes a constant one; what solves, commits
// or meshes anew takes one that it may change.

#pragma once

#include "process/scene/scene.h"
#include "process/state/attempt.h"
#include "process/state/model.h"
#include "process/state/run_clock.h"
#include "process/state/state.h"

#include <memory>
#include <span>
#include <vector>

namespace billet::process {

struct Run {
  /// At the start, its model built.
  /// @param prepared  its tools have been brought to touch
  /// @throws Error (Fault::case_file) if nothing holds the part
  explicit Run(Scene prepared);

  const Scene scene;
  State state;
  Model model;
  Attempt attempt;
  RunClock clock;

  /// The workpiece on its present mesh.
  [[nodiscard]] const Part& part() const { return *state.part; }
  [[nodiscard]] const mechanics::Mesh& mesh() const { return part().mesh; }
  /// As they are now.
  [[nodiscard]] std::span<const contact::Tool> tools() const { return model.tools; }
  /// Null: there are no tools.
  [[nodiscard]] const contact::ContactTerm* contact() const { return model.contact.get(); }
  [[nodiscard]] std::size_t n_nodal() const { return state.origins.size(); }
  /// Committed positions of the nodes, shape (n_nodal) [mm].
  [[nodiscard]] std::span<const double> positions() const {
    return std::span(state.x).first(n_nodal());
  }
  /// Those of the last attempt; of interest after a failure.
  [[nodiscard]] std::span<const double> trial_positions() const {
    return std::span(attempt.x).first(n_nodal());
  }
  /// Where a tool's free degrees of freedom are.
  [[nodiscard]] geometry::Driven driven(std::size_t tool) const {
    return model.contact ? model.contact->driven(tool, state.x) : geometry::Driven{};
  }
  /// Blows of presses given by their energy, in the order in which they began.
  [[nodiscard]] std::span<const BlowReport> blows() const {
    return model.blows ? std::span(model.blows->reports()) : std::span<const BlowReport>();
  }
  /// From the state to the last attempt, over a time [s].
  [[nodiscard]] mechanics::Trial trial(double dt) const {
    return {state.time, state.time + dt, state.x, attempt.x};
  }
  /// Factorizations and substitutions of the run.
  [[nodiscard]] mechanics::SolverWork solver_work() const {
    return model.newton->solver_work().after(clock.earlier_work);
  }
};

/// Puts a part in the place of the present one, and builds the model on it. All that is known of
/// nodes and points is the caller's to set.
///
/// @param x  positions of the nodes, then driven tools, shape (n_dofs + n_extra) [mm]
void rebuild(Run& run, Part part, std::vector<double> x);

/// Sums up where the time has gone so far.
void take_times(Run& run);

} // namespace billet::process
