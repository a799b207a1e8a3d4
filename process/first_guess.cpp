#include "process/first_guess.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace billet::process {

void FirstGuess::forget() {
  step_.clear();
  steady_ = 0;
}

void FirstGuess::begin_with(std::vector<double> step, double length) {
  step_ = std::move(step);
  length_ = length;
  steady_ = 0;
}

void FirstGuess::note(std::span<const double> from, std::span<const double> to, double length) {
  constexpr double nearly = 0.05; // of the largest displacement
  double moved = 0.0;
  double off = 0.0; // the straight line
  earlier_step_.swap(step_);
  earlier_length_ = std::exchange(length_, length);
  const double factor = length / earlier_length_;
  const bool compares = earlier_step_.size() == to.size();
  step_.resize(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    step_[i] = to[i] - from[i];
    moved = std::max(moved, std::abs(step_[i]));
    if (compares)
      off = std::max(off, std::abs(step_[i] - factor * earlier_step_[i]));
  }
  steady_ = compares && off <= nearly * moved ? steady_ + 1 : 0;
}

void FirstGuess::go_straight_on(double length, std::vector<double>& x) const {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += length / length_ * step_[i];
}

void FirstGuess::go_on(double length, std::vector<double>& x) const {
  constexpr int enough = 2;        // what a contact has changed lies before both
  constexpr double farthest = 2.0; // that the change is carried on, of the way it is known from
  const double onward = (length_ + length) / (length_ + earlier_length_);
  if (steady_ < enough || onward > farthest) {
    go_straight_on(length, x);
    return;
  }
  const double now = length / length_ * (1.0 + onward);
  const double then = length / earlier_length_ * onward;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += now * step_[i] - then * earlier_step_[i];
}

} // namespace billet::process
