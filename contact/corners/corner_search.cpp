#include "contact/corners/corner_search.h"

#include "contact/faces/line_face.h"
#include "geometry/base/angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace billet::contact {

namespace {

using billet::cross;

/// Of the parent element: deeper than that, a corner has not come through this face.
constexpr double deepest_share = 0.5;
/// Of the parent element: larger roundings are left to contact points. Their centres are far
/// enough outside of the metal for two places of a notch to be equally close. No ratio that a user
/// would choose: rounding must not decide.
constexpr double widest = 0.26;
/// Of the way to a corner from where a face ends on a plane of symmetry: its part along the face
/// over that along the normal. With more the corner is not above the part but next to it.
constexpr double steepest = 4.0;
/// Of the parent element: closer to a node than that, the way to it has no direction.
constexpr double at_node = 1e-12;

double facing(const PlacedCorner& corner, const Vec2& normal) {
  if ((corner.from + corner.to).dot(normal) < 0.0)
    return 0.0;
  return taken_over(cross(corner.from, normal)) * taken_over(cross(normal, corner.to));
}

template <class Shape> Vec2 inward(const LineNodes<Shape>& nodes, double xi) {
  const OnLine<Shape> at(xi);
  const Vec2 t = at.sum(at.dN, nodes).normalized();
  return {-t.y(), t.x()};
}

} // namespace

CornerSearch::CornerSearch(const ContactSurface& surface)
    : neighbours_(idx(surface.n_faces()), {-1, -1}) {
  std::map<Index, std::array<Index, 2>> around; // of a node: the face that begins there, that ends
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (std::size_t end = 0; end < 2; ++end) {
      const Index node = surface.scatter().nodes(f)[end];
      around.try_emplace(node, std::array<Index, 2>{-1, -1}).first->second[end] = f;
    }
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (std::size_t end = 0; end < 2; ++end)
      neighbours_[idx(f)][end] = around.at(surface.scatter().nodes(f)[end])[1 - end];
  depths_.resize(neighbours_.size());
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (std::size_t end = 0; end < 2; ++end) {
      const Index other = neighbours_[idx(f)][end];
      depths_[idx(f)][end] = 0.5 * (surface.depth(f) + surface.depth(other < 0 ? f : other));
    }
}

std::optional<CornerFoot> CornerSearch::find(const ContactSurface& surface,
                                             std::span<const double> x,
                                             const PlacedCorner& corner,
                                             double slack) const {
  std::optional<CornerFoot> best;
  double closest = std::numeric_limits<double>::infinity();
  visit_line(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    for (Index f = 0; f < surface.n_faces(); ++f) {
      const double parent_depth = surface.depth(f);
      if (corner.radius > widest * parent_depth)
        continue;
      const LineNodes<Shape> nodes = line_nodes<Shape>(surface, x, f);
      const double reach = corner.radius + std::max(slack, deepest_share * parent_depth);
      if ((corner.centre - nodes[0]).norm() > 2.0 * (nodes[1] - nodes[0]).norm() + reach)
        continue;
      const double xi = foot_on_line<Shape>(nodes, corner.centre);
      const OnLine<Shape> at(xi);
      const Vec2 off = corner.centre - at.sum(at.N, nodes);
      const double distance = off.norm();
      CornerFoot here{f, xi, inward<Shape>(nodes, xi), 0.0, 0.0};
      here.depth = off.dot(here.normal);
      if (std::abs(xi) == 1.0) {
        // The node is the closest place of both its faces, or the other face has a closer one.
        // Where faces end, on a plane of symmetry, the mirror image of this one would go on.
        const Index other = neighbours_[idx(f)][xi < 0.0 ? 0 : 1];
        Vec2 beside = here.normal;
        if (other >= 0) {
          const LineNodes<Shape> next = line_nodes<Shape>(surface, x, other);
          if (foot_on_line<Shape>(next, corner.centre) != -xi)
            continue;
          beside = inward<Shape>(next, -xi);
        } else if (std::abs(off.dot(at.sum(at.dN, nodes).normalized())) >
                   steepest * std::abs(here.depth)) {
          continue;
        }
        const bool inside = off.dot(here.normal + beside) >= 0.0;
        here.depth = inside ? distance : -distance;
        if (distance > at_node * parent_depth)
          here.normal = off / here.depth;
      }
      here.depth += corner.radius;
      here.facing = facing(corner, here.normal);
      if (distance >= closest || here.facing == 0.0 || here.depth > deepest_share * parent_depth)
        continue;
      best = here;
      closest = distance;
    }
  });
  if (best && !(best->depth > -slack))
    best.reset();
  return best;
}

} // namespace billet::contact
