#include "contact/term/penalty_factors.h"

#include <algorithm>

namespace billet::contact {

AppliedPenalty
applied_penalty(const ContactSurface& surface, const PenaltyFactors& factors, double softening) {
  Penalty penalty = surface.penalty();
  penalty.normal *= factors.trial * softening;
  // What presses lightly must not rather slip than sink: the share that the defaults have.
  constexpr double of_normal = 0.1;
  if (factors.trial < 1.0)
    penalty.tangent = std::min(penalty.tangent, of_normal * penalty.normal);
  return {penalty, softening};
}

} // namespace billet::contact
