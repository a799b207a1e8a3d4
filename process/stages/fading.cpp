#include "process/stages/fading.h"

#include "process/scene/scene.h"
#include "process/state/state.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::process {

namespace {

/// The longest way of a tool that acts, or of a support, from now to a time. [mm]
double way_until(const Run& run, const Stage& stage, double time) {
  const double now = run.state.time;
  double longest = 0.0;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    if (stage.tools[t] == 0 || !run.model.contact->acts(t, time))
      continue;
    const geometry::Motion& motion = run.tools()[t].motion;
    longest = std::max({longest, (motion.translation(time) - motion.translation(now)).norm(),
                        std::abs(motion.angle(time) - motion.angle(now)) * body_size(run.mesh())});
  }
  for (const Support& support : run.part().supports)
    longest = std::max(longest, std::abs(support.displacement(time) - support.displacement(now)));
  return longest;
}

} // namespace

bool tools_leave(const Run& run, const Stage& stage) {
  if (!run.model.contact)
    return false;
  constexpr double soon = 1e-9; // a tool acts up to the end of its time
  const double next = run.state.time + soon * (stage.end - run.state.time);
  for (std::size_t t = 0; t < run.tools().size(); ++t)
    if (contact::leaves(*run.model.contact, t, next))
      return true;
  return false;
}

double faded_at(const Run& run, const Stage& stage) {
  const double now = run.state.time;
  if (stage.unload)
    return stage.end;
  constexpr double farthest = 1e-4;  // of the part: of the order of what it springs back
  constexpr double fewest_parts = 8; // that may be cut from it
  const StageProgress& progress = run.state.progress;
  double length = std::min(fade_share * progress.length, stage.end - now);
  if (run.model.blows && run.model.blows->under_way())
    length = std::min(length, run.model.blows->first_step());
  const auto moves = [&](double within) {
    return std::max(way_until(run, stage, now + 0.5 * within), // it may come back
                    way_until(run, stage, now + within)) > farthest * body_size(run.mesh());
  };
  while (length > fewest_parts * progress.limits.min && moves(length))
    length *= 0.5;
  return now + length;
}

} // namespace billet::process
