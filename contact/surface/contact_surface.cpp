#include "contact/surface/contact_surface.h"

#include "mechanics/elements/elements.h"
#include "mechanics/mesh/mesh_edges.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::contact {

namespace {

using mechanics::FacePoint;

std::vector<Index> groups_of(const std::vector<mechanics::Face>& faces) {
  std::vector<Index> groups;
  for (const auto& face : faces)
    groups.insert(groups.end(), face.nodes.begin(), face.nodes.end());
  return groups;
}

/// Calls `visitor(face point, point number)` for every integration point of every face.
template <class Visitor>
void for_each_point(const ContactSurface& surface, std::span<const double> x, Visitor&& visitor) {
  visit_contact_face(surface.kind(), surface.form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    for (Index f = 0; f < surface.n_faces(); ++f) {
      mechanics::gather(x, surface.scatter().nodes(f), dim, local.data());
      for (int i = 0; i < Rule::points; ++i)
        visitor(FacePoint<Shape>(surface.analysis(), local.data(), Rule::point(i), Rule::weight(i)),
                idx(f * Rule::points + i));
    }
  });
}

/// Positions of an element's integration points.
std::vector<Vec3> element_points(const mechanics::Mesh& mesh, Index element) {
  return mechanics::visit_element(mesh.kind, [&](auto e) {
    using Element = decltype(e);
    std::vector<Vec3> positions;
    for (int g = 0; g < Element::Rule::points; ++g) {
      const auto N = Element::Shape::values(Element::Rule::point(g));
      Vec3 p = Vec3::Zero();
      for (std::size_t a = 0; a < N.size(); ++a)
        p += N[a] * mesh.points[idx(mesh.cell(element)[a])];
      positions.push_back(p);
    }
    return positions;
  });
}

constexpr double third = 1.0 / 3.0;

/// The part of the line [-1, 1] that point i of a Gauss rule stands for.
template <int n> std::array<double, 2> share_of_line(int i) {
  double low = -1.0;
  for (int before = 0; before < i; ++before)
    low += mechanics::GaussLine<n>::w[idx(before)];
  return {low, low + mechanics::GaussLine<n>::w[idx(i)]};
}

/// Reference coordinates in a triangle from barycentric ones counted from corner `first` on.
mechanics::RefPoint<2> at_barycentric(std::size_t first, const std::array<double, 3>& lambda) {
  return {lambda[(4 - first) % 3], lambda[(5 - first) % 3]};
}

/// Corners of the piece of the reference face that point i of a rule stands for, in turn: the
/// pieces' areas are in the ratio of the weights. (C.26)
template <int n> std::array<mechanics::RefPoint<1>, 2> piece(mechanics::GaussRule<1, n>, int i) {
  const auto [low, high] = share_of_line<n>(i);
  return {{{low}, {high}}};
}

template <int n> std::array<mechanics::RefPoint<2>, 4> piece(mechanics::GaussRule<2, n>, int i) {
  const auto [left, right] = share_of_line<n>(i % n);
  const auto [low, high] = share_of_line<n>(i / n);
  return {{{left, low}, {right, low}, {right, high}, {left, high}}};
}

/// A third: a corner, the middles of its sides, and the centre.
inline std::array<mechanics::RefPoint<2>, 4> piece(mechanics::SimplexRule<2, 3>, int i) {
  const auto a = static_cast<std::size_t>(i);
  return {{at_barycentric(a, {1.0, 0.0, 0.0}), at_barycentric(a, {0.5, 0.5, 0.0}),
           at_barycentric(a, {third, third, third}), at_barycentric(a, {0.5, 0.0, 0.5})}};
}

/// A corner cut off, or what lies between the side opposite to a corner and the centre.
inline std::vector<mechanics::RefPoint<2>> piece(mechanics::SimplexRule<2, 6> rule, int i) {
  const auto a = static_cast<std::size_t>(i % 3);
  const double cut = std::sqrt(rule.share[0]); // share of the sides that goes with the corner
  const double rest = 1.0 - cut;
  const double half = 0.5 * cut;
  if (i < 3)
    return {at_barycentric(a, {1.0, 0.0, 0.0}), at_barycentric(a, {rest, cut, 0.0}),
            at_barycentric(a, {rest, 0.0, cut})};
  return {at_barycentric(a, {0.0, rest, cut}), at_barycentric(a, {0.0, cut, rest}),
          at_barycentric(a, {half, half, rest}), at_barycentric(a, {third, third, third}),
          at_barycentric(a, {half, rest, half})};
}

} // namespace

std::size_t PointSource::nearest() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    best = weights[i] > 0.0 && weights[i] >= weights[best] ? i : best;
  return points[best];
}

ContactSurface::ContactSurface(const mechanics::Mesh& mesh,
                               const mechanics::Bulk& bulk,
                               const mechanics::BlockPattern& pattern,
                               const std::vector<mechanics::Face>& faces,
                               const ContactSettings& settings)
    : kind_(mesh.kind), analysis_(bulk.analysis()), form_(settings.form), scheme_(settings.scheme),
      max_penetration_(settings.max_penetration),
      points_(visit_contact_face(mesh.kind,
                                 settings.form,
                                 [](auto, auto rule) { return decltype(rule)::points; })),
      scatter_(pattern,
               groups_of(faces),
               mechanics::visit_face(mesh.kind, [](auto s) { return decltype(s)::nodes; })),
      bulk_points_(faces.size() * idx(points_)) {
  const std::vector<double> x = mechanics::node_positions(mesh);
  set_penalty(mesh, bulk, faces, settings);
  set_bulk_points(mesh, bulk, faces, x);
}

void ContactSurface::set_penalty(const mechanics::Mesh& mesh,
                                 const mechanics::Bulk& bulk,
                                 const std::vector<mechanics::Face>& faces,
                                 const ContactSettings& settings) {
  const double young = bulk.material().elasticity.young;
  const std::vector<double> x = mechanics::node_positions(mesh);
  std::vector<double> area(bulk_points_.size());
  areas(x, area);
  // A triangle is twice, a tetrahedron three times as high as a prism of its volume.
  const double height_share = mechanics::is_simplex(kind_) ? mesh.dimension() : 1.0;
  double total_volume = 0.0;
  double total_area = 0.0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    double volume = 0.0;
    for (int g = 0; g < bulk.points(); ++g)
      volume += bulk.volumes()[idx(faces[f].element * bulk.points() + g)];
    double face_area = 0.0;
    for (std::size_t i = 0; i < idx(points_); ++i)
      face_area += area[f * idx(points_) + i];
    volume *= height_share;
    depths_.push_back(volume / face_area);
    total_volume += volume;
    total_area += face_area;
  }
  // One penalty for the whole surface, from its mean depth: with one for each face a uniform
  // pressure on faces of different depth would need a jump of the gap between them (CON-01).
  stiffness_ = young * total_area / total_volume;
  penalty_ = {settings.penalty * stiffness_, settings.penalty_tangent * stiffness_};
}

bool ContactSurface::linear() const {
  return mechanics::visit_face(kind_,
                               [](auto shape) { return of_linear_element<decltype(shape)>; });
}

void ContactSurface::set_bulk_points(const mechanics::Mesh& mesh,
                                     const mechanics::Bulk& bulk,
                                     const std::vector<mechanics::Face>& faces,
                                     std::span<const double> x) {
  std::vector<Vec3> at(bulk_points_.size());
  positions(x, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Index element = faces[k / idx(points_)].element;
    double closest = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> candidates = element_points(mesh, element);
    for (std::size_t g = 0; g < candidates.size(); ++g) {
      const double distance = (candidates[g] - at[k]).norm();
      if (distance < closest) {
        closest = distance;
        bulk_points_[k] = idx(element * bulk.points()) + g;
      }
    }
  }
}

// Asked for in every trial: without areas and their derivatives.
void ContactSurface::positions(std::span<const double> x, std::span<Vec3> out) const {
  visit_contact_face(kind_, form_, [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    std::array<mechanics::ShapeValues<Shape::nodes>, Rule::points> N;
    for (int i = 0; i < Rule::points; ++i)
      N[idx(i)] = Shape::values(Rule::point(i));
    for (Index f = 0; f < n_faces(); ++f) {
      const std::span<const Index> nodes = scatter_.nodes(f);
      for (int i = 0; i < Rule::points; ++i) {
        Vec3& position = out[idx(f * Rule::points + i)];
        position.setZero();
        for (std::size_t a = 0; a < nodes.size(); ++a)
          for (int d = 0; d < dim; ++d)
            position[d] += N[idx(i)][a] * x[idx(nodes[a] * dim + d)];
      }
    }
  });
}

std::vector<double> ContactSurface::line_coordinates() const {
  return visit_contact_face(kind_, form_, [](auto, auto rule) {
    std::vector<double> coordinates;
    coordinates.reserve(std::size_t{decltype(rule)::points});
    for (int i = 0; i < decltype(rule)::points; ++i)
      coordinates.push_back(decltype(rule)::point(i)[0]);
    return coordinates;
  });
}

std::vector<Vec2> ContactSurface::face_coordinates() const {
  return visit_contact_face(kind_, form_, [](auto shape, auto rule) {
    std::vector<Vec2> coordinates;
    if constexpr (decltype(shape)::dim == 2)
      for (int i = 0; i < decltype(rule)::points; ++i)
        coordinates.emplace_back(decltype(rule)::point(i)[0], decltype(rule)::point(i)[1]);
    return coordinates;
  });
}

void ContactSurface::areas(std::span<const double> x, std::span<double> out) const {
  for_each_point(*this, x, [&](const auto& at, std::size_t k) { out[k] = at.measure; });
}

PointShares ContactSurface::shares(std::span<const double> x, std::size_t point) const {
  PointShares shares{scatter_.nodes(static_cast<Index>(point / idx(points_))), {}};
  visit_contact_face(kind_, form_, [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, shares.nodes, dim, local.data());
    const int i = static_cast<int>(point % idx(Rule::points));
    const FacePoint<Shape> at(analysis_, local.data(), Rule::point(i), Rule::weight(i));
    for (const double N : at.N)
      shares.areas.push_back(N * at.measure);
  });
  return shares;
}

Footprint ContactSurface::footprint(std::span<const double> x, std::size_t point) const {
  return visit_contact_face(kind_, form_, [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    constexpr int dim = Shape::dim + 1;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, scatter_.nodes(static_cast<Index>(point / idx(points_))), dim,
                      local.data());
    Footprint footprint;
    for (const auto& xi : piece(rule, static_cast<int>(point % idx(points_))))
      footprint.corners[footprint.n_corners++] =
          FacePoint<Shape>(analysis_, local.data(), xi, 1.0).position;
    return footprint;
  });
}

geometry::BezierPatch ContactSurface::patch(std::span<const double> x, Index face) const {
  return geometry::BezierPatch(samples(x, face, 2));
}

std::vector<Vec3> ContactSurface::samples(std::span<const double> x, Index face, int steps) const {
  return mechanics::visit_face(kind_, [&](auto shape) {
    using Shape = decltype(shape);
    constexpr int dim = Shape::dim + 1;
    constexpr bool triangle = is_triangle<Shape>;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, scatter_.nodes(face), dim, local.data());
    const auto coordinate = [&](int i) {
      const double share = static_cast<double>(i) / steps;
      return triangle ? share : 2.0 * share - 1.0;
    };
    std::vector<Vec3> points;
    for (int j = 0; j <= (Shape::dim == 2 ? steps : 0); ++j)
      for (int i = 0; i <= (triangle ? steps - j : steps); ++i) {
        mechanics::RefPoint<Shape::dim> xi{};
        xi[0] = coordinate(i);
        if constexpr (Shape::dim == 2)
          xi[1] = coordinate(j);
        points.push_back(FacePoint<Shape>(analysis_, local.data(), xi, 1.0).position);
      }
    return points;
  });
}

} // namespace billet::contact
