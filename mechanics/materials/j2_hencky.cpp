#include "mechanics/materials/j2_hencky.h"

#include "mechanics/elements/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <variant>

namespace billet::mechanics {

namespace {

/// Plastic strain increment and the slope of the flow law at its end.
struct Return {
  double increment;
  double slope;
};

/// Solves q - 3 mu d - sigma_y(old + d) = 0 for d in (0, q / 3 mu): Newton, kept in its bracket.
///
/// The residual is positive at 0 and not positive at the upper end for every law with
/// sigma_y >= 0, whatever its slope.
template <class Law>
std::optional<Return> solve_return(const Law& law, double mu, double q, double old) {
  double low = 0.0;
  double high = q / (3.0 * mu);
  const FlowStress start = law.flow_stress(old);
  double d = (q - start.stress) / (3.0 * mu + (std::isfinite(start.slope) ? start.slope : 0.0));
  if (!(d > low && d < high))
    d = 0.5 * (low + high);
  constexpr int most = 200; // bisection alone needs 60
  constexpr double tolerance = 4.0 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < most; ++i) {
    const FlowStress flow = law.flow_stress(old + d);
    const double residual = q - 3.0 * mu * d - flow.stress;
    if (!std::isfinite(residual))
      return std::nullopt;
    (residual > 0.0 ? low : high) = d;
    if (std::abs(residual) <= tolerance * q || high - low <= tolerance * high)
      return Return{d, flow.slope};
    const double newton = d + residual / (3.0 * mu + flow.slope);
    d = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return std::nullopt;
}

/// Moduli in principal axes from the scaled elastic ones; `share` is (M.7)'s gamma-bar.
void set_moduli(DeviatoricResponse& out,
                double mu,
                double beta,
                double share,
                const Vec3& direction) {
  out.normal_moduli = 2.0 * mu * beta * (Mat3::Identity() - Mat3::Constant(1.0 / 3.0)) -
                      2.0 * mu * share * direction * direction.transpose();
  out.normal_moduli.diagonal() -= 2.0 * out.s;
  const Vec3& b = out.predictor.values;
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k;
    const int j = k == 2 ? 2 : k + 1;
    out.shear_moduli[k] = mu * beta * log_difference(b[i], b[j]) - out.s[j];
  }
}

template <class Law>
bool update_point(const Law& law,
                  double mu,
                  const Mat3& b_pred,
                  const PointState& old,
                  DeviatoricResponse& out) {
  const Vec3& b = out.predictor.values;
  if (!(b.minCoeff() > 0.0) || !std::isfinite(b.sum()))
    return false;
  Vec3 eps = 0.5 * b.array().log();
  out.log_J = eps.sum();
  eps.array() -= out.log_J / 3.0;
  const Vec3 s_pred = 2.0 * mu * eps;
  const double norm = s_pred.norm();
  const double q = std::sqrt(1.5) * norm;
  out.state.plastic_strain = old.plastic_strain;
  out.plastic_increment = 0.0;
  if (q <= law.flow_stress(old.plastic_strain).stress) {
    out.s = s_pred;
    out.state.b_e = b_pred;
    set_moduli(out, mu, 1.0, 0.0, Vec3::Zero());
    return true;
  }
  const std::optional<Return> plastic = solve_return(law, mu, q, old.plastic_strain);
  if (!plastic)
    return false;
  const double beta = 1.0 - 3.0 * mu * plastic->increment / q;
  out.s = beta * s_pred;
  out.plastic_increment = plastic->increment;
  out.state.plastic_strain += plastic->increment;
  const Vec3 b_new = (2.0 * (beta * eps.array() + out.log_J / 3.0)).exp();
  const Mat3& n = out.predictor.vectors;
  out.state.b_e = n * b_new.asDiagonal() * n.transpose();
  set_moduli(out, mu, beta, 3.0 * mu / (3.0 * mu + plastic->slope) - (1.0 - beta), s_pred / norm);
  return true;
}

/// Calls `visit(i, decomposition of b_e)` for every state.
template <class Visit> void for_each_decomposed(std::span<const PointState> states, Visit visit) {
  constexpr std::size_t batch = 8;
  std::array<Mat3, batch> b;
  std::array<Spectral, batch> decomposed;
  for (std::size_t first = 0; first < states.size(); first += batch) {
    const std::size_t n = std::min(batch, states.size() - first);
    for (std::size_t i = 0; i < n; ++i)
      b[i] = states[first + i].b_e;
    spectral(std::span(b).first(n), std::span(decomposed).first(n));
    for (std::size_t i = 0; i < n; ++i)
      visit(first + i, decomposed[i]);
  }
}

void set_predictors(std::span<const Mat3> b_pred, bool planar, std::span<DeviatoricResponse> out) {
  if (planar) {
    for (std::size_t i = 0; i < b_pred.size(); ++i)
      out[i].predictor = spectral_plane(b_pred[i]);
    return;
  }
  constexpr std::size_t batch = 8;
  std::array<Spectral, batch> predictors;
  for (std::size_t first = 0; first < b_pred.size(); first += batch) {
    const std::size_t n = std::min(batch, b_pred.size() - first);
    spectral(b_pred.subspan(first, n), std::span(predictors).first(n));
    for (std::size_t i = 0; i < n; ++i)
      out[first + i].predictor = predictors[i];
  }
}

} // namespace

bool update(const Material& material,
            std::span<const Mat3> b_pred,
            std::span<const PointState> old,
            bool planar,
            std::span<DeviatoricResponse> out) {
  const double mu = material.elasticity.shear();
  set_predictors(b_pred, planar, out);
  return std::visit(
      [&](const auto& law) {
        for (std::size_t i = 0; i < b_pred.size(); ++i)
          if (!update_point(law, mu, b_pred[i], old[i], out[i]))
            return false;
        return true;
      },
      material.flow);
}

void elastic_energies(const Elasticity& elasticity,
                      std::span<const PointState> states,
                      std::span<double> out) {
  for_each_decomposed(states, [&](std::size_t i, const Spectral& b) {
    const Vec3 eps = 0.5 * b.values.array().log();
    const double log_J = eps.sum();
    const double squares = (eps.array() - log_J / 3.0).square().sum();
    out[i] = 0.5 * elasticity.bulk() * log_J * log_J + elasticity.shear() * squares;
  });
}

double plastic_work(const AnyFlowLaw& flow, double from, double to) {
  if (!(to > from))
    return 0.0;
  return std::visit(
      [&](const auto& law) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double strain = from + 0.5 * (1.0 + GaussLine<3>::x[i]) * (to - from);
          sum += 0.5 * GaussLine<3>::w[i] * law.flow_stress(strain).stress;
        }
        return sum * (to - from);
      },
      flow);
}

double yield_stress(const AnyFlowLaw& flow, double plastic_strain) {
  return std::visit([&](const auto& law) { return law.flow_stress(plastic_strain).stress; }, flow);
}

MisesStress
mises_stress(const Material& material, const PointState& state, double old_plastic_strain) {
  const double mu = material.elasticity.shear();
  const FlowStress flow = std::visit(
      [&](const auto& law) { return law.flow_stress(state.plastic_strain); }, material.flow);
  const Spectral b = spectral(state.b_e);
  Vec3 eps = 0.5 * b.values.array().log();
  eps.array() -= eps.mean();
  const double norm = eps.norm();
  MisesStress out{std::sqrt(6.0) * mu * norm, flow.stress, Mat3::Zero(), 0.0, 0.0};
  if (norm == 0.0)
    return out;
  out.direction = b.vectors * (eps / norm).asDiagonal() * b.vectors.transpose();
  out.d_stress = std::sqrt(6.0) * mu;
  if (state.plastic_strain > old_plastic_strain) {
    out.d_stress *= flow.slope / (3.0 * mu + flow.slope);
    out.d_strength = out.d_stress;
  }
  return out;
}

void kirchhoff_stresses(const Elasticity& elasticity,
                        std::span<const PointState> states,
                        std::span<Mat3> out) {
  for_each_decomposed(states, [&](std::size_t i, const Spectral& b) {
    const Vec3 eps = 0.5 * b.values.array().log();
    const double log_J = eps.sum();
    const Vec3 tau =
        2.0 * elasticity.shear() * (eps.array() - log_J / 3.0) + elasticity.bulk() * log_J;
    out[i] = b.vectors * tau.asDiagonal() * b.vectors.transpose();
  });
}

} // namespace billet::mechanics
