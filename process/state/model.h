// What is built on a part to solve for increments of it: metal, contact, loads, Newton's method.
//
// It is made anew where the part gets a new mesh, and read from a checkpoint where a run goes on.

#pragma once

#include "contact/self/self_contact_term.h"
#include "contact/term/contact_term.h"
#include "contact/trapped/trapped_term.h"
#include "contact/wear/wear.h"
#include "geometry/base/owned.h"
#include "geometry/surfaces/retreating_surface.h"
#include "mechanics/equilibrium/newton.h"
#include "mechanics/loads/loads.h"
#include "mechanics/loads/rigid_body_stabilization.h"
#include "process/presses/blows.h"
#include "process/scene/scene.h"
#include "process/tools/narrow_tools.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace billet::process {

/// A tool that touched when an unload stage began, its surface in another that draws back.
struct Retreating {
  std::size_t tool;
  std::shared_ptr<geometry::RetreatingSurface> surface;
};

struct Model {
  /// With the scene's tools as they are at the start; nothing is built yet.
  explicit Model(std::vector<contact::Tool> at_start) : tools(std::move(at_start)) {}
  Model(const Model&) = delete; // its parts refer to each other
  Model& operator=(const Model&) = delete;

  std::vector<contact::Tool> tools; ///< as they are now: some may draw back
  std::vector<Retreating> retreating;
  mechanics::BlockPattern pattern;
  Owned<mechanics::Bulk> bulk;
  Owned<contact::ContactSurface> surface;                 ///< empty: nothing can touch
  Owned<contact::ContactTerm> contact;                    ///< empty: there are no tools
  Owned<contact::SelfContactTerm> self_contact;           ///< empty: not looked at
  Owned<contact::TrappedTerm> trapped;                    ///< empty: pockets stay empty
  Owned<NarrowTools> narrow;                              ///< empty: there are no tools
  Owned<Blows> blows;                                     ///< empty: no press strikes
  Owned<contact::Wear> wear;                              ///< empty: no tool has a law of wear
  std::vector<std::unique_ptr<mechanics::Load>> loads;    ///< in the order of the part's
  std::vector<std::unique_ptr<mechanics::Load>> decaying; ///< forces of tools that have left
  Owned<mechanics::RigidBodyStabilization> stabilization; ///< empty: supports hold all motions
  std::vector<mechanics::ForceTerm*> terms; ///< of all these, in the order of assembly
  Owned<mechanics::Newton> newton;
  int free_motions = 0; ///< rigid motions held by stabilization alone
};

/// Builds all but wear, in the place of what was there before.
///
/// @param x  positions of the nodes, then driven tools, shape (n_dofs + n_extra) [mm]
/// @pre scene and part outlive the model, or the next time it is built
/// @throws Error (Fault::case_file) if nothing holds the part
void build(Model& model, const Scene& scene, const Part& part, std::span<const double> x);

/// Force per displacement of the size of the body's own stiffness [N/mm]; in plane strain that of a
/// slice of unit thickness.
[[nodiscard]] double body_stiffness(const Scene& scene, const Part& part);

/// How the free degrees of freedom of driven tools enter the equations.
[[nodiscard]] contact::DriveScale drive_scale(const Scene& scene, const Part& part);

/// Work that is no more than that of strains that are rounding, and says nothing [N mm].
[[nodiscard]] double negligible_work(const Model& model);

} // namespace billet::process
