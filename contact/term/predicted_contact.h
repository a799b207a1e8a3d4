// What is known of contact when an increment begins, if all goes on as in the last one: where
// points come to touch (C.42), and how tools turn against faces (C.5a).

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <cstddef>
#include <span>
#include <vector>

namespace billet::contact {

/// Tells where everything will be at the end of this try if it goes on as it does.
///
/// @param x  shape (n_dofs + n_extra) [mm]
void predict(const ContactModel& model, ContactState& state, std::span<const double> x);
void forget_prediction(ContactState& state);

/// Share of the increment in which a point that was open touches the tool, as the motion of point
/// and tool predicts at its beginning, whatever the trial; 0: they would not meet. (C.42)
[[nodiscard]] double touching_share(const ContactView& contact,
                                    std::size_t tool,
                                    std::size_t point,
                                    const mechanics::Trial& trial);

/// When points that are open come to touch in the increment as it has been predicted, as shares of
/// it, the earliest first. (P.27)
[[nodiscard]] std::vector<double> touches(const ContactView& contact,
                                          const mechanics::Trial& trial);

/// Whether a tool that acts turns in an increment.
[[nodiscard]] bool any_turns(const ContactView& contact, const mechanics::Trial& trial);

/// How a tool turns against the faces in the increment if all goes on as it does, shape (n_faces).
/// (C.5a)
[[nodiscard]] std::vector<Vec3>
turns(const ContactView& contact, std::size_t tool, const mechanics::Trial& trial);

} // namespace billet::contact
