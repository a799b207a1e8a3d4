// Holds the rigid motions of a body that no support holds, until a tool does. (M.17)

#pragma once

#include "mechanics/equilibrium/force_term.h"

namespace billet::mechanics {

/// Resistance against the motion of every unknown of the nodes within an increment; it vanishes at
/// rest.
class RigidBodyStabilization final : public ForceTerm {
public:
  /// @param stiffness  of an unknown [N/mm]
  /// @pre pattern outlives this
  RigidBodyStabilization(double stiffness, const BlockPattern& pattern)
      : stiffness_(stiffness), pattern_(&pattern) {}

  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override;
  /// Its force at the end of an increment is gone at the start of the next: it has no state.
  void commit(const Trial&) override {}

  /// How stiff it is for now, over what it was made with [-].
  [[nodiscard]] double share() const { return share_; }
  void set_share(double share) { share_ = share; }

  /// Norm of its forces in an increment [N].
  [[nodiscard]] double force_in(const Trial& trial) const;
  /// Work lost to it in an increment [N mm].
  [[nodiscard]] double work_in(const Trial& trial) const;

  template <class Archive> void fields(Archive& archive) { archive(share_); }

private:
  [[nodiscard]] double stiffness() const { return share_ * stiffness_; }
  /// Sum of the squares of what the nodes' unknowns have moved [mm^2].
  [[nodiscard]] double squares(const Trial& trial) const;

  double stiffness_;
  double share_ = 1.0;
  const BlockPattern* pattern_;
};

} // namespace billet::mechanics
