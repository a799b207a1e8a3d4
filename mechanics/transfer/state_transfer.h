// The history of a workpiece carried from a distorted mesh to a new one of the same body.
//
// What is transferred is the logarithmic elastic strain, its deviator and its trace apart, the
// plastic strain and, where there are, temperatures and rates; b_e is built anew from them. The new
// states are admissible: no plastic strain or rate below zero, no von Mises stress above the flow
// stress. An element of the new mesh whose points all lie where old points lie takes these as they
// are, so that a mesh transferred to itself changes no bit.
//
// quad4 and hex8 have one pressure an element, that of their mean dilatation: it is what their
// points transfer, for the points' own ratios of volume say nothing.
//
// Units   lengths mm, temperatures degC, rates 1/s. Theory: docs/theory/mechanics.md (M.33)-(M.40).

#pragma once

#include "mechanics/equilibrium/force_term.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/transfer/point_transfer.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// The state of a workpiece, at every integration point.
struct StateField {
  const Mesh* mesh;                       ///< the old mesh
  std::span<const double> x;              ///< current positions of its nodes, (n_points, dim) [mm]
  std::span<const PointState> states;     ///< committed, shape (n_elements, points per element)
  std::span<const double> temperatures{}; ///< same shape [degC]; empty: the material's
  /// Of the last increment, same shape [1/s]; empty: unknown.
  std::span<const double> plastic_rate{};
};

/// The same at the points of the new mesh.
struct TransferredState {
  std::vector<PointState> states;   ///< shape (n_elements, points per element)
  std::vector<double> temperatures; ///< same shape [degC]; empty if none were given
  std::vector<double> plastic_rate; ///< same shape [1/s]; empty if none were given
  int limited = 0;                  ///< points where the bounds of (M.36) acted
  int returned = 0;                 ///< points put back onto the yield surface (M.39)
};

/// Carries the state over to the points of a new mesh.
///
/// The metal of a rate law bears any stress above that at rest; it is put back only if rates are
/// given.
///
/// @param to  the new mesh where it lies now
/// @pre both meshes are of the same dimension, their elements not inverted
[[nodiscard]] TransferredState transfer_state(const StateField& from,
                                              const Mesh& to,
                                              Analysis analysis,
                                              const Material& material,
                                              TransferMethod method = TransferMethod::patch);

} // namespace billet::mechanics
