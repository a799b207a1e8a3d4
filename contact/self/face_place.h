// A place on a face of the workpiece that moves: where it is, its tangents, and the closest place
// of a face to a point.
//
// In the plane a face is a line and its second tangent is the normal of the plane, so that the
// outward normal is a1 x a2 everywhere.
//
// Units   lengths in mm. Theory: docs/theory/contact.md (C.50).

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/base/vector.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::contact {

/// Shape functions of a face at a place, with first and second derivatives by its coordinates.
struct FaceShapes {
  static constexpr std::size_t most = 8;
  using Values = std::array<double, most>;

  std::size_t nodes = 0;
  Values N{}, d1{}, d2{}, d11{}, d12{}, d22{};

  FaceShapes(mechanics::ElementKind kind, const Vec2& xi);

  [[nodiscard]] Vec3 sum(const Values& weights, std::span<const Vec3> at) const {
    Vec3 result = Vec3::Zero();
    for (std::size_t a = 0; a < nodes; ++a)
      result += weights[a] * at[a];
    return result;
  }
};

/// A face at a place: position, tangents and their derivatives.
struct FaceFrame {
  Vec3 position, a1, a2; ///< [mm]
  Vec3 a11, a12, a22;    ///< [mm]

  /// @param x  positions of the face's nodes [mm]
  FaceFrame(const FaceShapes& shapes, std::span<const Vec3> x, bool plane);

  [[nodiscard]] Vec3 normal() const { return a1.cross(a2).normalized(); }
  /// Columns: along the first tangent, in the face across it, normal.
  [[nodiscard]] Mat3 axes() const;
};

/// Directions of the reference face in which a place may move.
struct FreeDirections {
  std::array<Vec2, 2> along{Vec2::Zero(), Vec2::Zero()};
  std::size_t count = 0; ///< 0: at a corner
};

/// The closest place of a face to a point.
struct ClosestPlace {
  Vec2 xi = Vec2::Zero();
  FreeDirections free; ///< in the middle of the face all, on its border along it
};

/// @param x  positions of the face's nodes [mm]
[[nodiscard]] ClosestPlace
closest_place(mechanics::ElementKind kind, std::span<const Vec3> x, const Vec3& point);

/// Positions of the nodes of a face.
///
/// @param x  shape (n_dofs) [mm]
[[nodiscard]] std::vector<Vec3>
nodes_of_face(const ContactSurface& surface, std::span<const double> x, Index face);

} // namespace billet::contact
