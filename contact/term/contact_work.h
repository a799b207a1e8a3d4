// The energy that contact stores in its penalties, and the work of what changes it: tools,
// friction, and the penalties themselves. (C.18), (C.23)

#pragma once

#include "contact/law/interface_law.h"
#include "contact/term/penalty_factors.h"

namespace billet::contact {

/// Energies and work of contact since the start.
struct ContactWork {
  double external = 0.0; ///< done by the tools' motion [N mm]
  double friction = 0.0; ///< dissipated [N mm]
  /// Of it, what trapezoids of the work of forces do not see: slides that begin or turn within an
  /// increment; whoever drives them has done it. [N mm] (C.18a)
  double unseen = 0.0;
  double stored = 0.0; ///< in the penalties now [N mm]
  /// Done by raising penalties and multipliers, which work on what is pressed [N mm]. (C.23)
  double penalty_update = 0.0;

  template <class Archive> void fields(Archive& archive) {
    archive(external, friction, unseen, stored, penalty_update);
  }
};

/// What the normal penalty does at a point, over the area it stands for.
class PenaltyWork {
public:
  /// @param normal  penalty at the end of the increment, without softening [MPa/mm]
  PenaltyWork(double normal, const PenaltyFactors& factors)
      : now_(normal), old_(normal * (factors.committed / factors.trial)) {}

  /// Energy of a closed point [N/mm].
  [[nodiscard]] double stored(const Traction& now, double multiplier) const;
  /// Work by which changes of penalty and multiplier have changed a point in the increment [N/mm].
  /// (C.23)
  [[nodiscard]] double
  update_work(const PointHistory& old, const Traction& now, double multiplier) const;
  /// What of a shift of the gap moves a point under pressure [mm]: all of it; where it opens or
  /// closes, no more than its depth.
  [[nodiscard]] double pressed_shift(const PointHistory& old,
                                     const Traction& now,
                                     double multiplier,
                                     double shift) const;

private:
  double now_; ///< [MPa/mm]
  double old_; ///< when the increment began [MPa/mm]
};

} // namespace billet::contact
