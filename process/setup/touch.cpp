#include "process/setup/touch.h"

#include "contact/surface/contact_surface.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/collision/facet_body.h"
#include "geometry/collision/first_contact.h"
#include "process/scene/scene.h"
#include "process/setup/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

using geometry::DisplayMesh;
using geometry::FacetBody;

/// The unit vector of the first displacement that a tool's motion has; zero: it stands still.
Vec3 first_direction(const geometry::Motion& motion, double end) {
  if (motion.force && motion.force->blow)
    return motion.force->axis;
  constexpr int looks = 100;
  Vec3 direction = Vec3::Zero();
  for (int step = 1; step <= looks && direction.isZero(0.0); ++step) {
    const double time = end * step / looks;
    direction = motion.force ? Vec3(motion.force->load(time) * motion.force->axis)
                             : motion.translation(time);
  }
  return direction.isZero(0.0) ? direction : Vec3(direction.normalized());
}

/// Whether a torque drives a tool within that time; an idle roll needs nothing to hold its torque.
bool is_turned(const geometry::Motion& motion, double end) {
  const auto drives = [end](const std::pair<double, double>& point) {
    return point.second != 0.0 && point.first <= end;
  };
  return motion.torque && std::any_of(motion.torque->load.points().begin(),
                                      motion.torque->load.points().end(), drives);
}

/// Brings tools to one workpiece.
class Toucher {
public:
  Toucher(const Scene& scene, const contact::ContactSurface& surface, std::span<const double> x)
      : analysis_(scene.part.analysis), end_(scene.stages.back().end),
        n_contact_points_(surface.n_points()), points_(surface.n_points()),
        size_(box_of(scene.part.mesh.points).size()), workpiece_(drawn(surface, x)) {
    surface.positions(x, points_);
    for (mechanics::Index f = 0; f < surface.n_faces(); ++f)
      for (const mechanics::Index node : surface.scatter().nodes(f))
        points_.push_back(scene.part.mesh.points[static_cast<std::size_t>(node)]);
  }

  void bring(contact::Tool& tool) const {
    const Vec3 direction = first_direction(tool.motion, end_);
    if (direction.isZero(0.0))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("tool '{}' has touch = true but does not move{}", tool.name,
                              tool.motion.force ? ": its force is zero throughout" : ""),
                  "give it a velocity, a displacement or a force, or place it where it touches");
    const double reach = most_sizes_to_touch * size_;
    // Contact points are what carries the load of a driven tool: it must rest on one, and a node
    // between them may lie inside it by the curve of the tool over a part of a face.
    const std::span<const Vec3> all = points_;
    const bool driven = tool.motion.force || is_turned(tool.motion, end_);
    const auto by_points =
        geometry::distance_to_contact(*tool.surface, tool.motion.pose(0.0), direction,
                                      driven ? all.first(n_contact_points_) : all, reach);
    const double distance = driven && by_points
                                ? *by_points
                                : by_facets(tool, direction, by_points ? *by_points : reach);
    if (!by_points && !(distance < reach && faces_workpiece(tool, distance * direction)))
      throw Error(Fault::geometry, tool.said_at,
                  fmt::format("tool '{}' cannot be brought to touch: {}", tool.name,
                              by_points.error().reason),
                  "check its place, the direction of its motion and which way its surface faces" +
                      (tool.facing.empty() ? "" : ": " + tool.facing));
    tool.motion.offset = distance * direction;
  }

private:
  /// Whether the tool, moved there, has no point of the workpiece behind its surface.
  [[nodiscard]] bool faces_workpiece(const contact::Tool& tool, const Vec3& offset) const {
    const geometry::Pose start = tool.motion.pose(0.0);
    std::vector<Vec3> points;
    for (const Vec3& p : points_)
      points.push_back(start.to_tool(p - offset));
    std::vector<geometry::Projection> feet(points.size());
    tool.surface->project(points, most_sizes_to_touch * size_, feet);
    return std::none_of(feet.begin(), feet.end(), [&](const geometry::Projection& foot) {
      return foot.gap < -facet_tolerance * size_;
    });
  }

  [[nodiscard]] double
  by_facets(const contact::Tool& tool, const Vec3& direction, double latest) const {
    const geometry::Pose start = tool.motion.pose(0.0);
    Box window; // in the tool's frame: the workpiece where the tool starts, arrives, backs off to
    for (const Vec3& p : points_)
      for (const double s : {std::min(0.0, latest) - size_, latest})
        window.add(start.to_tool(p - s * direction));
    DisplayMesh drawing = tool.surface->display(window, analysis_ != mechanics::Analysis::solid);
    keep_within(window, drawing);
    Box all = window;
    for (const Vec3& p : drawing.points)
      all.add(p);
    const double tolerance =
        facet_tolerance * size_ + excess(*tool.surface, drawing) + workpiece_.error;
    const FacetBody body(std::move(drawing), all.size()), workpiece(workpiece_.mesh, all.size());
    return geometry::facet_contact({body, start}, direction, {workpiece, {}}, latest, tolerance);
  }

  mechanics::Analysis analysis_;
  double end_;
  std::size_t n_contact_points_;
  std::vector<Vec3> points_; ///< the contact points, then the nodes
  double size_;
  DrawnWorkpiece workpiece_;
};

} // namespace

void bring_to_touch(Scene& scene) {
  if (std::none_of(scene.touch.begin(), scene.touch.end(), [](char touch) { return touch != 0; }))
    return;
  const mechanics::BlockPattern pattern = mechanics::block_pattern(scene.part.mesh);
  const mechanics::Bulk bulk(scene.part.mesh, scene.part.analysis, scene.material, pattern);
  const contact::ContactSurface surface(scene.part.mesh, bulk, pattern, scene.part.contact_faces,
                                        scene.contact);
  const Toucher toucher(scene, surface, mechanics::node_positions(scene.part.mesh));
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.touch[t] != 0)
      toucher.bring(scene.tools[t]);
}

} // namespace billet::process
