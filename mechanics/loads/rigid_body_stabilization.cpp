#include "mechanics/loads/rigid_body_stabilization.h"

#include <cmath>
#include <cstddef>

namespace billet::mechanics {

Outcome<Assembled> RigidBodyStabilization::assemble(const Trial& trial, System& system) {
  for (Index i = 0; i < pattern_->n_dofs(); ++i) {
    system.residual[idx(i)] += stiffness() * (trial.x[idx(i)] - trial.x_old[idx(i)]);
    system.tangent.values[idx(pattern_->diagonal[idx(i)])] += stiffness();
  }
  return Assembled{};
}

double RigidBodyStabilization::squares(const Trial& trial) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < idx(pattern_->n_dofs()); ++i)
    sum += (trial.x[i] - trial.x_old[i]) * (trial.x[i] - trial.x_old[i]);
  return sum;
}

double RigidBodyStabilization::force_in(const Trial& trial) const {
  return stiffness() * std::sqrt(squares(trial));
}

double RigidBodyStabilization::work_in(const Trial& trial) const {
  return stiffness() * squares(trial);
}

} // namespace billet::mechanics
