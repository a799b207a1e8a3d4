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
using PathDual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 5, 1>>;

/// A vector in the plane of such numbers.
struct PathDualVec {
  PathDual x;
  PathDual y;
};

PathDual constant(double value) { return PathDual(value, Eigen::Matrix<double, 5, 1>::Zero()); }
PathDualVec operator+(const PathDualVec& a, const PathDualVec& b) { return {a.x + b.x, a.y + b.y}; }
PathDualVec operator-(const PathDualVec& a, const PathDualVec& b) { return {a.x - b.x, a.y - b.y}; }
PathDualVec operator*(const PathDual& f, const PathDualVec& v) { return {f * v.x, f * v.y}; }
PathDual dot(const PathDualVec& a, const PathDualVec& b) { return a.x * b.x + a.y * b.y; }
PathDual norm(const PathDualVec& v) { return sqrt(dot(v, v)); }

/// A slide along a straight path, from its first point on the limit.
struct Slide {
  PathDualVec shear;    ///< at its start [MPa]
  PathDualVec e;        ///< unit vector that the shear is driven along, against the path [-]
  PathDual drive;       ///< K times the length of path left [MPa]
  PathDual limit_start; ///< [MPa]
  PathDual limit_end;   ///< [MPa]
};

/// Where a shear driven from within the limit along `e` reaches it: the share of the increment at
/// which |tau + drive x e| = L0 + (L1 - L0) x. (F.16) @pre the end lies outside
PathDual share_within(const PathDualVec& shear,
                      const PathDualVec& e,
                      const PathDual& drive,
                      double limit_old,
                      const PathDual& limit_end) {
  const PathDual growth = limit_end - limit_old;
  const PathDual a = drive * drive - growth * growth;
  const PathDual b = drive * dot(shear, e) - limit_old * growth;
  const PathDual c = dot(shear, shear) - limit_old * limit_old;
  if (!(c.value() < 0.0) && b.value() >= 0.0)
    return constant(0.0);
  const PathDual root = sqrt(b * b - a * c);
  const PathDual x = b.value() >= 0.0 ? PathDual(-c / (b + root)) : PathDual((root - b) / a);
  return x;
}

/// (F.17): the angle between shear and drive falls as tan(theta / 2) exp(-drive / L), L the
/// logarithmic mean of the limits.
PathDualVec slide_exactly(const Slide& slide) {
  const PathDualVec across{-slide.e.y, slide.e.x};
  const PathDual along = dot(slide.shear, slide.e);
  const PathDual beside = dot(slide.shear, across);
  constexpr double opposite = 1e-12; // driven straight back while the limit falls: nothing turns
  if (!(slide.limit_start.value() + along.value() > opposite * slide.limit_start.value()))
    return (slide.limit_end / norm(slide.shear)) * slide.shear;
  const PathDual tangent = beside / (slide.limit_start + along);
  const PathDual growth = slide.limit_end - slide.limit_start;
  const double ratio = growth.value() / slide.limit_start.value();
  constexpr double nearly_constant = 1e-4; // below it four terms of the series are exact to 1e-17
  const PathDual x = growth / slide.limit_start;
  const PathDual mean_inverse =
      std::abs(ratio) < nearly_constant
          ? PathDual((1.0 - x * (0.5 - x * (1.0 / 3.0 - 0.25 * x))) / slide.limit_start)
          : PathDual(log(slide.limit_end / slide.limit_start) / growth);
  const PathDual t = tangent * exp(-slide.drive * mean_inverse);
  const PathDual size = slide.limit_end / (1.0 + t * t);
  return size * (1.0 - t * t) * slide.e + size * (2.0 * t) * across;
}

/// One sub-increment of the generalised mid-point rule. (F.18)
PathDualVec mid_point(const PathDualVec& shear, const PathDualVec& driven, const PathDual& limit) {
  const PathDualVec sum = shear + driven;
  const PathDual length = norm(sum);
  if (length.value() > 0.0) {
    const PathDualVec m = (1.0 / length) * sum;
    const PathDual b = dot(driven, m);
    const PathDual left = b * b - (dot(driven, driven) - limit * limit);
    if (left.value() > 0.0)
      return driven - (b - sqrt(left)) * m;
  }
  // The mean direction misses the limit: the step is too long for the rule.
  return (limit / norm(driven)) * driven;
}

PathDualVec slide_by_mid_points(const Slide& slide, int substeps) {
  constexpr int most = 100;
  const double smaller = std::min(slide.limit_start.value(), slide.limit_end.value());
  // Five for each T / K of path leave an eighth of a degree of a right angle (FRI-04).
  const double turns = 5.0 * slide.drive.value() / std::max(smaller, 1e-300);
  const int n =
      substeps > 0 ? substeps : static_cast<int>(std::clamp(std::ceil(turns), 1.0, double{most}));
  PathDualVec shear = slide.shear;
  for (int i = 1; i <= n; ++i) {
    const double x = static_cast<double>(i) / n;
    const PathDual limit = slide.limit_start + x * (slide.limit_end - slide.limit_start);
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
  const auto variable = [](double value, int which) { return PathDual(value, 5, which); };
  const PathDualVec shear{variable(step.shear[0], 0), variable(step.shear[1], 1)};
  const PathDualVec path{variable(step.path[0], 2), variable(step.path[1], 3)};
  const PathDual limit_end = variable(limit.shear, 4);
  const PathDual way = norm(path);
  const PathDualVec e = (-1.0 / way) * path;
  const PathDual drive = K * way;
  const PathDual within = share_within(shear, e, drive, limit_old, limit_end);
  Slide slide{shear + (within * drive) * e, e, (1.0 - within) * drive,
              limit_old + within * (limit_end - limit_old), limit_end};
  const PathDualVec end = scheme.integrator == Integrator::exact
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
