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

/// Length of the increment and temperature of one point.
struct PointConditions {
  double dt;
  double temperature;
};

/// Plastic strain increment, share of the stress that is left, and (M.7)'s gamma-bar.
struct Return {
  double increment;
  double beta;
  double share;
};

constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

/// The stress below which nothing flows.
template <FlowLaw Law>
double stress_at_rest(const Law& law, double strain, const PointConditions&) {
  return law.flow_stress(strain).stress;
}

template <RateFlowLaw Law>
double stress_at_rest(const Law& law, double strain, const PointConditions& at) {
  return law.flow_stress({strain, 0.0, at.temperature}).stress;
}

/// Solves q - 3 mu d - sigma_y(old + d) = 0 for d in (0, q / 3 mu): Newton, kept in its bracket.
///
/// The residual is positive at 0 and not positive at the upper end for every law with
/// sigma_y >= 0, whatever its slope.
template <FlowLaw Law>
std::optional<Return>
solve_return(const Law& law, double mu, double q, double old, const PointConditions&) {
  double low = 0.0;
  double high = q / (3.0 * mu);
  const FlowStress start = law.flow_stress(old);
  double d = (q - start.stress) / (3.0 * mu + (std::isfinite(start.slope) ? start.slope : 0.0));
  if (!(d > low && d < high))
    d = 0.5 * (low + high);
  constexpr int most = 200; // decades by threes need 100, bisection 60
  for (int i = 0; i < most; ++i) {
    const FlowStress flow = law.flow_stress(old + d);
    const double residual = q - 3.0 * mu * d - flow.stress;
    if (!std::isfinite(residual))
      return std::nullopt;
    (residual > 0.0 ? low : high) = d;
    if (high < std::numeric_limits<double>::min())
      return Return{0.0, 1.0, 0.0}; // nothing flows that could be told from rest
    if (std::abs(residual) <= rounding * q || high - low <= rounding * high) {
      const double beta = 1.0 - 3.0 * mu * d / q;
      return Return{d, beta, 3.0 * mu / (3.0 * mu + flow.slope) - (1.0 - beta)};
    }
    const double newton = d + residual / (3.0 * mu + flow.slope);
    // Where the slope is infinite at first, d may lie hundreds of decades below q / 3 mu.
    const double between = low > 0.0 ? 0.5 * (low + high) : 1e-3 * high;
    d = newton > low && newton < high ? newton : between;
  }
  return std::nullopt;
}

/// What a rate law's flow at the end of an increment leaves of the stress. `beta` comes from the
/// flow stress, for 1 - 3 mu d / q has no digits left where nearly all of the stress relaxes.
Return returned(double d, double mu, double q, const RateFlowStress& flow, double dt) {
  const double beta = flow.stress / q;
  const double h = flow.slope + flow.rate_slope / dt;
  return {d, beta, beta - 1.0 / (1.0 + 3.0 * mu / h)};
}

/// Solves q - 3 mu d - sigma(old + d, d / dt) = 0 for d in (0, q / 3 mu). (M.22)
///
/// Powers of d make a line of a logarithm, so Newton seeks ln d with the logarithm of what resists,
/// 3 mu d + sigma - sigma(rest): convex where sigma is a sum of powers, and from the right end of
/// the bracket it comes down in a few steps over any number of decades. (M.23)
template <RateFlowLaw Law>
std::optional<Return>
solve_return(const Law& law, double mu, double q, double old, const PointConditions& at) {
  const double at_rest = stress_at_rest(law, old, at);
  double low = 0.0;
  double high = q / (3.0 * mu);
  double d = high;
  const auto flows = [&] { return std::min(d, d / at.dt) > std::numeric_limits<double>::min(); };
  constexpr int most = 300;
  for (int i = 0; i < most && flows(); ++i) {
    const RateFlowStress flow = law.flow_stress({old + d, d / at.dt, at.temperature});
    const double residual = q - 3.0 * mu * d - flow.stress;
    if (std::isnan(residual))
      return std::nullopt;
    (residual > 0.0 ? low : high) = d;
    if (std::abs(residual) <= rounding * q || high - low <= rounding * high)
      return returned(d, mu, q, flow, at.dt);
    const double resists = 3.0 * mu * d + (flow.stress - at_rest);
    const double slope = 3.0 * mu * d + d * flow.slope + flow.rate_slope * (d / at.dt);
    constexpr double longest = 50.0; // of a step, in ln d
    double next =
        d * std::exp(-std::min(std::log(resists / (q - at_rest)) * resists / slope, longest));
    constexpr int patience = 8;
    if (!(next > low && next < high) || i % patience == patience - 1)
      next = low > 0.0 ? std::sqrt(low) * std::sqrt(high) : 1e-3 * high;
    else if (std::abs(next - d) <= rounding * d)
      return returned(d, mu, q, flow, at.dt);
    d = next;
  }
  // Nothing flows that could be told from rest.
  return flows() ? std::nullopt : std::optional(Return{0.0, 1.0, 0.0});
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
                  const PointConditions& at,
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
  if (q <= stress_at_rest(law, old.plastic_strain, at)) {
    out.s = s_pred;
    out.state.b_e = b_pred;
    set_moduli(out, mu, 1.0, 0.0, Vec3::Zero());
    return true;
  }
  const std::optional<Return> plastic = solve_return(law, mu, q, old.plastic_strain, at);
  if (!plastic)
    return false;
  const double beta = plastic->beta;
  out.s = beta * s_pred;
  out.plastic_increment = plastic->increment;
  out.state.plastic_strain += plastic->increment;
  const Vec3 b_new = (2.0 * (beta * eps.array() + out.log_J / 3.0)).exp();
  const Mat3& n = out.predictor.vectors;
  out.state.b_e = n * b_new.asDiagonal() * n.transpose();
  set_moduli(out, mu, beta, plastic->share, s_pred / norm);
  return true;
}

/// Flow stress of any law at a point of flow.
template <FlowLaw Law> RateFlowStress flow_at(const Law& law, const FlowPoint& at) {
  const FlowStress flow = law.flow_stress(at.plastic_strain);
  return {flow.stress, flow.slope, 0.0};
}

template <RateFlowLaw Law> RateFlowStress flow_at(const Law& law, const FlowPoint& at) {
  return law.flow_stress(at);
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
            const FlowConditions& at,
            std::span<DeviatoricResponse> out) {
  const double mu = material.elasticity.shear();
  set_predictors(b_pred, planar, out);
  return std::visit(
      [&](const auto& law) {
        for (std::size_t i = 0; i < b_pred.size(); ++i)
          if (!update_point(
                  law, mu, b_pred[i], old[i],
                  {at.dt, at.temperatures.empty() ? material.temperature : at.temperatures[i]},
                  out[i]))
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

double plastic_work(const AnyFlowLaw& flow, double from, const FlowPoint& to) {
  const double increment = to.plastic_strain - from;
  if (!(increment > 0.0))
    return 0.0;
  return std::visit(
      [&](const auto& law) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double strain = from + 0.5 * (1.0 + GaussLine<3>::x[i]) * increment;
          sum += 0.5 * GaussLine<3>::w[i] * flow_at(law, {strain, to.rate, to.temperature}).stress;
        }
        return sum * increment;
      },
      flow);
}

double yield_stress(const AnyFlowLaw& flow, const FlowPoint& at) {
  return std::visit([&](const auto& law) { return flow_at(law, at).stress; }, flow);
}

double strength_left(const AnyFlowLaw& flow, const FlowPoint& at) {
  const double end = yield_stress(flow, at);
  double largest = end;
  constexpr int places = 100;
  constexpr double shortest = 1e-3; // of the strain; evenly spread by its logarithm
  for (int i = 0; i < places; ++i)
    largest = std::max(
        largest,
        yield_stress(flow, {at.plastic_strain * std::pow(shortest, static_cast<double>(i) / places),
                            at.rate, at.temperature}));
  return std::isfinite(largest) && largest > 0.0 ? end / largest : 1.0;
}

MisesStress mises_stress(const Material& material,
                         const PointState& state,
                         double old_plastic_strain,
                         double dt,
                         double temperature) {
  const double mu = material.elasticity.shear();
  const double increment = state.plastic_strain - old_plastic_strain;
  const FlowPoint at{state.plastic_strain, increment / dt, temperature};
  const RateFlowStress flow =
      std::visit([&](const auto& law) { return flow_at(law, at); }, material.flow);
  const Spectral b = spectral(state.b_e);
  Vec3 eps = 0.5 * b.values.array().log();
  eps.array() -= eps.mean();
  const double norm = eps.norm();
  MisesStress out{std::sqrt(6.0) * mu * norm, flow.stress, Mat3::Zero(), 0.0, 0.0};
  if (norm == 0.0)
    return out;
  out.direction = b.vectors * (eps / norm).asDiagonal() * b.vectors.transpose();
  out.d_stress = std::sqrt(6.0) * mu;
  // A rate law flows under any stress above that at rest, be it by less than the rounding of its
  // plastic strain; its flow stress is the stress then.
  const bool flows = increment > 0.0 || (follows_rate(material.flow) && out.stress > flow.stress);
  if (flows) {
    const double h = flow.slope + (flow.rate_slope > 0.0 ? flow.rate_slope / dt : 0.0);
    out.d_stress *= std::isfinite(h) ? h / (3.0 * mu + h) : 1.0;
    out.d_strength = out.d_stress;
  }
  if (flows && follows_rate(material.flow))
    out.strength = out.stress;
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
