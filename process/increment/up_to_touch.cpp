#include "process/increment/up_to_touch.h"

#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::process {

double share_up_to_touch(std::span<const double> touches) {
  constexpr double late = 0.5;     // the first touch: what is before it is worth an increment
  constexpr double between = 0.25; // faces that come down one after the other
  constexpr double enough = 0.35;  // ... the second of them no sooner than here
  constexpr double before = 0.05;
  for (std::size_t i = 0; i < touches.size() && touches[i] < 1.0 - before; ++i)
    if (i == 0 ? touches[0] > late : touches[i] > std::max(touches[i - 1] + between, enough))
      return touches[i] - before;
  return 1.0;
}

double up_to_touch(Run& run, double step) {
  // Where points leave as others come, trapezoids of work that begin at every touch and do not end
  // where points part miss in one direction. New meshes come where a tool touches anyhow, and where
  // driven tools will be is not known.
  constexpr int lately = 10;
  if (!run.model.contact || run.state.last_step.empty() ||
      run.model.contact->state().since_parting < lately || run.scene.remesh ||
      run.state.x.size() > run.n_nodal())
    return step;
  const std::vector<double> x = predicted(run, step);
  const mechanics::Trial trial{run.state.time, run.state.time + step, run.state.x, x, {}};
  if (contact::any_turns(*run.model.contact, trial))
    return step;
  run.model.contact->predict(x);
  return step * share_up_to_touch(contact::touches(*run.model.contact, trial));
}

} // namespace billet::process
