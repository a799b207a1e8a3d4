#include "process/loop/verdict.h"

#include "process/increment/bent_increment.h"
#include "process/increment/work_criteria.h"
#include "process/remeshing/first_touch.h"
#include "process/remeshing/remeshing.h"
#include "process/stages/striking.h"
#include "process/state/run.h"

#include <optional>
#include <string>
#include <utility>

namespace billet::process {

namespace {

Verdict take_length(double length) {
  Verdict verdict;
  verdict.action = Verdict::Action::take_length;
  verdict.length = length;
  return verdict;
}

Verdict with_reason(Verdict::Action action, std::string why) {
  Verdict verdict;
  verdict.action = action;
  verdict.why = std::move(why);
  return verdict;
}

} // namespace

Verdict judge(const Run& run, double dt, double length, double shortest) {
  if (const std::optional<double> sooner = step_to_stop(run, dt))
    return take_length(*sooner);
  constexpr double share_that_lets_go = 0.25; // what is tried next
  if (lets_go_too_fast(run, dt))
    return take_length(share_that_lets_go * dt);
  const std::optional<Bend> bend = bend_within(run, dt, length, shortest);
  if (!bend && 0.5 * dt >= shortest)
    if (std::optional<std::string> missed = misses_too_much(run, dt, length))
      return with_reason(Verdict::Action::cut_back, std::move(*missed));
  Verdict verdict;
  if (std::optional<FirstTouch> touch = poor_first_touch(run, dt)) {
    verdict.action = Verdict::Action::new_mesh;
    verdict.touch = std::move(*touch);
  } else if (bend) {
    verdict = with_reason(Verdict::Action::in_parts, bend->why);
    verdict.share = bend->share;
  }
  return verdict;
}

} // namespace billet::process
