// How stiff the penalties are: those of the case, times what a limit of penetration asks for, times
// what is softer on the way to a solution. (C.21), (C.24), (N.10)

#pragma once

#include "contact/law/interface_law.h"
#include "contact/surface/contact_surface.h"

namespace billet::contact {

/// Normal penalty over that of the case [-].
struct PenaltyFactors {
  double trial = 1.0;
  double committed = 1.0; ///< in the committed state
  double next = 1.0;      ///< at the beginning of a try

  void restart() { trial = next; }
  void commit() {
    committed = trial;
    next = trial;
  }

  template <class Archive> void fields(Archive& archive) { archive(trial, committed, next); }
};

/// The penalties that a trial is assembled with.
struct AppliedPenalty {
  Penalty penalty;        ///< with softening
  double softening = 1.0; ///< of the normal one [-]

  /// Pressure that needs no penetration: the multiplier, and what a softer penalty on the way to a
  /// solution leaves of the pressure at the start of the increment [MPa]. (N.10)
  [[nodiscard]] double carried(const PointHistory& history, double multiplier) const {
    const double pressed = history.closed() ? history.pressure - multiplier : 0.0;
    return multiplier + (1.0 - softening) * pressed;
  }
};

[[nodiscard]] AppliedPenalty applied_penalty(const ContactSurface& surface,
                                             const PenaltyFactors& factors,
                                             double softening = 1.0);

} // namespace billet::contact
