// The run loop: a stage, increment by increment. (P.1), (P.3)

#pragma once

#include "geometry/base/outcome.h"
#include "process/loop/verdict.h"
#include "process/reports/observer.h"
#include "process/scene/scene.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <string>
#include <vector>

namespace billet::process {

/// Takes a run through one of its stages. Where it is within the stage is part of the run's state,
/// so a run that is resumed goes on in the midst of one.
class StageLoop {
public:
  /// @pre all outlive it
  StageLoop(Run& run, const Stage& stage, const std::vector<Observer*>& observers)
      : run_(run), stage_(stage), observers_(observers), progress_(run.state.progress) {}

  /// @param start  of the stage [s]
  /// @return done: at its end, or the presses have no energy left
  [[nodiscard]] RunStatus go(double start);

private:
  /// An increment that is tried.
  struct Step {
    double length;  ///< [s]
    double landing; ///< the next time at which one has to end [s]
    bool lands;     ///< there
  };

  [[nodiscard]] bool should_stop() const;
  void note_other_end();
  /// Whether nothing moves any more, and the run ends here.
  [[nodiscard]] bool comes_to_rest();
  /// Lets the forces of tools that leave now fade.
  void begin_fading();
  void end_fading();
  /// Through a flight, if there is one.
  /// @return whether there was
  [[nodiscard]] bool goes_through_flight();
  [[nodiscard]] Step next_step();
  [[nodiscard]] Outcome<Done> solve(const Step& step);
  [[nodiscard]] bool is_last_way(double length) const;
  void follow(const Verdict& verdict, const Step& step);
  void take(const Step& step);
  /// What is tried after an increment could not be solved.
  /// @return whether there is anything left to try
  [[nodiscard]] bool goes_on_after(const Step& step, const Failure& failure);
  /// On a new mesh, if one may help and can be made.
  [[nodiscard]] bool goes_on_with_new_mesh(const Step& step);
  /// What keeps tools from drawing back is left to their forces, which fade.
  void leave_forces_behind();
  void remesh_for(const std::string& cause, const std::vector<geometry::SizeAt>& sizes);
  void tell_of_failure(double length, std::string why);

  Run& run_;
  const Stage& stage_;
  const std::vector<Observer*>& observers_;
  StageProgress& progress_;
};

} // namespace billet::process
