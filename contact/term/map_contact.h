// What contact takes over from that on the mesh before. (C.41)

#pragma once

#include "contact/term/contact_state.h"

#include <span>

namespace billet::contact {

/// What a term on another mesh of the same part needs to go on.
[[nodiscard]] ContactSnapshot snapshot(const ContactState& state);

/// Where the nodes are on a new mesh, and where its contact points lie on the old one.
struct NewPlaces {
  std::span<const PointSource> sources; ///< of each point, those of the old that it lies between
  std::span<const double> x;            ///< shape (n_dofs + n_extra) [mm]
  double time;                          ///< [s]
};

/// Goes on where contact on an earlier mesh of the same part stood: its sums, its penalty, which
/// tools act.
///
/// @param state  has been started there
void map_contact(const ContactModel& model,
                 const ContactSnapshot& before,
                 const NewPlaces& at,
                 ContactState& state);

} // namespace billet::contact
