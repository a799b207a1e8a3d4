// An increment in which the place of a tool that a load drives is looked for.
//
// Where facets or friction change from iteration to iteration the tool's own equation carries every
// change to all points at once, and the iteration goes round in circles. With the tool held in a
// place the part finds its equilibrium as under a prescribed motion, and what it bears there says
// on which side of that place the load is borne. (P.32)

#include "process/run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace billet::process {

namespace {

/// A place of the tool, and what the part bears there more than the load.
struct Place {
  double travel;         ///< [mm]
  double excess;         ///< [N]
  std::vector<double> x; ///< unknowns in equilibrium [mm]
};

} // namespace

bool Process::try_held_tool(double dt, std::string& why) {
  if (x_.size() != x0_.size() + 1 ||
      grounding_) // more than one would have to be looked for at once
    return false;
  const std::size_t drive = x0_.size();
  const double size = body_size(scene_.mesh);
  double scale = 0.0;
  const auto held_at = [&](double travel,
                           const std::vector<double>& guess) -> std::optional<Place> {
    contact_->restart();
    contact_->foretell(foretold(dt));
    trial_x_ = guess;
    trial_x_[drive] = travel;
    mechanics::Prescribed held = prescribed(time_ + dt);
    held.unknowns.push_back(static_cast<Index>(drive));
    held.positions.push_back(travel);
    const auto outcome = newton_->solve(terms_, held, time_, time_ + dt, x_, trial_x_);
    wasted_iterations_ += spent();
    if (!outcome) {
      why = outcome.error().reason;
      return std::nullopt;
    }
    scale = outcome->force_scale;
    last_residual_ = outcome->residual;
    return Place{travel, newton_->residual()[drive], trial_x_};
  };
  const auto borne = [&](const Place& place) {
    return std::abs(place.excess) <= scene_.tolerance * scale;
  };
  const auto accepted = [&] {
    last_iterations_ = spent();
    wasted_iterations_ -= last_iterations_;
    const bool solved =
        plausible(dt, scale, why) && !passes_through(dt, why) && limit_penetration(dt, why);
    refused_inside_out_ = solved && turns_inside_out(why);
    return solved && !refused_inside_out_;
  };
  newton_->set_force_floor(force_floor(time_ + dt));
  std::optional<Place> near = held_at(x_[drive], x_);
  if (!near)
    return false;
  if (borne(*near))
    return accepted();
  // Away from where it bears too little, or too much, in longer and longer steps.
  constexpr double first = 1e-4, shortest = 1e-9, farthest = 0.05; // of the body
  constexpr int most_places = 40;
  const double sense = near->excess < 0.0 ? 1.0 : -1.0;
  const double usual = last_step_.empty() ? 0.0 : std::abs(last_step_[drive]) * dt / last_dt_;
  double step = std::clamp(usual, shortest * size, first * size);
  std::optional<Place> far;
  int places = 0;
  while (!far && places++ < most_places && std::abs(near->travel - x_[drive]) < farthest * size) {
    std::optional<Place> next = held_at(near->travel + sense * step, near->x);
    if (!next) {
      step *= 0.25;
      if (step < shortest * size)
        return false;
      continue;
    }
    if (borne(*next))
      return accepted();
    if ((next->excess < 0.0) == (near->excess < 0.0)) {
      near = std::move(next);
      step *= 2.0;
    } else {
      far = std::move(next);
    }
  }
  // Between the two, by the Illinois variant of the rule of false position.
  double weight_near = 1.0, weight_far = 1.0;
  for (; far && places < most_places; ++places) {
    const double a = weight_near * near->excess, b = weight_far * far->excess;
    const double share = a / (a - b);
    std::vector<double> guess = near->x;
    for (std::size_t i = 0; i < guess.size(); ++i)
      guess[i] += share * (far->x[i] - near->x[i]);
    std::optional<Place> next = held_at(near->travel + share * (far->travel - near->travel), guess);
    if (!next)
      return false;
    if (borne(*next))
      return accepted();
    const bool is_near = (next->excess < 0.0) == (near->excess < 0.0);
    (is_near ? near : far) = std::move(next);
    (is_near ? weight_near : weight_far) = 1.0;
    (is_near ? weight_far : weight_near) *= 0.5;
  }
  return false;
}

} // namespace billet::process
