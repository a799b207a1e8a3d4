#include "mechanics/materials/j2_hencky.h"

#include "geometry/base/index.h"
#include "mechanics/numerics/quadrature.h"
#include "mechanics/numerics/simd_pack.h"

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

/// What the return map finds at a point.
struct Return {
  double increment; ///< of the plastic strain [-]
  double stress;    ///< von Mises', that is left [MPa]
  double slope;     ///< of the flow stress along the increment, rates included [MPa]
};

/// Where nothing flows that could be told from rest.
Return at_rest(double q) { return {0.0, q, std::numeric_limits<double>::infinity()}; }

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
///
/// @param high  q / 3 mu
template <FlowLaw Law>
std::optional<Return>
solve_return(const Law& law, double mu, double q, double high, double old, const PointConditions&) {
  double low = 0.0;
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
      return at_rest(q);
    if (std::abs(residual) <= rounding * q || high - low <= rounding * high)
      return Return{d, q - 3.0 * mu * d, flow.slope};
    const double newton = d + residual / (3.0 * mu + flow.slope);
    // Where the slope is infinite at first, d may lie hundreds of decades below q / 3 mu.
    const double between = low > 0.0 ? 0.5 * (low + high) : 1e-3 * high;
    d = newton > low && newton < high ? newton : between;
  }
  return std::nullopt;
}

/// What a rate law's flow at the end of an increment leaves: the flow stress, for q - 3 mu d has no
/// digits left where nearly all of the stress relaxes.
Return returned(double d, const RateFlowStress& flow, double dt) {
  return {d, flow.stress, flow.slope + flow.rate_slope / dt};
}

/// Solves q - 3 mu d - sigma(old + d, d / dt) = 0 for d in (0, q / 3 mu). (M.22)
///
/// Powers of d make a line of a logarithm, so Newton seeks ln d with the logarithm of what resists,
/// 3 mu d + sigma - sigma(rest): convex where sigma is a sum of powers, and from the right end of
/// the bracket it comes down in a few steps over any number of decades. (M.23)
template <RateFlowLaw Law>
std::optional<Return> solve_return(const Law& law,
                                   double mu,
                                   double q,
                                   double high,
                                   double old,
                                   const PointConditions& at) {
  const double rest = stress_at_rest(law, old, at);
  double low = 0.0;
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
      return returned(d, flow, at.dt);
    const double resists = 3.0 * mu * d + (flow.stress - rest);
    const double slope = 3.0 * mu * d + d * flow.slope + flow.rate_slope * (d / at.dt);
    constexpr double longest = 50.0; // of a step, in ln d
    double next =
        d * std::exp(-std::min(std::log(resists / (q - rest)) * resists / slope, longest));
    constexpr int patience = 8;
    if (!(next > low && next < high) || i % patience == patience - 1)
      next = low > 0.0 ? std::sqrt(low) * std::sqrt(high) : 1e-3 * high;
    else if (std::abs(next - d) <= rounding * d)
      return returned(d, flow, at.dt);
    d = next;
  }
  return flows() ? std::nullopt : std::optional(at_rest(q));
}

/// What a series gives, or the function itself for points that it does not serve; what a point gets
/// does not depend on the others.
///
/// @param beyond  0 where the series serves
template <class Function>
PointPack repaired(const PointPack& values, const PointPack& beyond, Function function) {
  return PointPack::of([&](int l) { return beyond[l] == 0.0 ? values[l] : function(l); });
}

/// artanh(z) / z.
PointPack artanh_per_z(const PointPack& z) {
  const PointPack squares = z * z;
  PointPack sum{};
  for (const double coefficient : artanh_series)
    sum = PointPack::constant(coefficient) + squares * sum;
  return sum;
}

/// Logarithms of b > 0; false where one is not, or is infinite.
bool logarithms(const PrincipalPack& b, PrincipalPack& out) {
  const PointPack one = PointPack::constant(1.0);
  PrincipalPack beyond;
  for (std::size_t a = 0; a < 3; ++a) {
    const PointPack z = (b[a] - one) / (b[a] + one);
    beyond[a] = unless_within(z, artanh_series_reach);
    out[a] = 2.0 * (z * artanh_per_z(z));
  }
  if (all_zero(beyond[0] + beyond[1] + beyond[2]))
    return true;
  PointPack bad{};
  for (std::size_t a = 0; a < 3; ++a) {
    out[a] = repaired(out[a], beyond[a], [&](int l) { return std::log(b[a][l]); });
    bad += unless_positive(b[a]) + unless_within(b[a], std::numeric_limits<double>::max());
  }
  return all_zero(bad);
}

/// Exponentials.
PrincipalPack exponentials(const PrincipalPack& x) {
  constexpr double near = 1.0 / 32.0; // where the series is exact to rounding
  const PointPack one = PointPack::constant(1.0);
  PrincipalPack result;
  PrincipalPack beyond;
  for (std::size_t a = 0; a < 3; ++a) {
    result[a] = one;
    for (const double n : {9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0})
      result[a] = one + ((1.0 / n) * x[a]) * result[a];
    beyond[a] = unless_within(x[a], near);
  }
  if (!all_zero(beyond[0] + beyond[1] + beyond[2]))
    for (std::size_t a = 0; a < 3; ++a)
      result[a] = repaired(result[a], beyond[a], [&](int l) { return std::exp(x[a][l]); });
  return result;
}

/// `log_difference` of a and b.
PointPack log_differences(const PointPack& a, const PointPack& b) {
  const PointPack per_sum = PointPack::constant(1.0) / (a + b);
  const PointPack z = (a - b) * per_sum;
  const PointPack beyond = unless_within(z, artanh_series_reach);
  const PointPack series = 2.0 * (b * per_sum) * artanh_per_z(z);
  return all_zero(beyond)
             ? series
             : repaired(series, beyond, [&](int l) { return log_difference(a[l], b[l]); });
}

/// A batch of points on its way from the predictors to the responses.
struct Batch {
  PrincipalPack eps;  ///< deviatoric principal strains of the predictors
  PointPack norm;     ///< of the predictors' deviatoric stress [MPa]
  PointPack beta;     ///< share of the stress that is left; 1: elastic
  PointPack share;    ///< (M.7)'s gamma-bar; 0: elastic
  PointPack per_norm; ///< 1 / norm; 0: elastic
};

/// Strains and stress of the predictors, whose decompositions are in `out`; false when one of them
/// is not positive.
bool set_strains(double mu, DeviatoricResponse& out, Batch& now) {
  if (!logarithms(out.predictor.values, now.eps))
    return false;
  for (PointPack& strain : now.eps)
    strain = 0.5 * strain;
  out.log_J = now.eps[0] + now.eps[1] + now.eps[2];
  const PointPack mean = (1.0 / 3.0) * out.log_J;
  for (PointPack& strain : now.eps)
    strain = strain - mean;
  now.norm = (2.0 * mu) *
             sqrt(now.eps[0] * now.eps[0] + now.eps[1] * now.eps[1] + now.eps[2] * now.eps[2]);
  return true;
}

/// A symmetric tensor, given in principal axes, in space.
///
/// @tparam planar  the last axis is the one out of the plane
template <bool planar>
TensorPack in_space(const DeviatoricResponse& at, const PrincipalPack& values) {
  constexpr auto has = [](std::size_t i, std::size_t a) { return !planar || (i == 2) == (a == 2); };
  TensorPack tensor{};
  for (std::size_t k = 0; k < tensor.size(); ++k) {
    const auto [i, j] = tensor_components[k];
    for (std::size_t a = 0; a < 3; ++a)
      if (has(i, a) && has(j, a))
        tensor[k] += values[a] * (at.predictor.vectors[a][i] * at.predictor.vectors[a][j]);
  }
  return tensor;
}

/// Stresses and moduli in principal axes. (M.7), (M.8)
template <bool planar> void put_moduli(const Batch& at, double mu, DeviatoricResponse& out) {
  const PointPack scaled = (2.0 * mu) * at.beta;
  const PointPack less = (2.0 * mu) * at.share;
  PrincipalPack direction;
  for (std::size_t a = 0; a < 3; ++a) {
    out.s[a] = scaled * at.eps[a];
    direction[a] = (2.0 * mu) * (at.eps[a] * at.per_norm);
  }
  out.deviator = in_space<planar>(out, out.s);
  out.shear_moduli = {};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t c = a; c < 3; ++c) {
      const PointPack dyad = less * (direction[a] * direction[c]);
      out.normal_moduli[a][c] =
          a == c ? (2.0 / 3.0) * scaled - dyad - 2.0 * out.s[a] : (-1.0 / 3.0) * scaled - dyad;
      out.normal_moduli[c][a] = out.normal_moduli[a][c];
    }
    if (planar && a > 0)
      continue;
    const std::size_t i = a == 2 ? 0 : a;
    const std::size_t j = a == 2 ? 2 : a + 1;
    out.shear_moduli[a] =
        (0.5 * scaled) * log_differences(out.predictor.values[i], out.predictor.values[j]) -
        out.s[j];
  }
}

/// b_e in space from the strains that are left; where nothing flows the predictor, to the bit.
/// (M.9)
template <bool planar>
void put_states(const Batch& at, const TensorPack& b_pred, DeviatoricResponse& out) {
  PrincipalPack logarithm;
  for (std::size_t a = 0; a < 3; ++a)
    logarithm[a] = 2.0 * (at.beta * at.eps[a]) + (2.0 / 3.0) * out.log_J;
  const TensorPack flowing = in_space<planar>(out, exponentials(logarithm));
  for (std::size_t k = 0; k < b_pred.size(); ++k)
    out.b_e[k] = where_negative(-1.0 * at.per_norm, flowing[k], b_pred[k]);
}

/// Updates a batch, whose predictors are decomposed.
template <bool planar, class Law>
bool update_batch(const Law& law,
                  double mu,
                  const TensorPack& b_pred,
                  const PointsBefore& before,
                  DeviatoricResponse& out) {
  Batch now;
  if (!set_strains(mu, out, now))
    return false;
  const PointPack q = std::sqrt(1.5) * now.norm;
  const PointPack highest = (1.0 / (3.0 * mu)) * q;
  std::array<double, points_at_once> stress{};
  std::array<double, points_at_once> slope{};
  std::array<double, points_at_once> rests; // below zero where a point flows
  rests.fill(1.0);
  out.plastic_increment.fill(0.0);
  bool flows = false;
  for (std::size_t l = 0; l < idx(before.count); ++l) {
    const auto k = static_cast<int>(l);
    const PointConditions at{before.dt, before.temperature[l]};
    const double strain = before.plastic_strain[l];
    out.plastic_strain[l] = strain;
    if (q[k] <= stress_at_rest(law, strain, at))
      continue;
    const std::optional<Return> flow = solve_return(law, mu, q[k], highest[k], strain, at);
    if (!flow)
      return false;
    flows = true;
    rests[l] = -1.0;
    stress[l] = flow->stress;
    slope[l] = flow->slope;
    out.plastic_increment[l] = flow->increment;
    out.plastic_strain[l] += flow->increment;
  }
  const auto packed = [](const std::array<double, points_at_once>& numbers) {
    return PointPack::of([&](int l) { return numbers[idx(l)]; });
  };
  const PointPack one = PointPack::constant(1.0);
  const PointPack zero{};
  const PointPack rest = packed(rests);
  now.beta = where_negative(rest, packed(stress) / q, one);
  // 1 - 3 mu / (3 mu + slope), of infinite slopes as well.
  const PointPack kept = one / (one + PointPack::constant(3.0 * mu) / packed(slope));
  now.share = where_negative(rest, now.beta - kept, zero);
  now.per_norm = where_negative(rest, one / now.norm, zero);
  put_moduli<planar>(now, mu, out);
  if (flows)
    put_states<planar>(now, b_pred, out);
  else
    out.b_e = b_pred;
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

/// States side by side in their principal axes.
struct PrincipalStates {
  std::size_t first; ///< the first of them
  int count;
  DeviatoricResponse at; ///< axes, and ln J
  PrincipalPack eps;     ///< logarithmic strains, less their mean [-]
};

/// Calls `visit` with every batch of states.
template <class Visit>
void for_each_batch(std::span<const PointState> states, bool planar, Visit visit) {
  constexpr auto most = idx(points_at_once);
  for (std::size_t first = 0; first < states.size(); first += most) {
    const std::size_t count = std::min(most, states.size() - first);
    TensorPack b;
    for (std::size_t c = 0; c < tensor_components.size(); ++c) {
      const auto i = static_cast<Eigen::Index>(tensor_components[c][0]);
      const auto j = static_cast<Eigen::Index>(tensor_components[c][1]);
      b[c] = PointPack::of(
          [&](int l) { return states[first + std::min(idx(l), count - 1)].b_e(i, j); });
    }
    PrincipalStates batch;
    batch.first = first;
    batch.count = static_cast<int>(count);
    if (planar)
      decompose_in_plane(b, batch.at.predictor);
    else
      decompose(b, batch.at.predictor);
    Batch strains;
    static_cast<void>(set_strains(1.0, batch.at, strains)); // of what is not positive: NaN
    batch.eps = strains.eps;
    visit(batch);
  }
}

} // namespace

bool update(const Material& material,
            const TensorPack& b_pred,
            const PointsBefore& before,
            bool planar,
            DeviatoricResponse& out) {
  if (planar)
    decompose_in_plane(b_pred, out.predictor);
  else
    decompose(b_pred, out.predictor);
  const double mu = material.elasticity.shear();
  return std::visit(
      [&](const auto& law) {
        return planar ? update_batch<true>(law, mu, b_pred, before, out)
                      : update_batch<false>(law, mu, b_pred, before, out);
      },
      material.flow);
}

void elastic_energies(const Elasticity& elasticity,
                      std::span<const PointState> states,
                      bool planar,
                      std::span<double> out) {
  for_each_batch(states, planar, [&](const PrincipalStates& batch) {
    const PointPack squares =
        batch.eps[0] * batch.eps[0] + batch.eps[1] * batch.eps[1] + batch.eps[2] * batch.eps[2];
    const PointPack energies = (0.5 * elasticity.bulk()) * (batch.at.log_J * batch.at.log_J) +
                               elasticity.shear() * squares;
    for (int l = 0; l < batch.count; ++l)
      out[batch.first + idx(l)] = energies[l];
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

double flow_stress_left(const AnyFlowLaw& flow, const FlowPoint& at) {
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
    out.d_flow_stress = out.d_stress;
  }
  if (flows && follows_rate(material.flow))
    out.flow_stress = out.stress;
  return out;
}

void kirchhoff_stresses(const Elasticity& elasticity,
                        std::span<const PointState> states,
                        bool planar,
                        std::span<Mat3> out) {
  for_each_batch(states, planar, [&](const PrincipalStates& batch) {
    PrincipalPack tau;
    for (std::size_t a = 0; a < 3; ++a)
      tau[a] = (2.0 * elasticity.shear()) * batch.eps[a] + elasticity.bulk() * batch.at.log_J;
    const TensorPack in_axes =
        planar ? in_space<true>(batch.at, tau) : in_space<false>(batch.at, tau);
    for (int l = 0; l < batch.count; ++l)
      for (std::size_t c = 0; c < tensor_components.size(); ++c) {
        const auto i = static_cast<Eigen::Index>(tensor_components[c][0]);
        const auto j = static_cast<Eigen::Index>(tensor_components[c][1]);
        Mat3& to = out[batch.first + idx(l)];
        to(i, j) = to(j, i) = in_axes[c][l];
      }
  });
}

} // namespace billet::mechanics
