#include "process/energy/balance.h"

#include "process/reports/energy_balance.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace billet::process {

namespace {

/// The sums of the run with these energies of the metal and this contact.
EnergyBalance balance_of(const Run& run,
                         double elastic,
                         double plastic,
                         const contact::ContactTerm* contact,
                         const contact::ContactWork& self_contact) {
  EnergyBalance energy = run.state.energy;
  energy.elastic = elastic;
  energy.plastic = plastic;
  energy.external =
      run.state.works.supports - run.state.works.tools_gone + run.state.works.loads_before;
  for (const auto* loads : {&run.model.loads, &run.model.decaying})
    for (const auto& load : *loads)
      energy.external += load->work();
  if (contact != nullptr) {
    const contact::ContactWork& work = contact->work();
    energy.external += work.external + work.penalty_update + work.unseen;
    energy.penalty_update = contact->work().penalty_update;
    energy.friction = contact->work().friction;
    energy.contact = contact->work().stored;
  } else {
    energy.penalty_update = energy.friction = energy.contact = 0.0;
  }
  if (run.model.trapped)
    energy.external += run.model.trapped->work();
  energy.external += self_contact.penalty_update + self_contact.unseen;
  energy.penalty_update += self_contact.penalty_update;
  energy.friction += self_contact.friction;
  energy.contact += self_contact.stored;
  return energy;
}

} // namespace

double work_of_supports(const Run& run, double dt) {
  double work = 0.0;
  for (const Index i : prescribed_by_supports(run, run.state.time + dt).unknowns)
    work += 0.5 * (run.state.reactions[idx(i)] + run.model.newton->residual()[idx(i)]) *
            (run.attempt.x[idx(i)] - run.state.x[idx(i)]);
  return work;
}

void update_energy(Run& run) {
  run.state.energy =
      balance_of(run, run.model.bulk->elastic_energy(run.state.x).sum(),
                 run.model.bulk->plastic_work(), run.model.contact.get(),
                 run.model.self_contact ? run.model.self_contact->work() : contact::ContactWork{});
  run.state.energy.most = run.state.energy.scale();
  run.state.works.most = std::max({run.state.works.most, std::abs(run.state.energy.external),
                                   run.state.energy.plastic, run.state.energy.elastic});
}

EnergyBalance energy_after(const Run& run, double dt) {
  const mechanics::Trial trial = run.trial(dt);
  std::optional<contact::ContactTerm> contact;
  if (run.model.contact) {
    contact = *run.model.contact;
    contact->commit(trial);
  }
  EnergyBalance energy = balance_of(
      run, run.model.bulk->trial_elastic_energy(run.attempt.x).sum(),
      run.model.bulk->plastic_work() + run.model.bulk->trial_plastic_work(),
      contact ? &*contact : nullptr,
      run.model.self_contact ? run.model.self_contact->work_after(trial) : contact::ContactWork{});
  energy.external += work_of_supports(run, dt);
  for (const auto* loads : {&run.model.loads, &run.model.decaying})
    for (const auto& load : *loads)
      energy.external += load->work_in(trial);
  if (run.model.trapped)
    energy.external += run.model.trapped->work_in(trial);
  if (run.model.stabilization)
    energy.stabilization += run.model.stabilization->work_in(trial);
  return energy;
}

/// Work of the forces that Newton's method leaves at its floor (N.2), over the size of the part.
double work_of_rounding(const Run& run) {
  constexpr double of_stiffness = 1e-12;
  return of_stiffness * run.scene.material.elasticity.young * run.model.bulk->reference_volume();
}

} // namespace billet::process
