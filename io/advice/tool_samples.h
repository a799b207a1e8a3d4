// Places and times at which tools are looked at; a detail of io/advice.
//
// Whether two shapes are the same, or one is the same all the way round, is asked of their signed
// distances: surfaces differ in kind and in how they were cut into triangles.

#pragma once

#include "contact/tools/tool.h"
#include "geometry/base/vector.h"
#include "process/scene/scene.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::io {

/// A time of a stage and which tools act then.
struct Look {
  double time; ///< [s]
  const process::Stage* stage;

  /// Whether a tool acts.
  [[nodiscard]] bool acts(const process::Scene& scene, std::size_t tool) const {
    return !stage->unload && stage->tools[tool] != 0 && scene.tools[tool].active(time);
  }
};

/// Steps through all stages and the kinks of what is given over time, in order.
[[nodiscard]] std::vector<Look> looks_at(const process::Scene& scene);

/// Four times from the start to the end, for shapes on their way.
[[nodiscard]] std::vector<double> four_times(const process::Scene& scene);

/// Signed distances of points in space from a tool at a time, shape (n) [mm]; +inf: farther than
/// `reach` on either side.
[[nodiscard]] std::vector<double>
gaps_of(const contact::Tool& tool, double time, std::span<const Vec3> points, double reach);

/// Whether two lists of distances are the same; what is about as far as `reach` may be missing.
[[nodiscard]] bool
are_same_gaps(std::span<const double> a, std::span<const double> b, double reach, double tolerance);

/// How far distances may differ that stand for the same shape [mm]; none: a tool's facets lie so
/// far off the shape they stand for that nobody can tell.
[[nodiscard]] std::optional<double> shape_tolerance(const process::Scene& scene);

/// A grid over a box that is a quarter larger than the part on all sides.
[[nodiscard]] std::vector<Vec3> grid_about(const process::Scene& scene, int steps);

/// Nodes of the faces that may touch a tool, or every so many of them.
[[nodiscard]] std::vector<Vec3> contact_nodes(const process::Scene& scene, std::size_t most);

} // namespace billet::io
