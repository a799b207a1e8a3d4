#include "app/conditions.h"

#include "io/case/toml_text.h"
#include "mechanics/loads/loads.h"

#include <fmt/format.h>

#include <cstddef>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

namespace billet::app {

namespace {

/// "9 node(s) held in z".
std::string nodes_in_words(const io::Support& support, std::size_t nodes) {
  std::string held, moved;
  for (std::size_t c = 0; c < 3; ++c) {
    if (support.fix[c])
      held += "xyz"[c];
    else if (support.move[c])
      moved += "xyz"[c];
  }
  return fmt::format("{} node(s){}{}{}", nodes, held.empty() ? "" : " held in " + held,
                     held.empty() || moved.empty() ? "" : ",",
                     moved.empty() ? "" : " moved in " + moved);
}

double area_of(const process::Scene& scene, const std::vector<mechanics::Face>& faces) {
  const std::vector<double> areas = mechanics::face_areas(
      scene.part.mesh, scene.part.analysis, faces, mechanics::node_positions(scene.part.mesh));
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// "a force of (0, 0, -24000) N in all, times its amplitude".
std::string resultant_in_words(const process::Scene& scene,
                               const process::DeadForces& load,
                               const io::UnitSystem& units) {
  const auto dim = static_cast<std::size_t>(scene.part.mesh.dimension());
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < load.forces.size(); ++i)
    sum[static_cast<Eigen::Index>(i % dim)] += load.forces[i];
  const bool plane = scene.part.analysis == mechanics::Analysis::plane_strain;
  return fmt::format("a force of ({:.4g}, {:.4g}, {:.4g}) {}{} in all, times its amplitude", sum[0],
                     sum[1], sum[2], units.force, plane ? "/" + units.length : "");
}

} // namespace

void print_conditions(const process::Scene& scene, const io::Case& content) {
  std::size_t next = 0; // of the scene's supports: one for each component
  for (const io::Support& support : content.supports) {
    if (next == scene.part.supports.size())
      break;
    fmt::print("support {}: {}\n", io::toml_text(support.where),
               nodes_in_words(support, scene.part.supports[next].nodes.size()));
    for (std::size_t c = 0; c < static_cast<std::size_t>(content.dimension()); ++c)
      if (support.fix[c] || support.move[c])
        ++next;
  }
  const bool plane = scene.part.analysis == mechanics::Analysis::plane_strain;
  for (std::size_t i = 0; i < content.loads.size(); ++i) {
    const process::LoadSpec& load = scene.part.loads[i];
    const std::vector<mechanics::Face>& faces = process::faces_of(load);
    std::string text;
    if (!faces.empty())
      text = fmt::format("{} face(s), {:.6g} {}", faces.size(), area_of(scene, faces),
                         plane ? content.units.length + " long" : content.units.length + "^2");
    if (const auto* dead = std::get_if<process::DeadForces>(&load))
      text += (text.empty() ? "" : ", ") + resultant_in_words(scene, *dead, content.units);
    const bool body = std::holds_alternative<io::BodyForce>(content.loads[i].kind);
    fmt::print("load {}: {}\n", body ? "of the whole part" : io::toml_text(content.loads[i].where),
               text);
  }
}

} // namespace billet::app
