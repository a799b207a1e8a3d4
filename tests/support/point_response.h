// What a law answers at single points, read out of its batches.

#pragma once

#include "mechanics/materials/j2_hencky.h"
#include "mechanics/numerics/spectral.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::support {

/// mechanics::DeviatoricResponse of one point.
struct PointResponse {
  mechanics::Spectral predictor;
  double log_J;
  Vec3 s;
  Mat3 deviator;
  Mat3 normal_moduli;
  Vec3 shear_moduli;
  mechanics::PointState state;
  double plastic_increment;
};

inline PointResponse point_of(const mechanics::DeviatoricResponse& batch, int l) {
  const auto vector = [l](const mechanics::PrincipalPack& v) {
    return Vec3(v[0][l], v[1][l], v[2][l]);
  };
  PointResponse at;
  at.predictor.values = vector(batch.predictor.values);
  for (int i = 0; i < 3; ++i) {
    at.predictor.vectors.col(i) = vector(batch.predictor.vectors[static_cast<std::size_t>(i)]);
    at.normal_moduli.row(i) = vector(batch.normal_moduli[static_cast<std::size_t>(i)]);
  }
  at.log_J = batch.log_J[l];
  at.s = vector(batch.s);
  for (std::size_t k = 0; k < mechanics::tensor_components.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(mechanics::tensor_components[k][0]);
    const auto j = static_cast<Eigen::Index>(mechanics::tensor_components[k][1]);
    at.deviator(i, j) = at.deviator(j, i) = batch.deviator[k][l];
  }
  at.shear_moduli = vector(batch.shear_moduli);
  batch.put_state(l, at.state);
  at.plastic_increment = batch.plastic_increment[static_cast<std::size_t>(l)];
  return at;
}

/// Length of an increment [s].
struct Length {
  double dt;
};

/// mechanics::update for points given one by one.
inline bool update(const mechanics::Material& material,
                   std::span<const Mat3> b_pred,
                   std::span<const mechanics::PointState> old,
                   bool planar,
                   const Length& increment,
                   std::span<PointResponse> out) {
  constexpr int most = mechanics::points_at_once;
  for (std::size_t first = 0; first < b_pred.size(); first += most) {
    const std::size_t n = std::min<std::size_t>(most, b_pred.size() - first);
    mechanics::TensorPack predictors;
    for (std::size_t c = 0; c < mechanics::tensor_components.size(); ++c)
      predictors[c] = mechanics::PointPack::of([&](int l) {
        const Mat3& b = b_pred[first + std::min(static_cast<std::size_t>(l), n - 1)];
        return b(static_cast<Eigen::Index>(mechanics::tensor_components[c][0]),
                 static_cast<Eigen::Index>(mechanics::tensor_components[c][1]));
      });
    mechanics::PointsBefore before{static_cast<int>(n), increment.dt, {}, {}};
    for (std::size_t l = 0; l < n; ++l)
      before.plastic_strain[l] = old[first + l].plastic_strain;
    before.temperature.fill(material.temperature);
    mechanics::DeviatoricResponse response;
    if (!mechanics::update(material, predictors, before, planar, response))
      return false;
    for (std::size_t l = 0; l < n; ++l)
      out[first + l] = point_of(response, static_cast<int>(l));
  }
  return true;
}

} // namespace billet::support
