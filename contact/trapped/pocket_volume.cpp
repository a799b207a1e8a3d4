#include "contact/trapped/pocket_volume.h"

#include "mechanics/equilibrium/faces.h"

#include <numbers>

namespace billet::contact {

namespace {

using std::numbers::pi;

bool turned(mechanics::Analysis analysis) { return analysis == mechanics::Analysis::axisymmetric; }

/// The moment's integrand at a point of a face times its area vector there.
double moment_at(mechanics::Analysis analysis, const Vec3& position, const Vec3& area) {
  return turned(analysis) ? 0.5 * position.x() * area.x() : 0.5 * position.dot(area);
}

/// d line_moment / d `to`, and what the end of the chain itself adds, at the chain's last node:
/// the way from where it was, or back. (C.60)
Vec3 end_gradient(mechanics::Analysis analysis, const Vec3& old, const Vec3& now) {
  if (!turned(analysis)) {
    const Vec3 way = now - old;
    return 0.5 * Vec3(-way.y(), way.x(), 0.0);
  }
  const double mean_square = (now.x() * now.x() + now.x() * old.x() + old.x() * old.x()) / 3.0;
  return pi * Vec3(-(now.y() - old.y()) * (2.0 * now.x() + old.x()) / 3.0,
                   now.x() * now.x() - mean_square, 0.0);
}

template <class Shape>
void add_face(const ContactSurface& surface,
              Index face,
              std::span<const double> x,
              const geometry::Pose& pose,
              Chain& chain) {
  using Rule = typename mechanics::FaceRules<Shape>::Full;
  constexpr int dim = 2;
  const std::span<const Index> nodes = surface.scatter().nodes(face);
  std::array<double, std::size_t{Shape::nodes} * dim> in_space{}, in_tool{};
  mechanics::gather(x, nodes, dim, in_space.data());
  for (std::size_t a = 0; a < Shape::nodes; ++a) {
    const Vec3 seen = pose.to_tool({in_space[a * dim], in_space[a * dim + 1], 0.0});
    in_tool[a * dim] = seen.x();
    in_tool[a * dim + 1] = seen.y();
  }
  std::array<Vec3, Shape::nodes> areas;
  areas.fill(Vec3::Zero());
  for (int i = 0; i < Rule::points; ++i) {
    const mechanics::FacePoint<Shape> at(surface.analysis(), in_space.data(), Rule::point(i),
                                         Rule::weight(i));
    const mechanics::FacePoint<Shape> seen(surface.analysis(), in_tool.data(), Rule::point(i),
                                           Rule::weight(i));
    for (std::size_t a = 0; a < Shape::nodes; ++a)
      areas[a] += at.N[a] * at.area;
    chain.moment += moment_at(surface.analysis(), seen.position, seen.area);
    chain.area += at.measure;
    chain.length += at.measure / at.turn;
    chain.centre += at.measure * at.position;
  }
  // The first node is the last of the face before. Nodes of a face: its ends, then its middle.
  if (chain.nodes.empty()) {
    chain.nodes.push_back(nodes[0]);
    chain.areas.emplace_back(Vec3::Zero());
    chain.first = {in_tool[0], in_tool[1], 0.0};
  }
  chain.areas.back() += areas[0];
  for (std::size_t a = 2; a < Shape::nodes; ++a) {
    chain.nodes.push_back(nodes[a]);
    chain.areas.push_back(areas[a]);
  }
  chain.nodes.push_back(nodes[1]);
  chain.areas.push_back(areas[1]);
  chain.last = {in_tool[dim], in_tool[dim + 1], 0.0};
}

} // namespace

double line_moment(mechanics::Analysis analysis, const Vec3& from, const Vec3& to) {
  if (!turned(analysis))
    return 0.5 * (from.x() * to.y() - from.y() * to.x());
  return pi * (to.y() - from.y()) * (from.x() * from.x() + from.x() * to.x() + to.x() * to.x()) /
         3.0;
}

Chain chain_of(const ContactSurface& surface,
               std::span<const Index> faces,
               std::span<const double> x,
               const geometry::Pose& pose) {
  Chain chain;
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::dim == 1)
      for (const Index face : faces)
        add_face<Shape>(surface, face, x, pose, chain);
  });
  if (chain.area > 0.0)
    chain.centre /= chain.area;
  return chain;
}

double volume_change(mechanics::Analysis analysis, const Chain& old, const Chain& now) {
  return old.moment - now.moment - line_moment(analysis, now.last, old.last) -
         line_moment(analysis, old.first, now.first);
}

std::vector<Vec3> volume_gradient(mechanics::Analysis analysis,
                                  const Chain& old,
                                  const Chain& now,
                                  const geometry::Pose& pose) {
  std::vector<Vec3> gradient;
  gradient.reserve(now.areas.size());
  for (const Vec3& area : now.areas)
    gradient.emplace_back(-area);
  gradient.front() += pose.rotation * end_gradient(analysis, old.first, now.first);
  gradient.back() -= pose.rotation * end_gradient(analysis, old.last, now.last);
  return gradient;
}

} // namespace billet::contact
