#include "process/remeshing/remeshing_due.h"

#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/increment/snapshots.h"
#include "process/remeshing/contact_zones.h"
#include "process/remeshing/part_boundary.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/sizes.h"
#include "process/scene/scene.h"
#include "process/setup/drawing.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace billet::process {

namespace {

/// Without a limit of the case: a face that lies deeper in a tool, relative to the parent element,
/// and twice as deep as when the mesh was new, is too coarse for it.
constexpr double deep = 0.1;

/// Increments before a mesh that could not be made is tried again for another reason than quality.
constexpr int rest_after_refusal = 5;

/// A mesh that is only little finer is not worth its transfer.
constexpr double worth_while = 1.5;

/// A mesh has to have lost this share of its first quality before it is replaced.
constexpr double worn_share = 0.7;

/// One that is nearly due does not go into an increment at whose end it is predicted to be worse
/// than this share of the quality it is replaced at: force and shape there are those of bad
/// elements. What is predicted of better ones says little.
constexpr double worse_share = 0.9, nearly_due = 1.1;

/// Elements longer than so many times their width, and twice as long as when the mesh was new,
/// resolve little along them; quality, a matter of angles, does not see squares flattened.
constexpr double most_aspect = 10.0, most_stretch = 2.0;

/// Sides so many times longer than the surface of the tool that they touch lets new ones be, and
/// than those of the mesh when it was new were, cut off the edge that they lie on.
constexpr double most_excess = 1.6;

/// A mesh on which a corner bears this share of a tool's force, but which was made before metal was
/// strained so much, knows nothing of how it flows round the corner: it is replaced when it is.
constexpr double most_of_corner = 0.3, bitten = 0.25;

/// Contact that has grown onto sides so many times longer than the case wants there, over this
/// share of its length or area more than when the mesh was new.
constexpr double most_of_wanted = 1.6, coarse_share = 0.25;

/// Of the worst element when all has gone on for `dt` more.
///
/// @param x, velocity  of the nodes, shape (n_dofs)
double quality_after(double dt,
                     const mechanics::Mesh& mesh,
                     std::span<const double> x,
                     std::span<const double> velocity) {
  std::vector<double> then(x.begin(), x.end());
  for (std::size_t i = 0; i < then.size(); ++i)
    then[i] += dt * velocity[i];
  return worst_quality(mesh, then);
}

/// Largest angle between normals, those of places that are out of reach left out [rad].
double most_between_normals(std::span<const geometry::Projection> feet) {
  double least_cosine = 1.0;
  for (const geometry::Projection& a : feet)
    for (const geometry::Projection& b : feet)
      if (a.found() && b.found())
        least_cosine = std::min(least_cosine, a.normal.dot(b.normal));
  return std::acos(std::max(least_cosine, -1.0));
}

/// Of the present mesh since it was made, the largest growth of plastic strain [-].
double strain_since_mesh(const Run& run) {
  double grown = 0.0;
  for (std::size_t k = 0; k < run.state.mesh.strain.size(); ++k)
    grown = std::max(grown, run.model.bulk->states()[k].plastic_strain - run.state.mesh.strain[k]);
  return grown;
}

/// A zone of contact that a new mesh would give more sides.
std::optional<ContactZone> zone_to_refine(const Run& run) {
  for (const ContactZone& zone : zones_of_contact(run))
    if (can_be_refined(run, zone) && !leaves(run, idx(zone.tool)))
      return zone;
  return std::nullopt;
}

} // namespace

void start_remeshing(Run& run) {
  run.state.mesh.quality = worst_quality(run.mesh(), run.positions());
  run.state.mesh.aspect = aspect(run);
  run.state.mesh.excess = most_outgrown_side(run).excess;
  run.state.mesh.strain.assign(run.model.bulk->states().size(), 0.0);
}

OutgrownSide most_outgrown_side(const Run& run) {
  OutgrownSide most;
  if (!run.scene.remesh || !run.model.contact || run.mesh().dimension() != 2)
    return most;
  const double turn = remesh_sizes(run).turn, min = usual_sizes(run).min;
  const std::vector<Vec3> points = as_points(run.positions(), 2);
  const std::vector<int> touching = touching_tools(run);
  for (std::size_t f = 0; f < touching.size(); ++f) {
    if (touching[f] < 0 || leaves(run, idx(touching[f])))
      continue;
    const std::size_t tool = idx(touching[f]);
    const geometry::Pose pose = run.model.contact->pose(tool, run.state.time, run.state.x);
    std::vector<Vec3> nodes;
    for (const Index node : run.part().contact_faces[f].nodes)
      nodes.push_back(pose.to_tool(points[idx(node)]));
    std::vector<geometry::Projection> feet(nodes.size());
    run.tools()[tool].surface->project(nodes, run.state.mesh.first_side, feet);
    const double turned = most_between_normals(feet);
    const double length = (nodes[1] - nodes[0]).norm();
    const double excess = length / std::max(min, length * std::min(1.0, turn / turned));
    if (excess > most.excess)
      most = {excess, turned, tool};
  }
  return most;
}

double coarse_contact(const Run& run) {
  if (!run.scene.remesh || !run.scene.remesh->size_contact)
    return 0.0;
  const double longest = most_of_wanted * *run.scene.remesh->size_contact;
  const int dim = run.mesh().dimension();
  const std::vector<Vec3> points = as_points(run.positions(), dim);
  const std::vector<int> touching = touching_tools(run);
  double all = 0.0, coarse = 0.0;
  for (std::size_t f = 0; f < touching.size(); ++f) {
    if (touching[f] < 0)
      continue;
    const auto& nodes = run.part().contact_faces[f].nodes;
    const double side = (points[idx(nodes[1])] - points[idx(nodes[0])]).norm();
    const double measure = dim == 2 ? side : side * side;
    all += measure;
    coarse += side > longest ? measure : 0.0;
  }
  return all > 0.0 ? coarse / all : 0.0;
}

CornerLoad most_at_corner(const Run& run) {
  CornerLoad most;
  for (std::size_t t = 0; run.model.contact && t < run.tools().size(); ++t) {
    double at_points = 0.0, at_corner = 0.0;
    for (const contact::ClosedPoint& at : run.model.contact->closed()[t])
      at_points += at.area * at.pressure;
    for (const contact::CornerState& corner : contact::corners(*run.model.contact, t))
      at_corner += corner.press.area * corner.history.pressure;
    if (at_corner > most.share * (at_points + at_corner))
      most = {at_corner / (at_points + at_corner), t};
  }
  return most;
}

double aspect(const Run& run) {
  return mechanics::largest_aspect(run.mesh(), as_points(run.positions(), run.mesh().dimension()));
}

bool may_remesh(const Run& run) {
  return run.scene.remesh && run.state.leaving.decay_until <= run.state.time &&
         run.state.increment > run.state.mesh.increment;
}

bool can_be_refined(const Run& run, const ContactZone& zone) {
  return zone.too_short() && zone.length > worth_while * static_cast<double>(zone.n_sides) *
                                               usual_sizes(run).zones.in(zone, zone.length);
}

bool leaves(const Run& run, std::size_t tool) {
  constexpr double falling = 0.9, gone = 0.05;
  if (run.state.forces.before.empty())
    return false; // nothing has happened yet
  const double force = forces_on_tools(run)[tool];
  return force < falling * run.state.forces.before[tool] ||
         force < gone * run.state.forces.largest_on_tools[tool];
}

std::optional<std::string> remeshing_due(const Run& run, double left) {
  if (!may_remesh(run))
    return std::nullopt;
  const RemeshSettings& settings = *run.scene.remesh;
  const double quality = worst_quality(run.mesh(), run.positions());
  const double limit =
      std::min({least_quality(settings, run.mesh().kind), worn_share * run.state.mesh.quality,
                run.state.mesh.refused_quality});
  // Metal that springs back hardly flows: its mesh gets no worse.
  constexpr double of_limit = 0.5;
  if (quality < (run.state.springs_back ? of_limit * limit : limit))
    return fmt::format("element quality {:.2g} < {:.2g}", quality, limit);
  if (quality < nearly_due * limit && !run.state.springs_back) {
    constexpr double longer = 1.5; // than the last increment: what the next one is at most
    const double next = std::min({longer * run.state.last_dt, run.state.longest, left});
    const double then = quality_after(next, run.mesh(), run.positions(), run.state.velocity);
    if (then < worse_share * limit)
      return fmt::format("element quality {:.2g}, in the next increment {:.2g}", quality, then);
  }
  if (run.state.mesh.refused_increment &&
      run.state.increment <= *run.state.mesh.refused_increment + rest_after_refusal)
    return std::nullopt;
  const double longest = std::max(most_aspect, most_stretch * run.state.mesh.aspect);
  if (const double now = aspect(run); now > longest && !run.state.springs_back)
    return fmt::format("element aspect {:.3g} > {:.3g}", now, longest);
  if (const OutgrownSide side = most_outgrown_side(run);
      side.excess > most_excess * std::max(1.0, run.state.mesh.excess))
    return fmt::format("{} turns by {:.0f} degrees along an edge", run.tools()[side.tool].name,
                       side.turn * 180.0 / std::numbers::pi);
  constexpr double rounding = 1e-9;
  if (settings.interval &&
      run.state.time - run.state.mesh.time >= *settings.interval * (1.0 - rounding))
    return "interval";
  if (settings.penetration
          ? run.attempt.penetration.bound > *settings.penetration
          : run.attempt.penetration.share > std::max(deep, 2.0 * run.state.mesh.share))
    return fmt::format("penetration {:.3g}", run.attempt.penetration.bound);
  const double grown = strain_since_mesh(run);
  if (settings.strain && grown > *settings.strain)
    return fmt::format("plastic strain {:.2g} since the last mesh", grown);
  const double strained =
      run.state.mesh.strain.empty()
          ? 0.0
          : *std::max_element(run.state.mesh.strain.begin(), run.state.mesh.strain.end());
  if (grown > bitten && strained < bitten)
    if (const CornerLoad load = most_at_corner(run); load.share > most_of_corner)
      return fmt::format("{} presses with a corner", run.tools()[load.tool].name);
  if (coarse_contact(run) > coarse_share + run.state.mesh.coarse)
    return fmt::format("contact on edges longer than {:.3g}",
                       most_of_wanted * *settings.size_contact);
  if (const std::optional<ContactZone> zone = zone_to_refine(run))
    return fmt::format("{} touches on {}", run.tools()[idx(zone->tool)].name, sides_of(*zone));
  return std::nullopt;
}

double least_quality(const RemeshSettings& settings, mechanics::ElementKind kind) {
  // The best mesh of triangles has about half the quality of one of squares, and wears on from
  // there.
  constexpr double of_simplices = 0.2, of_others = 0.35;
  return settings.quality.value_or(mechanics::is_simplex(kind) ? of_simplices : of_others);
}

} // namespace billet::process
