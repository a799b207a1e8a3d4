// Where the next increment probably ends: what Newton's method begins with. (P.2), (P.28)

#pragma once

#include <span>
#include <vector>

namespace billet::process {

/// Goes on as in the last increments: straight on at their last velocities, or with the change of
/// velocity from one to the next where that has shown itself to be steady.
///
/// Positions, steps: all unknowns, shape (n_dofs + n_extra) [mm]; lengths of increments [s].
class FirstGuess {
public:
  /// Whether there is an increment to go by.
  [[nodiscard]] bool known() const { return !step_.empty(); }
  /// Way and length of that increment.
  [[nodiscard]] const std::vector<double>& step() const { return step_; }
  [[nodiscard]] double length() const { return length_; }

  /// Nothing goes on as it did.
  void forget();
  /// From now on straight on: the last try failed.
  void straighten() { steady_ = 0; }
  /// Goes by a step that no increment has made.
  void begin_with(std::vector<double> step, double length);
  /// An increment has been made.
  void note(std::span<const double> from, std::span<const double> to, double length);

  /// Moves `x`, the end of the last increment, on by `length`.
  void go_on(double length, std::vector<double>& x) const;
  /// Likewise, straight on.
  void go_straight_on(double length, std::vector<double>& x) const;

private:
  std::vector<double> step_;         ///< of the last increment; empty: none
  double length_ = 0.0;              ///< likewise
  std::vector<double> earlier_step_; ///< of the one before
  double earlier_length_ = 0.0;      ///< likewise
  int steady_ = 0;                   ///< increments in a row that went on nearly straight
};

} // namespace billet::process
