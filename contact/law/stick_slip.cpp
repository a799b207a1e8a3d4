#include "contact/law/stick_slip.h"

#include <Eigen/LU>
#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace billet::contact {

namespace {

// --- Backward Euler ------------------------------------------------------------------------------

/// (tau_lim Q + K s I): takes the sliding direction to the predictor. (F.14)
Mat2 return_matrix(const Mat2& Q, double limit, double elastic) {
  return limit * Q + elastic * Mat2::Identity();
}

/// Slip of a predictor outside the limit: the root of |A(s)^-1 T| = 1. (F.14)
double slip_of(const Friction& friction,
               const SlipStep& step,
               const Mat2& Q,
               const Vec2& predictor,
               bool isotropic) {
  const double size = predictor.norm();
  const double K = step.stiffness;
  if (isotropic && !friction.depends_on_slip())
    return (size - limit_at(friction, step.state, 0.0).shear) / K;
  const auto excess = [&](double s) {
    const double limit = limit_at(friction, step.state, s).shear;
    if (isotropic)
      return size - limit - K * s;
    return (return_matrix(Q, limit, K * s).inverse() * predictor).norm() - 1.0;
  };
  // The dissipation of a slide is positive, so the slip is no longer than all of the predictor's.
  const double most = size / K;
  const double least = isotropic ? 0.0 : most * 1e-30; // without a limit at rest A(0) is singular
  if (excess(most) >= 0.0)
    return most;
  if (excess(least) <= 0.0)
    return least;
  constexpr int bits = 52;
  std::uintmax_t iterations = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      excess, least, most, boost::math::tools::eps_tolerance<double>(bits), iterations);
  return std::abs(excess(below)) < std::abs(excess(above)) ? below : above;
}

/// Whether a predictor stays within the limit of a point at rest.
bool sticks(const Mat2& Q, double limit, const Vec2& predictor, bool isotropic) {
  if (predictor.isZero(0.0))
    return true;
  if (limit == 0.0)
    return false;
  return isotropic ? predictor.norm() <= limit : (Q.inverse() * predictor).norm() <= limit;
}

SlipResult stuck(const SlipStep& step, const Vec2& predictor, double limit) {
  return {Status::stick, predictor,        Vec2::Zero(),
          limit,         Mat2::Identity(), Mat2(-step.stiffness * Mat2::Identity()),
          Vec2::Zero(),  Vec2::Zero()};
}

SlipResult radial(const Friction& friction, const SlipStep& step, const Mat2& Q) {
  const bool isotropic = Q.isIdentity(0.0);
  const double K = step.stiffness;
  const Vec2 predictor = step.shear - K * step.path;
  const LimitAtSlip at_rest = limit_at(friction, step.state, 0.0);
  if (sticks(Q, at_rest.shear, predictor, isotropic))
    return stuck(step, predictor, at_rest.shear * Q.norm() / std::numbers::sqrt2);
  const double s = slip_of(friction, step, Q, predictor, isotropic);
  const LimitAtSlip limit = limit_at(friction, step.state, s);
  const Mat2 inverse = return_matrix(Q, limit.shear, K * s).inverse();
  const Vec2 d = (inverse * predictor).normalized();
  // Implicit differentiation of A(s) d = T with |d| = 1. (F.15)
  const Vec2 g = inverse.transpose() * d;
  const Vec2 c = limit.d_slip * (Q * d) + K * d;
  const Vec2 ds_dT = g / g.dot(c);
  const Mat2 dd_dT = inverse * (Mat2::Identity() - c * ds_dT.transpose());
  const Mat2 loss = K * (d * ds_dT.transpose() + s * dd_dT);
  SlipResult out;
  out.status = Status::slip;
  out.shear = limit.shear * (Q * d);
  out.slip = -s * d;
  out.limit = out.shear.norm();
  out.d_shear = Mat2::Identity() - loss;
  out.d_path = -K * out.d_shear;
  out.d_pressure = limit.d_pressure * (loss * (Q * d));
  out.d_shear_yield = limit.d_shear_yield * (loss * (Q * d));
  return out;
}

// --- Integrators of the path ---------------------------------------------------------------------

/// A number with its derivatives by shear (2), path (2) and slip limit at the end (1).
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 5, 1>>;

/// A vector in the plane of such numbers.
struct DualVec {
  Dual x;
  Dual y;
};

Dual constant(double value) { return Dual(value, Eigen::Matrix<double, 5, 1>::Zero()); }
DualVec operator+(const DualVec& a, const DualVec& b) { return {a.x + b.x, a.y + b.y}; }
DualVec operator-(const DualVec& a, const DualVec& b) { return {a.x - b.x, a.y - b.y}; }
DualVec operator*(const Dual& f, const DualVec& v) { return {f * v.x, f * v.y}; }
Dual dot(const DualVec& a, const DualVec& b) { return a.x * b.x + a.y * b.y; }
Dual norm(const DualVec& v) { return sqrt(dot(v, v)); }

/// A slide along a straight path, from its first point on the limit.
struct Slide {
  DualVec shear;    ///< at its start [MPa]
  DualVec e;        ///< unit vector that the shear is driven along, against the path [-]
  Dual drive;       ///< K times the length of path left [MPa]
  Dual limit_start; ///< [MPa]
  Dual limit_end;   ///< [MPa]
};

/// Where a shear driven from within the limit along `e` reaches it: the share of the increment at
/// which |tau + drive x e| = L0 + (L1 - L0) x. (F.16) @pre the end lies outside
Dual share_within(const DualVec& shear,
                  const DualVec& e,
                  const Dual& drive,
                  double limit_old,
                  const Dual& limit_end) {
  const Dual growth = limit_end - limit_old;
  const Dual a = drive * drive - growth * growth;
  const Dual b = drive * dot(shear, e) - limit_old * growth;
  const Dual c = dot(shear, shear) - limit_old * limit_old;
  if (!(c.value() < 0.0) && b.value() >= 0.0)
    return constant(0.0);
  const Dual root = sqrt(b * b - a * c);
  const Dual x = b.value() >= 0.0 ? Dual(-c / (b + root)) : Dual((root - b) / a);
  return x;
}

/// (F.17): the angle between shear and drive falls as tan(theta / 2) exp(-drive / L), L the
/// logarithmic mean of the limits.
DualVec slide_exactly(const Slide& slide) {
  const DualVec across{-slide.e.y, slide.e.x};
  const Dual along = dot(slide.shear, slide.e);
  const Dual beside = dot(slide.shear, across);
  constexpr double opposite = 1e-12; // driven straight back while the limit falls: nothing turns
  if (!(slide.limit_start.value() + along.value() > opposite * slide.limit_start.value()))
    return (slide.limit_end / norm(slide.shear)) * slide.shear;
  const Dual tangent = beside / (slide.limit_start + along);
  const Dual growth = slide.limit_end - slide.limit_start;
  const double ratio = growth.value() / slide.limit_start.value();
  constexpr double nearly_constant = 1e-4; // below it four terms of the series are exact to 1e-17
  const Dual x = growth / slide.limit_start;
  const Dual mean_inverse =
      std::abs(ratio) < nearly_constant
          ? Dual((1.0 - x * (0.5 - x * (1.0 / 3.0 - 0.25 * x))) / slide.limit_start)
          : Dual(log(slide.limit_end / slide.limit_start) / growth);
  const Dual t = tangent * exp(-slide.drive * mean_inverse);
  const Dual size = slide.limit_end / (1.0 + t * t);
  return size * (1.0 - t * t) * slide.e + size * (2.0 * t) * across;
}

/// One sub-increment of the generalised mid-point rule. (F.18)
DualVec mid_point(const DualVec& shear, const DualVec& driven, const Dual& limit) {
  const DualVec sum = shear + driven;
  const Dual length = norm(sum);
  if (length.value() > 0.0) {
    const DualVec m = (1.0 / length) * sum;
    const Dual b = dot(driven, m);
    const Dual left = b * b - (dot(driven, driven) - limit * limit);
    if (left.value() > 0.0)
      return driven - (b - sqrt(left)) * m;
  }
  // The mean direction misses the limit: the step is too long for the rule.
  return (limit / norm(driven)) * driven;
}

DualVec slide_by_mid_points(const Slide& slide, int substeps) {
  constexpr int most = 100;
  const double smaller = std::min(slide.limit_start.value(), slide.limit_end.value());
  // Five for each T / K of path leave an eighth of a degree of a right angle (FRI-04).
  const double turns = 5.0 * slide.drive.value() / std::max(smaller, 1e-300);
  const int n =
      substeps > 0 ? substeps : static_cast<int>(std::clamp(std::ceil(turns), 1.0, double{most}));
  DualVec shear = slide.shear;
  for (int i = 1; i <= n; ++i) {
    const double x = static_cast<double>(i) / n;
    const Dual limit = slide.limit_start + x * (slide.limit_end - slide.limit_start);
    shear = mid_point(shear, shear + (slide.drive / double(n)) * slide.e, limit);
  }
  return shear;
}

/// An isotropic increment with a length of path, by `midpoint` or `exact`.
SlipResult along_path(const Friction& friction, const SlipScheme& scheme, const SlipStep& step) {
  const double K = step.stiffness;
  const double length = step.path.norm();
  const LimitAtSlip limit = limit_at(friction, step.state, length);
  const Vec2 predictor = step.shear - K * step.path;
  // A committed shear above its limit (the law has changed) starts on it.
  const double limit_old = std::max(step.limit_old, step.shear.norm());
  if (predictor.norm() <= limit.shear)
    return stuck(step, predictor, limit.shear);
  const auto variable = [](double value, int which) { return Dual(value, 5, which); };
  const DualVec shear{variable(step.shear[0], 0), variable(step.shear[1], 1)};
  const DualVec path{variable(step.path[0], 2), variable(step.path[1], 3)};
  const Dual limit_end = variable(limit.shear, 4);
  const Dual way = norm(path);
  const DualVec e = (-1.0 / way) * path;
  const Dual drive = K * way;
  const Dual within = share_within(shear, e, drive, limit_old, limit_end);
  Slide slide{shear + (within * drive) * e, e, (1.0 - within) * drive,
              limit_old + within * (limit_end - limit_old), limit_end};
  const DualVec end = scheme.integrator == Integrator::exact
                          ? slide_exactly(slide)
                          : slide_by_mid_points(slide, scheme.substeps);
  SlipResult out;
  out.status = Status::slip;
  out.shear = {end.x.value(), end.y.value()};
  out.slip = step.path + (out.shear - step.shear) / K;
  out.limit = limit.shear;
  Eigen::Matrix<double, 2, 5> d;
  d << end.x.derivatives().transpose(), end.y.derivatives().transpose();
  const Vec2 d_limit = d.col(4);
  out.d_shear = d.leftCols<2>();
  out.d_path = d.middleCols<2>(2) + limit.d_slip / length * d_limit * step.path.transpose();
  out.d_pressure = limit.d_pressure * d_limit;
  out.d_shear_yield = limit.d_shear_yield * d_limit;
  return out;
}

} // namespace

SlipResult stick_slip(const Friction& friction,
                      const SlipScheme& scheme,
                      const SlipStep& step,
                      const Mat2& Q) {
  // Without a way, and against a limit that vanishes, there is nothing to integrate along.
  constexpr double shortest = 1e-12; // of the path that the limit allows elastically
  const bool moves = step.stiffness * step.path.norm() > shortest * step.limit_old;
  if (scheme.integrator == Integrator::radial || !Q.isIdentity(0.0) || !moves ||
      !(step.limit_old > 0.0) || !(limit_at(friction, step.state, step.path.norm()).shear > 0.0))
    return radial(friction, step, Q);
  return along_path(friction, scheme, step);
}

} // namespace billet::contact
