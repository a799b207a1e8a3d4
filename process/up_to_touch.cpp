#include "process/up_to_touch.h"

#include "process/run.h"

#include <algorithm>
#include <cstddef>
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

double Process::up_to_touch(double step) {
  // Where points leave as others come, trapezoids of work that begin at every touch and do not end
  // where points part miss in one direction. New meshes come where a tool touches anyhow, and where
  // driven tools will be is not known.
  constexpr int lately = 10;
  if (!contact_ || state_.last_step.empty() || contact_->state().since_parting < lately ||
      scene_.remesh || state_.x.size() > state_.origins.size())
    return step;
  const std::vector<double> x = predicted(step);
  const mechanics::Trial trial{state_.time, state_.time + step, state_.x, x, {}};
  if (contact::any_turns(*contact_, trial))
    return step;
  contact_->predict(x);
  return step * share_up_to_touch(contact::touches(*contact_, trial));
}

} // namespace billet::process
