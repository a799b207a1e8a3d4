#include "io/results/wear_frame.h"

#include "geometry/convex_polygon.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::io {

namespace {

using mechanics::Index;

/// Cuts a shape off where it has no end.
Box drawn_part(const geometry::RigidSurface& surface, const Box& window) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box bounds = surface.bounds();
  const Vec3 middle = 0.5 * (window.low + window.high);
  std::array<geometry::Projection, 1> foot;
  surface.project(std::array{middle}, infinity, foot);
  const Vec3 around = foot[0].found() ? foot[0].foot : middle;
  Box part;
  for (int d = 0; d < 3; ++d) {
    const bool ends = std::isfinite(bounds.low[d]) && std::isfinite(bounds.high[d]);
    part.low[d] = ends ? -infinity : around[d] - window.size();
    part.high[d] = ends ? infinity : around[d] + window.size();
  }
  return part;
}

} // namespace

void add_wear(const contact::WearMap& map,
              const contact::Tool& tool,
              const Box& window,
              const std::string& unit_of_length,
              SurfaceFrame& frame) {
  const Box part = drawn_part(*tool.surface, window);
  std::vector<double> depth;
  for (const contact::WearCell& cell : map.cells()) {
    const bool line = cell.shape.corners().size() == 2;
    geometry::ConvexPolygon drawn = cell.shape;
    drawn.cut(part);
    if (drawn.empty() || (!line && drawn.corners().size() < 3))
      continue;
    std::vector<Index>& corners = (line ? frame.lines : frame.polygons).emplace_back();
    for (const Vec3& corner : drawn.corners()) {
      corners.push_back(static_cast<Index>(frame.points.size()));
      frame.points.push_back(corner);
    }
    depth.push_back(cell.depth);
  }
  std::vector<double> extrapolated = depth;
  for (double& value : extrapolated)
    value *= tool.wear->strokes;
  frame.cell_fields.push_back({"wear_depth", 1, std::move(depth), unit_of_length});
  if (tool.wear->strokes > 1.0)
    frame.cell_fields.push_back(
        {"wear_depth_extrapolated", 1, std::move(extrapolated), unit_of_length});
}

} // namespace billet::io
