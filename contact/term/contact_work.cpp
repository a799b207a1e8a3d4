#include "contact/term/contact_work.h"

#include <algorithm>

namespace billet::contact {

double PenaltyWork::stored(const Traction& now, double multiplier) const {
  return 0.5 * (now.pressure * now.pressure - multiplier * multiplier) / now_;
}

double
PenaltyWork::update_work(const PointHistory& old, const Traction& now, double multiplier) const {
  const double multiplier_old = old.closed() ? old.multiplier : 0.0;
  if (now.status == Status::open) // it has parted at the old multiplier, which then went
    return 0.5 * multiplier_old * multiplier_old / old_;
  const double depth = (now.pressure - multiplier) / now_;
  const double depth_old = old.closed() ? (old.pressure - old.multiplier) / old_ : 0.0;
  return 0.5 *
         ((multiplier - multiplier_old) * (depth + depth_old) + (now_ - old_) * depth * depth_old);
}

double PenaltyWork::pressed_shift(const PointHistory& old,
                                  const Traction& now,
                                  double multiplier,
                                  double shift) const {
  const bool closed = now.status != Status::open;
  if (old.closed() && closed)
    return shift;
  const double depth = closed ? (now.pressure - multiplier) / now_ : 0.0;
  const double depth_old = old.closed() ? (old.pressure - old.multiplier) / old_ : 0.0;
  return std::clamp(shift, -std::max(0.0, depth_old), std::max(0.0, depth));
}

} // namespace billet::contact
