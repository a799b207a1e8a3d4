#include "contact/self/face_place.h"

#include "mechanics/equilibrium/faces.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace billet::contact {

namespace {

/// A reference face: its corners in turn; a line has two.
struct ReferenceFace {
  std::array<Vec2, 4> corners;
  std::size_t n_corners;

  [[nodiscard]] bool line() const { return n_corners == 2; }
  [[nodiscard]] Vec2 middle() const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < n_corners; ++i)
      sum += corners[i];
    return sum / static_cast<double>(n_corners);
  }
  [[nodiscard]] bool holds(const Vec2& xi) const {
    if (n_corners == 3)
      return xi.minCoeff() >= 0.0 && xi.sum() <= 1.0;
    return xi.cwiseAbs().maxCoeff() <= 1.0;
  }
};

ReferenceFace reference_face(mechanics::ElementKind kind) {
  return mechanics::visit_face(kind, [](auto shape) -> ReferenceFace {
    using Shape = decltype(shape);
    if constexpr (Shape::dim == 1)
      return {{Vec2(-1, 0), Vec2(1, 0), Vec2::Zero(), Vec2::Zero()}, 2};
    else if constexpr (is_triangle<Shape>)
      return {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2::Zero()}, 3};
    else
      return {{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}, 4};
  });
}

constexpr int max_steps = 20;
constexpr double still = 1e-14;

/// Half the squared distance to a point over the coordinates of a face.
class Distance {
public:
  Distance(mechanics::ElementKind kind, std::span<const Vec3> x, const Vec3& point)
      : kind_(kind), x_(x), point_(point), face_(reference_face(kind)) {}

  [[nodiscard]] const ReferenceFace& face() const { return face_; }
  [[nodiscard]] double at(const Vec2& xi) const {
    const FaceShapes shapes(kind_, xi);
    return 0.5 * (shapes.sum(shapes.N, x_) - point_).squaredNorm();
  }
  /// The place in the middle of the face where the distance is stationary, if Newton's method finds
  /// one.
  [[nodiscard]] std::optional<Vec2> within() const {
    Vec2 xi = face_.middle();
    for (int step = 0; step < max_steps; ++step) {
      const auto [slope, curvature] = derivatives(xi);
      const double det = curvature.determinant();
      if (!(det > 0.0) || !(curvature(0, 0) > 0.0))
        return std::nullopt;
      const Vec2 move = -curvature.inverse() * slope;
      constexpr double farthest = 1.0; // in a step: beyond it a curved face is another one
      xi += move * std::min(1.0, farthest / std::max(farthest, move.norm()));
      if (move.norm() < still)
        break;
    }
    return face_.holds(xi) ? std::optional(xi) : std::nullopt;
  }
  /// The closest place of one side, as the share of the way along it.
  [[nodiscard]] double along(const Vec2& from, const Vec2& to) const {
    const Vec2 way = to - from;
    double best = 0.0;
    double least = at(from);
    constexpr int pieces = 2; // a side is straight or an arc
    for (int piece = 0; piece <= pieces; ++piece) {
      double s = static_cast<double>(piece) / pieces;
      for (int step = 0; step < max_steps; ++step) {
        const auto [slope, curvature] = derivatives(from + s * way);
        const double bend = way.dot(curvature * way);
        if (!(bend > 0.0))
          break;
        const double next = std::clamp(s - slope.dot(way) / bend, 0.0, 1.0);
        const bool done = std::abs(next - s) < still;
        s = next;
        if (done)
          break;
      }
      if (const double there = at(from + s * way); there < least) {
        least = there;
        best = s;
      }
    }
    return best;
  }

private:
  struct Derivatives {
    Vec2 slope;
    Eigen::Matrix2d curvature;
  };
  [[nodiscard]] Derivatives derivatives(const Vec2& xi) const {
    const FaceShapes shapes(kind_, xi);
    const FaceFrame at(shapes, x_, false);
    const Vec3 off = at.position - point_;
    Derivatives d;
    d.slope = {off.dot(at.a1), off.dot(at.a2)};
    const double mixed = at.a1.dot(at.a2) + off.dot(at.a12);
    d.curvature << at.a1.squaredNorm() + off.dot(at.a11), mixed, mixed,
        at.a2.squaredNorm() + off.dot(at.a22);
    return d;
  }

  mechanics::ElementKind kind_;
  std::span<const Vec3> x_;
  Vec3 point_;
  ReferenceFace face_;
};

} // namespace

FaceShapes::FaceShapes(mechanics::ElementKind kind, const Vec2& xi) {
  mechanics::visit_face(kind, [&](auto shape) {
    using Shape = decltype(shape);
    nodes = Shape::nodes;
    constexpr double h = 0.5; // gradients are quadratic at most: differences of them are exact
    const auto gradients = [](const Vec2& at) {
      if constexpr (Shape::dim == 1)
        return Shape::gradients({at[0]});
      else
        return Shape::gradients({at[0], at[1]});
    };
    const auto difference = [&](const Vec2& way) {
      auto ahead = gradients(xi + h * way);
      const auto behind = gradients(xi - h * way);
      for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t d = 0; d < Shape::dim; ++d)
          ahead[a][d] -= behind[a][d];
      return ahead;
    };
    const auto slopes = gradients(xi);
    const auto along1 = difference(Vec2(1.0, 0.0));
    if constexpr (Shape::dim == 1) {
      const auto values = Shape::values({xi[0]});
      for (std::size_t a = 0; a < nodes; ++a) {
        N[a] = values[a];
        d1[a] = slopes[a][0];
        d11[a] = along1[a][0];
      }
    } else {
      const auto values = Shape::values({xi[0], xi[1]});
      const auto along2 = difference(Vec2(0.0, 1.0));
      for (std::size_t a = 0; a < nodes; ++a) {
        N[a] = values[a];
        d1[a] = slopes[a][0];
        d2[a] = slopes[a][1];
        d11[a] = along1[a][0];
        d12[a] = along1[a][1];
        d22[a] = along2[a][1];
      }
    }
  });
}

FaceFrame::FaceFrame(const FaceShapes& shapes, std::span<const Vec3> x, bool plane)
    : position(shapes.sum(shapes.N, x)), a1(shapes.sum(shapes.d1, x)),
      a2(plane ? Vec3(Vec3::UnitZ()) : shapes.sum(shapes.d2, x)), a11(shapes.sum(shapes.d11, x)),
      a12(shapes.sum(shapes.d12, x)), a22(shapes.sum(shapes.d22, x)) {}

Mat3 FaceFrame::axes() const {
  Mat3 axes;
  axes.col(0) = a1.normalized();
  axes.col(2) = normal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

ClosestPlace
closest_place(mechanics::ElementKind kind, std::span<const Vec3> x, const Vec3& point) {
  const Distance distance(kind, x, point);
  const ReferenceFace& face = distance.face();
  if (face.line()) {
    const Vec2 from = face.corners[0], to = face.corners[1];
    const double s = distance.along(from, to);
    ClosestPlace place{from + s * (to - from), {}};
    if (s > 0.0 && s < 1.0)
      place.free = {{Vec2(1.0, 0.0), Vec2::Zero()}, 1};
    return place;
  }
  if (const std::optional<Vec2> within = distance.within())
    return {*within, {{Vec2(1.0, 0.0), Vec2(0.0, 1.0)}, 2}};
  ClosestPlace best;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < face.n_corners; ++i) {
    const Vec2 from = face.corners[i], to = face.corners[(i + 1) % face.n_corners];
    const double s = distance.along(from, to);
    const Vec2 xi = from + s * (to - from);
    if (const double there = distance.at(xi); there < least) {
      least = there;
      best.xi = xi;
      best.free = {};
      if (s > 0.0 && s < 1.0)
        best.free = {{to - from, Vec2::Zero()}, 1};
    }
  }
  return best;
}

std::vector<Vec3>
nodes_of_face(const ContactSurface& surface, std::span<const double> x, Index face) {
  const std::span<const Index> numbers = surface.scatter().nodes(face);
  const std::size_t dim = surface.analysis() == mechanics::Analysis::solid ? 3 : 2;
  std::vector<Vec3> nodes(numbers.size(), Vec3::Zero());
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t d = 0; d < dim; ++d)
      nodes[a][static_cast<Index>(d)] = x[idx(numbers[a]) * dim + d];
  return nodes;
}

} // namespace billet::contact
