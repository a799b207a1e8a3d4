#include "process/tools/passage_guard.h"

#include "geometry/base/outcome.h"
#include "geometry/collision/passage.h"
#include "geometry/triangles/box_tree.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

using mechanics::Index;

// A point in a tool may go this much deeper, in depths of the parent element, without being
// followed: contact itself is no sharper.
constexpr double slack_share = 0.02;

/// Contact points and nodes of the candidate faces before and after an increment.
struct Followed {
  std::vector<Vec3> before;
  std::vector<Vec3> after;
  std::vector<double> slack; ///< [mm]
};

void add_nodes(const contact::ContactSurface& surface,
               const mechanics::Trial& trial,
               Followed& points) {
  const int dim = surface.analysis() == mechanics::Analysis::solid ? 3 : 2;
  std::vector<char> seen(trial.x.size(), 0);
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (const Index node : surface.scatter().nodes(f)) {
      const auto first = static_cast<std::size_t>(node) * static_cast<std::size_t>(dim);
      if (std::exchange(seen[first], char{1}) != 0)
        continue;
      Vec3 before = Vec3::Zero(), after = Vec3::Zero();
      for (int d = 0; d < dim; ++d) {
        before[d] = trial.x_old[first + static_cast<std::size_t>(d)];
        after[d] = trial.x[first + static_cast<std::size_t>(d)];
      }
      points.before.push_back(before);
      points.after.push_back(after);
      points.slack.push_back(slack_share * surface.depth(f));
    }
}

Followed followed_points(const contact::ContactSurface& surface, const mechanics::Trial& trial) {
  Followed points;
  points.before.resize(surface.n_points());
  points.after.resize(surface.n_points());
  surface.positions(trial.x_old, points.before);
  surface.positions(trial.x, points.after);
  for (Index f = 0; f < surface.n_faces(); ++f)
    points.slack.insert(points.slack.end(), static_cast<std::size_t>(surface.points()),
                        slack_share * surface.depth(f));
  add_nodes(surface, trial, points);
  return points;
}

geometry::Whereabouts
whereabouts(const geometry::Motion& motion, double time, const geometry::Driven& driven) {
  return {motion.translation(time, driven), motion.angle(time, driven)};
}

Outcome<Done> check_passage(const contact::Tool& tool,
                            const Followed& points,
                            const geometry::Whereabouts& from,
                            const geometry::Whereabouts& to) {
  const Box bounds = tool.surface->bounds();
  const geometry::Pose start = tool.motion.pose_at(from.shift, from.angle);
  for (std::size_t k = 0; k < points.before.size(); ++k) {
    const geometry::Encounter encounter{tool.motion, from, to, points.before[k], points.after[k]};
    const double way = geometry::way(encounter);
    // Most points cannot reach the tool's box.
    if (geometry::distance2(bounds, start.to_tool(points.before[k])) > way * way)
      continue;
    if (const auto place = geometry::passage(*tool.surface, encounter, points.slack[k]))
      return Failure{
          fmt::format("the increment carries the workpiece through tool '{}' at ({:.6g}, {:.6g}, "
                      "{:.6g})",
                      tool.name, (*place)[0], (*place)[1], (*place)[2])};
  }
  return Done{};
}

} // namespace

Outcome<Done> check_passages(std::span<const contact::Tool> tools,
                             const contact::ContactSurface& surface,
                             const contact::ContactTerm& contact,
                             const mechanics::Trial& trial) {
  const Followed points = followed_points(surface, trial);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (!contact.acts(t, trial.time))
      continue;
    const geometry::Motion& motion = tools[t].motion;
    Outcome<Done> outside = check_passage(
        tools[t], points, whereabouts(motion, trial.time_old, contact.driven(t, trial.x_old)),
        whereabouts(motion, trial.time, contact.driven(t, trial.x)));
    if (!outside)
      return outside;
  }
  return Done{};
}

} // namespace billet::process
