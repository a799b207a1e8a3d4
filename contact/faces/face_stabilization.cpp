#include "contact/faces/face_stabilization.h"

#include "mechanics/equilibrium/faces.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace billet::contact {

namespace {

using geometry::Projection;
using mechanics::FacePoint;

/// Of the parent element: on a flat tool nothing is deeper than the points, and rounding must not
/// decide which springs press.
constexpr double dead_zone = 1e-9;

/// Of the springs, over the largest contact pressure of their face.
constexpr double max_pressures = 10.0;

/// Of what a spring is off, followed at the end of an increment. Springs that went the whole way
/// would lift a point off the tool, be gone for it, let it come back, and so on.
constexpr double share_followed = 0.5;

/// Of the parent element: springs of a face that nothing presses any more are gone by then.
constexpr double negligible_share = 1e-6;

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

/// What a spring presses on next, where it presses on `now` and `measured` is what it would press
/// on if it had not been there; what is positive does not press. [mm]
double followed(double now, double measured, double negligible) {
  const double pressed = std::min(0.0, now);
  const double next = pressed + share_followed * (std::min(0.0, measured) - pressed);
  return measured > 0.0 && next > -negligible ? measured : next;
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

/// Largest contact pressure of a face's points; nothing if none touches.
std::optional<double> pressure_of(std::span<const PointHistory> points) {
  std::optional<double> largest;
  for (const PointHistory& point : points)
    if (point.closed())
      largest = std::max(largest.value_or(0.0), point.pressure);
  return largest;
}

/// What a face's springs would press on if they had not been there, at the places of its full rule.
template <class Shape> struct Wanted {
  std::array<Vec3, Full<Shape>::points> normals; ///< of the tool, in space [-]
  std::array<double, Full<Shape>::points> areas; ///< [mm^2]
  std::array<double, Full<Shape>::points> rest;  ///< [mm]
  /// The rest of place x normal and of the normals, in the tool's frame.
  std::array<std::array<Vec3, 2>, Full<Shape>::points> levers;
  bool is_clear = true; ///< all places are outside the tool
};

/// @param deepest  what they may press on [mm]
/// @return nothing if the tool is out of reach
template <class Shape>
std::optional<Wanted<Shape>> wanted(mechanics::Analysis analysis,
                                    const FaceStabilization::At& at,
                                    const double* local,
                                    double deepest) {
  constexpr auto n_points = std::size_t{Mixed<Shape>::points};
  constexpr auto n_places = std::size_t{Full<Shape>::points};
  Wanted<Shape> result;
  std::array<Vec3, n_points + n_places> places;
  for (std::size_t m = 0; m < n_points; ++m)
    places[m] =
        FacePoint<Shape>(analysis, local, Mixed<Shape>::point(static_cast<int>(m)), 1.0).position;
  for (std::size_t q = 0; q < n_places; ++q) {
    const int i = static_cast<int>(q);
    const FacePoint<Shape> place(analysis, local, Full<Shape>::point(i), Full<Shape>::weight(i));
    places[n_points + q] = place.position;
    result.areas[q] = place.measure;
  }
  const std::vector<Projection> feet = feet_of(at, places);
  if (feet.empty())
    return std::nullopt;
  for (std::size_t q = 0; q < n_places; ++q) {
    const Projection& foot = feet[n_points + q];
    double rest = foot.gap;
    Vec3 lever = foot.foot.cross(foot.normal), normal = foot.normal;
    for (std::size_t m = 0; m < n_points; ++m) {
      const double share = rest_of<Shape>().points(static_cast<int>(q), static_cast<int>(m));
      rest -= share * feet[m].gap;
      lever -= share * feet[m].foot.cross(feet[m].normal);
      normal -= share * feet[m].normal;
    }
    result.levers[q] = {lever, normal};
    result.rest[q] = std::max({rest, foot.gap, -deepest});
    result.is_clear = result.is_clear && foot.gap > 0.0;
    result.normals[q] = at.pose.rotation * foot.normal;
  }
  return result;
}

} // namespace

void FaceStabilization::set(const ContactSurface& surface,
                            std::span<const PointHistory> history,
                            const At& at,
                            std::span<const double> x,
                            double stiffness) {
  const std::vector<Spring> before = std::exchange(springs_, {});
  auto of_face = before.begin(); // they are in the order of the faces
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (!of_linear_element<Shape>) {
      constexpr int dim = Shape::dim + 1;
      constexpr auto n_points = std::size_t{Mixed<Shape>::points};
      std::array<double, std::size_t{Shape::nodes} * dim> local{};
      for (Index f = 0; f < surface.n_faces(); ++f) {
        while (of_face != before.end() && of_face->face < f)
          ++of_face;
        const bool pressed = of_face != before.end() && of_face->face == f;
        const auto pressure = pressure_of(history.subspan(idx(f) * n_points, n_points));
        if (!pressure && !pressed)
          continue;
        mechanics::gather(x, surface.scatter().nodes(f), dim, local.data());
        const double deepest = max_pressures * pressure.value_or(0.0) / stiffness;
        const auto face = wanted<Shape>(surface.analysis(), at, local.data(), deepest);
        if (!face || (!pressure && face->is_clear))
          continue;
        const double negligible = negligible_share * surface.depth(f);
        double lowest = 0.0;
        for (std::size_t q = 0; q < face->rest.size(); ++q) {
          const int place = static_cast<int>(q);
          double rest = face->rest[q] + dead_zone * surface.depth(f);
          if (pressed) {
            const Spring& old = *(of_face + place);
            const double now = old.rest + along<Shape>(place, old.normal, local) - old.along;
            rest = followed(now, rest, negligible);
          }
          lowest = std::min(lowest, rest);
          springs_.push_back({f, place, face->normals[q], stiffness * face->areas[q], rest,
                              along<Shape>(place, face->normals[q], local), face->levers[q][0],
                              face->levers[q][1]});
        }
        if (!pressure && lowest > -negligible) // they are gone with their pressure
          springs_.resize(springs_.size() - face->rest.size());
      }
    }
  });
}

/// Calls `visitor(shape, spring, weights of the nodes, rest of the gap now)` for each that presses.
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
        if (rest < 0.0)
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
                spring.stiffness * std::min(0.0, spring.rest) *
                rest_of<Shape>().nodes[idx(spring.place)][a] * spring.normal[d];
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

Vec3 FaceStabilization::moment_about(const Turning& turning,
                                     const ContactSurface& surface,
                                     std::span<const double> x) const {
  Vec3 moment = Vec3::Zero();
  for_each(surface, x, [&](auto, const Spring& spring, const auto&, double rest) {
    moment -= spring.stiffness * rest * (turning.rotation * spring.lever(turning.point));
  });
  return moment;
}

void FaceStabilization::add_moment_row(const Turning& turning,
                                       const ContactSurface& surface,
                                       std::span<const double> x,
                                       const Vec3& axis,
                                       std::span<double> row) const {
  for_each(surface, x, [&](auto shape, const Spring& spring, const auto& weights, double) {
    constexpr int dim = decltype(shape)::dim + 1;
    const auto nodes = surface.scatter().nodes(spring.face);
    const double lever = axis.dot(turning.rotation * spring.lever(turning.point));
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < dim; ++d)
        row[idx(nodes[a] * dim + d)] -= spring.stiffness * weights[a] * lever * spring.normal[d];
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
