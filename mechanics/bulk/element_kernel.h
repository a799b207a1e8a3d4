// Forces and tangents of elements at a trial configuration.
//
// Virtual work of the Kirchhoff stress over the reference volume, f = sum_g dV0 tau : grad du, with
// gradients with respect to the current positions (M.3). Quadratic elements evaluate the whole
// stress at each point; quad4 and hex8 take the pressure from the dilatation of the whole element
// (variational mean dilatation, M.11-M.13), which keeps the tangent symmetric.
//
// Shapes   positions (nodes, dim) row by row; local vectors (nodes * dim); local matrices
//          go to the system's matrix block by block.

#pragma once

#include "mechanics/equilibrium/force_term.h"
#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/mesh/mesh.h"

#include <span>

namespace billet::mechanics {

/// What an element is given.
struct ElementInput {
  const double* x_old;                    ///< committed positions of its nodes [mm]
  const double* x;                        ///< positions tried [mm]
  std::span<const double> volumes;        ///< reference volume of each point [mm^3]
  std::span<const PointState> old;        ///< committed states
  double dt;                              ///< length of the increment [s]
  std::span<const double> temperatures{}; ///< of the points [degC]; empty: the material's
};

/// What an element gives; the arrays belong to the caller.
struct ElementOutput {
  double* force = nullptr;              ///< internal forces, overwritten
  const BlockPlaces* tangent = nullptr; ///< where it is added; null: not wanted
  std::span<PointState> trial;          ///< trial states
  double largest_plastic_increment = 0; ///< over the points [-]
  std::span<double> shape_energies;     ///< elastic, of the trial states [MPa]; empty: not wanted
};

enum class ElementStatus { good, inverted, no_return };

/// The kernel of one kind and analysis, for 1 to `elements_at_once` elements side by side. What one
/// gets does not depend on the others but for rounding: whoever wants the same bits takes the same
/// elements together. Nothing is added to the tangent unless all are good: alone they say which is
/// not.
using ElementKernel = ElementStatus (*)(const Material&,
                                        std::span<const ElementInput>,
                                        std::span<ElementOutput>);

[[nodiscard]] ElementKernel element_kernel(ElementKind kind, Analysis analysis);

/// Elements whose points fill a batch.
[[nodiscard]] int elements_at_once(ElementKind kind);

/// Volumes of the integration points of 1 to `elements_at_once` elements in a configuration (of the
/// full turn when axisymmetric).
///
/// @param x    positions, shape (elements, nodes, dim) [mm]
/// @param out  shape (elements, points), overwritten [mm^3]
void point_volumes(ElementKind kind, Analysis analysis, const double* x, std::span<double> out);

/// Whether all points of an element share one pressure. (M.11)
[[nodiscard]] bool has_mean_dilatation(ElementKind kind);

/// Volume ratio v / V0 that the pressure of each point goes with: the element's mean for elements
/// with mean dilatation, the point's own otherwise. (M.12)
[[nodiscard]] double pressure_ratio(ElementKind kind,
                                    std::span<const double> current,
                                    std::span<const double> reference,
                                    std::size_t point);

/// Derivative of `n : grad u` at an integration point by the nodal displacements from a
/// configuration. (F.21)
///
/// @param n    symmetric [-]
/// @param x    positions, shape (nodes, dim) [mm]
/// @param out  shape (nodes * dim), overwritten [1/mm]
void strain_gradient(ElementKind kind,
                     Analysis analysis,
                     const double* x,
                     std::size_t point,
                     const Mat3& n,
                     std::span<double> out);

} // namespace billet::mechanics
