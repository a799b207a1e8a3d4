#include "geometry/rigid_surface.h"

#include <cassert>

namespace billet::geometry {

void RigidSurface::project(std::span<const Vec3> points,
                           double reach,
                           std::span<Projection> out) const {
  assert(points.size() == out.size());
  assert(reach > 0.0);
  do_project(points, reach, out);
}

std::vector<ToolCorner> RigidSurface::corners(double /*angle*/) const { return {}; }

std::vector<InnerBall> RigidSurface::narrow_parts(const NarrowSearch& /*search*/) const {
  return {};
}

} // namespace billet::geometry
