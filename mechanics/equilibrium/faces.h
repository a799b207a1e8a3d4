// Faces of elements: the lines, quadrilaterals and triangles on which loads and contact act.
//
// A face's area vector a = n dA / dxi points out of the body and grows with the area; its length
// and derivative carry follower loads and contact into the tangent. In axisymmetry the measure
// includes the full turn. Theory: docs/theory/mechanics.md (M.15), docs/theory/contact.md (C.3).

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/elements/shapes.h"
#include "mechanics/equilibrium/force_term.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/numerics/quadrature.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace billet::mechanics {

/// Calls `visitor` with the face shape of an element kind.
template <class Visitor> decltype(auto) visit_face(ElementKind kind, Visitor&& visitor) {
  switch (kind) {
  case ElementKind::quad4:
    return visitor(Line2{});
  case ElementKind::quad8:
  case ElementKind::tri6:
    return visitor(Line3{});
  case ElementKind::hex8:
    return visitor(Quad4{});
  case ElementKind::hex20:
    return visitor(Quad8{});
  case ElementKind::tet4:
    return visitor(Tri3{});
  case ElementKind::tet10:
    return visitor(Tri6{});
  }
  throw std::logic_error("element kind without faces");
}

/// Rules of a face. `Full` is exact for the products of two shape functions on a flat face and for
/// a uniform pressure on a curved one; `Lower` has as many points as a stress of one order less has
/// terms, 2 along a line.
template <class Shape> struct FaceRules {
  using Full = GaussRule<Shape::dim, 3>;
  using Lower = GaussRule<Shape::dim, 2>;
};
template <> struct FaceRules<Tri3> {
  using Full = SimplexRule<2, 3>;
  using Lower = SimplexRule<2, 3>;
};
template <> struct FaceRules<Tri6> {
  using Full = SimplexRule<2, 6>;
  using Lower = SimplexRule<2, 3>;
};

/// Position, area and their derivatives at a point of a face.
template <class Shape> struct FacePoint {
  static constexpr std::size_t nodes = Shape::nodes;

  ShapeValues<Shape::nodes> N;
  Vec3 position = Vec3::Zero();            ///< [mm]
  Vec3 area = Vec3::Zero();                ///< outward area vector times weight [mm^2]
  double measure = 0.0;                    ///< its length
  std::array<Vec3, Shape::nodes> dmeasure; ///< d measure / d position of each node
  ShapeGradients<Shape::nodes, Shape::dim> dN;
  std::array<Vec3, 2> tangents{Vec3::Zero(), Vec3::Zero()}; ///< d position / d xi
  double turn = 1.0;                                        ///< 2 pi r in axisymmetry

  /// @param x  positions of the face's nodes, shape (nodes, dim + 1) row by row [mm]
  FacePoint(Analysis analysis, const double* x, const RefPoint<Shape::dim>& xi, double weight)
      : N(Shape::values(xi)), dN(Shape::gradients(xi)) {
    constexpr std::size_t space = Shape::dim + 1;
    for (std::size_t a = 0; a < nodes; ++a) {
      Vec3 node = Vec3::Zero();
      for (std::size_t i = 0; i < space; ++i)
        node[static_cast<Eigen::Index>(i)] = x[a * space + i];
      position += N[a] * node;
      for (std::size_t d = 0; d < Shape::dim; ++d)
        tangents[d] += dN[a][d] * node;
    }
    if constexpr (Shape::dim == 1)
      set_line(analysis, weight);
    else
      set_surface(weight);
  }

private:
  void set_line(Analysis analysis, double weight) {
    const Vec3& t = tangents[0];
    const double length = t.norm();
    const bool axisymmetric = analysis == Analysis::axisymmetric;
    turn = axisymmetric ? 2.0 * std::numbers::pi * position[0] : 1.0;
    area = Vec3(t[1], -t[0], 0.0) * turn * weight;
    measure = length * turn * weight;
    for (std::size_t a = 0; a < nodes; ++a) {
      dmeasure[a] = dN[a][0] * turn * weight / length * t;
      if (axisymmetric)
        dmeasure[a][0] += 2.0 * std::numbers::pi * N[a] * length * weight;
    }
  }
  void set_surface(double weight) {
    const Vec3 cross = tangents[0].cross(tangents[1]);
    const double length = cross.norm();
    const Vec3 unit = cross / length;
    area = cross * weight;
    measure = length * weight;
    const Vec3 along0 = tangents[1].cross(unit) * weight;
    const Vec3 along1 = unit.cross(tangents[0]) * weight;
    for (std::size_t a = 0; a < nodes; ++a)
      dmeasure[a] = dN[a][0] * along0 + dN[a][1] * along1;
  }
};

} // namespace billet::mechanics
