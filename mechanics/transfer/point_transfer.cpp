#include "mechanics/transfer/point_transfer.h"

#include "mechanics/bulk/element_rings.h"
#include "mechanics/elements/elements.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/transfer/local_fit.h"

#include <Eigen/LU>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

namespace billet::mechanics {

namespace {

/// Sizes of a field.
struct Shape {
  std::size_t components; ///< of a point, all quantities together
  Index per_element;      ///< points

  explicit Shape(const PointField& field)
      : components(
            static_cast<std::size_t>(std::accumulate(field.groups.begin(), field.groups.end(), 0))),
        per_element(static_cast<Index>(field.positions.size()) / field.mesh->n_elements()) {}
};

/// Points of elements, ascending.
void points_of(std::span<const Index> elements, Index per_element, std::vector<Index>& points) {
  points.clear();
  for (const Index e : elements)
    for (Index k = 0; k < per_element; ++k)
      points.push_back(e * per_element + k);
}

/// What one thread works with.
struct Scratch {
  explicit Scratch(int dim) : fit(dim) {}
  LocalFit fit;
  Index element = -1;        ///< whose surroundings were sought last
  std::vector<Index> points; ///< in them
};

/// Transfer by local fits; `nearest` takes no more of them than the nearest point.
TransferredField by_fits(const PointField& from,
                         std::span<const Vec3> points,
                         std::span<const MeshLocation> at,
                         bool nearest_only) {
  const Shape shape(from);
  const int dim = from.mesh->dimension();
  const ElementRings rings(*from.mesh);
  TransferredField to{std::vector<double>(points.size() * shape.components),
                      std::vector<Index>(points.size(), -1), std::vector<char>(points.size())};
  const auto transfer = [&](std::size_t i, Scratch& scratch) {
    if (scratch.element != at[i].element) {
      scratch.element = at[i].element;
      points_of(rings.first(at[i].element), shape.per_element, scratch.points);
      if (scratch.points.size() < LocalFit::enough(dim))
        points_of(rings.second(at[i].element), shape.per_element, scratch.points);
    }
    LocalFit& fit = scratch.fit;
    fit.set(points[i], scratch.points, from.positions);
    if (fit.coincides())
      to.coincident[i] = fit.nearest();
    if (!nearest_only)
      fit.weigh();
    std::size_t c = 0;
    for (const int size : from.groups) {
      const auto n = static_cast<std::size_t>(size);
      const std::span out(&to.values[i * shape.components + c], n);
      if (fit.evaluate(from.values.subspan(c), shape.components, out))
        to.limited[i] = 1;
      c += n;
    }
  };
  tbb::enumerable_thread_specific<Scratch> scratch([dim] { return Scratch(dim); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        transfer(i, scratch.local());
                    });
  return to;
}

/// Terms that as many points determine: all products of one coordinate each, or the linear ones.
template <int dim> Eigen::VectorXd terms(const RefPoint<dim>& xi, int n_points) {
  Eigen::VectorXd p = Eigen::VectorXd::Ones(n_points);
  for (int t = 1; t < n_points; ++t)
    for (int d = 0; d < dim; ++d)
      if (n_points == dim + 1 ? t == d + 1 : (t >> d & 1) != 0)
        p[t] *= xi[static_cast<std::size_t>(d)];
  return p;
}

/// Value at each node by the values at the points of an element, shape (nodes, points). (M.37)
Eigen::MatrixXd extrapolation(ElementKind kind, Index per_element) {
  return visit_element(kind, [&](auto element) -> Eigen::MatrixXd {
    using Element = decltype(element);
    constexpr int dim = Element::Shape::dim;
    constexpr int points = Element::Rule::points;
    if (per_element == 1)
      return Eigen::MatrixXd::Ones(Element::Shape::nodes, 1);
    assert(per_element == points);
    Eigen::MatrixXd at_points(points, points);
    for (int g = 0; g < points; ++g)
      at_points.row(g) = terms<dim>(Element::Rule::point(g), points);
    Eigen::MatrixXd at_nodes(Element::Shape::nodes, points);
    for (int a = 0; a < Element::Shape::nodes; ++a)
      at_nodes.row(a) = terms<dim>(Element::Shape::corners[static_cast<std::size_t>(a)], points);
    return at_nodes * at_points.inverse();
  });
}

/// Means at the nodes of what the elements around predict.
std::vector<double> nodal_means(const PointField& from, const Shape& shape) {
  const Eigen::MatrixXd E = extrapolation(from.mesh->kind, shape.per_element);
  const std::size_t n = shape.components;
  std::vector<double> sums(from.mesh->points.size() * n);
  std::vector<double> counts(from.mesh->points.size());
  for (Index e = 0; e < from.mesh->n_elements(); ++e) {
    const auto cell = from.mesh->cell(e);
    for (std::size_t a = 0; a < cell.size(); ++a) {
      counts[idx(cell[a])] += 1.0;
      for (Index k = 0; k < shape.per_element; ++k)
        for (std::size_t c = 0; c < n; ++c)
          sums[idx(cell[a]) * n + c] +=
              E(static_cast<Index>(a), k) * from.values[idx(e * shape.per_element + k) * n + c];
    }
  }
  for (std::size_t node = 0; node < counts.size(); ++node)
    for (std::size_t c = 0; c < n; ++c)
      sums[node * n + c] /= std::max(counts[node], 1.0);
  return sums;
}

TransferredField by_nodes(const PointField& from, std::span<const MeshLocation> at) {
  const Shape shape(from);
  const std::vector<double> nodal = nodal_means(from, shape);
  TransferredField to{std::vector<double>(at.size() * shape.components),
                      std::vector<Index>(at.size(), -1), std::vector<char>(at.size())};
  for (std::size_t i = 0; i < at.size(); ++i)
    interpolate(*from.mesh, at[i], nodal,
                std::span(to.values).subspan(i * shape.components, shape.components));
  return to;
}

} // namespace

TransferredField transfer_field(const PointField& from,
                                std::span<const Vec3> points,
                                std::span<const MeshLocation> at,
                                TransferMethod method) {
  return method == TransferMethod::nodal
             ? by_nodes(from, at)
             : by_fits(from, points, at, method == TransferMethod::nearest);
}

} // namespace billet::mechanics
