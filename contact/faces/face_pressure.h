// The pressures of the points of one face from their gaps, where a face has more points than nodes
// can follow: stiff against their mean gap, soft against what single points differ by. (C.45)
//
// Theory  docs/theory/contact.md.

#pragma once

#include <Eigen/Core>

namespace billet::contact {

using PointValues = Eigen::VectorXd; ///< one a point
using PointMatrix = Eigen::MatrixXd;

/// What a face answers to the gaps of its points with.
struct FaceCompliance {
  double mean = 0.0;       ///< stiffness against the mean gap [MPa/mm]
  double deviation = 0.0;  ///< against what gaps differ from it by, below `mean` [MPa/mm]
  PointValues weights;     ///< shares of the points in the face's area, their sum is 1 [-]
  PointValues rise;        ///< pressure above the mean that asks for no gap; no mean [MPa]
  double multiplier = 0.0; ///< mean pressure that needs no penetration (C.20) [MPa]

  template <class Archive> void fields(Archive& archive) {
    archive(mean, deviation, weights, rise, multiplier);
  }
};

/// Pressures of a face's points and how they change with each other's gaps.
struct FacePressure {
  PointValues pressure; ///< [MPa]
  PointMatrix d_gap;    ///< d pressure_i / d gap_j [MPa/mm]

  template <class Archive> void fields(Archive& archive) { archive(pressure, d_gap); }
};

/// The pressures p >= 0 that with their gaps leave no point pressed in: the compliance is symmetric
/// and positive definite, so there is one answer, continuous in the gaps. (C.45)
///
/// @param gaps   of the points [mm]
/// @param pulls  points that pull are kept (C.15)
[[nodiscard]] FacePressure
face_pressure(const FaceCompliance& face, const PointValues& gaps, bool pulls = false);

} // namespace billet::contact
