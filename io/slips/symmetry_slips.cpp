// Tools that turn across a plane of symmetry: told from the scene, before anything is solved.

#include "io/advice/tool_samples.h"
#include "io/slips/scene_slips.h"
#include "io/slips/slip.h"
#include "process/state/wall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace billet::io {

namespace {

/// Whether a tool goes on beyond a plane of symmetry as its own image.
bool is_own_image(const process::Scene& scene, std::size_t tool, const process::Wall& wall) {
  const std::optional<double> tolerance = shape_tolerance(scene);
  constexpr std::size_t enough = 200;
  const std::vector<Vec3> places = contact_nodes(scene, enough);
  std::vector<Vec3> images = places;
  for (Vec3& image : images)
    image[wall.component] = 2.0 * wall.at - image[wall.component];
  const double reach = process::body_size(scene.part.mesh);
  const std::vector<double> gaps = gaps_of(scene.tools[tool], 0.0, places, reach);
  return tolerance &&
         std::any_of(gaps.begin(), gaps.end(), [](double g) { return g < HUGE_VAL; }) &&
         are_same_gaps(gaps, gaps_of(scene.tools[tool], 0.0, images, reach), reach, *tolerance);
}

/// Whether a tool turns, or is turned, so that its image would turn the other way.
bool turns_across(const process::Scene& scene, std::size_t tool, const process::Wall& wall) {
  constexpr double same_angle = 1e-6; // [rad]
  const geometry::Motion& motion = scene.tools[tool].motion;
  const auto across = [&](Vec3 axis) {
    axis[wall.component] = 0.0;
    return axis.norm();
  };
  if (motion.torque)
    return across(motion.torque->axis) > same_angle;
  const std::vector<double> times = four_times(scene);
  return std::any_of(times.begin(), times.end(), [&](double t) {
    return std::abs(motion.angle(t)) * across(motion.axis()) > same_angle;
  });
}

} // namespace

std::vector<std::string> symmetry_slips(const Case& content, const process::Run& run) {
  std::vector<std::string> slips;
  for (std::size_t t = 0; t < run.scene.tools.size(); ++t) {
    if (std::holds_alternative<contact::Frictionless>(content.tools[t].friction.law))
      continue;
    for (const process::Wall& wall : run.state.walls)
      if (!wall.axis && turns_across(run.scene, t, wall) && is_own_image(run.scene, t, wall)) {
        add_slip(slips, "turns-across-symmetry",
                 fmt::format("tool '{}' turns across {}: in the mirror it turns the other way, and "
                             "so do its friction and what it twists; take the whole part, without "
                             "supports there",
                             run.scene.tools[t].name, process::name_of_wall(wall)));
        break;
      }
  }
  return slips;
}

} // namespace billet::io
