#include "contact/law/interface_law.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace billet::contact {

namespace {

/// Relative sliding of the increment in the tangent plane, and its derivative. (C.5)
struct Sliding {
  Vec3 path;     ///< [mm]
  Mat3 dpath_dx; ///< [-]
};

/// (phi / sin phi - 1) / sin^2 phi of the angle between two normals, and its derivative by cos phi.
struct ArcExcess {
  double value, slope;
};

ArcExcess arc_excess(double cosine) {
  constexpr double least = 0.5; // beyond 60 degrees the tool's surface is hardly an arc
  const double c = std::max(cosine, least);
  const double s2 = std::max(0.0, 1.0 - c * c);
  ArcExcess arc{};
  if (constexpr double small = 1e-3; s2 < small) { // terms of arcsin s, against cancellation
    arc.value = 1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (5.0 / 112.0 + s2 * 35.0 / 1152.0));
    arc.slope = -2.0 * c * (3.0 / 40.0 + s2 * (5.0 / 56.0 + s2 * 35.0 / 384.0));
  } else {
    const double s = std::sqrt(s2);
    const double excess = std::acos(c) - s;
    arc.value = excess / (s * s2);
    arc.slope = ((c - 1.0) * s + 3.0 * c * excess) / (s * s2 * s2);
  }
  if (cosine < least)
    arc.slope = 0.0;
  return arc;
}

constexpr double max_half_turn = 1.5; // beyond a whole increment no longer tells where it was

/// By how much the end of a path is turned from its chord about the normal.
double half_turn(const Vec3& turn, const Vec3& n) {
  return std::clamp(-0.5 * turn.dot(n), -max_half_turn, max_half_turn);
}

/// Where tool and face turn against each other in the tangent plane a point goes along an arc of
/// that angle in the tool's frame: what it slides with is the arc's length along its end, not its
/// chord. (C.5a)
void bend(Sliding& s, const Vec3& turn, const Vec3& n, const Mat3& H) {
  const double a = half_turn(turn, n);
  constexpr double none = 1e-9;
  if (std::abs(a) < none)
    return;
  const double sine = std::sin(a), cosine = std::cos(a);
  const double f = a / sine; // arc over chord
  const double df = (sine - a * cosine) / (sine * sine);
  const Vec3 across = n.cross(s.path);
  Mat3 dacross;
  for (int j = 0; j < 3; ++j)
    dacross.col(j) = n.cross(s.dpath_dx.col(j)) + H.col(j).cross(s.path);
  const Vec3 dpath_da = (df * cosine - f * sine) * s.path + (df * sine + f * cosine) * across;
  const Eigen::RowVector3d da = std::abs(a) < max_half_turn
                                    ? Eigen::RowVector3d(-0.5 * turn.transpose() * H)
                                    : Eigen::RowVector3d::Zero();
  s.dpath_dx = f * (cosine * s.dpath_dx + sine * dacross) + dpath_da * da;
  s.path = f * (cosine * s.path + sine * across);
}

/// @param share  of the increment in which the point touches
Sliding sliding(const PointHistory& old, const InterfaceInput& at, double share = 1.0) {
  const Vec3& n = at.projection.normal;
  const Mat3& H = at.projection.dnormal_dx;
  const Vec3 way = at.position - old.position;
  const Mat3 P = Mat3::Identity() - n * n.transpose();
  Sliding s;
  s.path = P * way;
  s.dpath_dx = P - n.dot(way) * H - n * (way.transpose() * H);
  // In the direction in which the tool's surface has turned: its arc, not the arc's projection.
  const double c = n.dot(old.normal);
  const ArcExcess arc = arc_excess(c);
  const Vec3 q = old.normal - c * n;
  const Eigen::RowVector3d dc = old.normal.transpose() * H;
  const Mat3 dq = -n * dc - c * H;
  const double along = q.dot(way);
  s.path += arc.value * along * q;
  s.dpath_dx += q * (arc.slope * along * dc + arc.value * (way.transpose() * dq + q.transpose())) +
                arc.value * along * dq;
  s.path *= share;
  s.dpath_dx *= share;
  bend(s, share * at.turn, n, H);
  return s;
}

/// Derivative of `turn(v, from, n(x))`, H = dn/dx.
Mat3 turn_derivative(const Vec3& v, const Vec3& from, const Vec3& n, const Mat3& H) {
  const double c = 1.0 + n.dot(from);
  const double along = n.dot(v);
  const Vec3 sum = n + from;
  return -sum * ((v.transpose() / c - along / (c * c) * from.transpose()) * H) - along / c * H;
}

/// An orthonormal frame of the tangent plane, and how it turns about the normal as the point moves.
struct TangentFrame {
  Eigen::Matrix<double, 3, 2> E; ///< columns e1, e2
  Vec3 spin;                     ///< de1 . e2 = spin . dx [1/mm]
};

/// A tangent where nothing prefers one: in the plane of a plane scene.
Vec3 some_tangent(const Vec3& n) {
  const Vec3 in_plane = n.cross(Vec3::UnitZ());
  return in_plane.isZero(0.0) ? n.unitOrthogonal() : Vec3(in_plane.normalized());
}

/// The frame whose first axis is the projection of a direction. (F.12)
TangentFrame frame_along(const Vec3& direction, const geometry::Projection& foot) {
  const Vec3& n = foot.normal;
  const Vec3 projected = direction - n.dot(direction) * n;
  const double length = projected.norm();
  constexpr double smallest = 1e-9; // of a unit vector: it has no projection
  const Vec3 e1 = length > smallest ? Vec3(projected / length) : some_tangent(n);
  TangentFrame frame;
  frame.E << e1, n.cross(e1);
  frame.spin = Vec3::Zero();
  if (length > smallest)
    frame.spin = -n.dot(direction) / length * (foot.dnormal_dx.transpose() * frame.E.col(1));
  return frame;
}

/// Any frame, carried along without turning: isotropic friction cannot tell.
TangentFrame any_frame(const Vec3& n) {
  const Vec3 e1 = some_tangent(n);
  TangentFrame frame;
  frame.E << e1, n.cross(e1);
  frame.spin = Vec3::Zero();
  return frame;
}

/// A tangential vector and its derivative, in components of a frame.
struct InFrame {
  Vec2 v;
  Eigen::Matrix<double, 2, 3> dv_dx;
};

InFrame in_frame(const TangentFrame& frame, const Vec3& v, const Mat3& dv_dx) {
  const Vec2 c = frame.E.transpose() * v;
  return {c, frame.E.transpose() * dv_dx + Vec2(c[1], -c[0]) * frame.spin.transpose()};
}

/// Derivative in space of a tangential vector given in a frame.
Mat3 in_space(const TangentFrame& frame,
              const Vec2& v,
              const Eigen::Matrix<double, 2, 3>& dv_dx,
              const geometry::Projection& foot) {
  const Vec3 in_plane = frame.E * v;
  return frame.E * (dv_dx - Vec2(v[1], -v[0]) * frame.spin.transpose()) -
         foot.normal * (in_plane.transpose() * foot.dnormal_dx);
}

/// Whether the slip limit is that of the pressure at the start of the increment. (F.3a)
bool lags(const PointHistory& old, const InterfaceInput& at) {
  return at.friction_lagged && old.closed() && old.pressure > 0.0;
}

/// What a point that rubs is under.
struct Rubbing {
  SlipState state;   ///< with the pressure that the slip limit is taken at
  double d_pressure; ///< of that pressure by the one that acts [-]
  double stiffness;  ///< by which the pressure that acts falls with the gap [MPa/mm]
};

/// Sets the pressure that the slip limit is taken at.
///
/// @param resting  the point lies on the tool but for rounding: whether it sticks must not depend
/// on
///                 the sign of its gap
void take_limit_at(const Penalty& penalty,
                   const PointHistory& old,
                   const InterfaceInput& at,
                   bool resting,
                   Rubbing& rubbing) {
  constexpr double steep = 100.0; // shear ends with the pressure, however much it lags (F.3a)
  double& pressure = rubbing.state.pressure;
  const auto fix = [&](double value) {
    pressure = value;
    rubbing.d_pressure = 0.0;
  };
  if (lags(old, at)) {
    pressure *= steep;
    rubbing.d_pressure = steep;
    if (pressure >= old.pressure)
      fix(old.pressure);
  }
  if (at.kept && old.closed() && old.pressure > pressure) // also under tension
    fix(old.pressure);
  if (const double noise = penalty.normal * at.noise; resting && noise > pressure)
    fix(noise);
}

/// By what the shear of a point whose friction lags is off the law at the pressure that acts.
/// (F.3a)
double lag_of(const Friction& friction, const SlipState& state, const Traction& now) {
  const double slip = now.slip.norm(), shear = now.shear.norm();
  SlipState acting = state;
  acting.pressure = now.pressure;
  const double asked = limit_at(friction, acting, slip).shear;
  if (now.status == Status::stick)
    return std::max(0.0, shear - asked);
  const double had = limit_at(friction, state, slip).shear;
  return had > 0.0 ? shear * std::abs(asked / had - 1.0) : asked;
}

/// The shear of a point that was closed, or touches for a share of the increment. (C.4)-(C.6)
void add_shear(const Friction& friction,
               const Penalty& penalty,
               const PointHistory& old,
               const InterfaceInput& at,
               const SlipScheme& scheme,
               const Rubbing& rubbing,
               Traction& out) {
  const geometry::Projection& foot = at.projection;
  const Vec3& n = foot.normal;
  const Sliding s = sliding(old, at, old.closed() ? 1.0 : at.touching);
  const double stiffness = at.softening * (old.stiffness > 0.0 ? old.stiffness : penalty.tangent);
  const TangentFrame frame =
      friction.tensor ? frame_along(friction.tensor->direction, foot) : any_frame(n);
  Mat3 dturned = Mat3::Zero();
  if (!old.shear.isZero(0.0)) {
    out.turned = turn(old.shear, old.normal, n);
    dturned = turn_derivative(old.shear, old.normal, n, foot.dnormal_dx);
  }
  const InFrame shear = in_frame(frame, out.turned, dturned);
  // The slip turned with the point: so did the shear of a point that slid all the time.
  out.turned = Eigen::AngleAxisd(2.0 * half_turn(at.turn, n), n) * out.turned;
  const InFrame path = in_frame(frame, s.path, s.dpath_dx);
  const SlipStep step{shear.v, path.v, stiffness, old.limit, rubbing.state};
  const SlipResult end =
      stick_slip(friction, scheme, step, friction.tensor ? friction.tensor->Q : Mat2::Identity());
  out.status = end.status;
  out.shear = frame.E * end.shear;
  out.slip = frame.E * end.slip;
  out.limit = end.limit;
  Eigen::Matrix<double, 2, 3> dshear = end.d_shear * shear.dv_dx + end.d_path * path.dv_dx;
  if (rubbing.d_pressure != 0.0) {
    const Vec2 by_pressure = rubbing.d_pressure * end.d_pressure;
    dshear -= rubbing.stiffness * by_pressure * n.transpose();
    out.dtraction_dp += frame.E * by_pressure;
  }
  out.traction += out.shear;
  out.dtraction_dx += in_space(frame, end.shear, dshear, foot);
  out.dtraction_dk = frame.E * end.d_shear_yield;
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

namespace {

/// A slide begins where the shear has come to its limit: from rest, or from the other side after
/// a turn, that is farther on than where the increment began. (C.18a)
double unseen_work(const PointHistory& old, const Traction& now) {
  const double way = now.slip.norm();
  if (!old.closed() || way == 0.0 || now.pressure <= 0.0)
    return 0.0;
  const Vec3 along = -now.slip / way; // as the shear acts
  const double before = now.turned.norm();
  const double limit = std::max(before, std::min(old.limit, now.shear.norm()));
  const double there = now.turned.dot(along);
  const double rise = std::sqrt(std::max(0.0, there * there + limit * limit - before * before));
  return 0.5 * std::max(0.0, rise - there) * way;
}

} // namespace

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
  const double unseen = unseen_work(old, now);
  return {after, lost + stored - shear_energy(now.shear, after) + unseen, unseen};
}

Traction traction(const Friction& friction,
                  const Penalty& penalty,
                  const PointHistory& old,
                  const InterfaceInput& at,
                  const SlipScheme& scheme) {
  Traction out;
  const geometry::Projection& foot = at.projection;
  // A point that lay on the tool and has not moved off yet resists being pressed in: without its
  // stiffness the first correction would throw a body that only contact holds through the tool.
  const bool resting = old.closed() && foot.gap <= at.rounding && !at.shared;
  const bool kept = at.kept && old.closed();
  const double pressure =
      at.shared ? at.shared->pressure : at.multiplier - penalty.normal * foot.gap;
  const double stiffness = at.shared ? at.shared->stiffness : penalty.normal;
  if (!(pressure > 0.0) && !resting && !kept)
    return out;
  const Vec3& n = foot.normal;
  out.pressure = pressure;
  if (!kept)
    out.pressure = std::max(0.0, out.pressure);
  out.status = Status::slip;
  out.traction = out.pressure * n;
  out.dtraction_dp = n;
  out.dtraction_dx = -stiffness * n * n.transpose() + out.pressure * foot.dnormal_dx;
  const bool rubs = old.closed() || at.touching > 0.0;
  Rubbing rubbing{{out.pressure, at.shear_yield, old.sliding, at.dt}, 1.0, stiffness};
  take_limit_at(penalty, old, at, resting, rubbing);
  if (!old.closed() && rubs)
    rubbing.state.dt *= at.touching;
  rubbing.state.limited = !old.closed() && rubs;
  out.limit = limit_at(friction, rubbing.state, 0.0).shear;
  if (!rubs)
    return out;
  if (out.limit == 0.0 && !friction.depends_on_slip()) {
    out.slip = sliding(old, at, old.closed() ? 1.0 : at.touching).path;
    return out;
  }
  add_shear(friction, penalty, old, at, scheme, rubbing, out);
  if (lags(old, at))
    out.lag = lag_of(friction, rubbing.state, out);
  return out;
}

} // namespace billet::contact
