// A forming process: a scene taken through its stages, increment by increment.
//
// An increment moves the tools, solves for equilibrium with contact found anew in every iteration,
// and is accepted or cut back; the step grows on easy increments. Observers look at each accepted
// increment and change nothing. Theory: docs/theory/process.md (P.1)-(P.21).

#pragma once

#include "process/reports/observer.h"
#include "process/state/run.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace billet::process {

class Process {
public:
  /// Prepares a scene: brings tools to touch, checks that nothing overlaps and that all is held.
  /// @throws Error (Fault::geometry, Fault::case_file)
  explicit Process(Scene scene);

  /// The run as it is now. Constant: what looks at it changes nothing.
  [[nodiscard]] const Run& view() const { return run_; }
  operator const Run&() const { return run_; } // NOLINT: a process is looked at as its run

  /// Runs to the end, or to where it cannot go on or an observer stops it; called again it goes on.
  RunStatus run(const std::vector<Observer*>& observers);

  /// Gives away the memory that the positions of the nodes are in, followed by those of driven
  /// tools, and goes on with a copy: whoever looks at them may keep them.
  [[nodiscard]] std::vector<double> take_positions();

  /// The run as it is between two increments, in bytes: what `resume` goes on from. The linear
  /// solver forgets, as it has where a run is resumed, so that both go on with the same bits.
  [[nodiscard]] std::string store();
  /// Goes on from where another run of the same scene was stored; before `run`.
  ///
  /// The scene may differ in what is still to come: later stages, the end, settings of the solver.
  /// @throws Error (Fault::input_output) if the bytes are not those of such a run
  void resume(std::string_view stored);

private:
  Run run_;
  bool resumed_ = false;
};

} // namespace billet::process
