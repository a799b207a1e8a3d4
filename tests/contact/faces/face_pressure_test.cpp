// The pressures of a face's points from their gaps. (C.45)

#include "contact/faces/face_pressure.h"

#include <gtest/gtest.h>

#include <random>

namespace billet::contact::face_pressure_test {
namespace {

PointValues values(std::initializer_list<double> list) {
  PointValues out(static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const double value : list)
    out[i++] = value;
  return out;
}

FaceCompliance some_face() {
  FaceCompliance face;
  face.mean = 1e6;
  face.deviation = 2e4;
  face.weights = values({0.2, 0.3, 0.1, 0.4});
  face.rise = values({50.0, -20.0, 60.0, -25.0});
  return face;
}

PointValues random_gaps(std::mt19937& generator, double mean) {
  std::normal_distribution<double> gap(mean, 0.01);
  PointValues gaps(4);
  for (double& value : gaps)
    value = gap(generator);
  return gaps;
}

TEST(FacePressure, IsStiffAgainstTheMeanAndSoftAgainstDeviations) {
  const FaceCompliance face = some_face();
  const PointValues even = PointValues::Constant(4, -1e-3);
  const FacePressure pressed = face_pressure(face, even);
  EXPECT_NEAR((pressed.pressure - face.rise).minCoeff(), 1000.0, 1e-9);
  EXPECT_NEAR((pressed.pressure - face.rise).maxCoeff(), 1000.0, 1e-9);
  const PointValues off = values({3e-3, -2e-3, 4e-3, -1e-3}); // no mean
  ASSERT_NEAR(off.dot(face.weights), 0.0, 1e-15);
  const PointValues change = face_pressure(face, even + off).pressure - pressed.pressure;
  EXPECT_LT((change + face.deviation * off).lpNorm<Eigen::Infinity>(), 1e-9);
}

// What is found is the one solution of p >= 0, s >= 0, p s = 0 with s = gap + compliance * p.
TEST(FacePressure, LeavesNoPointPressedInAndNonePulling) {
  const FaceCompliance face = some_face();
  std::mt19937 generator(1);
  int partly = 0;
  for (int i = 0; i < 2000; ++i) {
    const PointValues gaps = random_gaps(generator, 0.005);
    const PointValues p = face_pressure(face, gaps).pressure;
    const double mean = p.dot(face.weights);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const double s = gaps[k] + mean / face.mean + (p[k] - mean - face.rise[k]) / face.deviation;
      EXPECT_GE(p[k], 0.0);
      EXPECT_GT(s, -1e-12);
      EXPECT_LT(p[k] * s, 1e-9);
    }
    partly += p.minCoeff() == 0.0 && p.maxCoeff() > 0.0 ? 1 : 0;
  }
  EXPECT_GT(partly, 500);
}

TEST(FacePressure, HasTheDerivativeOfDifferencesAndIsSymmetric) {
  FaceCompliance face = some_face();
  face.multiplier = 30.0;
  std::mt19937 generator(2);
  constexpr double h = 1e-7;
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const PointValues gaps = random_gaps(generator, 0.0);
    const FacePressure at = face_pressure(face, gaps);
    const PointMatrix weighted = face.weights.asDiagonal() * at.d_gap;
    EXPECT_LT((weighted - weighted.transpose()).norm(), 1e-9 * (1.0 + weighted.norm()));
    for (Eigen::Index j = 0; j < 4; ++j) {
      const PointValues step = h * PointValues::Unit(4, j);
      const PointValues above = face_pressure(face, gaps + step).pressure;
      const PointValues below = face_pressure(face, gaps - step).pressure;
      if (((above.array() > 0.0) != (below.array() > 0.0)).any())
        continue;
      ++checked;
      const PointValues slope = (above - below) / (2.0 * h);
      EXPECT_LT((slope - at.d_gap.col(j)).norm(), 1e-6 * face.mean);
    }
  }
  EXPECT_GT(checked, 1500);
}

TEST(FacePressure, OfPointsThatAreKeptMayPull) {
  const FaceCompliance face = some_face();
  const PointValues apart = values({1e-3, 2e-3, 1e-3, 1e-3});
  EXPECT_EQ(face_pressure(face, PointValues::Constant(4, 1.0)).pressure.norm(), 0.0);
  const PointValues p = face_pressure(face, apart, true).pressure;
  EXPECT_NEAR(p.dot(face.weights), -face.mean * apart.dot(face.weights), 1e-9);
}

} // namespace
} // namespace billet::contact::face_pressure_test
