// Slips of size and mesh: elements that cannot show what is asked of them.

#include "geometry/base/box.h"
#include "geometry/collision/facet_body.h"
#include "io/slips/scene_slips.h"
#include "io/slips/slip.h"
#include "io/slips/slips.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/setup/tool_reach.h"
#include "process/state/model.h"
#include "process/state/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

using mechanics::Index;
using mechanics::Mesh;

/// Metal parts have 1 µm to 100 m.
Slip odd_size(const Case& content, const Mesh& mesh) {
  constexpr double least = 1e-6, most = 100.0; // [m]
  const Box box = box_of(mesh.points);
  const double size = box.size() * std::pow(10.0, content.units.length_power);
  if (size >= least && size <= most)
    return std::nullopt;
  return fmt::format(
      "the workpiece is {:.3g} {} long, which is {:.3g} m: are its numbers in another "
      "unit of length?",
      box.size(), content.units.length, size);
}

/// Linear elements make a cylinder a prism, inside of it.
Slip angular_cylinder(const Case& content, const process::Run& run) {
  constexpr double least = 0.99; // of the volume
  const auto* const cylinder = std::get_if<CylinderMesh>(&content.workpiece.mesh);
  if (cylinder == nullptr)
    return std::nullopt;
  const double whole = std::numbers::pi * cylinder->radius * cylinder->radius * cylinder->height *
                       cylinder->sector / 360.0;
  const double share = run.model.bulk->volume(run.state.x) / whole;
  if (share >= least)
    return std::nullopt;
  return fmt::format("the edges of {} elements make the cylinder a prism with {:.1f} % of its "
                     "volume, and forces fall short by as much: more cells along the radius, or "
                     "hex20",
                     mechanics::name(run.mesh().kind), 100.0 * share);
}

/// Faces of a cell that have no corner in common; simplices have none.
std::vector<std::pair<std::size_t, std::size_t>> opposite_faces(mechanics::ElementKind kind) {
  const auto faces = mechanics::face_nodes(kind);
  const auto corners = static_cast<std::ptrdiff_t>(mechanics::corners_per_face(kind));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size(); ++j)
      if (std::none_of(faces[i].begin(), faces[i].begin() + corners, [&](int node) {
            return std::find(faces[j].begin(), faces[j].end(), node) != faces[j].end();
          }))
        pairs.emplace_back(i, j);
  return pairs;
}

/// The boundary faces of each cell that has some, as sets of nodes.
using FacesOfCells = std::map<Index, std::set<std::set<Index>>>;

FacesOfCells by_cell(const std::vector<mechanics::Face>& faces) {
  FacesOfCells cells;
  for (const mechanics::Face& face : faces)
    cells[face.element].emplace(face.nodes.begin(), face.nodes.end());
  return cells;
}

/// Cells that are the only one between a face that may touch a tool and the boundary behind it.
std::vector<Index> lone_cells(const process::Scene& scene) {
  const Mesh& mesh = scene.part.mesh;
  const auto faces = mechanics::face_nodes(mesh.kind);
  const auto pairs = opposite_faces(mesh.kind);
  const FacesOfCells touched = by_cell(scene.part.contact_faces);
  const FacesOfCells boundary = by_cell(mechanics::boundary_faces(mesh));
  std::vector<Index> lone;
  for (const auto& [cell, touching] : touched) {
    const auto& may_touch = touching; // clang 14 captures no bindings
    const auto nodes = mesh.cell(cell);
    const auto face = [&](std::size_t i) {
      std::set<Index> set;
      for (const int node : faces[i])
        set.insert(nodes[static_cast<std::size_t>(node)]);
      return set;
    };
    const auto& all = boundary.at(cell);
    if (std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
          const std::set<Index> one = face(pair.first), other = face(pair.second);
          return all.contains(one) && all.contains(other) &&
                 (may_touch.contains(one) || may_touch.contains(other));
        }))
      lone.push_back(cell);
  }
  return lone;
}

std::string centre_of_cell(const Mesh& mesh, Index cell) {
  Vec3 centre = Vec3::Zero();
  for (const Index node : mesh.cell(cell))
    centre += mesh.points[idx(node)] / mechanics::nodes_per_element(mesh.kind);
  return mesh.dimension() == 2
             ? fmt::format("({:.6g}, {:.6g})", centre.x(), centre.y())
             : fmt::format("({:.6g}, {:.6g}, {:.6g})", centre.x(), centre.y(), centre.z());
}

/// One linear element over the height neither bulges nor bends.
Slip one_element_high(const process::Scene& scene) {
  if (scene.tools.empty() || mechanics::is_quadratic(scene.part.mesh.kind))
    return std::nullopt;
  const std::vector<Index> lone = lone_cells(scene);
  if (lone.empty())
    return std::nullopt;
  return fmt::format("{} of {} elements are the only one between two faces of the workpiece, the "
                     "first with its centre at {}: a single {} does not bulge, and in bending it "
                     "is too soft where "
                     "it is short, too stiff where it is long; take four "
                     "or more over the height, or quadratic elements",
                     lone.size(), scene.part.mesh.n_elements(),
                     centre_of_cell(scene.part.mesh, lone.front()),
                     mechanics::name(scene.part.mesh.kind));
}

/// Shortest edge between corners of the faces that may touch [mm].
double shortest_contact_edge(const process::Scene& scene) {
  const std::size_t corners = mechanics::corners_per_face(scene.part.mesh.kind);
  double shortest = std::numeric_limits<double>::infinity();
  for (const mechanics::Face& face : scene.part.contact_faces)
    for (std::size_t i = 0; i < corners; ++i) {
      const Vec3 &a = scene.part.mesh.points[idx(face.nodes[i])],
                 &b = scene.part.mesh.points[idx(face.nodes[(i + 1) % corners])];
      shortest = std::min(shortest, (b - a).norm());
    }
  return shortest;
}

/// The radius of a round tool that presses from outside; none: it has none.
struct OuterRadius {
  std::optional<double> operator()(const CircleSurface& s) const { return of(s, s.radius); }
  std::optional<double> operator()(const SphereSurface& s) const { return of(s, s.radius); }
  std::optional<double> operator()(const CylinderSurface& s) const { return of(s, s.radius); }
  std::optional<double> operator()(const TorusSurface& s) const { return of(s, s.minor); }
  template <class Other> std::optional<double> operator()(const Other&) const {
    return std::nullopt;
  }

private:
  template <class Round> static std::optional<double> of(const Round& s, double radius) {
    return s.inside ? std::nullopt : std::optional(radius);
  }
};

/// The least radius that a tool presses with; none: it is flat, sharp, or known by triangles only.
std::optional<double> least_radius(const Tool& tool, const geometry::RigidSurface& surface) {
  constexpr double turn = 0.5; // [rad], less is nearly flat
  std::optional<double> least = std::visit(OuterRadius{}, tool.surface);
  for (const geometry::ToolCorner& corner : surface.corners(turn))
    if (corner.radius > 0.0 && !(least && *least <= corner.radius))
      least = corner.radius;
  return least;
}

/// Even the shortest of the elements bridges a rounding of the tool.
Slip longer_than_radius(const Tool& tool,
                        const geometry::RigidSurface& surface,
                        double shortest,
                        const UnitSystem& units) {
  constexpr double far_longer = 2.0;
  const std::optional<double> radius = least_radius(tool, surface);
  if (!radius || shortest <= far_longer * *radius)
    return std::nullopt;
  return fmt::format(
      "tool '{}' is rounded with a radius of {:.3g} {}, and no element that may touch "
      "it is shorter than {:.3g} {}: its force will be that of the elements; make "
      "them half of the radius there, or give a [remesh] section",
      tool.name, *radius, units.length, shortest, units.length);
}

/// A narrow gap that two tools leave when they have come together.
///
/// @return  none: they do not come together, or a load drives one of them
std::optional<double> last_gap(const process::Scene& scene, std::size_t i, std::size_t j) {
  const contact::Tool &a = scene.tools[i], &b = scene.tools[j];
  const auto is_bounded = [](const contact::Tool& tool) {
    return std::isfinite(tool.surface->bounds().size()) && !tool.motion.force &&
           !tool.motion.torque;
  };
  if (!is_bounded(a) || !is_bounded(b))
    return std::nullopt;
  constexpr double closing = 0.5; // of the gap at the start
  const bool planar = scene.part.analysis != mechanics::Analysis::solid;
  const double size = a.surface->bounds().size() + b.surface->bounds().size();
  const geometry::FacetBody body_a(a.surface->display(a.surface->bounds(), planar), size);
  const geometry::FacetBody body_b(b.surface->display(b.surface->bounds(), planar), size);
  const auto gap = [&](double time) {
    return geometry::clearance({body_a, a.motion.pose(time)}, {body_b, b.motion.pose(time)});
  };
  double least = std::numeric_limits<double>::infinity();
  for (const process::Stage& stage : scene.stages)
    if (!stage.unload && stage.tools[i] != 0 && stage.tools[j] != 0)
      least = std::min(least, gap(stage.end));
  for (const double time : scene.landing_times)
    if (a.active(time) && b.active(time) && scene.stages.size() == 1)
      least = std::min(least, gap(time));
  return least < closing * gap(0.0) ? std::optional(least) : std::nullopt;
}

/// Metal that flows into a flash much thinner than an element meets a wall of one element.
Slip longer_than_flash(const process::Scene& scene,
                       std::size_t i,
                       std::size_t j,
                       double shortest,
                       const UnitSystem& units) {
  constexpr double far_longer = 2.0;
  const std::optional<double> flash = last_gap(scene, i, j);
  if (!flash || *flash == 0.0 || shortest <= far_longer * *flash)
    return std::nullopt;
  return fmt::format("tools '{}' and '{}' come together to a gap of {:.3g} {}, and no element that "
                     "may touch them is shorter than {:.3g} {}: metal cannot flow into it; take "
                     "smaller elements, or give a [remesh] section",
                     scene.tools[i].name, scene.tools[j].name, *flash, units.length, shortest,
                     units.length);
}

} // namespace

std::vector<std::string> mesh_slips(const Case& content, const process::Run& run) {
  const process::Scene& scene = run.scene;
  std::vector<std::string> slips;
  add_slip(slips, "part-size", odd_size(content, scene.part.mesh));
  add_slip(slips, "angular-cylinder", angular_cylinder(content, run));
  add_slip(slips, "one-element", one_element_high(scene));
  if (scene.remesh || scene.part.contact_faces.empty()) // new meshes fit the tools
    return slips;
  const double shortest = shortest_contact_edge(scene);
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    add_slip(
        slips, "element-over-radius",
        longer_than_radius(content.tools[t], *scene.tools[t].surface, shortest, content.units));
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    for (std::size_t j = i + 1; j < scene.tools.size(); ++j)
      add_slip(slips, "element-over-flash",
               longer_than_flash(scene, i, j, shortest, content.units));
  return slips;
}

std::vector<std::string> scene_slips(const Case& content, const process::Run& run) {
  std::vector<std::string> slips = motion_slips(content, run);
  for (auto more : {&symmetry_slips, &mesh_slips})
    for (std::string& slip : more(content, run))
      slips.push_back(std::move(slip));
  return slips;
}

} // namespace billet::io
