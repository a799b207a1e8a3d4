// J2 plasticity at finite strain: Hencky elasticity and the exponential return map.
//
// Given the elastic predictor b_e,pred = f b_e,old f^T of an increment, gives the deviatoric
// Kirchhoff stress, its exact spatial moduli and the new state. The volumetric part is the
// element's business (elements/): kappa/2 (ln J)^2, which plastic flow never touches.
//
// Kinematics   left elastic Cauchy-Green tensor b_e, logarithmic strains eps_a = ln(b_a) / 2.
// Yield        von Mises stress of the *Kirchhoff* stress against the flow law.
// Rates        backward Euler: the rate of an increment is its plastic strain over its length.
// Units        stresses MPa. Theory: docs/theory/mechanics.md (M.4)-(M.9), (M.22)-(M.23); Simo
//              (1992).

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/materials/any_flow_law.h"
#include "mechanics/numerics/simd_pack.h"
#include "mechanics/numerics/spectral.h"

#include <array>
#include <cstddef>
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
  double temperature = 20.0; ///< of the workpiece at the start, and for good without heating [degC]
  double heating = 0.0;      ///< rise of temperature per plastic work; 0: isothermal [degC/MPa]
};

/// History of one integration point: all that a restart needs.
struct PointState {
  Mat3 b_e = Mat3::Identity(); ///< left elastic Cauchy-Green tensor [-], current axes
  double plastic_strain = 0.0; ///< accumulated [-]

  template <class Archive> void fields(Archive& archive) { archive(b_e, plastic_strain); }
};

/// Points that are updated side by side: as many as the widest processors' vectors hold numbers, of
/// others two vectors, neither of which waits for the other.
constexpr int points_at_once = tensors_at_once;
using PointPack = SimdPack<points_at_once>;
/// Of each principal axis.
using PrincipalPack = std::array<PointPack, 3>;
/// Symmetric tensors: xx, yy, zz, xy, yz, xz.
using TensorPack = TensorsSideBySide;

/// A batch of points as an increment finds them.
struct PointsBefore {
  int count = points_at_once; ///< points; the batch may have more than there are
  double dt = 0.0;            ///< length of the increment [s], > 0; matters to rate laws only
  std::array<double, points_at_once> plastic_strain; ///< [-]
  std::array<double, points_at_once> temperature;    ///< [degC]
};

/// Deviatoric response of a batch of points, mostly in the principal axes of the predictors.
struct DeviatoricResponse {
  SpectralSideBySide predictor;
  PointPack log_J;                            ///< ln J, J the total (elastic) volume ratio [-]
  PrincipalPack s;                            ///< principal deviatoric Kirchhoff stresses [MPa]
  TensorPack deviator;                        ///< the same in space [MPa]
  std::array<PrincipalPack, 3> normal_moduli; ///< d s_a / d eps_b - 2 s_a delta_ab [MPa]
  /// Spatial moduli of the shears 01, 12, 02, the last two 0 where the problem is planar [MPa].
  PrincipalPack shear_moduli;
  TensorPack b_e;                                       ///< of the trial states [-]
  std::array<double, points_at_once> plastic_strain;    ///< of the trial states [-]
  std::array<double, points_at_once> plastic_increment; ///< [-]

  /// Writes the trial state of a point: number by number to where it stays, for a copy of a state
  /// just written would be waited for.
  void put_state(int point, PointState& to) const {
    for (std::size_t k = 0; k < b_e.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(tensor_components[k][0]);
      const auto j = static_cast<Eigen::Index>(tensor_components[k][1]);
      to.b_e(i, j) = b_e[k][point];
      to.b_e(j, i) = b_e[k][point];
    }
    to.plastic_strain = plastic_strain[static_cast<std::size_t>(point)];
  }
};

/// Updates a batch of points.
///
/// @param b_pred  elastic predictors, positive definite, beyond the last point as well
/// @param planar  no shear out of the plane: xz and yz entries are zero
/// @param out     overwritten
/// @return false when a return map has no solution (NaN or a predictor that is not positive)
[[nodiscard]] bool update(const Material& material,
                          const TensorPack& b_pred,
                          const PointsBefore& before,
                          bool planar,
                          DeviatoricResponse& out);

/// Elastic energies of shape per reference volume [MPa]. (M.6)
///
/// @param s  principal deviatoric Kirchhoff stresses [MPa]
[[nodiscard]] inline PointPack shape_energies(const Elasticity& elasticity,
                                              const PrincipalPack& s) {
  return (1.0 / (4.0 * elasticity.shear())) * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
}

/// Elastic energies per reference volume stored in states, shape (n) [MPa]. (M.6)
///
/// @param planar  no shear out of the plane
void elastic_energies(const Elasticity& elasticity,
                      std::span<const PointState> states,
                      bool planar,
                      std::span<double> out);

/// Plastic work per reference volume at the flow stress [MPa]. (M.9)
///
/// @param from  plastic strain at the start [-]
/// @param to    plastic strain at the end [-]; rate and temperature are those of the whole way
[[nodiscard]] double plastic_work(const AnyFlowLaw& flow, double from, const FlowPoint& to);

/// Flow stress [MPa]; infinite for an elastic body.
[[nodiscard]] double yield_stress(const AnyFlowLaw& flow, const FlowPoint& at);

/// Flow stress as a share of the largest on the way there from no strain, at the same rate and
/// temperature, found at a hundred strains; 1 for an elastic body [-].
[[nodiscard]] double flow_stress_left(const AnyFlowLaw& flow, const FlowPoint& at);

/// Von Mises stress of a state and how it follows the strains of an increment. (F.21)
struct MisesStress {
  double stress;        ///< q, of the Kirchhoff stress [MPa]
  double flow_stress;   ///< at its plastic strain, rate and temperature [MPa]
  Mat3 direction;       ///< unit deviator of the elastic strain [-]; zero without one
  double d_stress;      ///< d q = d_stress direction : grad u [MPa]
  double d_flow_stress; ///< the same of the flow stress [MPa]
};

/// @param old_plastic_strain  of the committed state: the point flows when it has grown [-]
/// @param dt                  length of the increment [s]
/// @param temperature         [degC]
[[nodiscard]] MisesStress mises_stress(const Material& material,
                                       const PointState& state,
                                       double old_plastic_strain,
                                       double dt,
                                       double temperature);

/// Kirchhoff stresses of states, shape (n) [MPa]. (M.6)
///
/// @param planar  no shear out of the plane
void kirchhoff_stresses(const Elasticity& elasticity,
                        std::span<const PointState> states,
                        bool planar,
                        std::span<Mat3> out);

} // namespace billet::mechanics
