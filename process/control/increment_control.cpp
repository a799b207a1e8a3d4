#include "process/control/increment_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace billet::process {

namespace {

constexpr int laboured_iterations = 9; ///< beyond them the increment may be too long
constexpr double short_share = 0.1;    ///< of the longest: shorter ones are too many
constexpr double easy_growth = 1.5;
constexpr double careful_growth = 1.15;
constexpr double shrinking = 0.7;
constexpr double below_failure = 0.9; ///< of the length that failed
constexpr double most_missed = 0.02;  ///< of the work of an increment
constexpr double exact_share = 0.25;  ///< of the longest: no shorter for the sake of the balance
constexpr double rise_of_ceiling = 1.1;
constexpr double trial_growth = 8.0;

} // namespace

double step_towards(double left, double dt) { return dt >= left ? left : std::min(dt, 0.5 * left); }

double part_towards(double left, double part) {
  constexpr double rounding = 1e-9;
  return part > (1.0 - rounding) * left ? left : part;
}

void IncrementControl::split(double step, double share, int iterations) {
  if (in_parts())
    parts_.pop_back();
  else
    accepted(step, iterations);
  parts_.push_back((1.0 - share) * step);
  parts_.push_back(share * step);
}

void IncrementControl::accepted(double step, int iterations, double missed) {
  if (in_parts()) {
    parts_.pop_back();
    return;
  }
  before_trial_ = 0.0;
  const double wanted = next_;
  const bool whole = step >= wanted; // else it tells little about the length wanted
  if (iterations <= easy_iterations) {
    next_ = std::max(wanted, step) * easy_growth;
  } else if (iterations <= laboured_iterations) {
    next_ = whole && step < short_share * limits_.max ? step * careful_growth : wanted;
  } else {
    const bool longer = last_step_ > 0.0 && step > last_step_;
    const bool pays = last_step_ == 0.0 || iterations * last_step_ < last_iterations_ * step ||
                      step == last_step_;
    next_ = longer == pays ? step * careful_growth : step * shrinking;
  }
  // What trapezoids miss goes with the square of the length. The next ones may be easy, and one
  // after them as rough as this.
  if (missed > most_missed) {
    const double shorter = step * std::max(shrinking, std::sqrt(most_missed / missed));
    const double ceiling = std::max(exact_share * limits_.max, shorter);
    ceiling_ = ceiling_ > 0.0 ? std::min(ceiling_, ceiling) : ceiling;
  }
  if (ceiling_ > 0.0) {
    next_ = std::min(next_, ceiling_);
    ceiling_ = ceiling_ < limits_.max ? ceiling_ * rise_of_ceiling : 0.0;
  }
  next_ = std::clamp(next_, std::min(limits_.min, step), limits_.max);
  last_step_ = step;
  last_iterations_ = iterations;
  try_longer(step);
}

void IncrementControl::try_longer(double step) {
  if (step >= short_share * limits_.max) {
    n_short_ = 0;
    patience_ = first_patience;
  } else if (++n_short_ >= patience_) {
    n_short_ = 0;
    patience_ *= 2;
    before_trial_ = next_;
    next_ = std::min(trial_growth * step, exact_share * limits_.max);
  }
}

void IncrementControl::failed(double step) {
  const bool was_trial = before_trial_ > 0.0 && !in_parts();
  const double before = std::exchange(before_trial_, 0.0);
  parts_.clear();
  if (was_trial) {
    next_ = before;
    return;
  }
  next_ = 0.5 * step;
  ceiling_ = below_failure * step;
  last_step_ = 0.0;
}

} // namespace billet::process
