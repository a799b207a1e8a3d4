// J2 plasticity at finite strain: Hencky elasticity and the exponential return map.
//
// Given the elastic predictor b_e,pred = f b_e,old f^T of an increment, gives the deviatoric
// Kirchhoff stress, its exact spatial moduli and the new state. The volumetric part is the
// element's business (elements/): kappa/2 (ln J)^2, which plastic flow never touches.
//
// Kinematics   left elastic Cauchy-Green tensor b_e, logarithmic strains eps_a = ln(b_a) / 2.
// Yield        von Mises stress of the *Kirchhoff* stress against the flow law.
// Units        stresses MPa. Theory: docs/theory/mechanics.md (M.4)-(M.9); Simo (1992).

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/materials/any_flow_law.h"
#include "mechanics/spectral.h"

#include <span>

namespace billet::mechanics {

/// Isotropic elasticity.
struct Elasticity {
  double young;   ///< E [MPa], > 0
  double poisson; ///< nu [-], in (-1, 0.5)

  [[nodiscard]] double shear() const { return young / (2.0 * (1.0 + poisson)); }
  [[nodiscard]] double bulk() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }
};

/// A workpiece material.
struct Material {
  Elasticity elasticity;
  AnyFlowLaw flow;
};

/// History of one integration point: all that a restart needs.
struct PointState {
  Mat3 b_e = Mat3::Identity(); ///< left elastic Cauchy-Green tensor [-], current axes
  double plastic_strain = 0.0; ///< accumulated [-]
};

/// Deviatoric response of one point, in the principal axes of the predictor.
struct DeviatoricResponse {
  Spectral predictor;             ///< principal values of b_e,pred and their directions
  double log_J;                   ///< ln J, J the total (elastic) volume ratio [-]
  Vec3 s;                         ///< principal deviatoric Kirchhoff stresses [MPa]
  Mat3 normal_moduli;             ///< d s_a / d eps_b - 2 s_a delta_ab [MPa], symmetric
  Vec3 shear_moduli;              ///< spatial moduli of the shears 01, 12, 02 [MPa]
  PointState state;               ///< trial state
  double plastic_increment = 0.0; ///< of the accumulated plastic strain [-]
};

/// Updates a batch of points; the flow law is resolved once per call.
///
/// @param b_pred  elastic predictors, shape (n), symmetric positive definite
/// @param old     committed states, shape (n)
/// @param planar  no shear out of the plane: xz and yz entries are zero
/// @param out     shape (n), overwritten
/// @return false when a return map has no solution (NaN or a predictor that is not positive)
[[nodiscard]] bool update(const Material& material,
                          std::span<const Mat3> b_pred,
                          std::span<const PointState> old,
                          bool planar,
                          std::span<DeviatoricResponse> out);

/// Elastic energies per reference volume stored in states, shape (n) [MPa]. (M.6)
void elastic_energies(const Elasticity& elasticity,
                      std::span<const PointState> states,
                      std::span<double> out);

/// Plastic work per reference volume from `from` to `to` at the flow stress [MPa]. (M.9)
[[nodiscard]] double plastic_work(const AnyFlowLaw& flow, double from, double to);

/// Yield stress at a plastic strain [MPa]; infinite for an elastic body.
[[nodiscard]] double yield_stress(const AnyFlowLaw& flow, double plastic_strain);

/// Von Mises stress of a state and how it follows the strains of an increment. (F.21)
struct MisesStress {
  double stress;     ///< q, of the Kirchhoff stress [MPa]
  double strength;   ///< yield stress at its plastic strain [MPa]
  Mat3 direction;    ///< unit deviator of the elastic strain [-]; zero without one
  double d_stress;   ///< d q = d_stress direction : grad u [MPa]
  double d_strength; ///< of the yield stress, likewise [MPa]
};

/// @param old_plastic_strain  of the committed state: the point flows when it has grown [-]
[[nodiscard]] MisesStress
mises_stress(const Material& material, const PointState& state, double old_plastic_strain);

/// Kirchhoff stresses of states, shape (n) [MPa]. (M.6)
void kirchhoff_stresses(const Elasticity& elasticity,
                        std::span<const PointState> states,
                        std::span<Mat3> out);

} // namespace billet::mechanics
