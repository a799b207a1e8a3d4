// Takes a material point through prescribed deformations or uniaxial stress.
//
// The stress is the whole Kirchhoff stress: the deviator of the law and kappa ln J.

#pragma once

#include "mechanics/materials/j2_hencky.h"
#include "tests/support/point_response.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace billet::support {

/// A point with its history; F is the total deformation gradient reached.
class PointDriver {
public:
  explicit PointDriver(mechanics::Material material, bool planar = false)
      : material_(std::move(material)), planar_(planar) {}

  /// Length of the increments to come [s].
  void set_dt(double dt) { dt_ = dt; }

  /// Response to an increment f on top of the committed state.
  [[nodiscard]] PointResponse response(const Mat3& f) const {
    Mat3 b = f * state_.b_e * f.transpose();
    b = 0.5 * (b + b.transpose()).eval();
    PointResponse out;
    EXPECT_TRUE(update(material_, {&b, 1}, {&state_, 1}, planar_, {dt_}, {&out, 1}));
    return out;
  }
  /// Kirchhoff stress of a response [MPa].
  [[nodiscard]] Mat3 kirchhoff(const PointResponse& at) const {
    const Mat3& n = at.predictor.vectors;
    const Mat3 s = n * at.s.asDiagonal() * n.transpose();
    return s + material_.elasticity.bulk() * at.log_J * Mat3::Identity();
  }
  /// Goes to a deformation gradient in one increment and stays there.
  void go(const Mat3& F) {
    const auto at = response(F * F_.inverse());
    state_ = at.state;
    tau_ = kirchhoff(at);
    F_ = F;
  }
  /// Goes to an axial logarithmic strain (axis x) with free sides.
  void go_uniaxial(double strain) {
    const double axial = std::exp(strain) / F_(0, 0);
    const auto lateral_stress = [&](double lateral) {
      const auto at = response(Vec3(axial, std::exp(lateral), std::exp(lateral)).asDiagonal());
      return kirchhoff(at)(1, 1);
    };
    // The stress on the sides grows with the lateral strain: bisection to rounding.
    double low = -1.0 - std::abs(strain);
    double high = -low;
    for (int i = 0; i < 200 && high - low > 1e-17; ++i) {
      const double middle = 0.5 * (low + high);
      (lateral_stress(middle) < 0.0 ? low : high) = middle;
    }
    const double lateral = std::exp(0.5 * (low + high)) * F_(1, 1);
    go(Vec3(std::exp(strain), lateral, lateral).asDiagonal());
  }

  [[nodiscard]] const mechanics::PointState& state() const { return state_; }
  [[nodiscard]] const Mat3& F() const { return F_; }
  [[nodiscard]] const Mat3& tau() const { return tau_; }
  [[nodiscard]] Mat3 sigma() const { return tau_ / F_.determinant(); }

private:
  mechanics::Material material_;
  bool planar_;
  double dt_ = 1.0;
  mechanics::PointState state_;
  Mat3 F_ = Mat3::Identity();
  Mat3 tau_ = Mat3::Zero();
};

} // namespace billet::support
