// Contact and friction of the workpiece with itself, as a force term.
//
// Every contact point of the surface is pushed out of the faces ahead of it, and the opposite force
// acts on these at the closest place: both sides are considered, each with half of the weight, so
// neither has to be chosen and the forces of a pair add up to zero. The law is that of tools, and
// so is its penalty. The entries of the tangent that couple two faces are kept outside of the
// mesh's pattern.
//
// Where nothing lies ahead of anything the term does nothing. Theory: docs/theory/contact.md
// (C.50)-(C.55).

#pragma once

#include "contact/friction/friction.h"
#include "contact/self/self_search.h"
#include "contact/self/self_state.h"
#include "contact/self/self_traction.h"
#include "contact/surface/contact_surface.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/equilibrium/force_term.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

class SelfContactTerm final : public mechanics::ForceTerm {
public:
  /// @pre surface, bulk and friction outlive the term; friction has no tensor
  SelfContactTerm(const ContactSurface& surface,
                  const mechanics::Bulk& bulk,
                  const Friction& friction);

  /// Nothing touches; looks ahead from where everything is.
  void start(std::span<const double> x);
  /// Goes on where a term on an earlier mesh of the same part stood.
  ///
  /// @param sources  of each point, those of the old that it lies between
  void go_on_from(const SelfContactSnapshot& before,
                  std::span<const PointSource> sources,
                  std::span<const double> x);
  /// @param x  committed positions [mm]
  [[nodiscard]] SelfContactSnapshot snapshot(std::span<const double> x) const;

  [[nodiscard]] Outcome<mechanics::Assembled> assemble(const mechanics::Trial& trial,
                                                       mechanics::System& system) override;
  [[nodiscard]] bool nonsmooth() const override { return true; }
  void commit(const mechanics::Trial& trial) override;

  [[nodiscard]] const SelfContactState& state() const { return state_; }
  [[nodiscard]] const ContactWork& work() const { return state_.work; }
  /// What `work` will be once the last assembled trial is committed.
  [[nodiscard]] ContactWork work_after(const mechanics::Trial& trial) const;
  /// Of the last assembled trial, shape (n_points); empty if nothing has ever been ahead.
  [[nodiscard]] std::span<const SelfTraction> tractions() const { return trial_; }
  /// Whether points have gone through a face that they were not known to meet.
  [[nodiscard]] std::optional<SelfPassage> passage(const mechanics::Trial& trial) const;

  template <class Archive> void fields(Archive& archive) { archive(state_); }

private:
  /// Both sides of a pair are looked at: each bears half.
  static constexpr double weight = 0.5;

  [[nodiscard]] SelfTraction evaluate(std::size_t point,
                                      const Vec3& position,
                                      const mechanics::Trial& trial,
                                      const Penalty& penalty) const;
  void add_forces(std::size_t point, std::span<const double> x, mechanics::System& system) const;
  void commit_point(std::size_t point, const mechanics::Trial& trial, double area);
  [[nodiscard]] double shear_yield(std::size_t point) const;
  [[nodiscard]] Penalty penalty(double softening) const;

  const ContactSurface* surface_;
  const mechanics::Bulk* bulk_;
  const Friction* friction_;
  SelfContactState state_;
  std::vector<SelfTraction> trial_; ///< shape (n_points) once something is ahead
  std::vector<Vec3> positions_;     ///< of the points in it [mm]
};

} // namespace billet::contact
