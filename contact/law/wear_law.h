// How much a sliding contact wears away: the law of Archard, used for forming tools by Hansen and
// Bay (1990), the paper's ref. [16].
//
// Units   mm, MPa. Theory: docs/theory/contact.md (W.1), (W.4), (W.7).

#pragma once

#include <optional>

namespace billet::contact {

/// A surface that wears by dw = (K / H) p ds. (W.1)
struct Archard {
  double K;        ///< wear constant [-], >= 0
  double hardness; ///< H of what wears [MPa], > 0

  /// Depth worn away [mm] by the integral of the pressure over the way slid [MPa mm].
  [[nodiscard]] double depth(double pressed_way) const { return K / hardness * pressed_way; }
};

/// Wear of a tool and of the workpiece on it.
struct PairWear {
  Archard tool;
  std::optional<Archard> workpiece; ///< absent: that of the workpiece is not asked for (W.4)
  double strokes = 1.0;             ///< number of strokes to extrapolate the tool's wear to (W.7)
};

} // namespace billet::contact
