// Contact and friction between the workpiece and rigid tools, as a force term.
//
// The contact area is unknown and found anew in every iteration: every integration point of every
// candidate face is projected on every tool that acts, and what lies inside is pushed out. A point
// may touch several tools. The term holds a model, a state and the steps of an increment; what can
// be read of a state is in contact_report.h, penetration.h and predicted_contact.h.
//
// Frames   tractions and histories in the tool's frame, forces in space. Theory:
// docs/theory/contact.md.

#pragma once

#include "contact/term/contact_model.h"
#include "contact/term/contact_report.h"
#include "contact/term/contact_state.h"
#include "contact/term/map_contact.h"
#include "contact/term/penetration.h"
#include "contact/term/predicted_contact.h"
#include "contact/term/traction_sum.h"
#include "mechanics/equilibrium/force_term.h"

#include <span>
#include <vector>

namespace billet::contact {

class ContactTerm final : public mechanics::ForceTerm {
public:
  /// @pre surface, bulk, pattern and tools outlive the term
  ContactTerm(const ContactSurface& surface,
              const mechanics::Bulk& bulk,
              const mechanics::BlockPattern& pattern,
              std::span<const Tool> tools,
              double reach,
              const DriveScale& drives = {});

  /// Places the points at the start of the run; histories begin here.
  void start(std::span<const double> x, double time);
  /// The same for a tool that has been moved between increments; it must have no history.
  void start(std::size_t tool, std::span<const double> x, double time);
  /// Goes on where a term on an earlier mesh of the same part was. After `start`.
  void go_on_from(const ContactSnapshot& before, const NewPlaces& at);

  [[nodiscard]] Outcome<mechanics::Assembled> assemble(const mechanics::Trial& trial,
                                                       mechanics::System& system) override;
  [[nodiscard]] bool nonsmooth() const override { return true; }
  void commit(const mechanics::Trial& trial) override;

  /// Where contact stands, and what it is computed on: what readers take.
  [[nodiscard]] const ContactState& state() const { return state_; }
  [[nodiscard]] const ContactModel& model() const { return model_; }
  [[nodiscard]] ContactView view() const { return {model_, state_}; }
  operator ContactView() const { return view(); } // NOLINT: a term is read as its state

  /// Which tools act and stand still.
  [[nodiscard]] ToolActivity& activity() { return state_.activity; }
  /// Whether a tool is enabled and active.
  [[nodiscard]] bool acts(std::size_t tool, double time) const { return view().acts(tool, time); }
  /// Where a tool's free degrees of freedom are in a vector of unknowns.
  [[nodiscard]] geometry::Driven driven(std::size_t tool, std::span<const double> x) const {
    return model_.driven(tool, x);
  }
  /// A tool's place at a time with those unknowns.
  [[nodiscard]] geometry::Pose
  pose(std::size_t tool, double time, std::span<const double> x) const {
    return model_.pose(tool, time, x);
  }

  /// Begins a try of an increment: penalties are those of the committed state, nothing is
  /// predicted.
  void restart();
  /// Does the same, and gives points that were chattering in the last try the slip limit of their
  /// pressure at the start of the increment. (F.3a)
  ///
  /// @return whether that is another limit for any of them
  bool restart_friction_lagged();
  /// Tells where everything will be at the end of this try if it goes on as it does. Points that
  /// come down on a tool rub from where they touch; without this, from the next increment on.
  /// (C.42)
  ///
  /// @param x  shape (n_dofs + n_extra) [mm]
  void predict(std::span<const double> x) { contact::predict(model_, state_, x); }
  /// Makes the normal penalty stiffer from the next trial on. (C.21)
  void stiffen(double factor) { state_.penalty.trial *= factor; }
  /// Changes the penalty with which the tries of the next increment begin; below that of the case
  /// the one against slip is no stiffer than it. (C.24)
  void begin_with_stiffness(double factor) { state_.penalty.next *= factor; }
  /// Makes the pressures of the last trial the multipliers of the next. (C.22)
  void augment();
  /// Tells how far a tool's surface has drawn back at the end of this try, along its normals, in
  /// addition to what its motion does; it may be less than in the try before.
  ///
  /// @param all  with what it has drawn back in increments before [mm]
  void retreat(std::size_t tool, double distance, double all);
  /// Takes a tool's contact away: returns its committed nodal forces on the workpiece, shape
  /// (n_dofs) [N], and forgets its history. The penalties' energy goes with it.
  [[nodiscard]] std::vector<double> release(std::size_t tool);

  /// How deep the workpiece lies inside tools at the last assembled trial; remembers what shows it.
  [[nodiscard]] Penetration certify(const mechanics::Trial& trial, double limit) {
    return penetration(model_, state_, trial, limit);
  }

  /// Adds a force at a place to what a tool feels in the increment just committed: of what is
  /// neither metal nor tool.
  void bear(std::size_t tool, const Vec3& force, const Vec3& place, const mechanics::Trial& trial);

  /// Resultants of the last committed trial, one a tool.
  [[nodiscard]] std::span<const ToolLoad> loads() const { return state_.loads; }
  [[nodiscard]] const ContactWork& work() const { return state_.work; }
  /// What the points closed on each tool did in the last committed increment, shape (n_tools).
  [[nodiscard]] std::span<const std::vector<ClosedPoint>> closed() const { return state_.closed; }
  /// Time spent in all assemblies [s].
  struct Times {
    double search = 0.0;
    double elements = 0.0; ///< laws, contact elements, loads of tools
  };
  [[nodiscard]] const Times& times() const { return times_; }

  template <class Archive> void fields(Archive& archive) { archive(state_); }

private:
  /// Adds what one tool that acts does.
  void assemble_tool(std::size_t tool,
                     const mechanics::Trial& trial,
                     const AppliedPenalty& penalty,
                     mechanics::System& system);
  /// Adds what a tool's corners do. (C.46)
  void press_corners(std::size_t tool,
                     const geometry::Pose& pose,
                     const mechanics::Trial& trial,
                     const AppliedPenalty& penalty,
                     mechanics::System& system);

  ContactModel model_;
  ContactState state_;
  TractionSum sum_; ///< of the trial
  Times times_;
};

} // namespace billet::contact
