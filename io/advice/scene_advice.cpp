#include "io/advice/scene_advice.h"

#include "io/advice/advice_parts.h"

#include <utility>

namespace billet::io {

namespace {

/// Whether a plane of symmetry is one that a scene of the plane has anyway.
bool is_implied(const std::optional<PlaneScene>& plane, int normal) {
  if (!plane)
    return false;
  return plane->advice.kind == Advice::Kind::axisymmetric ? normal != plane->axis
                                                          : normal == plane->axis;
}

void add_reductions(const Case& content, const process::Scene& scene, std::vector<Advice>& all) {
  const std::optional<PlaneScene> plane = plane_scene(content, scene);
  if (plane)
    all.push_back(plane->advice);
  for (int axis = 0; axis < scene.part.mesh.dimension(); ++axis) {
    const bool is_radius = scene.part.analysis == mechanics::Analysis::axisymmetric && axis == 0;
    if (is_radius || is_implied(plane, axis))
      continue;
    if (std::optional<Advice> advice = mirror_advice(content, scene, axis))
      all.push_back(std::move(*advice));
  }
}

} // namespace

std::string_view code_of(Advice::Kind kind) {
  switch (kind) {
  case Advice::Kind::symmetry:
    return "symmetry";
  case Advice::Kind::plane_strain:
    return "plane-strain";
  case Advice::Kind::axisymmetric:
    return "axisymmetric";
  case Advice::Kind::idle_tool:
    return "idle-tool";
  case Advice::Kind::die_pressure:
    return "die-pressure";
  case Advice::Kind::heating:
    return "heating";
  case Advice::Kind::chill:
    return "chill";
  case Advice::Kind::inertia:
    return "inertia";
  case Advice::Kind::rate:
    return "rate";
  case Advice::Kind::buckling:
    return "buckling";
  }
  return "";
}

std::vector<Advice> scene_advice(const Case& content, const process::Scene& scene) {
  std::vector<Advice> all;
  add_reductions(content, scene, all);
  for (Advice& advice : tool_advice(content, scene))
    all.push_back(std::move(advice));
  if (const std::optional<NominalFlow> flow = nominal_flow(scene)) {
    for (Advice& advice : physics_advice(content, scene, *flow))
      all.push_back(std::move(advice));
    if (std::optional<Advice> advice = buckling_advice(content, scene, *flow))
      all.push_back(std::move(*advice));
  }
  return all;
}

} // namespace billet::io
