#include "process/state/model.h"

#include "geometry/base/error.h"
#include "process/presses/blows.h"
#include "process/scene/scene.h"
#include "process/tools/narrow_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

void clear(Model& model) {
  model.terms.clear();
  model.loads.clear();
  model.decaying.clear();
  model.stabilization.reset();
  model.newton.reset();
  model.narrow.reset();
  model.blows.reset();
  model.trapped.reset();
  model.self_contact.reset();
  model.contact.reset();
  model.surface.reset();
  model.bulk.reset();
}

void build_loads(Model& model, const Part& part) {
  for (const LoadSpec& spec : part.loads) {
    if (const auto* pressure = std::get_if<PressureOn>(&spec))
      model.loads.push_back(mechanics::make_pressure(part.mesh, part.analysis, model.pattern,
                                                     pressure->faces, pressure->pressure));
    else
      model.loads.push_back(mechanics::make_dead_load(std::get<DeadForces>(spec).forces,
                                                      std::get<DeadForces>(spec).amplitude));
    model.terms.push_back(model.loads.back().get());
  }
}

/// Lines on which supports hold the part, and the axis: in the plane.
std::vector<contact::SymmetryLine> lines_of_symmetry(const Part& part, std::span<const double> x) {
  std::vector<contact::SymmetryLine> lines;
  if (part.analysis == mechanics::Analysis::axisymmetric)
    lines.push_back({0, 0.0});
  const double rounding = 1e-9 * body_size(part.mesh);
  for (const Support& support : part.supports) {
    const auto at = [&](Index node) { return x[idx(2 * node + support.component)]; };
    const auto& way = support.displacement.points();
    if (!support.nodes.empty() &&
        std::all_of(way.begin(), way.end(),
                    [](const auto& point) { return point.second == 0.0; }) &&
        std::all_of(support.nodes.begin(), support.nodes.end(), [&](Index node) {
          return std::abs(at(node) - at(support.nodes.front())) <= rounding;
        }))
      lines.push_back({support.component, at(support.nodes.front())});
  }
  return lines;
}

void build_contact(Model& model, const Scene& scene, const Part& part, std::span<const double> x) {
  if (model.tools.empty() && !scene.contact.self)
    return;
  constexpr double reach = 4.0; // sizes of the body
  model.surface = std::make_unique<contact::ContactSurface>(part.mesh, *model.bulk, model.pattern,
                                                            part.contact_faces, scene.contact);
  if (scene.contact.self) {
    model.self_contact = std::make_unique<contact::SelfContactTerm>(*model.surface, *model.bulk,
                                                                    *scene.contact.self);
    model.self_contact->start(x);
    model.terms.push_back(model.self_contact.get());
  }
  if (model.tools.empty())
    return;
  model.contact = std::make_unique<contact::ContactTerm>(*model.surface, *model.bulk, model.pattern,
                                                         model.tools, reach * body_size(part.mesh),
                                                         drive_scale(scene, part));
  model.terms.push_back(model.contact.get());
  if (scene.contact.trapped) {
    model.trapped = std::make_unique<contact::TrappedTerm>(*model.contact, *scene.contact.trapped,
                                                           lines_of_symmetry(part, x));
    model.terms.push_back(model.trapped.get());
  }
  model.narrow = std::make_unique<NarrowTools>(part.mesh, model.tools, *model.surface, x);
}

void build_blows(Model& model, const Part& part) {
  const bool strikes =
      std::any_of(model.tools.begin(), model.tools.end(), [](const contact::Tool& tool) {
        return tool.motion.force && tool.motion.force->blow;
      });
  if (!strikes)
    return;
  const auto n_nodal = part.mesh.points.size() * idx(part.mesh.dimension());
  model.blows = std::make_unique<Blows>(model.tools, *model.contact, body_size(part.mesh), n_nodal);
  model.terms.push_back(&model.blows->term());
}

void build_stabilization(Model& model, const Scene& scene, const Part& part) {
  model.free_motions = free_rigid_motions(part);
  if (model.free_motions == 0)
    return;
  if (model.tools.empty())
    throw Error(Fault::case_file, "",
                fmt::format("the workpiece can move freely: {} rigid motion(s) are held by no "
                            "support and there is no tool",
                            model.free_motions),
                "add a [[support]] that holds them");
  // Spread over all nodes it is a hundred-millionth of the body's own stiffness.
  constexpr double share = 1e-8;
  model.stabilization = std::make_unique<mechanics::RigidBodyStabilization>(
      share * body_stiffness(scene, part) / part.mesh.n_points(), model.pattern);
  model.terms.push_back(model.stabilization.get());
}

} // namespace

void build(Model& model, const Scene& scene, const Part& part, std::span<const double> x) {
  clear(model);
  model.pattern = mechanics::block_pattern(part.mesh);
  model.bulk =
      std::make_unique<mechanics::Bulk>(part.mesh, part.analysis, scene.material, model.pattern);
  model.newton = std::make_unique<mechanics::Newton>(
      model.pattern, scene.solver,
      mechanics::NewtonSettings{.tolerance = scene.tolerance,
                                .largest_correction = body_size(part.mesh)},
      contact::drive_unknowns(model.tools).size());
  model.terms = {model.bulk.get()};
  build_loads(model, part);
  build_contact(model, scene, part, x);
  build_blows(model, part);
  build_stabilization(model, scene, part);
}

double body_stiffness(const Scene& scene, const Part& part) {
  const double young = scene.material.elasticity.young;
  return part.analysis == mechanics::Analysis::plane_strain ? young : young * body_size(part.mesh);
}

contact::DriveScale drive_scale(const Scene& scene, const Part& part) {
  // So little compared with the body's own stiffness that it carries rounding, never a load,
  // however slender the body is.
  constexpr double share = 1e-12;
  return {body_size(part.mesh), share * body_stiffness(scene, part)};
}

double negligible_work(const Model& model) {
  constexpr double rounding = 1e-16; // of E times the volume: strains of 1e-8
  return rounding * model.bulk->material().elasticity.young * model.bulk->reference_volume();
}

} // namespace billet::process
