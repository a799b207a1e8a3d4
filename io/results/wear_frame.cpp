#include "io/results/wear_frame.h"

#include "geometry/collision/convex_polygon.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

using mechanics::Index;

/// What is drawn of a shape where it has no end: what is near the workpiece, and what is worn.
Box drawn_part(const geometry::RigidSurface& surface,
               const Box& window,
               std::span<const contact::WearCell> cells) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box bounds = surface.bounds();
  const Vec3 middle = 0.5 * (window.low + window.high);
  std::array<geometry::Projection, 1> foot;
  surface.project(std::array{middle}, infinity, foot);
  const Vec3 around = foot[0].found() ? foot[0].foot : middle;
  Box part;
  part.add(around - Vec3::Constant(window.size()));
  part.add(around + Vec3::Constant(window.size()));
  for (const contact::WearCell& cell : cells)
    if (cell.depth > 0.0)
      for (const Vec3& corner : cell.shape.corners())
        part.add(corner);
  for (int d = 0; d < 3; ++d)
    if (std::isfinite(bounds.low[d]) && std::isfinite(bounds.high[d])) {
      part.low[d] = -infinity;
      part.high[d] = infinity;
    }
  return part;
}

} // namespace

void add_wear(const contact::WearMap& map,
              const contact::Tool& tool,
              const Box& window,
              const std::string& unit_of_length,
              SurfaceFrame& frame) {
  const std::vector<contact::WearCell> cells = map.cells();
  const Box part = drawn_part(*tool.surface, window, cells);
  std::vector<double> depth;
  for (const contact::WearCell& cell : cells) {
    const bool line = cell.shape.corners().size() == 2;
    geometry::ConvexPolygon drawn = cell.shape;
    if (cell.depth == 0.0) // a worn one stays whole: the sum over the frame is what was worn
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
