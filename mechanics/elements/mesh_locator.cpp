#include "mechanics/elements/mesh_locator.h"

#include "geometry/base/box.h"
#include "mechanics/elements/elements.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/LU>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace billet::mechanics {

namespace {

/// A box that holds the element: its nodes and, for curved edges, the middle one of the three
/// points whose hull holds a parabola.
Box element_box(const Mesh& mesh, std::span<const double> x, Index element) {
  const int dim = mesh.dimension();
  const auto cell = mesh.cell(element);
  Box box;
  for (const Index node : cell)
    box.add(node_position(x, dim, node));
  if (!is_quadratic(mesh.kind))
    return box;
  const auto edges = element_edges(mesh.kind);
  const auto corners = static_cast<std::size_t>(corners_per_element(mesh.kind));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Vec3 a = node_position(x, dim, cell[static_cast<std::size_t>(edges[e][0])]);
    const Vec3 b = node_position(x, dim, cell[static_cast<std::size_t>(edges[e][1])]);
    box.add(2.0 * node_position(x, dim, cell[corners + e]) - 0.5 * (a + b));
  }
  return box;
}

/// Planes `normal . xi <= bound` around the reference cell.
template <class Shape> struct ReferenceCell {
  static constexpr int dim = Shape::dim;
  static constexpr bool simplex =
      Shape::nodes == dim + 1 || Shape::nodes == (dim + 1) * (dim + 2) / 2;
  static constexpr int n_planes = simplex ? dim + 1 : 2 * dim;
  using Vector = Eigen::Matrix<double, dim, 1>;

  static Vector normal(int plane) {
    if (simplex && plane == dim)
      return Vector::Ones();
    return (simplex || plane >= dim ? -1.0 : 1.0) * Vector::Unit(plane % dim);
  }
  static double bound(int plane) { return simplex && plane < dim ? 0.0 : 1.0; }
  static Vector centre() { return Vector::Constant(simplex ? 1.0 / (dim + 1) : 0.0); }
};

/// The step from xi that minimises step . A step / 2 - g . step within the reference cell: planes
/// are taken in when a step crosses them, the farthest first, and let go when they pull.
template <class Shape>
typename ReferenceCell<Shape>::Vector
bounded_step(const Eigen::Matrix<double, Shape::dim, Shape::dim>& A,
             const Eigen::Matrix<double, Shape::dim, 1>& g,
             const Eigen::Matrix<double, Shape::dim, 1>& xi) {
  using Cell = ReferenceCell<Shape>;
  constexpr int dim = Shape::dim;
  constexpr double slack = 1e-14; // of natural coordinates
  std::array<int, dim> active{};
  int n_active = 0;
  typename Cell::Vector step = Cell::Vector::Zero();
  for (int turn = 0; turn < 4 * Cell::n_planes; ++turn) {
    Eigen::Matrix<double, 2 * dim, 2 * dim> M = Eigen::Matrix<double, 2 * dim, 2 * dim>::Identity();
    Eigen::Matrix<double, 2 * dim, 1> r = Eigen::Matrix<double, 2 * dim, 1>::Zero();
    M.template topLeftCorner<dim, dim>() = A;
    r.template head<dim>() = g;
    for (int k = 0; k < n_active; ++k) {
      const typename Cell::Vector n = Cell::normal(active[static_cast<std::size_t>(k)]);
      M.template block<dim, 1>(0, dim + k) = n;
      M.template block<1, dim>(dim + k, 0) = n.transpose();
      M(dim + k, dim + k) = 0.0;
      r[dim + k] = Cell::bound(active[static_cast<std::size_t>(k)]) - n.dot(xi);
    }
    const Eigen::Matrix<double, 2 * dim, 1> solution = M.partialPivLu().solve(r);
    step = solution.template head<dim>();
    int crossed = -1;
    double farthest = slack;
    for (int plane = 0; plane < Cell::n_planes; ++plane) {
      const double beyond = Cell::normal(plane).dot(xi + step) - Cell::bound(plane);
      if (beyond > farthest) {
        farthest = beyond;
        crossed = plane;
      }
    }
    if (crossed >= 0 && n_active < dim) {
      active[static_cast<std::size_t>(n_active++)] = crossed;
      continue;
    }
    int pulling = -1;
    double strongest = 0.0;
    for (int k = 0; k < n_active; ++k)
      if (solution[dim + k] < strongest) {
        strongest = solution[dim + k];
        pulling = k;
      }
    if (pulling < 0)
      break;
    active[static_cast<std::size_t>(pulling)] = active[static_cast<std::size_t>(--n_active)];
  }
  return step;
}

/// The place of an element nearest to a point, by Gauss and Newton's method. (M.33)
template <class Shape> struct NearestPlace {
  static constexpr int dim = Shape::dim;
  using Cell = ReferenceCell<Shape>;
  using Vector = Eigen::Matrix<double, dim, 1>;

  Eigen::Matrix<double, dim, Shape::nodes> nodes;
  Vector point;
  Vector xi = Cell::centre();
  double distance2 = 0.0;

  NearestPlace(const Mesh& mesh, std::span<const double> x, Index element, const Vec3& target)
      : point(target.head<dim>()) {
    int a = 0;
    for (const Index node : mesh.cell(element))
      nodes.col(a++) = Eigen::Map<const Vector>(&x[idx(node * dim)]);
    distance2 = offset(xi).squaredNorm();
  }

  /// Newton's method without bounds; true if it ends within the cell, give or take `slack`.
  bool find_inside(double slack) {
    constexpr int most = 10;
    for (int k = 0; k < most; ++k) {
      const Vector step = jacobian().inverse() * offset(xi);
      xi += step;
      if (!xi.allFinite() || xi.cwiseAbs().maxCoeff() > astray)
        return false;
      if (step.cwiseAbs().maxCoeff() < converged) {
        distance2 = offset(xi).squaredNorm();
        return inside(xi, slack);
      }
    }
    return false;
  }

  /// Gauss and Newton's method with steps that stay within the cell.
  void seek() {
    constexpr int most = 40;
    for (int k = 0; k < most; ++k) {
      const auto J = jacobian();
      const Vector d = offset(xi);
      Vector step = J.inverse() * d;
      if (!step.allFinite() || !inside(xi + step, 0.0))
        step = bounded_step<Shape>(J.transpose() * J / J.squaredNorm(),
                                   J.transpose() * d / J.squaredNorm(), xi);
      if (!step.allFinite() || !advance(step) || step.cwiseAbs().maxCoeff() < converged)
        return;
    }
  }

private:
  static constexpr double converged = 1e-8; // of natural coordinates; the next step is its square
  static constexpr double astray =
      10.0; // natural coordinates; such a point lies in another element

  static RefPoint<dim> reference(const Vector& at) {
    RefPoint<dim> place;
    std::copy(at.data(), at.data() + dim, place.begin());
    return place;
  }
  [[nodiscard]] Vector offset(const Vector& at) const {
    const auto N = Shape::values(reference(at));
    Vector d = point;
    for (int a = 0; a < Shape::nodes; ++a)
      d -= N[static_cast<std::size_t>(a)] * nodes.col(a);
    return d;
  }
  [[nodiscard]] Eigen::Matrix<double, dim, dim> jacobian() const {
    const auto dN = Shape::gradients(reference(xi));
    Eigen::Matrix<double, dim, dim> J = Eigen::Matrix<double, dim, dim>::Zero();
    for (int a = 0; a < Shape::nodes; ++a)
      for (int i = 0; i < dim; ++i)
        J.col(i) += dN[static_cast<std::size_t>(a)][static_cast<std::size_t>(i)] * nodes.col(a);
    return J;
  }
  [[nodiscard]] static bool inside(const Vector& at, double slack) {
    for (int plane = 0; plane < Cell::n_planes; ++plane)
      if (Cell::normal(plane).dot(at) > Cell::bound(plane) + slack)
        return false;
    return true;
  }

  /// Goes towards `step` as far as the distance shrinks; false when nothing is gained.
  bool advance(Vector step) {
    constexpr int halvings = 12;
    for (int k = 0; k < halvings; ++k, step *= 0.5) {
      const double next = offset(xi + step).squaredNorm();
      if (next < distance2) {
        xi += step;
        distance2 = next;
        return true;
      }
    }
    return false;
  }
};

} // namespace

MeshLocator::MeshLocator(const Mesh& mesh, std::span<const double> x) : mesh_(&mesh), x_(x) {
  std::vector<Box> boxes;
  boxes.reserve(idx(mesh.n_elements()));
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    boxes.push_back(element_box(mesh, x, e));
    sizes_.push_back(boxes.back().size());
  }
  tree_ = geometry::BoxTree(boxes);
}

MeshLocation MeshLocator::locate(const Vec3& point, double reach) const {
  return visit_element(mesh_->kind, [&](auto kind) {
    using Shape = typename decltype(kind)::Shape;
    MeshLocation best{.element = std::numeric_limits<Index>::max(),
                      .distance = std::numeric_limits<double>::infinity()};
    const auto take = [&](Index e, const NearestPlace<Shape>& place) {
      best.element = e;
      best.xi.template head<Shape::dim>() = place.xi;
      best.distance = std::sqrt(place.distance2);
    };
    constexpr double on_face = 1e-9; // of natural coordinates, and of an element's size
    tree_.walk(point, 0.0, [&](std::int32_t e) {
      NearestPlace<Shape> place(*mesh_, x_, e, point);
      if (e < best.element && place.find_inside(on_face))
        take(e, place);
      return 0.0;
    });
    if (std::isfinite(best.distance))
      return best;
    best.distance = reach;
    tree_.walk(point, reach * reach, [&](std::int32_t e) {
      NearestPlace<Shape> place(*mesh_, x_, e, point);
      place.seek();
      const double distance = std::sqrt(place.distance2);
      const double same = on_face * sizes_[idx(e)];
      if (distance < best.distance - same || (distance <= best.distance + same && e < best.element))
        take(e, place);
      const double left = best.distance + same;
      return left * left;
    });
    if (best.element == std::numeric_limits<Index>::max())
      best = {.element = -1, .distance = std::numeric_limits<double>::infinity()};
    return best;
  });
}

std::vector<MeshLocation> MeshLocator::locate(std::span<const Vec3> points, double reach) const {
  std::vector<MeshLocation> places(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        places[i] = locate(points[i], reach);
                    });
  return places;
}

void interpolate(const Mesh& mesh,
                 const MeshLocation& at,
                 std::span<const double> nodal,
                 std::span<double> out) {
  visit_element(mesh.kind, [&](auto kind) {
    using Shape = typename decltype(kind)::Shape;
    RefPoint<Shape::dim> xi;
    std::copy(at.xi.data(), at.xi.data() + Shape::dim, xi.begin());
    const auto N = Shape::values(xi);
    const auto cell = mesh.cell(at.element);
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t a = 0; a < N.size(); ++a)
      for (std::size_t c = 0; c < out.size(); ++c)
        out[c] += N[a] * nodal[idx(cell[a]) * out.size() + c];
  });
}

std::vector<Vec3> integration_points(const Mesh& mesh, std::span<const double> x) {
  return visit_element(mesh.kind, [&](auto kind) {
    using Element = decltype(kind);
    std::vector<Vec3> places;
    places.reserve(idx(mesh.n_elements()) * Element::Rule::points);
    for (Index e = 0; e < mesh.n_elements(); ++e)
      for (int g = 0; g < Element::Rule::points; ++g) {
        const auto N = Element::Shape::values(Element::Rule::point(g));
        Vec3 p = Vec3::Zero();
        for (std::size_t a = 0; a < N.size(); ++a)
          p += N[a] * node_position(x, Element::Shape::dim, mesh.cell(e)[a]);
        places.push_back(p);
      }
    return places;
  });
}

} // namespace billet::mechanics
