#include "contact/self/self_traction.h"

#include <Eigen/LU>
#include <unsupported/Eigen/AutoDiff>

#include <algorithm>

namespace billet::contact {

namespace {

using Derivative = Eigen::Matrix<double, n_self_variables, 1>;
using Dual = Eigen::AutoDiffScalar<Derivative>;
using Dual2 = Eigen::Matrix<Dual, 2, 1>;
using Dual3 = Eigen::Matrix<Dual, 3, 1>;

/// Where groups of three variables begin.
enum Variables : int { the_point = 0, place = 3, tangent1 = 6, tangent2 = 9, old_place = 12 };

Dual3 variable(const Vec3& value, int first, bool varies = true) {
  Dual3 v;
  for (int d = 0; d < 3; ++d) {
    v[d] = Dual(value[d], Derivative::Zero());
    if (varies)
      v[d].derivatives()[first + d] = 1.0;
  }
  return v;
}

Vec3 value(const Dual3& v) { return {v[0].value(), v[1].value(), v[2].value()}; }
Vec2 value(const Dual2& v) { return {v[0].value(), v[1].value()}; }

Dual3 unit(const Dual3& v) {
  const Dual length = sqrt(v.dot(v));
  return v / length;
}

/// Axes of a place that moves.
struct DualAxes {
  Dual3 e1, e2, e3;

  DualAxes(const Dual3& a1, const Dual3& a2) : e1(unit(a1)), e2(Dual3()), e3(unit(a1.cross(a2))) {
    e2 = e3.cross(e1);
  }
  [[nodiscard]] Dual3 in_space(const Vec3& v) const { return v[0] * e1 + v[1] * e2 + v[2] * e3; }
};

/// The closest place with what the variables do to it: one step of Newton's method from the root
/// has the root's derivative.
struct DualFoot {
  Dual2 step; ///< of the coordinates of the place
  Dual3 position, a1, a2, normal;
  Dual gap;

  DualFoot(const SelfInput& at, const FaceFrame& frame) {
    const Dual3 point = variable(at.point, the_point);
    const Dual3 x = variable(frame.position, place);
    const Dual3 t1 = variable(frame.a1, tangent1);
    const Dual3 t2 = variable(frame.a2, tangent2, !at.plane);
    const Dual3 off = point - x;
    step = Dual2(Dual(0.0, Derivative::Zero()), Dual(0.0, Derivative::Zero()));
    const FreeDirections& free = at.foot.place.free;
    if (free.count > 0) {
      const Vec3 d = value(off);
      Eigen::Matrix2d J;
      const double mixed = -frame.a1.dot(frame.a2) + d.dot(frame.a12);
      J << -frame.a1.squaredNorm() + d.dot(frame.a11), mixed, mixed,
          -frame.a2.squaredNorm() + d.dot(frame.a22);
      Eigen::Matrix2d T = Eigen::Matrix2d::Identity();
      for (std::size_t i = 0; i < free.count; ++i)
        T.col(static_cast<Index>(i)) = free.along[i];
      const Dual2 r(off.dot(t1), off.dot(t2));
      if (free.count == 1) {
        const Vec2 t = T.col(0);
        const Dual along = -(t[0] * r[0] + t[1] * r[1]) / t.dot(J * t);
        step = Dual2(t[0] * along, t[1] * along);
      } else {
        const Eigen::Matrix2d inverse = -J.inverse();
        step = Dual2(inverse(0, 0) * r[0] + inverse(0, 1) * r[1],
                     inverse(1, 0) * r[0] + inverse(1, 1) * r[1]);
      }
      // Its value is rounding; only what the variables do to it counts.
      step[0].value() = 0.0;
      step[1].value() = 0.0;
    }
    position = x + t1 * step[0] + t2 * step[1];
    a1 = t1;
    a2 = t2;
    for (int i = 0; i < 3; ++i) {
      a1[i] += frame.a11[i] * step[0] + frame.a12[i] * step[1];
      if (!at.plane)
        a2[i] += frame.a12[i] * step[0] + frame.a22[i] * step[1];
    }
    normal = unit(a1.cross(a2));
    gap = normal.dot(Dual3(point - position));
  }
};

/// A vector turned into the plane normal to `to` by the smallest rotation. (C.4)
Dual3 turned(const Dual3& v, const Dual3& from, const Dual3& to) {
  const Dual c = Dual(1.0) + to.dot(from);
  if (!(c.value() > 0.0))
    return v;
  const Dual share = to.dot(v) / c;
  return v - (to + from) * share;
}

/// The shear of a point that touched when the increment began.
class Shear {
public:
  Shear(const SelfPoint& old, const SelfInput& at, const DualFoot& foot) {
    const FaceFrame before(FaceShapes(at.kind, old.xi), at.old_face, at.plane);
    const Dual3 point = variable(at.point, the_point);
    const Dual3 was = variable(before.position, old_place);
    const DualAxes axes(variable(before.a1, old_place + 3),
                        variable(before.a2, old_place + 6, !at.plane));
    e1_ = unit(foot.a1);
    e2_ = foot.normal.cross(e1_);
    const Dual3 way = point - was - axes.in_space(old.offset);
    path_ = in_plane(way);
    shear_ = in_plane(turned(axes.in_space(old.shear), axes.e3, foot.normal));
  }

  /// Adds the shear to the traction; isotropic friction cannot tell which axes it is given.
  void add(const Friction& friction,
           const SlipScheme& scheme,
           double stiffness,
           const SelfPoint& old,
           const SlipState& state,
           const Dual& pressure,
           Dual3& traction,
           Traction& law) const {
    const SlipStep step{value(shear_), value(path_), stiffness, old.history.limit, state};
    const SlipResult end = stick_slip(friction, scheme, step);
    Dual2 shear;
    for (int i = 0; i < 2; ++i) {
      shear[i] = Dual(end.shear[i], Derivative::Zero());
      for (int j = 0; j < 2; ++j)
        shear[i].derivatives() +=
            end.d_shear(i, j) * shear_[j].derivatives() + end.d_path(i, j) * path_[j].derivatives();
      shear[i].derivatives() += end.d_pressure[i] * pressure.derivatives();
    }
    traction += e1_ * shear[0] + e2_ * shear[1];
    law.status = end.status;
    law.shear = in_space(end.shear);
    law.slip = in_space(end.slip);
    law.turned = in_space(value(shear_));
    law.limit = end.limit;
  }
  [[nodiscard]] Vec3 path() const { return in_space(value(path_)); }

private:
  [[nodiscard]] Dual2 in_plane(const Dual3& v) const { return {e1_.dot(v), e2_.dot(v)}; }
  [[nodiscard]] Vec3 in_space(const Vec2& v) const { return v[0] * value(e1_) + v[1] * value(e2_); }

  Dual3 e1_, e2_;
  Dual2 path_, shear_;
};

} // namespace

SelfTraction self_traction(const Friction& friction,
                           const Penalty& penalty,
                           const SelfPoint& old,
                           const SelfInput& at,
                           const SlipScheme& scheme) {
  SelfTraction out;
  out.foot = at.foot;
  out.old_face = old.face;
  out.old_xi = old.xi;
  // As in contact with tools: what lay there and has not moved off resists being pressed in.
  const double gap = at.foot.gap + old.history.offset;
  const bool resting = old.closed() && gap <= at.rounding;
  if (!(at.carried - penalty.normal * gap > 0.0) && !resting)
    return out;
  const DualFoot foot(at, FaceFrame(FaceShapes(at.kind, at.foot.place.xi), at.face, at.plane));
  Dual pressure = Dual(at.carried - penalty.normal * old.history.offset, Derivative::Zero()) -
                  penalty.normal * foot.gap;
  pressure.value() = std::max(0.0, pressure.value());
  Dual3 traction = foot.normal * pressure;
  out.law.status = Status::slip;
  out.law.pressure = pressure.value();
  const SlipState state{pressure.value(), at.shear_yield, old.history.sliding, at.dt};
  out.law.limit = limit_at(friction, state, 0.0).shear;
  if (old.closed()) {
    const Shear shear(old, at, foot);
    if (out.law.limit == 0.0 && !friction.depends_on_slip()) {
      out.law.slip = shear.path();
    } else {
      const double stiffness =
          at.softening * (old.history.stiffness > 0.0 ? old.history.stiffness : penalty.tangent);
      shear.add(friction, scheme, stiffness, old, state, pressure, traction, out.law);
    }
  }
  out.law.traction = value(traction);
  for (int i = 0; i < 3; ++i)
    out.d_traction.row(i) = traction[i].derivatives().transpose();
  for (int i = 0; i < 2; ++i)
    out.d_place.row(i) = foot.step[i].derivatives().transpose();
  return out;
}

} // namespace billet::contact
