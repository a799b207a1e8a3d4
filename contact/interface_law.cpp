#include "contact/interface_law.h"

#include <algorithm>
#include <cmath>

namespace billet::contact {

namespace {

/// Relative sliding of the increment in the tangent plane, and its derivative. (C.5)
struct Sliding {
  Vec3 path;     ///< [mm]
  Mat3 dpath_dx; ///< [-]
};

Sliding sliding(const PointHistory& old, const InterfaceInput& at) {
  const Vec3& n = at.projection.normal;
  const Mat3& H = at.projection.dnormal_dx;
  const Vec3 way = at.position - old.position;
  const Mat3 P = Mat3::Identity() - n * n.transpose();
  Sliding s;
  s.path = P * way;
  s.dpath_dx = P - n.dot(way) * H - n * (way.transpose() * H);
  return s;
}

/// No shear without pressure: a limit that does not vanish with the pressure is cut to a steep
/// cone. (C.10) A point that lifts would otherwise lose its shear at once, and between the two
/// states there may be no equilibrium at all.
SlipLimit bounded(const SlipLimit& limit, double pressure) {
  constexpr double steepest = 100.0;
  return limit.shear > steepest * pressure ? SlipLimit{steepest * pressure, steepest} : limit;
}

/// Derivative of `turn(v, from, n(x))`, H = dn/dx.
Mat3 turn_derivative(const Vec3& v, const Vec3& from, const Vec3& n, const Mat3& H) {
  const double c = 1.0 + n.dot(from);
  const double along = n.dot(v);
  const Vec3 sum = n + from;
  return -sum * ((v.transpose() / c - along / (c * c) * from.transpose()) * H) - along / c * H;
}

} // namespace

Vec3 turn(const Vec3& v, const Vec3& from, const Vec3& to) {
  // A half turn has no smallest rotation; no contact point does that within one increment.
  const double c = 1.0 + to.dot(from);
  return c > 0.0 ? Vec3(v - to.dot(v) / c * (to + from)) : v;
}

double shear_energy(const Vec3& shear, double stiffness) {
  return stiffness > 0.0 ? 0.5 * shear.squaredNorm() / stiffness : 0.0;
}

ShearBalance balance(const Penalty& penalty,
                     const PointHistory& old,
                     const Traction& now,
                     double sliding,
                     double depth) {
  const double before = old.stiffness > 0.0 ? old.stiffness : penalty.tangent;
  if (now.status == Status::open)
    return {0.0, shear_energy(old.shear, before)};
  constexpr double share_of_sliding = 0.02;
  constexpr double share_of_depth = 0.005;
  const double range = std::min(share_of_sliding * sliding, share_of_depth * depth);
  // Without a limit, or without a way slid, the penalty as it is given.
  double after = penalty.tangent;
  if (now.limit > 0.0 && penalty.tangent * range > now.limit)
    after = now.limit / range;
  const double lost = -0.5 * (now.turned + now.shear).dot(now.slip);
  const double stored = shear_energy(now.shear, before);
  // A softer stiffness stores more under the same shear: no more than the slide has paid for.
  const double most = stored + std::max(0.0, lost);
  if (shear_energy(now.shear, after) > most)
    after = 0.5 * now.shear.squaredNorm() / most;
  return {after, lost + stored - shear_energy(now.shear, after)};
}

Traction traction(const AnyFrictionLaw& law,
                  const Penalty& penalty,
                  const PointHistory& old,
                  const InterfaceInput& at) {
  Traction out;
  const geometry::Projection& foot = at.projection;
  // A point that lay on the tool and has not moved off yet resists being pressed in: without its
  // stiffness the first correction would throw a body that only contact holds through the tool.
  const bool resting = old.closed() && foot.gap <= at.rounding;
  const bool kept = at.kept && old.closed();
  const double pressure = at.multiplier - penalty.normal * foot.gap;
  if (!(pressure > 0.0) && !resting && !kept)
    return out;
  const Vec3& n = foot.normal;
  out.pressure = pressure;
  if (!kept)
    out.pressure = std::max(0.0, out.pressure);
  const double holding = kept ? std::max(out.pressure, old.pressure) : out.pressure;
  out.status = Status::slip;
  out.traction = out.pressure * n;
  out.dtraction_dx = -penalty.normal * n * n.transpose() + out.pressure * foot.dnormal_dx;
  SlipLimit limit = bounded(slip_limit(law, {holding, at.shear_yield}), holding);
  if (holding > out.pressure)
    limit.d_pressure = 0.0;
  out.limit = limit.shear;
  if (!old.closed())
    return out;
  const Sliding s = sliding(old, at);
  if (limit.shear == 0.0) {
    out.slip = s.path;
    return out;
  }
  const double stiffness = at.softening * (old.stiffness > 0.0 ? old.stiffness : penalty.tangent);
  Mat3 dshear = -stiffness * s.dpath_dx;
  if (!old.shear.isZero(0.0)) {
    out.turned = turn(old.shear, old.normal, n);
    dshear += turn_derivative(old.shear, old.normal, n, foot.dnormal_dx);
  }
  const Vec3 predictor = out.turned - stiffness * s.path;
  const double size = predictor.norm();
  if (size <= limit.shear) {
    out.status = Status::stick;
    out.shear = predictor;
  } else {
    const Vec3 e = predictor / size;
    out.shear = limit.shear * e;
    dshear = (limit.shear / size * (Mat3::Identity() - e * e.transpose()) * dshear).eval();
    dshear -= limit.d_pressure * penalty.normal * e * n.transpose();
    out.slip = s.path + (out.shear - out.turned) / stiffness;
  }
  out.traction += out.shear;
  out.dtraction_dx += dshear;
  return out;
}

} // namespace billet::contact
