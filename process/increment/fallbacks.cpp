#include "process/increment/fallbacks.h"

#include "contact/term/contact_report.h"
#include "geometry/base/outcome.h"
#include "process/increment/force_floor.h"
#include "process/increment/held_tool.h"
#include "process/increment/solve_increment.h"
#include "process/state/run.h"

#include <array>
#include <optional>

namespace billet::process {

namespace {

using mechanics::Continuation;

/// What has been solved and refused has the same solution again.
bool unsolved(const Run& run) {
  return run.model.contact && !run.attempt.too_deep && !run.attempt.inside_out;
}

/// A part that is free but for a touch goes to and fro between points that are off by rounding.
std::optional<Outcome<Done>> hardly_touching(Run& run, double dt) {
  if (!may_hardly_touch(run, run.state.time + dt))
    return std::nullopt;
  run.attempt.hardly_touches = true;
  Outcome<Done> solved = try_increment(run, dt, Continuation::none);
  run.attempt.hardly_touches = false;
  return solved;
}

/// Finds the neutral point of a roll.
std::optional<Outcome<Done>> softer_friction(Run& run, double dt) {
  return try_increment(run, dt, Continuation::friction);
}

/// Where a sheet lifts off a tool that it lay on a stiff penalty opens little more than a point an
/// iteration.
std::optional<Outcome<Done>> softer_penalty(Run& run, double dt) {
  return try_increment(run, dt, Continuation::penalty_and_friction);
}

/// At the edge of a contact, where the slip limit grows fast with the pressure, neither stick nor
/// slip need be in equilibrium. With the limit of the pressure before one of them usually is.
/// (F.3a)
std::optional<Outcome<Done>> with_lagged_friction(Run& run, double dt, Continuation continuation) {
  constexpr int most_rounds = 4; // calm points may leave others chattering
  std::optional<Outcome<Done>> solved;
  for (int round = 0; round < most_rounds && run.model.contact->restart_friction_lagged();
       ++round) {
    solved = solve_increment(run, dt, continuation);
    run.attempt.friction_lagged = *solved && contact::friction_lags(*run.model.contact);
    if (*solved || run.attempt.too_deep || run.attempt.inside_out)
      break;
  }
  return solved;
}

std::optional<Outcome<Done>> friction_lagged(Run& run, double dt) {
  return with_lagged_friction(run, dt, Continuation::none);
}

/// Metal that snaps off an edge has far to go in any increment.
std::optional<Outcome<Done>> more_iterations(Run& run, double dt) {
  return try_increment(run, dt, Continuation::more_iterations);
}

std::optional<Outcome<Done>> friction_lagged_and_more_iterations(Run& run, double dt) {
  return with_lagged_friction(run, dt, Continuation::more_iterations);
}

/// A way to a solution.
struct Fallback {
  bool Difficulty::*worth_it;                              ///< from what difficulty on
  std::optional<Outcome<Done>> (*go)(Run& run, double dt); ///< none: it does not apply here
};

constexpr std::array<Fallback, 7> fallbacks{{
    {&Difficulty::failed_before, hardly_touching},
    {&Difficulty::failed_before, softer_friction},
    {&Difficulty::failed_before, softer_penalty},
    {&Difficulty::failed_before, friction_lagged},
    {&Difficulty::last_way, more_iterations},
    {&Difficulty::last_way, friction_lagged_and_more_iterations},
    {&Difficulty::keeps_failing, held_tool},
}};

} // namespace

Outcome<Done> solve_by_any_way(Run& run, double dt, const Difficulty& difficulty) {
  run.attempt.friction_lagged = false;
  Outcome<Done> solved = try_increment(run, dt, Continuation::none);
  for (const Fallback& way : fallbacks)
    if (!solved && difficulty.*way.worth_it && unsolved(run))
      if (const std::optional<Outcome<Done>> by_it = way.go(run, dt))
        solved = *by_it;
  return solved;
}

} // namespace billet::process
