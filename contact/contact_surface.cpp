#include "contact/contact_surface.h"

#include "mechanics/elements/elements.h"

#include <array>
#include <limits>
#include <utility>

namespace billet::contact {

namespace {

using mechanics::FacePoint;

std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

std::vector<double> flat(const mechanics::Mesh& mesh) {
  std::vector<double> x;
  for (const Vec3& p : mesh.points)
    x.insert(x.end(), p.data(), p.data() + mesh.dimension());
  return x;
}

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

} // namespace

ContactSurface::ContactSurface(const mechanics::Mesh& mesh,
                               const mechanics::Bulk& bulk,
                               const mechanics::BlockPattern& pattern,
                               const std::vector<mechanics::Face>& faces,
                               const ContactSettings& settings)
    : kind_(mesh.kind), analysis_(bulk.analysis()), form_(settings.form), scheme_(settings.scheme),
      points_(visit_contact_face(mesh.kind,
                                 settings.form,
                                 [](auto, auto rule) { return decltype(rule)::points; })),
      scatter_(pattern,
               groups_of(faces),
               mechanics::visit_face(mesh.kind, [](auto s) { return decltype(s)::nodes; })),
      beneath_(faces.size() * idx(points_)) {
  const std::vector<double> x = flat(mesh);
  set_penalty(mesh, bulk, faces, settings);
  set_beneath(mesh, bulk, faces, x);
}

void ContactSurface::set_penalty(const mechanics::Mesh& mesh,
                                 const mechanics::Bulk& bulk,
                                 const std::vector<mechanics::Face>& faces,
                                 const ContactSettings& settings) {
  const double young = bulk.material().elasticity.young;
  const std::vector<double> x = flat(mesh);
  std::vector<double> area(beneath_.size());
  areas(x, area);
  double total_volume = 0.0;
  double total_area = 0.0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    double volume = 0.0;
    for (int g = 0; g < bulk.points(); ++g)
      volume += bulk.volumes()[idx(faces[f].element * bulk.points() + g)];
    double face_area = 0.0;
    for (std::size_t i = 0; i < idx(points_); ++i)
      face_area += area[f * idx(points_) + i];
    depths_.push_back(volume / face_area);
    total_volume += volume;
    total_area += face_area;
  }
  // One penalty for the whole surface, from its mean depth: with one for each face a uniform
  // pressure on faces of different depth would need a jump of the gap between them (CON-01).
  const double stiffness = young * total_area / total_volume;
  penalty_ = {settings.penalty * stiffness, settings.penalty_tangent * stiffness};
}

void ContactSurface::set_beneath(const mechanics::Mesh& mesh,
                                 const mechanics::Bulk& bulk,
                                 const std::vector<mechanics::Face>& faces,
                                 std::span<const double> x) {
  std::vector<Vec3> at(beneath_.size());
  positions(x, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Index element = faces[k / idx(points_)].element;
    double closest = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> candidates = element_points(mesh, element);
    for (std::size_t g = 0; g < candidates.size(); ++g) {
      const double distance = (candidates[g] - at[k]).norm();
      if (distance < closest) {
        closest = distance;
        beneath_[k] = idx(element * bulk.points()) + g;
      }
    }
  }
}

void ContactSurface::positions(std::span<const double> x, std::span<Vec3> out) const {
  for_each_point(*this, x, [&](const auto& at, std::size_t k) { out[k] = at.position; });
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
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, scatter_.nodes(static_cast<Index>(point / idx(points_))), dim,
                      local.data());
    std::array<std::array<double, 2>, Shape::dim> ends;
    int i = static_cast<int>(point % idx(points_));
    for (auto& [low, high] : ends) {
      low = -1.0;
      for (int before = 0; before < i % Rule::per_direction; ++before)
        low += mechanics::GaussLine<Rule::per_direction>::w[idx(before)];
      high = low + mechanics::GaussLine<Rule::per_direction>::w[idx(i % Rule::per_direction)];
      i /= Rule::per_direction;
    }
    Footprint footprint;
    const auto add = [&](const mechanics::RefPoint<Shape::dim>& xi) {
      footprint.corners[footprint.n_corners++] =
          FacePoint<Shape>(analysis_, local.data(), xi, 1.0).position;
    };
    if constexpr (Shape::dim == 1) {
      add({ends[0][0]});
      add({ends[0][1]});
    } else {
      for (const auto& [first, second] : {std::pair{0U, 0U}, {1U, 0U}, {1U, 1U}, {0U, 1U}})
        add({ends[0][first], ends[1][second]});
    }
    return footprint;
  });
}

geometry::BezierPatch ContactSurface::patch(std::span<const double> x, Index face) const {
  return geometry::BezierPatch(grid(x, face, 2));
}

std::vector<Vec3> ContactSurface::samples(std::span<const double> x, Index face) const {
  return grid(x, face, 4);
}

std::vector<Vec3> ContactSurface::grid(std::span<const double> x, Index face, int steps) const {
  return mechanics::visit_face(kind_, [&](auto shape) {
    using Shape = decltype(shape);
    constexpr int dim = Shape::dim + 1;
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, scatter_.nodes(face), dim, local.data());
    std::vector<Vec3> points;
    for (int j = 0; j <= (Shape::dim == 2 ? steps : 0); ++j)
      for (int i = 0; i <= steps; ++i) {
        mechanics::RefPoint<Shape::dim> xi{};
        xi[0] = 2.0 * i / steps - 1.0;
        if constexpr (Shape::dim == 2)
          xi[1] = 2.0 * j / steps - 1.0;
        points.push_back(FacePoint<Shape>(analysis_, local.data(), xi, 1.0).position);
      }
    return points;
  });
}

} // namespace billet::contact
