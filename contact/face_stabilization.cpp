#include "contact/face_stabilization.h"

#include "contact/fading.h"
#include "mechanics/elements/faces.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace billet::contact {

namespace {

using geometry::Projection;
using mechanics::FacePoint;

template <class Shape> using Mixed = typename mechanics::FaceRules<Shape>::Lower;
template <class Shape> using Full = typename mechanics::FaceRules<Shape>::Full;

/// Terms of a stress of one order less than the displacement, as many as its rule has points: 1,
/// xi, eta, xi eta.
template <class Rule, std::size_t dim>
Eigen::Matrix<double, 1, Rule::points> stress_terms(const std::array<double, dim>& xi) {
  Eigen::Matrix<double, 1, Rule::points> terms;
  terms.setOnes();
  for (int j = 0; j < Rule::points; ++j)
    for (std::size_t d = 0; d < dim; ++d)
      if ((j >> d & 1) != 0)
        terms[j] *= xi[d];
  return terms;
}

/// A field at the places of the full rule, less what a stress field's order makes of its values at
/// the points of the mixed form.
template <class Shape> struct Rest {
  using OfPoints = Eigen::Matrix<double, Full<Shape>::points, Mixed<Shape>::points>;
  OfPoints points; ///< what those make of it
  std::array<mechanics::ShapeValues<Shape::nodes>, Full<Shape>::points> nodes; ///< the rest
};

template <class Shape> const Rest<Shape>& rest_of() {
  static const Rest<Shape> rest = [] {
    Rest<Shape> made;
    Eigen::Matrix<double, Mixed<Shape>::points, Mixed<Shape>::points> at_points;
    for (int m = 0; m < Mixed<Shape>::points; ++m)
      at_points.row(m) = stress_terms<Mixed<Shape>>(Mixed<Shape>::point(m));
    const auto terms = at_points.inverse().eval();
    for (int q = 0; q < Full<Shape>::points; ++q) {
      made.points.row(q) = stress_terms<Mixed<Shape>>(Full<Shape>::point(q)) * terms;
      auto& nodes = made.nodes[idx(q)];
      nodes = Shape::values(Full<Shape>::point(q));
      for (int m = 0; m < Mixed<Shape>::points; ++m) {
        const auto N = Shape::values(Mixed<Shape>::point(m));
        for (std::size_t a = 0; a < N.size(); ++a)
          nodes[a] -= made.points(q, m) * N[a];
      }
    }
    return made;
  }();
  return rest;
}

/// What the positions of a face's nodes along a normal make of the rest of the gap.
template <class Shape> double along(int place, const Vec3& normal, std::span<const double> local) {
  constexpr std::size_t dim = Shape::dim + 1;
  double sum = 0.0;
  for (std::size_t i = 0; i < local.size(); ++i)
    sum += rest_of<Shape>().nodes[idx(place)][i / dim] * local[i] *
           normal[static_cast<Eigen::Index>(i % dim)];
  return sum;
}

/// Feet of places of a face, in the tool's frame; none if one of them is out of reach.
std::vector<Projection> feet_of(const FaceStabilization::At& at, std::span<const Vec3> places) {
  std::vector<Vec3> on_tool;
  for (const Vec3& place : places)
    on_tool.push_back(at.pose.to_tool(place));
  std::vector<Projection> feet(places.size());
  at.tool.project(on_tool, at.reach, feet);
  const bool all =
      std::all_of(feet.begin(), feet.end(), [](const Projection& foot) { return foot.found(); });
  return all ? feet : std::vector<Projection>{};
}

double deepest(std::span<const Projection> feet) {
  return std::min_element(feet.begin(), feet.end(),
                          [](const Projection& a, const Projection& b) { return a.gap < b.gap; })
      ->gap;
}

} // namespace

const FaceStabilization::Spring* FaceStabilization::find(Index face, int place) const {
  const auto found = std::lower_bound(springs_.begin(), springs_.end(), std::pair(face, place),
                                      [](const Spring& spring, const std::pair<Index, int>& key) {
                                        return std::pair(spring.face, spring.place) < key;
                                      });
  const bool same = found != springs_.end() && found->face == face && found->place == place;
  return same ? &*found : nullptr;
}

void FaceStabilization::set(const ContactSurface& surface,
                            std::span<const PointHistory> history,
                            const At& at,
                            std::span<const double> x,
                            double stiffness) {
  FaceStabilization now;
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (!of_linear_element<Shape>) {
      constexpr int dim = Shape::dim + 1;
      constexpr auto n_points = static_cast<std::ptrdiff_t>(Mixed<Shape>::points);
      std::array<double, std::size_t{Shape::nodes} * dim> local{};
      for (Index f = 0; f < surface.n_faces(); ++f) {
        const auto own = history.subspan(idx(f) * n_points, n_points);
        const auto closed = std::count_if(own.begin(), own.end(),
                                          [](const PointHistory& point) { return point.closed(); });
        if (closed == 0)
          continue;
        mechanics::gather(x, surface.scatter().nodes(f), dim, local.data());
        const auto face_point = [&](const auto& xi, double weight) {
          return FacePoint<Shape>(surface.analysis(), local.data(), xi, weight);
        };
        std::vector<Vec3> places;
        for (int m = 0; m < Mixed<Shape>::points; ++m)
          places.push_back(face_point(Mixed<Shape>::point(m), 1.0).position);
        const std::vector<Projection> points = feet_of(at, places);
        if (points.empty())
          continue;
        if (closed < n_points) {
          places.clear();
          for (const auto& node : Shape::corners)
            places.push_back(face_point(node, 1.0).position);
          const std::vector<Projection> nodes = feet_of(at, places);
          if (nodes.empty() || deepest(nodes) > 2.0 * std::min(deepest(points), 0.0))
            continue;
        }
        places.clear();
        std::vector<double> measures;
        for (int q = 0; q < Full<Shape>::points; ++q) {
          const FacePoint<Shape> place = face_point(Full<Shape>::point(q), Full<Shape>::weight(q));
          places.push_back(place.position);
          measures.push_back(place.measure);
        }
        const std::vector<Projection> feet = feet_of(at, places);
        for (int q = 0; q < static_cast<int>(feet.size()); ++q) {
          const Projection& foot = feet[idx(q)];
          if (foot.gap > 0.0)
            continue;
          Spring spring{
              f,   q,  at.pose.rotation * foot.normal, stiffness * measures[idx(q)], foot.gap,
              0.0, 0.0};
          for (int m = 0; m < Mixed<Shape>::points; ++m)
            spring.rest -= rest_of<Shape>().points(q, m) * points[idx(m)].gap;
          spring.along = along<Shape>(q, spring.normal, local);
          const Spring* before = find(f, q);
          spring.fresh = before == nullptr ? spring.rest : faded(before->fresh, at.way);
          spring.rest -= spring.fresh;
          now.springs_.push_back(spring);
        }
      }
    }
  });
  *this = std::move(now);
}

/// Calls `visitor(shape, spring, weights of the nodes, rest of the gap now)` for each spring.
template <class Visitor>
void FaceStabilization::for_each(const ContactSurface& surface,
                                 std::span<const double> x,
                                 Visitor&& visitor) const {
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (!of_linear_element<Shape>) {
      constexpr int dim = Shape::dim + 1;
      std::array<double, std::size_t{Shape::nodes} * dim> local{};
      for (const Spring& spring : springs_) {
        mechanics::gather(x, surface.scatter().nodes(spring.face), dim, local.data());
        const double rest =
            spring.rest + along<Shape>(spring.place, spring.normal, local) - spring.along;
        visitor(shape, spring, rest_of<Shape>().nodes[idx(spring.place)], rest);
      }
    }
  });
}

void FaceStabilization::add(const ContactSurface& surface,
                            const mechanics::BlockPattern& pattern,
                            std::span<const double> x,
                            mechanics::System& system) const {
  for_each(surface, x, [&](auto shape, const Spring& spring, const auto& weights, double rest) {
    using Shape = decltype(shape);
    constexpr int dim = Shape::dim + 1;
    constexpr int size = Shape::nodes * dim;
    Eigen::Matrix<double, size, 1> gradient;
    for (int a = 0; a < Shape::nodes; ++a)
      gradient.template segment<dim>(a * dim) =
          weights[idx(a)] * spring.normal.template head<dim>();
    const Eigen::Matrix<double, size, 1> force = spring.stiffness * rest * gradient;
    const Eigen::Matrix<double, size, size, Eigen::RowMajor> tangent =
        spring.stiffness * gradient * gradient.transpose();
    surface.scatter().add(dim, spring.face, force.data(), system.residual);
    surface.scatter().add(pattern, spring.face, tangent.data(), system.tangent.values);
  });
}

void FaceStabilization::add_forces(const ContactSurface& surface, std::span<double> forces) const {
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (!of_linear_element<Shape>)
      for (const Spring& spring : springs_) {
        const auto nodes = surface.scatter().nodes(spring.face);
        for (std::size_t a = 0; a < nodes.size(); ++a)
          for (int d = 0; d <= Shape::dim; ++d)
            forces[idx(nodes[a] * (Shape::dim + 1) + d)] -=
                spring.stiffness * spring.rest * rest_of<Shape>().nodes[idx(spring.place)][a] *
                spring.normal[d];
      }
  });
}

Vec3 FaceStabilization::moment(const ContactSurface& surface, std::span<const double> x) const {
  Vec3 moment = Vec3::Zero();
  for_each(surface, x, [&](auto shape, const Spring& spring, const auto& weights, double rest) {
    constexpr int dim = decltype(shape)::dim + 1;
    const auto nodes = surface.scatter().nodes(spring.face);
    Vec3 arm = Vec3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < dim; ++d)
        arm[d] += weights[a] * x[idx(nodes[a] * dim + d)];
    moment -= spring.stiffness * rest * arm.cross(spring.normal);
  });
  return moment;
}

void FaceStabilization::add_moment_row(const ContactSurface& surface,
                                       std::span<const double> x,
                                       const Vec3& axis,
                                       std::span<double> row) const {
  for_each(surface, x, [&](auto shape, const Spring& spring, const auto& weights, double rest) {
    constexpr int dim = decltype(shape)::dim + 1;
    const auto nodes = surface.scatter().nodes(spring.face);
    const Vec3 turned = spring.normal.cross(axis); // axis . (arm x normal) = arm . turned
    double lever = 0.0;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < dim; ++d)
        lever += weights[a] * x[idx(nodes[a] * dim + d)] * turned[d];
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < dim; ++d)
        row[idx(nodes[a] * dim + d)] -=
            spring.stiffness * weights[a] * (lever * spring.normal[d] + rest * turned[d]);
  });
}

double FaceStabilization::energy(const ContactSurface& surface, std::span<const double> x) const {
  double energy = 0.0;
  for_each(surface, x, [&](auto, const Spring& spring, const auto&, double rest) {
    energy += 0.5 * spring.stiffness * rest * rest;
  });
  return energy;
}

} // namespace billet::contact
