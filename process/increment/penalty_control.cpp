#include "process/increment/penalty_control.h"

#include "process/increment/penetration_limit.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::process {

namespace {

void begin_with_stiffness(Run& run, double factor) {
  run.model.contact->begin_with_stiffness(factor);
  run.state.record.penalty_event = fmt::format("  contact penalty: {:.3g} times that of the case",
                                               run.model.contact->state().penalty.next);
}

} // namespace

void adapt_penalty(Run& run, Progress progress) {
  const contact::ContactSettings& settings = run.scene.contact;
  if (!run.model.contact || bounds_penetration(run))
    return;
  // Depths of the deepest contact point over that of the parent element, with the penalty that the
  // next increment begins with.
  constexpr double needlessly_small = 1e-6, small = 1e-5, large = 1e-4;
  // Softer lets points sink a little; stiffer throws them out, so it comes in small steps.
  constexpr double softer = 0.1, stiffer = 2.0;
  // Of the stiffness of the parent element over its depth; while nothing says what presses, no
  // softer than the element.
  const bool presses = run.attempt.penetration.share_pressed > 0.0;
  const double least = presses ? 1e-3 : 1.0;
  const double next = run.model.contact->state().penalty.next;
  const double share =
      run.attempt.penetration.share_pressed * run.model.contact->state().penalty.trial / next;
  const double enough = progress == Progress::none ? small : needlessly_small;
  // At the first touch nothing is pressed yet: only tries that keep failing tell.
  const bool tells = progress == Progress::none || (progress == Progress::laboured && presses);
  if (tells && share < enough && next * settings.penalty > least)
    begin_with_stiffness(run, softer);
  else if (share > large && next < 1.0)
    begin_with_stiffness(run, std::min(stiffer, 1.0 / next));
  else if (progress == Progress::easy && share == 0.0 && next < 1.0)
    begin_with_stiffness(run, 1.0 / next); // nothing touches that a stiffer one could throw out
}

} // namespace billet::process
