#include "process/remeshing/onto_tools.h"

#include "process/state/run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace billet::process {

namespace {

/// How far a place belongs to what touches: 1 among old points that do, falling to 0 halfway to one
/// that does not. A place that is in or out by a hair would go onto the tool in one system of units
/// and stay where it is in another.
double touching_share(const contact::ContactTerm& contact,
                      std::size_t tool,
                      const contact::PointSource& source) {
  double closed = 0.0;
  for (std::size_t k = 0; k < source.points.size(); ++k)
    if (source.weights[k] > 0.0 && contact::closed_on(contact, tool, source.points[k]))
      closed += source.weights[k];
  return std::clamp(2.0 * closed - 1.0, 0.0, 1.0);
}

/// How deep the pressures of old points let a place lie in a tool: as deep as the part is when it
/// is meshed anew. On the tool instead, the part would be swollen by as much, and what each new
/// mesh is off by would fade with the slide (C.41) and take the force along.
double pressed_depth(const contact::ContactTerm& contact,
                     std::size_t tool,
                     const contact::PointSource& source) {
  double depth = 0.0, closed = 0.0;
  for (std::size_t k = 0; k < source.points.size(); ++k)
    if (source.weights[k] > 0.0 && contact::closed_on(contact, tool, source.points[k])) {
      closed += source.weights[k];
      depth += source.weights[k] * contact::depth_of_pressure(contact, tool, source.points[k]);
    }
  return closed > 0.0 ? depth / closed : 0.0;
}

/// The nearest point of a tool that the node may go to; none: it is out of reach or further off.
std::optional<Vec3>
onto_tool(const Run& run, std::size_t tool, const Vec3& x, const WayToTool& way) {
  const geometry::Pose pose = run.model.contact->pose(tool, run.state.time, run.state.x);
  Vec3 there = x;
  constexpr int most_steps = 20;
  constexpr double near = 1e-10, flat = 0.2;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 at = pose.to_tool(there);
    geometry::Projection foot;
    run.tools()[tool].surface->project(std::span(&at, 1), run.state.mesh.first_side,
                                       std::span(&foot, 1));
    if (!foot.found() || (step == 0 && foot.gap > way.most_gap))
      return std::nullopt;
    const double gap = foot.gap + way.depth;
    Vec3 move = -gap * (pose.rotation * foot.normal);
    if (way.fixed == 0)
      return Vec3(there + move);
    if (std::abs(gap) <= near * run.state.mesh.first_side)
      return there;
    for (int i = 0; i < 3; ++i)
      if ((way.fixed >> static_cast<unsigned>(i) & 1U) != 0)
        move[i] = 0.0;
    if (move.norm() < flat * std::abs(gap))
      return std::nullopt;
    there += gap * gap / move.squaredNorm() * move; // into the tangent plane of the foot
  }
  return std::nullopt;
}

} // namespace

Vec3 projected_onto_tools(const Run& run,
                          const contact::PointSource& source,
                          const Vec3& x,
                          std::optional<int> tool,
                          const WayToTool& way) {
  Vec3 result = x;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    if (!run.model.contact->acts(t, run.state.time))
      continue;
    // What touches with nothing near it stays, but not inside the tool.
    const bool touches = tool.value_or(static_cast<int>(t)) == static_cast<int>(t);
    const double gap = touches ? way.most_gap * touching_share(*run.model.contact, t, source) : 0.0;
    const double depth = pressed_depth(*run.model.contact, t, source);
    if (const std::optional<Vec3> there =
            onto_tool(run, t, result, {.most_gap = gap, .depth = depth, .fixed = way.fixed}))
      result = *there;
  }
  return result;
}

} // namespace billet::process
