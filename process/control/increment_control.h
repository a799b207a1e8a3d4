// How long the next increment may be.
//
// Increments grow while they are easy and shrink when they fail. Between the two lies what many
// iterations mean: often that the increment is long, but contact that changes as the part rolls
// past takes its iterations whatever the length, and shrinking would only add increments. So what
// counts is the cost, iterations per time: an increment that laboured is shortened only as long as
// that saves iterations, and one between the two grows as long as it is far shorter than it may be.
// After many short ones a much longer one is tried: contact that keeps changing can be as hard to
// solve in short increments as in long ones.
// An easy one may be too long for the trapezoids of its work: the balance of energy tells. One in
// which the load curve bends is gone in parts, and says of the length of others what it said whole.
//
// Theory: docs/theory/process.md (P.1).

#pragma once

#include <vector>

namespace billet::process {

/// The step to take when `left` is left to a landing: two equal ones rather than a long and a tiny
/// one.
[[nodiscard]] double step_towards(double left, double dt);

/// The step to take for a part of an increment: the part, or all that is left if no more than
/// rounding is between them.
[[nodiscard]] double part_towards(double left, double part);

class IncrementControl {
public:
  /// Lengths of increments [s].
  struct Limits {
    double first = 0.0;
    double min = 0.0;
    double max = 0.0;

    template <class Archive> void fields(Archive& archive) { archive(first, min, max); }
  };

  IncrementControl() = default;
  explicit IncrementControl(const Limits& limits) : limits_(limits), next_(limits.first) {}

  /// Wanted length of the next increment [s].
  [[nodiscard]] double next() const { return in_parts() ? parts_.back() : next_; }
  /// Whether an increment of that length is too short to be tried.
  [[nodiscard]] bool exhausted() const { return next_ < limits_.min; }

  /// An increment of this length has been accepted.
  ///
  /// @param step        its length, maybe shorter than wanted: something had to be met [s]
  /// @param iterations  that it took
  /// @param missed      what its balance of energy misses, as a share of its work [-]
  void accepted(double step, int iterations, double missed = 0.0);

  /// An increment of this length has failed.
  void failed(double step);

  /// An increment of this length has been solved, but is to be gone in two parts, or its part is.
  ///
  /// @param share       the first one's
  /// @param iterations  that the increment took: for the length of the one after it
  void split(double step, double share, int iterations);
  /// Whether the next one is such a part.
  [[nodiscard]] bool in_parts() const { return !parts_.empty(); }

  /// The next one has this length, whatever has been before [s].
  void set_next(double length) {
    parts_.clear();
    next_ = length;
    before_trial_ = 0.0;
  }

  /// Other limits from now on: the stage has become longer or shorter.
  void set_limits(const Limits& limits) { limits_ = limits; }

  /// Iterations up to which an increment counts as easy.
  static constexpr int easy_iterations = 5;

  template <class Archive> void fields(Archive& archive) {
    archive(limits_, next_, parts_, ceiling_, last_step_, last_iterations_, n_short_, patience_,
            before_trial_);
  }

private:
  /// Counts short increments in a row; after many the next one is much longer, for a trial.
  void try_longer(double step);

  static constexpr int first_patience = 40; ///< short increments before the first trial

  Limits limits_;
  double next_ = 0.0;
  std::vector<double> parts_; ///< to be gone before that, the next one last [s]
  double ceiling_ = 0.0;      ///< not beyond it for now: a longer one has failed; 0: none [s]
  double last_step_ = 0.0;    ///< of the increment before [s]; 0: none
  int last_iterations_ = 0;   ///< of it
  int n_short_ = 0;           ///< increments in a row that were short
  int patience_ = first_patience;
  double before_trial_ = 0.0; ///< wanted before the one that is tried; 0: none is [s]
};

} // namespace billet::process
