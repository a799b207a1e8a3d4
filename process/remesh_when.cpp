// When the part is meshed anew. (P.15)

#include "geometry/mesh2d/closed_creases.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/remeshing.h"
#include "process/run.h"
#include "process/solid_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

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

} // namespace

std::vector<Vec3> as_points(std::span<const double> x, int dim) {
  std::vector<Vec3> points(x.size() / idx(dim), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i)
    points[i / idx(dim)][static_cast<Index>(i % idx(dim))] = x[i];
  return points;
}

double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x) {
  const std::vector<double> all =
      mechanics::element_qualities(mesh, as_points(x, mesh.dimension()));
  return *std::min_element(all.begin(), all.end());
}

double mean_side(const mechanics::Mesh& mesh) {
  double measure = 0.0;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Vec3> points;
    for (const Index node : mesh.cell(e))
      points.push_back(mesh.points[idx(node)]);
    measure += mechanics::element_measure(mesh.kind, points);
  }
  const bool plane = mesh.dimension() == 2;
  const double of_simplex = plane ? std::numbers::sqrt3 / 4.0 : 1.0 / (6.0 * std::numbers::sqrt2);
  const double share = mechanics::is_simplex(mesh.kind) ? of_simplex : 1.0;
  const double mean = measure / (share * mesh.n_elements());
  return plane ? std::sqrt(mean) : std::cbrt(mean);
}

void Process::start_remeshing() {
  state_.mesh.first_side = mean_side(scene_.mesh);
  state_.mesh.quality = worst_quality(scene_.mesh, positions());
  state_.mesh.aspect = aspect();
  state_.mesh.excess = most_outgrown_side().excess;
  state_.mesh.strain.assign(bulk_->states().size(), 0.0);
}

OutgrownSide Process::most_outgrown_side() const {
  OutgrownSide most;
  if (!scene_.remesh || !contact_ || scene_.mesh.dimension() != 2)
    return most;
  const double turn = remesh_sizes().turn, min = usual_sizes().min;
  const std::vector<Vec3> points = as_points(positions(), 2);
  const std::vector<int> touching = touching_tools();
  for (std::size_t f = 0; f < touching.size(); ++f) {
    if (touching[f] < 0 || leaves(idx(touching[f])))
      continue;
    const std::size_t tool = idx(touching[f]);
    const geometry::Pose pose = contact_->pose(tool, state_.time, state_.x);
    std::vector<Vec3> nodes;
    for (const Index node : scene_.contact_faces[f].nodes)
      nodes.push_back(pose.to_tool(points[idx(node)]));
    std::vector<geometry::Projection> feet(nodes.size());
    scene_.tools[tool].surface->project(nodes, state_.mesh.first_side, feet);
    const double turned = most_between_normals(feet);
    const double length = (nodes[1] - nodes[0]).norm();
    const double excess = length / std::max(min, length * std::min(1.0, turn / turned));
    if (excess > most.excess)
      most = {excess, turned, tool};
  }
  return most;
}

double Process::coarse_contact() const {
  if (!scene_.remesh || !scene_.remesh->size_contact)
    return 0.0;
  const double longest = most_of_wanted * *scene_.remesh->size_contact;
  const int dim = scene_.mesh.dimension();
  const std::vector<Vec3> points = as_points(positions(), dim);
  const std::vector<int> touching = touching_tools();
  double all = 0.0, coarse = 0.0;
  for (std::size_t f = 0; f < touching.size(); ++f) {
    if (touching[f] < 0)
      continue;
    const auto& nodes = scene_.contact_faces[f].nodes;
    const double side = (points[idx(nodes[1])] - points[idx(nodes[0])]).norm();
    const double measure = dim == 2 ? side : side * side;
    all += measure;
    coarse += side > longest ? measure : 0.0;
  }
  return all > 0.0 ? coarse / all : 0.0;
}

double Process::strain_since_mesh() const {
  double grown = 0.0;
  for (std::size_t k = 0; k < state_.mesh.strain.size(); ++k)
    grown = std::max(grown, bulk_->states()[k].plastic_strain - state_.mesh.strain[k]);
  return grown;
}

CornerLoad Process::most_at_corner() const {
  CornerLoad most;
  for (std::size_t t = 0; contact_ && t < scene_.tools.size(); ++t) {
    double at_points = 0.0, at_corner = 0.0;
    for (const contact::ClosedPoint& at : contact_->closed()[t])
      at_points += at.area * at.pressure;
    for (const contact::CornerState& corner : contact::corners(*contact_, t))
      at_corner += corner.press.area * corner.history.pressure;
    if (at_corner > most.share * (at_points + at_corner))
      most = {at_corner / (at_points + at_corner), t};
  }
  return most;
}

double Process::aspect() const {
  return mechanics::largest_aspect(scene_.mesh, as_points(positions(), scene_.mesh.dimension()));
}

bool Process::may_remesh() const {
  return scene_.remesh && state_.leaving.fading_until <= state_.time &&
         state_.increment > state_.mesh.increment;
}

std::vector<ContactZone> Process::zones_of_contact() const {
  if (!contact_ || scene_.mesh.dimension() != 2)
    return {};
  return contact_zones(part_boundary(scene_, positions(), touching_tools(), {}));
}

std::vector<Lap> Process::laps() const {
  constexpr double noticed = 0.25; // of an element: in a hollow corner of a die sides touch
  const std::vector<int> none(scene_.contact_faces.size(), -1);
  const double element = mean_side(scene_.mesh);
  std::vector<Lap> found;
  if (scene_.mesh.dimension() == 2) {
    PartBoundary boundary = part_boundary(scene_, positions(), none, {});
    for (const geometry::ClosedFold& fold : weld_folds(boundary, 0.0, 0.0))
      found.push_back(lap(fold));
  } else {
    SolidPart part = solid_part(scene_, positions(), none, {});
    for (const geometry::ClosedCrease& crease :
         geometry::flatten_creases(part.boundary, 0.0, noticed * element))
      found.push_back(lap(crease));
    if (const auto crease = geometry::cut_at(part.boundary.mesh)) // too deep to be drawn flat
      found.push_back(lap(*crease));
  }
  std::erase_if(found, [&](const Lap& each) { return each.depth < noticed * element; });
  return found;
}

std::vector<ContactZone> Process::poorly_resolved_tools() const {
  std::map<int, ContactZone> longest;
  for (const ContactZone& zone : zones_of_contact())
    if (const auto [known, is_new] = longest.try_emplace(zone.tool, zone);
        !is_new && known->second.too_short())
      known->second = zone;
  std::vector<ContactZone> poor;
  for (const auto& [tool, zone] : longest)
    if (zone.too_short() && indents(zone))
      poor.push_back(zone);
  return poor;
}

// A strip that is bent touches its tools along lines, whatever the mesh; its force is that of the
// bend. With the half width of elastic contact in the plane, 2 F' / E deep to within a logarithm.
bool Process::indents(const ContactZone& zone) const {
  constexpr double of_flow_stress = 0.5, of_work = 0.01;
  double force = 0.0, area = 0.0, weakest = std::numeric_limits<double>::infinity();
  for (const contact::ClosedPoint& at : contact_->closed()[idx(zone.tool)]) {
    force += at.area * at.pressure;
    area += at.area;
    weakest = std::min(weakest, bulk_->trial_flow_stress(surface_->bulk_point(at.point)));
  }
  for (const contact::CornerState& corner : contact::corners(*contact_, idx(zone.tool)))
    force += corner.press.area * corner.history.pressure;
  if (!(area > 0.0))
    return force > 0.0;
  const double pressure = force / area;
  const double work = force * pressure * zone.length / scene_.material.elasticity.young;
  return pressure > of_flow_stress * weakest ||
         work > of_work * (state_.energy.elastic + state_.energy.plastic);
}

bool Process::can_be_refined(const ContactZone& zone) const {
  return zone.too_short() && zone.length > worth_while * static_cast<double>(zone.n_sides) *
                                               usual_sizes().zones.in(zone, zone.length);
}

void Process::note_forces() {
  state_.forces.before = forces_on_tools();
  state_.forces.largest_on_tools.resize(state_.forces.before.size(), 0.0);
  for (std::size_t t = 0; t < state_.forces.before.size(); ++t)
    state_.forces.largest_on_tools[t] =
        state_.forces.before[t] > 0.0
            ? std::max(state_.forces.largest_on_tools[t], state_.forces.before[t])
            : 0.0;
}

bool Process::leaves(std::size_t tool) const {
  constexpr double falling = 0.9, gone = 0.05;
  if (state_.forces.before.empty())
    return false; // nothing has happened yet
  const double force = forces_on_tools()[tool];
  return force < falling * state_.forces.before[tool] ||
         force < gone * state_.forces.largest_on_tools[tool];
}

std::optional<ContactZone> Process::zone_to_refine() const {
  for (const ContactZone& zone : zones_of_contact())
    if (can_be_refined(zone) && !leaves(idx(zone.tool)))
      return zone;
  return std::nullopt;
}

double least_quality(const RemeshSettings& settings, mechanics::ElementKind kind) {
  // The best mesh of triangles has about half the quality of one of squares, and wears on from
  // there.
  constexpr double of_simplices = 0.2, of_others = 0.35;
  return settings.quality.value_or(mechanics::is_simplex(kind) ? of_simplices : of_others);
}

std::string Process::remeshing_due(double left) const {
  if (!may_remesh())
    return {};
  const RemeshSettings& settings = *scene_.remesh;
  const double quality = worst_quality(scene_.mesh, positions());
  const double limit = std::min({least_quality(settings, scene_.mesh.kind),
                                 worn_share * state_.mesh.quality, state_.mesh.refused_quality});
  // Metal that springs back hardly flows: its mesh gets no worse.
  constexpr double of_limit = 0.5;
  if (quality < (state_.springs_back ? of_limit * limit : limit))
    return fmt::format("element quality {:.2g} < {:.2g}", quality, limit);
  if (quality < nearly_due * limit && !state_.springs_back) {
    constexpr double longer = 1.5; // than the last increment: what the next one is at most
    const double next = std::min({longer * state_.last_dt, state_.longest, left});
    const double then = quality_after(next, scene_.mesh, positions(), state_.velocity);
    if (then < worse_share * limit)
      return fmt::format("element quality {:.2g}, in the next increment {:.2g}", quality, then);
  }
  if (state_.mesh.refused_increment &&
      state_.increment <= *state_.mesh.refused_increment + rest_after_refusal)
    return {};
  const double longest = std::max(most_aspect, most_stretch * state_.mesh.aspect);
  if (const double now = aspect(); now > longest && !state_.springs_back)
    return fmt::format("element aspect {:.3g} > {:.3g}", now, longest);
  if (const OutgrownSide side = most_outgrown_side();
      side.excess > most_excess * std::max(1.0, state_.mesh.excess))
    return fmt::format("{} turns by {:.0f} degrees along a side", scene_.tools[side.tool].name,
                       side.turn * 180.0 / std::numbers::pi);
  constexpr double rounding = 1e-9;
  if (settings.interval && state_.time - state_.mesh.time >= *settings.interval * (1.0 - rounding))
    return "interval";
  if (settings.penetration
          ? state_.record.penetration.bound > *settings.penetration
          : state_.record.penetration.share > std::max(deep, 2.0 * state_.mesh.share))
    return fmt::format("penetration {:.3g}", state_.record.penetration.bound);
  const double grown = strain_since_mesh();
  if (settings.strain && grown > *settings.strain)
    return fmt::format("plastic strain {:.2g} since the last mesh", grown);
  const double strained = state_.mesh.strain.empty() ? 0.0
                                                     : *std::max_element(state_.mesh.strain.begin(),
                                                                         state_.mesh.strain.end());
  if (grown > bitten && strained < bitten)
    if (const CornerLoad load = most_at_corner(); load.share > most_of_corner)
      return fmt::format("{} presses with a corner", scene_.tools[load.tool].name);
  if (coarse_contact() > coarse_share + state_.mesh.coarse)
    return fmt::format("contact on sides longer than {:.3g}",
                       most_of_wanted * *settings.size_contact);
  if (const std::optional<ContactZone> zone = zone_to_refine())
    return fmt::format("{} touches on {}", scene_.tools[idx(zone->tool)].name, sides_of(*zone));
  return {};
}

} // namespace billet::process
