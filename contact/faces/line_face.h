// A face of a plane scene as a curve, with what differentiating its closest place takes.

#pragma once

#include "contact/surface/contact_surface.h"
#include "mechanics/elements/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace billet::contact {

/// Calls `visitor(shape)` with the face shape of an element kind of the plane, not with others.
template <class Visitor> void visit_line(mechanics::ElementKind kind, Visitor&& visitor) {
  mechanics::visit_face(kind, [&](auto shape) {
    if constexpr (decltype(shape)::dim == 1)
      visitor(shape);
  });
}

/// A coordinate of a line: shape functions there, their first and second derivatives.
template <class Shape> struct OnLine {
  double xi;
  mechanics::ShapeValues<Shape::nodes> N, dN, ddN;

  explicit OnLine(double at) : xi(at), N(Shape::values({at})) {
    const auto slopes = Shape::gradients({at}), slopes_at_end = Shape::gradients({at + 1.0});
    for (std::size_t a = 0; a < N.size(); ++a) {
      dN[a] = slopes[a][0];
      ddN[a] = slopes_at_end[a][0] - slopes[a][0]; // they are linear
    }
  }
  /// Sum of vectors at the nodes, of any scalar.
  template <class Nodes>
  [[nodiscard]] auto sum(const mechanics::ShapeValues<Shape::nodes>& weights,
                         const Nodes& nodes) const {
    typename Nodes::value_type result = weights[0] * nodes[0];
    for (std::size_t a = 1; a < weights.size(); ++a)
      result += weights[a] * nodes[a];
    return result;
  }
};

template <class Shape> using LineNodes = std::array<Vec2, Shape::nodes>;

/// Positions of the nodes of a face in the plane.
///
/// @param x  shape (n_dofs) [mm]
template <class Shape>
[[nodiscard]] LineNodes<Shape>
line_nodes(const ContactSurface& surface, std::span<const double> x, Index face) {
  LineNodes<Shape> nodes;
  const auto numbers = surface.scatter().nodes(face);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    nodes[a] = {x[idx(2 * numbers[a])], x[idx(2 * numbers[a] + 1)]};
  return nodes;
}

/// The coordinate of the closest place of a line, in [-1, 1].
template <class Shape>
[[nodiscard]] double foot_on_line(const LineNodes<Shape>& nodes, const Vec2& place) {
  constexpr int max_steps = 20;
  constexpr double beyond = 1.5; // where a curve may be followed to
  constexpr double still = 1e-14;
  const Vec2 chord = nodes[1] - nodes[0];
  double xi = 2.0 * (place - nodes[0]).dot(chord) / chord.squaredNorm() - 1.0;
  for (int step = 0; Shape::nodes > 2 && step < max_steps; ++step) {
    const OnLine<Shape> at(std::clamp(xi, -beyond, beyond));
    const Vec2 off = place - at.sum(at.N, nodes), t = at.sum(at.dN, nodes);
    const double slope = off.dot(at.sum(at.ddN, nodes)) - t.squaredNorm();
    if (!(slope < 0.0))
      break;
    xi = at.xi - off.dot(t) / slope;
    if (std::abs(xi - at.xi) < still)
      break;
  }
  return std::clamp(xi, -1.0, 1.0);
}

} // namespace billet::contact
