// The certificate of an increment: how deep the workpiece lies inside tools, at most. (C.13)

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <cstddef>

namespace billet::contact {

/// How deep the workpiece lies inside tools: every point of every candidate face. (C.13)
struct Penetration {
  double bound = 0.0;           ///< no point of any face is deeper [mm]
  double share = 0.0;           ///< nor deeper than this relative to the parent element [-]
  double sampled = 0.0;         ///< depth of the deepest point found [mm]
  double at_points = 0.0;       ///< of the deepest contact point [mm]
  double pressed = 0.0;         ///< the same, as contact counts its gap [mm]
  double share_pressed = 0.0;   ///< the same, relative to the parent element [-]
  Vec3 position = Vec3::Zero(); ///< of the deepest point found, in space [mm]
  std::size_t tool = 0;         ///< in which that point lies
  /// The deepest point found relative to its parent element: another one on a graded mesh.
  struct Place {
    double share = 0.0;           ///< [-]
    double depth = 0.0;           ///< [mm]
    Vec3 position = Vec3::Zero(); ///< in space [mm]
    std::size_t tool = 0;
    Index face = -1; ///< -1: no face is in a tool

    template <class Archive> void fields(Archive& archive) {
      archive(share, depth, position, tool, face);
    }
  };
  Place relative;
  std::size_t queries = 0; ///< of tools' surfaces, for the cost

  template <class Archive> void fields(Archive& archive) {
    archive(bound, share, sampled, at_points, pressed, share_pressed, position, tool, relative,
            queries);
  }
};

/// Penetration at the last assembled trial, over whole faces.
///
/// @param state  what is found clear of tools serves the next call (G.59)
/// @param limit  that it is compared with: a bound is resolved to a twentieth of it [mm]
[[nodiscard]] Penetration penetration(const ContactModel& model,
                                      ContactState& state,
                                      const mechanics::Trial& trial,
                                      double limit);

} // namespace billet::contact
