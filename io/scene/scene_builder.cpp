#include "io/scene/scene_builder.h"

#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/mesh2d/mesher_2d.h"
#include "io/case/accuracy_preset.h"
#include "io/case/material_range.h"
#include "io/case/units.h"
#include "io/mesh/read_mesh.h"
#include "io/scene/material_builder.h"
#include "io/scene/remesh_builder.h"
#include "io/scene/selector.h"
#include "io/tools/profile.h"
#include "io/tools/step.h"
#include "io/tools/stl.h"
#include "io/tools/tool_builder.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/linear/distributed/processes.h"
#include "mechanics/linear/multigrid/multigrid.h"
#include "mechanics/loads/loads.h"
#include "mechanics/mesh/domain_meshes.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Face;
using mechanics::Index;
using mechanics::Mesh;

ElementKind element_kind(const std::string& element) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                 ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    if (mechanics::name(kind) == element)
      return kind;
  throw Error(Fault::case_file, "", "unknown element '" + element + "'");
}

/// What `make` makes; its complaints that have no place yet get that of a file.
template <class Make> auto at_file(const InputFile& file, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    std::vector<Complaint> complaints = error.complaints();
    for (Complaint& complaint : complaints)
      if (complaint.place.empty())
        complaint.place = file.given;
    throw Error(error.fault(), std::move(complaints));
  }
}

/// A note about a file; warnings stay such.
std::string of_file(const std::string& file, std::string_view note) {
  const std::size_t text = note.starts_with("warning: [") ? note.find("] ") + 2 : 0;
  return fmt::format("{}{}: {}", note.substr(0, text), file, note.substr(text));
}

/// What elements of Abaqus say of the analysis, where the case says something else.
std::optional<std::string> other_analysis(std::string_view type, Analysis analysis) {
  const bool revolved = analysis == Analysis::axisymmetric;
  if (type.starts_with("CAX") && !revolved)
    return fmt::format("{} elements are of a body of revolution, and the case is of plane strain",
                       type);
  if (type.starts_with("CPE") && revolved)
    return fmt::format("{} elements are of plane strain, and the case is axisymmetric", type);
  if (type.starts_with("CPS"))
    return fmt::format("{} elements are of plane stress, which is not modelled: the case is {}",
                       type, revolved ? "axisymmetric" : "of plane strain");
  return std::nullopt;
}

/// Makes or reads the mesh of each kind of source.
struct MeshMaker {
  ElementKind kind;
  Analysis analysis;
  std::vector<std::string>& notes;
  const Say& say;
  const std::string& unit_system;
  mechanics::MeshLabels& labels; ///< of a mesh from a file that has some

  Mesh operator()(const BoxMesh& box) const {
    return mechanics::box_mesh({kind, box.low, box.high, box.cells, box.grading});
  }
  Mesh operator()(const CylinderMesh& c) const {
    return mechanics::cylinder_mesh({kind, c.radius, c.height, c.cells[0], c.cells[1], c.sector});
  }
  Mesh operator()(const FileMesh& file) const {
    MeshFile read = read_mesh(file.file.path, 1.0, {file.folder, file.allow_outside});
    for (const std::string& note : read.notes)
      notes.push_back(of_file(file.file.given, note));
    if (const std::optional<std::string> other = other_analysis(read.type, analysis))
      notes.push_back(of_file(file.file.given, "warning: [mesh-analysis] " + *other));
    if (!read.unit_system.empty())
      take_frame(file.file.given, read.unit_system);
    if (read.mesh.kind != kind)
      throw Error(
          Fault::geometry, file.file.given,
          fmt::format("the mesh is of {} elements, the case says {}",
                      mechanics::name(read.mesh.kind), mechanics::name(kind)),
          fmt::format("set element = \"{}\" in [workpiece]", mechanics::name(read.mesh.kind)));
    labels = std::move(read.labels);
    return std::move(read.mesh);
  }
  Mesh operator()(const OutlineMesh& outline) const {
    const geometry::Profile profile = read_profile(outline.file.path);
    const geometry::PlaneMesh domain =
        at_file(outline.file, [&] { return geometry::mesh_outline(profile, outline.size); });
    notes.push_back(fmt::format("{}: meshed with {} triangles of size {:.6g}, smallest angle "
                                "{:.1f} degrees",
                                outline.file.given, domain.triangles.size(), outline.size,
                                geometry::smallest_angle(domain)));
    return mechanics::triangle_mesh(domain);
  }
  Mesh operator()(const StlMesh& stl) const {
    return meshed(read_stl(stl.file.path), stl.unit_factor, stl);
  }
  Mesh operator()(const StepMesh& step) const {
    constexpr double share_of_size = 0.01;
    const double chord_error = step.chord_error.value_or(share_of_size * step.size);
    return meshed(read_step(step.file.path, chord_error / step.unit_factor), step.unit_factor,
                  step);
  }

private:
  void take_frame(const std::string& file, const std::string& units) const {
    if (units != unit_system)
      throw Error(
          Fault::geometry, file,
          fmt::format("it is a frame of results in {}, the case is in {}", units, unit_system),
          fmt::format("write units = \"{}\" at the top of the case", units));
    notes.push_back(of_file(file,
                            "warning: [frame-as-mesh] it is a frame of results: its shape is "
                            "the mesh, and the metal begins without the strain, stress and "
                            "temperature of the frame (billet run --from goes on with them)"));
  }

  template <class Body>
  [[nodiscard]] Mesh meshed(const FacetFile& facets, double scale, const Body& source) const {
    return at_file(source.file, [&] {
      return solid_mesh({source.file, facets, scale},
                        {source.size, source.feature_angle, source.details.value_or(0.0)}, say,
                        notes);
    });
  }
};

/// The axis of an axisymmetric part is no surface.
bool lies_on_axis(const Mesh& mesh, const Face& face) {
  return std::all_of(face.nodes.begin(), face.nodes.end(),
                     [&](Index a) { return mesh.points[idx(a)][0] == 0.0; });
}

/// A face on a symmetry plane or held in every direction: nothing is to touch it.
bool unreachable(const Mesh& mesh, const Face& face, const std::vector<std::array<char, 3>>& held) {
  // Told without looking at the axes: a clamped foot is none either where the part is turned.
  if (std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index a) {
        return std::all_of(held[idx(a)].begin(), held[idx(a)].begin() + mesh.dimension(),
                           [](char is_held) { return is_held != 0; });
      }))
    return true;
  for (int c = 0; c < mesh.dimension(); ++c) {
    const double level = mesh.points[idx(face.nodes.front())][c];
    Box box;
    bool all = true;
    for (const Index a : face.nodes) {
      all = all && held[idx(a)][idx(c)] != 0;
      box.add(mesh.points[idx(a)]);
    }
    const bool flat = std::abs(box.high[c] - level) <= 1e-9 * box.size() &&
                      std::abs(box.low[c] - level) <= 1e-9 * box.size();
    if (all && flat)
      return true;
  }
  return false;
}

std::vector<Face> candidates(const process::Scene& scene, const std::vector<Face>& boundary) {
  std::vector<std::array<char, 3>> held(scene.part.mesh.points.size(), {0, 0, 0});
  for (const process::Support& support : scene.part.supports)
    for (const Index node : support.nodes)
      held[idx(node)][idx(support.component)] = 1;
  std::vector<Face> faces;
  for (const Face& face : boundary)
    if (!unreachable(scene.part.mesh, face, held))
      faces.push_back(face);
  return faces;
}

bool equal(const TimeFunction& a, const TimeFunction& b) {
  const auto same_at = [&](const std::pair<double, double>& point) {
    return a(point.first) == b(point.first);
  };
  return std::all_of(a.points().begin(), a.points().end(), same_at) &&
         std::all_of(b.points().begin(), b.points().end(), same_at);
}

/// A node that two supports move differently would follow one of them, and nobody would know which.
void require_agreement(const process::Scene& scene,
                       const std::vector<std::size_t>& number,
                       const std::string& place) {
  std::map<std::pair<Index, int>, std::size_t> first;
  for (std::size_t s = 0; s < scene.part.supports.size(); ++s) {
    const process::Support& support = scene.part.supports[s];
    for (const Index node : support.nodes) {
      const auto [known, is_new] = first.try_emplace({node, support.component}, s);
      if (is_new || equal(scene.part.supports[known->second].displacement, support.displacement))
        continue;
      const Vec3& at = scene.part.mesh.points[idx(node)];
      throw Error(
          Fault::case_file, place,
          fmt::format("support.{} and support.{} prescribe different displacements in {} at "
                      "({:.6g}, {:.6g}, {:.6g}), which belongs to both",
                      number[known->second], number[s], "xyz"[support.component], at[0], at[1],
                      at[2]),
          "leave that place out of one of them by its where, or the direction");
    }
  }
}

void add_supports(const Case& content,
                  Selector& select,
                  const std::string& place,
                  process::Scene& scene) {
  std::vector<std::size_t> number; // in the case file
  for (std::size_t s = 0; s < content.supports.size(); ++s) {
    const Support& support = content.supports[s];
    const std::vector<Index> nodes = select.nodes(support.where);
    for (int c = 0; c < content.dimension(); ++c) {
      if (support.fix[idx(c)])
        scene.part.supports.push_back({nodes, c, TimeFunction(0.0), support.name});
      else if (support.move[idx(c)])
        scene.part.supports.push_back({nodes, c, *support.move[idx(c)], support.name});
      else
        continue;
      number.push_back(s);
    }
  }
  require_agreement(scene, number, place);
}

void add_loads(const Case& content, Selector& select, process::Scene& scene) {
  for (const Load& load : content.loads) {
    if (const auto* pressure = std::get_if<PressureLoad>(&load.kind))
      scene.part.loads.emplace_back(
          process::PressureOn{select.faces(load.where), pressure->pressure});
    else if (const auto* traction = std::get_if<TractionLoad>(&load.kind)) {
      const std::vector<Face> faces = select.faces(load.where);
      scene.part.loads.emplace_back(process::DeadForces{
          mechanics::traction_forces(scene.part.mesh, scene.part.analysis, faces,
                                     traction->traction),
          traction->amplitude,
          {.faces = faces, .tractions = std::vector<Vec3>(faces.size(), traction->traction)}});
    } else {
      const auto& [force, amplitude] = std::get<BodyForce>(load.kind);
      scene.part.loads.emplace_back(
          process::DeadForces{mechanics::body_forces(scene.part.mesh, scene.part.analysis, force),
                              amplitude,
                              {.faces = {}, .tractions = {}, .body = force}});
    }
  }
}

contact::SlipScheme scheme_of(const ContactSettings& settings) {
  switch (settings.integrator) {
  case ContactIntegrator::midpoint:
    return {contact::Integrator::midpoint, settings.substeps.value_or(0)};
  case ContactIntegrator::exact:
    return {contact::Integrator::exact};
  case ContactIntegrator::radial:
    break;
  }
  return {contact::Integrator::radial};
}

contact::PairWear pair_wear(const Tool& tool, const Material& material) {
  contact::PairWear wear{{tool.wear->K, tool.wear->hardness}, std::nullopt, tool.wear->strokes};
  if (tool.wear->K_workpiece && !material.hardness)
    throw Error(
        Fault::case_file, tool.said_at,
        fmt::format("tool '{}': its wear has K_workpiece, but nothing gives the hardness of "
                    "the workpiece",
                    tool.name),
        "give the material its hardness");
  if (tool.wear->K_workpiece)
    wear.workpiece = contact::Archard{*tool.wear->K_workpiece, *material.hardness};
  return wear;
}

void add_tools(const Case& content, BuiltScene& built) {
  process::Scene& scene = built.scene;
  Box workpiece;
  for (const Vec3& p : scene.part.mesh.points)
    workpiece.add(p);
  for (const Tool& tool : content.tools) {
    scene.tools.push_back(build_tool(tool, content.analysis, workpiece.size(), built.notes));
    scene.touch.push_back(tool.touch ? 1 : 0);
    if (tool.wear)
      scene.tools.back().wear = pair_wear(tool, content.materials.at(content.workpiece.material));
    if (scene.tools.back().friction.follows_material() &&
        std::holds_alternative<mechanics::Elastic>(scene.material.flow))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("tool '{}': its friction follows the shear yield stress, but the "
                              "workpiece is elastic",
                              tool.name),
                  "give k (or cap) as a stress, or the material a flow law");
    if (scene.tools.back().friction.tensor &&
        content.contact.integrator != ContactIntegrator::radial)
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("tool '{}': friction with a tensor is integrated by \"radial\" only",
                              tool.name),
                  "leave contact.integrator out, or the tensor");
  }
}

/// None: contact of the workpiece with itself is switched off.
std::optional<contact::Friction> self_friction_of(const Case& content) {
  if (!content.contact.self.on)
    return std::nullopt;
  contact::Friction friction = friction_of(content.contact.self.friction);
  const Material& material = content.materials.at(content.workpiece.material);
  if (friction.follows_material() && !material.flow)
    throw Error(Fault::case_file, "[contact]",
                "self: its friction follows the shear yield stress, but the workpiece is elastic",
                "give k (or cap) as a stress, or the material a flow law");
  return friction;
}

std::optional<contact::TrappedMedium> medium_of(const std::optional<Trapped>& trapped) {
  if (!trapped)
    return std::nullopt;
  if (const auto* const gas = std::get_if<TrappedGas>(&*trapped))
    return contact::TrappedGas{gas->pressure, gas->exponent};
  return contact::TrappedLubricant{std::get<TrappedLubricant>(*trapped).bulk_modulus};
}

process::StopRules stop_rules_of(const Case& content) {
  process::StopRules rules{.on_full_cavity = content.stop.on_full_cavity,
                           .on_tools_overloaded = content.stop.on_tools_overloaded,
                           .on_tools_together = content.stop.on_tools_together,
                           .on_lap = content.stop.on_lap};
  // Tool steels yield at 2.2 GPa at the most (advice on dies), and bear more of it where metal
  // around holds them.
  if (const Outcome<double> bearable = converted("3 GPa", quantity::stress, content.units))
    rules.bearable = *bearable;
  return rules;
}

std::vector<process::Measure> measures_of(const Case& content) {
  std::vector<process::Measure> measures;
  for (const Measure& measure : content.measures) {
    const auto tool = std::find_if(content.tools.begin(), content.tools.end(),
                                   [&](const Tool& each) { return each.name == measure.tool; });
    measures.push_back({.name = measure.name,
                        .kind = measure.kind,
                        .point = measure.point,
                        .axis = measure.axis.normalized(),
                        .direction = measure.direction.normalized(),
                        .tool = static_cast<std::size_t>(tool - content.tools.begin()),
                        .touching = measure.touching,
                        .within = measure.within});
  }
  return measures;
}

void add_stages(const Case& content, process::Scene& scene) {
  const std::size_t n = content.tools.size();
  if (content.stages.empty()) {
    scene.stages.push_back({"", content.time.end, std::vector<char>(n, 1), false});
    return;
  }
  for (const Stage& stage : content.stages) {
    std::vector<char> act(n, stage.tools ? 0 : 1);
    if (stage.tools)
      for (std::size_t t = 0; t < n; ++t)
        act[t] = std::count(stage.tools->begin(), stage.tools->end(), content.tools[t].name) > 0;
    scene.stages.push_back({stage.name, stage.end, std::move(act), stage.unload});
  }
}

void add_times(const TimeFunction& function, std::vector<double>& times) {
  if (function.points().size() > 1)
    for (const auto& [t, v] : function.points())
      times.push_back(t);
}

/// Times of the frames asked for. Frames closer than increments are simply one an increment.
std::vector<double> frame_times(const Case& content) {
  std::vector<double> times = content.output.at;
  const double end = content.time.end;
  constexpr double most_increments = 1e6; // more than any run has
  constexpr double default_share = 0.02;  // of an increment, as the run loop has it
  const double longest = content.time.increments.max.value_or(default_share * end);
  if (content.output.every && *content.output.every >= std::max(longest, end / most_increments))
    for (int k = 1; k * *content.output.every < end; ++k)
      times.push_back(k * *content.output.every);
  return times;
}

/// Kinks of the loads that drive a tool, dead centres and kinks of a press.
void add_drive_times(const geometry::Motion& motion, double end, std::vector<double>& times) {
  for (const auto* drive : {&motion.force, &motion.torque})
    if (*drive)
      add_times((*drive)->load, times);
  if (!motion.crank)
    return;
  add_times(motion.crank->speed, times);
  const std::vector<double> bottoms = motion.crank->bottom_dead_centres(end);
  times.insert(times.end(), bottoms.begin(), bottoms.end());
}

/// Kinks of everything given over time, and the frames asked for: increments end there.
std::vector<double> landing_times(const Case& content, const process::Scene& scene) {
  std::vector<double> times = frame_times(content);
  for (const process::Support& support : scene.part.supports)
    add_times(support.displacement, times);
  for (const process::LoadSpec& load : scene.part.loads) {
    if (const auto* pressure = std::get_if<process::PressureOn>(&load))
      add_times(pressure->pressure, times);
    else
      add_times(std::get<process::DeadForces>(load).amplitude, times);
  }
  for (const contact::Tool& tool : scene.tools) {
    if (tool.motion.displacement)
      for (const TimeFunction& component : *tool.motion.displacement)
        add_times(component, times);
    if (tool.motion.rotation)
      add_times(tool.motion.rotation->speed, times);
    add_drive_times(tool.motion, content.time.end, times);
    for (const double t : {tool.active_from, tool.active_to})
      if (std::isfinite(t))
        times.push_back(t);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Where a law is asked for more than it can say.
void note_molten(const mechanics::Material& material, std::vector<std::string>& notes) {
  const auto* const law = std::get_if<mechanics::JohnsonCook>(&material.flow);
  if (law != nullptr && law->softening(material.temperature) <= mechanics::JohnsonCook::melt_floor)
    notes.push_back(fmt::format("warning: [molten] at {} degC the metal is molten (T_melt = {}): "
                                "what is left of its flow stress, a "
                                "millionth, only keeps the equations solvable",
                                material.temperature, law->T_melt));
}

/// Bricks that the reduced rule leaves a motion.
void note_single_file(const process::Scene& scene, std::vector<std::string>& notes) {
  std::vector<char> held(scene.part.mesh.points.size(), 0);
  for (const process::Support& support : scene.part.supports)
    for (const Index node : support.nodes)
      held[static_cast<std::size_t>(node)] = 1;
  const auto cells = mechanics::cells_in_single_file(scene.part.mesh, held);
  if (!cells.empty())
    notes.push_back(fmt::format(
        "warning: [single-file] {} element(s) of hex20, the first is {}, lie in single file with "
        "all other faces "
        "free: nothing holds their middle nodes in one of their motions, and the shape can be "
        "wrong or an increment fail; take two elements in one direction across, or tet10",
        cells.size(), cells.front()));
}

/// Linear elements that are much longer than thick, or in a part that is.
void note_flat_elements(const mechanics::Mesh& mesh, std::vector<std::string>& notes) {
  constexpr double flat = 8.0;
  if (mechanics::is_quadratic(mesh.kind))
    return;
  const double aspect = mechanics::largest_aspect(mesh, mesh.points);
  Box box;
  for (const Vec3& p : mesh.points)
    box.add(p);
  const Vec3 extent = box.high - box.low;
  const double longest = extent.maxCoeff();
  double thinnest = longest;
  for (int i = 0; i < mesh.dimension(); ++i)
    thinnest = std::min(thinnest, extent[i]);
  if (aspect > flat)
    notes.push_back(fmt::format(
        "warning: [flat-elements] elements of {} are up to {:.3g} times as long as thick: "
        "in bending they are stiffer than the part by about a third of the square of their length "
        "over its thickness; quadratic elements are not",
        mechanics::name(mesh.kind), aspect));
  else if (longest > flat * thinnest)
    notes.push_back(fmt::format(
        "a part {:.3g} times as long as thick, of {}: where it is bent, elements as long as the "
        "part is thick resist by a third too much, half as long by a twelfth, and a single layer "
        "of them by up to a half too little; two layers of quadratic elements do not",
        longest / thinnest, mechanics::name(mesh.kind)));
}

/// Keys that are read and kept but change nothing here: said, not passed over.
void note_keys_without_effect(const Case& content, std::vector<std::string>& notes) {
  constexpr double default_feature_angle = 30.0;
  const auto raw = [&](const auto* facets) {
    return facets != nullptr && !facets->smooth && facets->feature_angle != default_feature_angle;
  };
  for (const Tool& tool : content.tools)
    if (raw(std::get_if<StlSurface>(&tool.surface)) || raw(std::get_if<StepSurface>(&tool.surface)))
      notes.push_back(fmt::format(
          "tool '{}': without smooth = true feature_angle only counts feature edges", tool.name));
  for (const Tool& tool : content.tools)
    if (content.analysis == Analysis::axisymmetric && tool.motion.rotation)
      notes.push_back(fmt::format(
          "warning: [turns-off-meridian] tool '{}' turns about the normal of the meridian, which "
          "no tool of revolution can do without changing its shape",
          tool.name));
  const Material& material = content.materials.at(content.workpiece.material);
  if (material.library.empty() && material.density && !material.heating)
    notes.push_back("density serves advice alone: without heating the run does not need it, and "
                    "there is no inertia");
  if (material.library.empty() && material.heat_capacity && !material.heating)
    notes.push_back("heat_capacity has no effect without heating");
}

} // namespace

BuiltScene build_scene(const Case& content, const std::string& place, const Say& say) {
  BuiltScene built;
  process::Scene& scene = built.scene;
  scene.title = content.title;
  note_keys_without_effect(content, built.notes);
  scene.part.analysis = content.analysis;
  const ElementKind kind = element_kind(content.workpiece.element);
  mechanics::MeshLabels labels;
  scene.part.mesh =
      std::visit(MeshMaker{kind, content.analysis, built.notes, say, content.units.name, labels},
                 content.workpiece.mesh);
  const geometry::Pose pose = pose_of(content.workpiece.place);
  for (Vec3& p : scene.part.mesh.points)
    p = pose.to_space(p);
  mechanics::require_sound_mesh(scene.part.mesh, place,
                                scene.part.analysis == mechanics::Analysis::axisymmetric, labels);
  scene.material = material_of(content);
  note_molten(scene.material, built.notes);
  if (const auto outside = outside_range(content.materials.at(content.workpiece.material),
                                         scene.material.temperature))
    built.notes.push_back(*outside);
  const std::vector<Face> surface = mechanics::boundary_faces(scene.part.mesh);
  std::vector<Face> boundary = surface;
  if (scene.part.analysis == mechanics::Analysis::axisymmetric)
    std::erase_if(boundary, [&](const Face& face) { return lies_on_axis(scene.part.mesh, face); });
  Selector select(scene.part.mesh, surface, boundary);
  add_supports(content, select, place, scene);
  note_single_file(scene, built.notes);
  note_flat_elements(scene.part.mesh, built.notes);
  add_loads(content, select, scene);
  add_tools(content, built);
  scene.part.contact_faces = content.contact.surface ? select.faces(*content.contact.surface)
                                                     : candidates(scene, boundary);
  select.throw_if_any();
  built.notes.insert(built.notes.end(), select.warnings().begin(), select.warnings().end());
  scene.contact = {content.contact.form == ContactForm::compatible ? contact::Form::compatible
                                                                   : contact::Form::mixed,
                   content.contact.penalty,
                   content.contact.penalty_tangent,
                   content.contact.method == ContactMethod::augmented ? contact::Method::augmented
                                                                      : contact::Method::penalty,
                   content.contact.max_penetration,
                   scheme_of(content.contact),
                   self_friction_of(content),
                   medium_of(content.contact.trapped)};
  scene.measures = measures_of(content);
  add_stages(content, scene);
  scene.increments = {
      content.time.increments.first, content.time.increments.min, content.time.increments.max,
      preset_of(content.solver.accuracy).increments / content.time.increments.refine};
  scene.landing_times = landing_times(content, scene);
  scene.remesh = remesh_settings_of(content, scene.part, place);
  scene.stop = stop_rules_of(content);
  scene.tolerance = content.solver.tolerance;
  scene.solver.choice = content.solver.linear;
  if (scene.solver.choice == mechanics::SolverChoice::multigrid &&
      !mechanics::Multigrid::is_there())
    throw Error(Fault::case_file, place,
                "solver.linear: \"multigrid\" needs a component that is not installed",
                "./dev build --multigrid builds it, with PETSc; \"auto\" takes it where it pays");
  if (scene.solver.choice == mechanics::SolverChoice::superlu_dist &&
      mechanics::number_of_processes() == 1)
    throw Error(Fault::case_file, place,
                "solver.linear: \"superlu-dist\" is for several processes, and this is one",
                "start mpiexec -n N billet-mpi run, or write \"mumps\" or \"auto\"");
  return built;
}

} // namespace billet::io
