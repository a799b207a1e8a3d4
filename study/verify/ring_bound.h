// The ring between flat dies with constant shear, by the upper-bound method.
//
// Parallel flow (Avitzur, Metal Forming: Processes and Analysis, 1968): u_z = -A z and
// u_r = A/2 (r - c / r), A the rate of reduction. The power of a rigid, perfectly plastic ring,
//
//   2 pi h sigma A int r sqrt(1 + c^2 / (3 r^4)) dr  +  2 pi m sigma / sqrt(3) A int |r^2 - c| dr,
//
// is least for one c; with it the bore is followed from height to height.

#pragma once

namespace billet::study {

struct RingShape {
  double bore;    ///< inner radius [mm]
  double outside; ///< outer radius [mm]
  double height;  ///< [mm]
};

/// The square of the neutral radius that makes the power least [mm^2]; below bore^2 all metal goes
/// outward.
///
/// @param m  shear on the dies over the shear yield stress [-], 0 to 1
[[nodiscard]] double neutral_square(const RingShape& ring, double m);

/// Decrease of the bore's diameter when the height has been reduced by a share [%].
[[nodiscard]] double bore_decrease_of_bound(const RingShape& ring, double m, double reduction);

} // namespace billet::study
