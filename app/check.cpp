// billet check: everything about a case that can be known without solving it.

#include "app/command_line.h"
#include "app/make_process.h"
#include "geometry/base/box.h"
#include "io/case/material_library.h"
#include "io/case/read_case.h"
#include "io/case/toml_text.h"
#include "mechanics/linear_solver.h"
#include "mechanics/mesh_check.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace billet::app {

namespace {

using mechanics::Index;

/// Entries and operations of a Cholesky factor, from its elimination tree's column counts.
struct FactorCost {
  double entries = 0.0;
  double operations = 0.0;
};

/// Symbolic elimination on the node graph; costs are those of `dim` unknowns a node.
FactorCost factor_cost(const mechanics::BlockPattern& pattern) {
  const std::vector<Index> order = mechanics::fill_reducing_order(pattern);
  const auto n = static_cast<std::size_t>(pattern.n_nodes());
  const auto dim = static_cast<std::size_t>(pattern.dim);
  std::vector<Index> position(n);
  for (std::size_t k = 0; k < n; ++k)
    position[static_cast<std::size_t>(order[k * dim]) / dim] = static_cast<Index>(k);
  std::vector<std::vector<Index>> below(n);
  for (std::size_t a = 0; a < n; ++a)
    for (Index k = pattern.neighbour_start[a]; k < pattern.neighbour_start[a + 1]; ++k) {
      const Index b =
          position[static_cast<std::size_t>(pattern.neighbours[static_cast<std::size_t>(k)])];
      if (b > position[a])
        below[static_cast<std::size_t>(position[a])].push_back(b);
    }
  FactorCost cost;
  for (std::size_t k = 0; k < n; ++k) {
    auto& column = below[k];
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    const double width = static_cast<double>(dim);
    const double height = width * static_cast<double>(column.size()) + 0.5 * width;
    cost.entries += width * height;
    cost.operations += width * height * height;
    if (column.empty())
      continue;
    auto& parent = below[static_cast<std::size_t>(column.front())];
    parent.insert(parent.end(), column.begin() + 1, column.end());
    column.clear();
    column.shrink_to_fit();
  }
  return cost;
}

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
  const Box box = box_of(scene.mesh.points);
  const auto qualities = mechanics::element_qualities(scene.mesh, scene.mesh.points);
  fmt::print("workpiece: {} {} elements, {} nodes, material law '{}'\n", scene.mesh.n_elements(),
             mechanics::name(scene.mesh.kind), scene.mesh.n_points(),
             law_name(scene.material.flow));
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
  std::string text =
      mechanics::follows_rate(scene.material.flow) ? "rate-dependent" : "rate-independent";
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
                     const process::Process& process,
                     const io::UnitSystem& units) {
  const bool plane = process.scene().mesh.dimension() == 2;
  const double first = process::least_quality(remesh, process.scene().mesh.kind);
  const double later = process::least_quality(remesh, plane ? mechanics::ElementKind::tri6
                                                            : mechanics::ElementKind::tet10);
  std::string when = fmt::format("an element is worse than {:.2g}", first);
  if (later != first)
    when += fmt::format(" ({:.2g} in new meshes)", later);
  when += " or increments fail";
  if (plane && process.contact() != nullptr)
    when += ", a tool touches on fewer than three sides";
  if (remesh.strain)
    when += fmt::format(", plastic strain has grown by {:.3g}", *remesh.strain);
  if (remesh.interval)
    when += fmt::format(", every {:.4g} {}", *remesh.interval, units.time);
  if (remesh.penetration)
    when +=
        fmt::format(", a face lies {:.3g} {} deep in a tool", *remesh.penetration, units.length);
  const geometry::RemeshSizes sizes = process.remesh_sizes();
  fmt::print("remeshing with {} when {}; {} of {:.4g} to {:.4g} {}\n", plane ? "tri6" : "tet10",
             when, plane ? "sides" : "edges", sizes.min, sizes.max, units.length);
}

void print_activity(const process::Scene& scene,
                    const process::Process& process,
                    const io::Case& content) {
  fmt::print("active: {} unknowns a node, {}, {}wear, {}remeshing\n", scene.mesh.dimension(),
             describe(scene, content), process.wear() != nullptr ? "" : "no ",
             scene.remesh ? "" : "no ");
  if (scene.remesh)
    print_remeshing(*scene.remesh, process, content.units);
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const contact::Tool& tool = scene.tools[t];
    fmt::print(
        "contact pair: workpiece - '{}', friction {}{}\n", tool.name, describe(tool.friction),
        tool.motion.offset.isZero(0.0)
            ? ""
            : fmt::format(", brought to touch by ({:.6g}, {:.6g}, {:.6g})", tool.motion.offset[0],
                          tool.motion.offset[1], tool.motion.offset[2]));
  }
  if (!scene.tools.empty())
    fmt::print("  {} of the boundary faces may be touched, {} points each\n",
               scene.contact_faces.size(), process.surface()->points());
  const bool linear = scene.mesh.kind == mechanics::ElementKind::quad4 ||
                      scene.mesh.kind == mechanics::ElementKind::hex8;
  if (!scene.tools.empty() && linear)
    fmt::print(
        "  on faces of linear elements contact.form \"mixed\" and \"compatible\" are the same\n");
  if (process.grounded_motions() > 0)
    fmt::print("  {} rigid motion(s) are held by contact alone; a vanishing grounding stiffness "
               "carries them until then\n",
               process.grounded_motions());
}

void print_cost(const process::Scene& scene) {
  const mechanics::BlockPattern pattern = mechanics::block_pattern(scene.mesh);
  const FactorCost cost = factor_cost(pattern);
  constexpr double megabyte = 1e6;
  // Of an entry: value, column, the symmetric neighbour's value, and the copy that is permuted.
  const double matrix = 30.0 * static_cast<double>(pattern.n_entries());
  // Cholesky's factor, or an LU's two in single precision, and the working front besides.
  const double factors = 8.0 * cost.entries * 1.5;
  fmt::print("unknowns: {}, entries of the tangent {}, of its factors {:.3g}\n", pattern.n_dofs(),
             pattern.n_entries(), cost.entries);
  fmt::print("memory: about {:.0f} MB; one factorization about {:.3g} GFLOP\n",
             (matrix + factors) / megabyte, cost.operations * 1e-9);
}

} // namespace

int check_case(const Arguments& arguments) {
  const io::Case content =
      io::read_case(arguments.file, arguments.overrides, {arguments.allow_outside});
  const ReadyProcess ready = make_process(content, arguments.file, 1, [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout); // what takes a while follows
  });
  const process::Process& process = *ready.process;
  const process::Scene& scene = process.scene();
  fmt::print("{}: {}\n", arguments.file, content.title);
  for (const std::string& note : ready.notes)
    fmt::print("{}\n", note);
  print_mesh(scene, content);
  print_material(content);
  print_activity(scene, process, content);
  print_cost(scene);
  fmt::print("the case is good\n");
  return 0;
}

} // namespace billet::app
