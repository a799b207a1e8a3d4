// What is trapped in pockets presses on metal and tool, as a force term. In the plane.
//
// A pocket is found at the end of an increment, once its ends touch; its medium then has the
// pressure of the surroundings. During an increment its faces stay the same, and the pressure
// follows the volume that metal and tool leave: the tangent couples all of its nodes, outside of
// the mesh's pattern. Where a pocket's end leaves the tool it is vented.
//
// Theory: docs/theory/contact.md (C.57)-(C.61).

#pragma once

#include "contact/law/trapped_medium.h"
#include "contact/term/contact_term.h"
#include "contact/trapped/pocket.h"
#include "contact/trapped/pocket_volume.h"
#include "contact/trapped/tool_line.h"
#include "mechanics/equilibrium/force_term.h"

#include <span>
#include <vector>

namespace billet::contact {

/// What a new mesh of the same part takes over: pockets are known again by where they are.
struct TrappedSnapshot {
  TrappedState state;

  template <class Archive> void fields(Archive& archive) { archive(state); }
};

class TrappedTerm final : public mechanics::ForceTerm {
public:
  /// To be assembled and committed after the contact term, which it reads and whose loads on tools
  /// it completes.
  ///
  /// @pre contact outlives the term; the scene is plane or axisymmetric
  TrappedTerm(ContactTerm& contact, const TrappedMedium& medium, std::vector<SymmetryLine> lines);

  [[nodiscard]] Outcome<mechanics::Assembled> assemble(const mechanics::Trial& trial,
                                                       mechanics::System& system) override;
  void commit(const mechanics::Trial& trial) override;

  /// Goes on where a term on an earlier mesh stood; after the contact term has.
  ///
  /// @param x  committed positions [mm]
  void go_on_from(const TrappedSnapshot& before, std::span<const double> x, double time);
  [[nodiscard]] TrappedSnapshot snapshot() const { return {state_}; }

  [[nodiscard]] const TrappedState& state() const { return state_; }
  /// Done on the workpiece by all commits [N mm].
  [[nodiscard]] double work() const { return state_.work; }
  /// Done on it in an increment, by the trapezoidal rule [N mm].
  [[nodiscard]] double work_in(const mechanics::Trial& trial) const;

  template <class Archive> void fields(Archive& archive) { archive(state_); }

private:
  /// A pocket in a trial.
  struct Tried {
    Chain old, now;
    double volume = 0.0; ///< [mm^3]
    MediumPressure medium{};
  };

  [[nodiscard]] Tried tried(const Pocket& pocket, const mechanics::Trial& trial) const;
  void add_tangent(const Pocket& pocket,
                   const Tried& now,
                   const mechanics::Trial& trial,
                   mechanics::System& system) const;
  void add_drives(const Pocket& pocket,
                  const Tried& now,
                  const mechanics::Trial& trial,
                  mechanics::System& system) const;
  /// Which pockets there are now, and what of the old ones is in them.
  void look(std::span<const double> x, double time);

  ContactTerm* contact_;
  TrappedMedium medium_;
  std::vector<SymmetryLine> lines_;
  TrappedState state_;
};

} // namespace billet::contact
