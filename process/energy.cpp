// The balance of energy, and what it says of the length of an increment. (P.6), (P.23), (P.24)

#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace billet::process {

double EnergyBalance::error() const {
  return scale() > nothing ? std::abs(missing()) / scale() : 0.0;
}

double EnergyBalance::largest_since(const EnergyBalance& before) const {
  return std::max({std::abs(external - before.external), std::abs(elastic - before.elastic),
                   plastic - before.plastic, friction - before.friction,
                   std::abs(contact - before.contact)});
}

double EnergyBalance::error_since(const EnergyBalance& before) const {
  const double largest = largest_since(before);
  return largest > 0.0 ? std::abs(missing() - before.missing()) / largest : 0.0;
}

double Process::work_of_supports(double dt) const {
  double work = 0.0;
  for (const Index i : prescribed(state_.time + dt).unknowns)
    work += 0.5 * (state_.reactions[idx(i)] + newton_->residual()[idx(i)]) *
            (trial_x_[idx(i)] - state_.x[idx(i)]);
  return work;
}

EnergyBalance
Process::balance_of(double elastic, double plastic, const contact::ContactTerm* contact) const {
  EnergyBalance energy = state_.energy;
  energy.elastic = elastic;
  energy.plastic = plastic;
  energy.external = state_.works.supports - state_.works.tools_gone + state_.works.loads_before;
  for (const auto* loads : {&loads_, &fading_})
    for (const auto& load : *loads)
      energy.external += load->work();
  if (contact != nullptr) {
    const contact::ContactWork& work = contact->work();
    energy.external += work.external + work.penalty_update + work.unseen;
    energy.penalty_update = contact->work().penalty_update;
    energy.friction = contact->work().friction;
    energy.contact = contact->work().stored;
  }
  return energy;
}

void Process::update_energy() {
  state_.energy =
      balance_of(bulk_->elastic_energy(state_.x).sum(), bulk_->plastic_work(), contact_.get());
  state_.energy.most = state_.energy.scale();
  state_.works.most = std::max({state_.works.most, std::abs(state_.energy.external),
                                state_.energy.plastic, state_.energy.elastic});
}

EnergyBalance Process::energy_after(double dt) const {
  const mechanics::Trial trial{state_.time, state_.time + dt, state_.x, trial_x_};
  std::optional<contact::ContactTerm> contact;
  if (contact_) {
    contact = *contact_;
    contact->commit(trial);
  }
  EnergyBalance energy = balance_of(bulk_->trial_elastic_energy(trial_x_).sum(),
                                    bulk_->plastic_work() + bulk_->trial_plastic_work(),
                                    contact ? &*contact : nullptr);
  energy.external += work_of_supports(dt);
  for (const auto* loads : {&loads_, &fading_})
    for (const auto& load : *loads)
      energy.external += load->work_in(trial);
  if (stabilization_)
    energy.stabilization += stabilization_->work_in(trial);
  return energy;
}

/// Work of the forces that Newton's method leaves at its floor (N.2), over the size of the part.
double Process::work_of_rounding() const {
  constexpr double of_stiffness = 1e-12;
  return of_stiffness * scene_.material.elasticity.young * bulk_->reference_volume();
}

std::string Process::misses_too_much(double dt, double length) const {
  constexpr double rounding = 1e-9;
  constexpr double most = 0.05;        // of the work of an increment longer than by default
  constexpr double most_of_all = 1e-3; // of all work so far, in one of another length
  constexpr double early = 0.1;        // of the run: there is next to no work yet to compare with
  constexpr double short_share = 0.1;  // of the longest: no shorter for that
  const double usual = default_longest(length);
  const bool is_long = dt > (1.0 + rounding) * usual;
  const bool is_spoiling = !scene_.increments.max && dt > short_share * usual &&
                           state_.time - state_.flights.flown >
                               early * (scene_.stages.back().end - state_.flights.flown);
  if (!is_long && !is_spoiling)
    return "";
  const EnergyBalance after = energy_after(dt);
  const double missed = std::abs(after.missing() - state_.energy.missing());
  if (missed <= work_of_rounding())
    return "";
  if (is_long && after.error_since(state_.energy) > most)
    return fmt::format("its balance of energy misses {:.2g} %",
                       100.0 * after.error_since(state_.energy));
  if (!is_long && missed > most_of_all * state_.works.most)
    return fmt::format("its balance of energy misses {:.2g} % of all work so far",
                       100.0 * missed / state_.works.most);
  return "";
}

double Process::missed_since(const EnergyBalance& before, double gone) const {
  constexpr double half_of_the_budget = 0.0025; // the balance of a run is to be within 0.5 %
  constexpr double early = 0.1;                 // what the first yield misses counts little later
  const double used = state_.energy.error() / half_of_the_budget;
  const bool at_risk = gone > early && used > 1.0;
  // The less of the budget is left the more is asked of an increment.
  return at_risk && !scene_.increments.max ? used * used * state_.energy.error_since(before) : 0.0;
}

bool Process::lets_go_too_fast(double dt) const {
  constexpr double early = 0.1; // of the run: there is next to no work yet to compare with
  if (!contact_ || scene_.increments.max ||
      state_.time - state_.flights.flown <
          early * (scene_.stages.back().end - state_.flights.flown))
    return false;
  // Of all work so far, for a tool whose force falls by more than half.
  constexpr double most = 1e-3, fall = 0.5;
  const mechanics::Trial trial{state_.time, state_.time + dt, state_.x, trial_x_};
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    if (!contact_->acts(t, state_.time + dt))
      continue;
    const auto [before, now] = contact::forces_of_tool(*contact_, t, trial);
    if (now.sum < fall * before.sum && 0.5 * std::abs(now.work - before.work) >
                                           std::max(most * state_.works.most, work_of_rounding()))
      return true;
  }
  return false;
}

} // namespace billet::process
