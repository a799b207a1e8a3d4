#include "process/increment/held_tool.h"

#include "geometry/base/outcome.h"
#include "process/increment/acceptance.h"
#include "process/increment/force_floor.h"
#include "process/increment/solve_increment.h"
#include "process/scene/scene.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// A place of the tool, and what the part bears there more than the load.
struct HeldPlace {
  double travel;         ///< [mm]
  double excess;         ///< [N]
  std::vector<double> x; ///< unknowns in equilibrium [mm]
};

/// Looks for the place where the load is borne.
class PlaceSearch {
public:
  /// The part with the tool held somewhere, from a guess; none: there is no solution.
  using HeldAt = std::function<std::optional<HeldPlace>(double, const std::vector<double>&)>;
  using Borne = std::function<bool(const HeldPlace&)>;

  /// @param way   of the unknowns per mm of the tool, as it has been; empty: not known
  /// @param size  of the body [mm]
  PlaceSearch(HeldAt held_at, Borne borne, std::vector<double> way, double size)
      : held_at_(std::move(held_at)), borne_(std::move(borne)), way_(std::move(way)), size_(size) {}

  /// @param step  first one away from the start [mm]
  /// @return whether it is borne where the tool is held at last
  [[nodiscard]] bool from(HeldPlace start, double step) {
    if (borne_(start))
      return true;
    near_ = std::move(start);
    return march(step) || (far_ && close_in());
  }

private:
  /// Away from where it bears too little, or too much, in longer and longer steps.
  [[nodiscard]] bool march(double step) {
    constexpr double shortest = 1e-9, longest = 1e-2, farthest = 0.1; // of the body
    constexpr int most_places = 100;
    constexpr double after_failure = 1.2; // what was too long is so soon again
    const double start = near_.travel;
    const double sense = near_.excess < 0.0 ? 1.0 : -1.0;
    double growth = 2.0;
    for (int place = 0; place < most_places && std::abs(near_.travel - start) < farthest * size_;
         ++place) {
      std::optional<HeldPlace> next = held_at_(near_.travel + sense * step, ahead(sense * step));
      if (!next) {
        step *= 0.5;
        growth = after_failure;
        if (step < shortest * size_)
          return false;
        continue;
      }
      if (borne_(*next))
        return true;
      if (!same_side(*next)) {
        far_ = std::move(next);
        return false;
      }
      way_ = to(*next);
      near_ = std::move(*next);
      step = std::min(growth * step, longest * size_);
    }
    return false;
  }

  /// Between the two, by the Illinois variant of the rule of false position.
  [[nodiscard]] bool close_in() {
    constexpr int most_places = 60;
    constexpr double smallest_share = 1e-3;
    double weight_near = 1.0, weight_far = 1.0, nearer = 1.0;
    for (int place = 0; place < most_places; ++place) {
      const double a = weight_near * near_.excess, b = weight_far * far_->excess;
      const double share = nearer * a / (a - b);
      std::vector<double> guess = near_.x;
      for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] += share * (far_->x[i] - near_.x[i]);
      std::optional<HeldPlace> next =
          held_at_(near_.travel + share * (far_->travel - near_.travel), guess);
      if (!next) { // there is another one on the way, as a rule
        nearer *= 0.5;
        if (nearer < smallest_share)
          return false;
        continue;
      }
      if (borne_(*next))
        return true;
      nearer = 1.0;
      const bool is_near = same_side(*next);
      (is_near ? near_ : *far_) = std::move(*next);
      (is_near ? weight_near : weight_far) = 1.0;
      (is_near ? weight_far : weight_near) *= 0.5;
    }
    return false;
  }

  /// The part goes on with the tool as it did over the last step.
  [[nodiscard]] std::vector<double> ahead(double travel) const {
    std::vector<double> guess = near_.x;
    for (std::size_t i = 0; i < way_.size(); ++i)
      guess[i] += travel * way_[i];
    return guess;
  }

  /// How the unknowns go from the nearest place to another, per mm of the tool.
  [[nodiscard]] std::vector<double> to(const HeldPlace& other) const {
    std::vector<double> way = other.x;
    for (std::size_t i = 0; i < way.size(); ++i)
      way[i] = (way[i] - near_.x[i]) / (other.travel - near_.travel);
    return way;
  }

  [[nodiscard]] bool same_side(const HeldPlace& place) const {
    return (place.excess < 0.0) == (near_.excess < 0.0);
  }

  HeldAt held_at_;
  Borne borne_;
  std::vector<double> way_; ///< of the unknowns per mm of the tool; empty: not known
  double size_;             ///< of the body [mm]
  HeldPlace near_{};
  std::optional<HeldPlace> far_;
};

/// The one tool that a force drives, if no other is driven: more would have to be looked for at
/// once.
std::optional<std::size_t> driven_alone(const Run& run, double time) {
  const std::vector<contact::DriveUnknown> drives = contact::drive_unknowns(run.model.tools);
  if (drives.size() != 1 || drives[0].turns || run.tools()[drives[0].tool].motion.force->blow ||
      !run.model.contact->acts(drives[0].tool, time))
    return std::nullopt;
  return drives[0].tool;
}

} // namespace

std::optional<Outcome<Done>> held_tool(Run& run, double dt) {
  if (!driven_alone(run, run.state.time + dt))
    return std::nullopt;
  const std::size_t drive = run.n_nodal();
  double scale = 0.0;
  const auto held_at = [&](double travel,
                           const std::vector<double>& guess) -> std::optional<HeldPlace> {
    run.model.contact->restart();
    run.model.contact->predict(predicted(run, dt));
    run.attempt.x = guess;
    run.attempt.x[drive] = travel;
    mechanics::Prescribed held = prescribed(run, run.state.time + dt);
    held.unknowns.push_back(static_cast<Index>(drive));
    held.positions.push_back(travel);
    const auto outcome = run.model.newton->solve(run.model.terms, held, run.state.time,
                                                 run.state.time + dt, run.state.x, run.attempt.x);
    run.state.counters.wasted_iterations += spent(run);
    if (!outcome)
      return std::nullopt;
    scale = outcome->force_scale;
    run.attempt.residual = outcome->residual;
    return HeldPlace{travel, run.model.newton->residual()[drive], run.attempt.x};
  };
  run.model.newton->set_force_floor(force_floor(run, run.state.time + dt));
  std::optional<HeldPlace> start = held_at(run.state.x[drive], run.state.x);
  const double size = body_size(run.mesh());
  constexpr double first = 1e-4, shortest = 1e-9; // of the body
  const double usual = run.state.last_step.empty()
                           ? 0.0
                           : std::abs(run.state.last_step[drive]) * dt / run.state.last_dt;
  std::vector<double> way = run.state.last_step;
  if (usual > 0.0)
    for (double& u : way)
      u /= run.state.last_step[drive];
  else
    way.clear();
  PlaceSearch search(
      held_at,
      [&](const HeldPlace& place) { return std::abs(place.excess) <= run.scene.tolerance * scale; },
      std::move(way), size);
  if (!start || !search.from(std::move(*start),
                             usual > 0.0 ? std::max(usual, shortest * size) : first * size))
    return std::nullopt;
  Outcome<Done> solved = check_solution(run, dt, scale);
  if (solved) {
    run.attempt.iterations = spent(run);
    run.state.counters.wasted_iterations -= run.attempt.iterations;
  }
  return solved;
}

} // namespace billet::process
