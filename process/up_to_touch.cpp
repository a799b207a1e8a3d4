// Increments that end where more of the part comes to touch a tool. (P.27)
//
// In the plane, between dies, on one mesh: in space points come down in any order, rolls take in
// one after the other, and new meshes come where a tool touches anyhow; nothing is saved there.

#include "process/run.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::process {

namespace {

/// Where an increment had better end, as a share of it, whose touches come at these.
///
/// Once a point touches, all goes on in another way than it did: an increment that begins there is
/// guessed well, one that goes on far beyond is not, least of all when a second face comes down in
/// it.
double share_up_to_touch(const std::vector<double>& touches) {
  constexpr double late = 0.5;     // the first touch: what is before it is worth an increment
  constexpr double between = 0.25; // faces that come down one after the other
  constexpr double enough = 0.35;  // ... the second of them no sooner than here
  constexpr double before = 0.05;
  for (std::size_t i = 0; i < touches.size() && touches[i] < 1.0 - before; ++i)
    if (i == 0 ? touches[0] > late : touches[i] > std::max(touches[i - 1] + between, enough))
      return touches[i] - before;
  return 1.0;
}

} // namespace

double Process::up_to_touch(double step) {
  if (!contact_ || last_step_.empty() || scene_.mesh.dimension() == 3 || scene_.remesh)
    return step;
  const std::vector<double> x = foretold(step);
  const mechanics::Trial trial{time_, time_ + step, x_, x, {}};
  if (contact_->any_turns(trial))
    return step;
  contact_->foretell(x);
  return step * share_up_to_touch(contact_->touches(trial));
}

} // namespace billet::process
