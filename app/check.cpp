// billet check: everything about a case that can be known without solving it.

#include "app/command_line.h"
#include "app/conditions.h"
#include "app/cost.h"
#include "app/make_process.h"
#include "geometry/base/box.h"
#include "geometry/base/memory.h"
#include "io/advice/scene_advice.h"
#include "io/case/accuracy_preset.h"
#include "io/case/material_library.h"
#include "io/case/read_case.h"
#include "io/case/setting_words.h"
#include "io/case/toml_text.h"
#include "mechanics/elements/mesh_check.h"
#include "process/loop/process.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/sizes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace billet::app {

namespace {

std::string_view law_name(const mechanics::AnyFlowLaw& flow) {
  return std::visit([](const auto& law) { return law.name; }, flow);
}

/// The law's name and what modifies it.
std::string describe(const contact::Friction& friction) {
  std::string text(std::visit([](const auto& law) { return law.name; }, friction.law));
  if (!friction.table.empty())
    text += " by table";
  if (!friction.evolution.empty())
    text += ", evolving with the sliding distance";
  if (friction.tensor)
    text += ", anisotropic";
  return text;
}

void print_mesh(const process::Scene& scene, const io::Case& content) {
  const Box box = box_of(scene.part.mesh.points);
  const auto qualities = mechanics::element_qualities(scene.part.mesh, scene.part.mesh.points);
  fmt::print("workpiece: {} {} elements, {} nodes, material law '{}'\n",
             scene.part.mesh.n_elements(), mechanics::name(scene.part.mesh.kind),
             scene.part.mesh.n_points(), law_name(scene.material.flow));
  fmt::print("  box ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) {}, worst element "
             "quality {:.3f}\n",
             box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2],
             content.units.length, *std::min_element(qualities.begin(), qualities.end()));
}

/// The constants of the workpiece's material, in the units of the case.
void print_material(const io::Case& content) {
  const std::string& name = content.workpiece.material;
  const io::Material& material = content.materials.at(name);
  fmt::print("material '{}':\n", name);
  const std::string text = io::toml_text(material);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    fmt::print("  {}\n", text.substr(from, end - from));
    from = end == std::string::npos ? text.size() : end + 1;
  }
  if (const io::LibraryMaterial* const known = io::find_library_material(material.library))
    fmt::print("  source: {}\n", known->source);
}

/// What depends on rate and temperature.
std::string describe(const process::Scene& scene, const io::Case& content) {
  const bool flows = content.materials.at(content.workpiece.material).flow.has_value();
  std::string text = !flows ? "elastic (the material has no flow law)"
                     : mechanics::follows_rate(scene.material.flow) ? "rate-dependent"
                                                                    : "rate-independent";
  if (scene.material.heating > 0.0)
    text += fmt::format(", adiabatic heating from {} {}", scene.material.temperature,
                        content.units.temperature);
  else if (content.temperature)
    text +=
        fmt::format(", isothermal at {} {}", scene.material.temperature, content.units.temperature);
  else
    text += ", isothermal";
  return text;
}

void print_remeshing(const process::RemeshSettings& remesh,
                     const process::Run& run,
                     const io::UnitSystem& units) {
  const bool plane = run.mesh().dimension() == 2;
  const double first = process::least_quality(remesh, run.mesh().kind);
  const double later = process::least_quality(remesh, plane ? mechanics::ElementKind::tri6
                                                            : mechanics::ElementKind::tet10);
  std::string when = fmt::format("an element is worse than {:.2g}", first);
  if (later != first)
    when += fmt::format(" ({:.2g} in new meshes)", later);
  when += " or increments fail";
  if (plane && run.contact() != nullptr)
    when += ", a tool touches on fewer than three edges";
  if (remesh.strain)
    when += fmt::format(", plastic strain has grown by {:.3g}", *remesh.strain);
  if (remesh.interval)
    when += fmt::format(", every {:.4g} {}", *remesh.interval, units.time);
  if (remesh.penetration)
    when +=
        fmt::format(", a face lies {:.3g} {} deep in a tool", *remesh.penetration, units.length);
  const geometry::RemeshSizes sizes = process::remesh_sizes(run);
  fmt::print("remeshing with {} when {}; edges of {:.4g} to {:.4g} {}\n", plane ? "tri6" : "tet10",
             when, sizes.min, sizes.max, units.length);
}

/// " (along x, about z)".
std::string names_of(const process::FreeMotions& free) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 3; ++i)
    if (free.along[i])
      names.push_back(fmt::format("along {}", "xyz"[i]));
  for (std::size_t i = 0; i < 3; ++i)
    if (free.about[i])
      names.push_back(fmt::format("about {}", "xyz"[i]));
  return names.empty() ? "" : fmt::format(" ({})", fmt::join(names, ", "));
}

/// What a tool does until the end of the run.
std::string motion_in_words(const contact::Tool& tool, double end, const io::UnitSystem& units) {
  const geometry::Motion& motion = tool.motion;
  std::vector<std::string> parts;
  const auto text = [](const Vec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]);
  };
  if (motion.force && motion.force->blow)
    parts.push_back(fmt::format("strikes with {:.4g} {}/{}, an energy of {:.4g} {} {}",
                                motion.force->blow->speed, units.length, units.time,
                                motion.force->blow->energy(), units.force, units.length));
  else if (motion.force)
    parts.emplace_back("is driven by a force");
  else if (const Vec3 way = motion.translation(end) - motion.translation(0.0); !way.isZero(0.0))
    parts.push_back(fmt::format("moves by {} {} until t = {:.4g} {}", text(way), units.length, end,
                                units.time));
  if (motion.torque)
    parts.emplace_back("is turned by a torque");
  else if (const double turned = motion.angle(end); turned != 0.0)
    parts.push_back(fmt::format("turns by {:.4g} rad", turned));
  return parts.empty() ? "rests" : fmt::format("{}", fmt::join(parts, ", "));
}

void print_trapped(const process::Scene& scene, const io::UnitSystem& units) {
  if (const auto& trapped = scene.contact.trapped)
    fmt::print(
        "trapped in pockets: {}\n",
        std::visit(
            [&](const auto& medium) {
              if constexpr (std::is_same_v<std::decay_t<decltype(medium)>, contact::TrappedGas>)
                return fmt::format("a gas of {:g} {}, exponent {:g}", medium.ambient, units.stress,
                                   medium.exponent);
              else
                return fmt::format("a lubricant with a bulk modulus of {:g} {}", medium.bulk,
                                   units.stress);
            },
            *trapped));
}

void print_activity(const process::Scene& scene, const process::Run& run, const io::Case& content) {
  fmt::print("active: {} unknowns per node, {}, {}wear, {}remeshing\n", scene.part.mesh.dimension(),
             describe(scene, content), run.model.wear.get() != nullptr ? "" : "no ",
             scene.remesh ? "" : "no ");
  if (scene.remesh)
    print_remeshing(*scene.remesh, run, content.units);
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const contact::Tool& tool = scene.tools[t];
    fmt::print(
        "contact pair: workpiece - '{}', friction {}{}\n", tool.name, describe(tool.friction),
        tool.motion.offset.isZero(0.0)
            ? ""
            : fmt::format(", brought to touch by ({:.6g}, {:.6g}, {:.6g})", tool.motion.offset[0],
                          tool.motion.offset[1], tool.motion.offset[2]));
    fmt::print("  '{}' {}\n", tool.name,
               motion_in_words(tool, scene.stages.back().end, content.units));
  }
  print_trapped(scene, content.units);
  if (scene.contact.self)
    fmt::print("contact pair: workpiece - itself, friction {}\n", describe(*scene.contact.self));
  if (!scene.tools.empty())
    fmt::print("  {} of the boundary faces may be touched, {} points each\n",
               scene.part.contact_faces.size(), run.model.surface->points());
  const bool linear = scene.part.mesh.kind == mechanics::ElementKind::quad4 ||
                      scene.part.mesh.kind == mechanics::ElementKind::hex8;
  if (!scene.tools.empty() && linear)
    fmt::print(
        "  on faces of linear elements contact.form \"mixed\" and \"compatible\" are the same\n");
  if (run.model.free_motions > 0)
    fmt::print("  {} rigid motion(s) are held by contact alone{}; a vanishing stiffness "
               "carries them until then; a [[support]] on a plane of symmetry takes them away\n",
               run.model.free_motions, names_of(process::free_motions(scene.part)));
}

/// Seconds as a user reads them: "40 s", "25 min", "7 h".
std::string readable(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds < 10.0)
    return fmt::format("{:.2g} s", seconds);
  if (seconds < 5.0 * minute)
    return fmt::format("{:.0f} s", seconds);
  return seconds < 2.0 * hour ? fmt::format("{:.0f} min", seconds / minute)
                              : fmt::format("{:.0f} h", seconds / hour);
}

void print_accuracy(const io::Case& content) {
  const io::Increments& given = content.time.increments;
  const double share = io::preset_of(content.solver.accuracy).increments / given.refine;
  fmt::print("accuracy: {}: increments of at most {}, tolerance {:g}\n",
             io::word_text(content.solver.accuracy, io::accuracies),
             given.max ? fmt::format("{:.6g} {}", *given.max, content.units.time)
                       : fmt::format("1/{:.0f} of a stage", 1.0 / process::default_longest(share)),
             content.solver.tolerance);
}

constexpr double megabyte = 1e6;

void print_cost(const CostEstimate& cost) {
  fmt::print("unknowns: {}, entries of the tangent {}, of its factors {:.3g}\n", cost.unknowns,
             cost.entries, cost.factor_entries);
  const std::optional<double> left = available_memory();
  fmt::print("memory: about {:.0f} MB{}; one factorization about {:.3g} GFLOP\n",
             cost.memory / megabyte,
             left ? fmt::format(" of {:.0f} MB that are left", *left / megabyte) : "",
             cost.operations * 1e-9);
  if (mechanics::may_pay(cost.systems) || cost.by_multigrid)
    fmt::print("linear systems: by {}; {}\n", cost.by_multigrid ? "multigrid" : "factorization",
               mechanics::costs_in_words(cost.systems));
  fmt::print("time: about {} for {:.0f} increments of {:.0f} iterations, of one thread; a third of "
             "it to ten times as much\n",
             readable(cost.seconds), cost.increments, cost.iterations);
}

/// What the next finer mesh takes.
void print_finer(const CostEstimate& finer) {
  fmt::print("with elements half as long: {} unknowns, about {:.0f} MB and {}\n", finer.unknowns,
             finer.memory / megabyte, readable(finer.seconds));
}

} // namespace

int check_case(const Arguments& arguments) {
  const io::Case content =
      io::read_case(arguments.file, arguments.overrides, {arguments.allow_outside});
  const ReadyProcess ready = make_process(content, arguments.file, [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout); // what takes a while follows
  });
  const process::Run& run = ready.process->view();
  const process::Scene& scene = run.scene;
  fmt::print("{}: {}\n", arguments.file, content.title);
  for (const std::string& note : ready.notes)
    fmt::print("{}\n", note);
  print_mesh(scene, content);
  print_material(content);
  print_conditions(scene, content);
  print_activity(scene, run, content);
  print_accuracy(content);
  const CostEstimate cost = ready.cost ? *ready.cost : cost_estimate(scene);
  print_cost(cost);
  print_finer(finer_cost(cost, content.dimension()));
  if (const std::optional<std::string> warning = memory_warning(cost); warning && !ready.cost)
    fmt::print("{}\n", *warning);
  for (const io::Advice& advice : io::scene_advice(content, scene))
    fmt::print("advice: [{}] {}\n", io::code_of(advice.kind), advice.text);
  fmt::print("the case is good\n");
  return 0;
}

} // namespace billet::app
