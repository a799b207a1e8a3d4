// The part as it is meshed anew: its boundary, sizes, and tools that nodes lie on. (P.14)

#include "geometry/base/error.h"
#include "geometry/mesh2d/closed_creases.h"
#include "geometry/mesh3d/solid_remesher.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/transfer/rate_gradient.h"
#include "process/part_boundary.h"
#include "process/remeshing.h"
#include "process/run.h"
#include "process/solid_part.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace billet::process {

namespace {

/// Faces that touch a tool are off it by up to this share of their length.
constexpr double off = 0.05;

/// How far a place belongs to what touches: 1 among old points that do, falling to 0 halfway to one
/// that does not. A place that is in or out by a hair would go onto the tool in one system of units
/// and stay where it is in another.
double touching_share(const contact::ContactTerm& contact,
                      std::size_t tool,
                      const contact::PointSource& source) {
  double closed = 0.0;
  for (std::size_t k = 0; k < source.points.size(); ++k)
    if (source.weights[k] > 0.0 && contact::closed_on(contact, tool, source.points[k]))
      closed += source.weights[k];
  return std::clamp(2.0 * closed - 1.0, 0.0, 1.0);
}

/// How deep the pressures of old points let a place lie in a tool: as deep as the part is when it
/// is meshed anew. On the tool instead, the part would be swollen by as much, and what each new
/// mesh is off by would fade with the slide (C.41) and take the force along.
double pressed_depth(const contact::ContactTerm& contact,
                     std::size_t tool,
                     const contact::PointSource& source) {
  double depth = 0.0, closed = 0.0;
  for (std::size_t k = 0; k < source.points.size(); ++k)
    if (source.weights[k] > 0.0 && contact::closed_on(contact, tool, source.points[k])) {
      closed += source.weights[k];
      depth += source.weights[k] * contact::depth_of_pressure(contact, tool, source.points[k]);
    }
  return closed > 0.0 ? depth / closed : 0.0;
}

/// Length of the old side that holds a place [mm].
double chord_at(const PartBoundary& boundary, const geometry::BoundaryPlace& place) {
  const std::vector<Vec2>& corners = boundary.loops[idx(place.loop)].corners;
  return (corners[(idx(place.side) + 1) % corners.size()] - corners[idx(place.side)]).norm();
}

/// What sizes are multiplied with for another mesh of the same part.
struct OtherSizes {
  double all;
  double shortest; ///< that the boundary's own curvature may ask for
};

/// With shorter sides than asked for where the boundary turns sharply, if it cannot be meshed
/// otherwise; `sizes` become those it was meshed with.
RemeshedPart remesh_finely_enough(const Scene& scene,
                                  const PartBoundary& boundary,
                                  geometry::RemeshSizes& sizes,
                                  const geometry::Settle& settle) {
  const double least = 0.25 * sizes.min;
  while (true) {
    try {
      return remesh_part(scene, boundary, sizes, settle);
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry || sizes.min <= least)
        throw;
      sizes.min *= 0.5;
    }
  }
}

/// What `make` gives. A fold is welded only where there is no mesh otherwise: first where its walls
/// cross, then where it is narrower than sides of a new mesh are long.
///
/// @param weld  (near, shortest) -> folds that were welded; shortest side of the new mesh
template <class Make, class Weld>
NewPart welded_where_needed(const Make& make, const Weld& weld, double shortest) {
  constexpr std::array<double, 4> nears{0.0, 0.1, 0.3, 1.0}; // of the shortest
  std::vector<Lap> laps;
  std::size_t tried = 0;
  while (true)
    try {
      NewPart part = make();
      part.laps = std::move(laps);
      return part;
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry)
        throw;
      const std::size_t before = laps.size();
      while (laps.size() == before && tried < nears.size())
        for (const auto& fold : weld(nears[tried++] * shortest, shortest))
          laps.push_back(lap(fold));
      if (laps.size() == before)
        throw;
    }
}

} // namespace

std::vector<int> Process::touching_tools() const {
  std::vector<int> touching(scene_.contact_faces.size(), -1);
  for (std::size_t t = 0; contact_ && t < scene_.tools.size(); ++t) {
    for (const contact::ClosedPoint& at : contact_->closed()[t])
      touching[at.point / idx(surface_->points())] = static_cast<int>(t);
    for (const contact::CornerState& corner : contact::corners(*contact_, t))
      if (const auto& foot = corner.press.foot)
        touching[idx(foot->face)] = static_cast<int>(t);
  }
  return touching;
}

Process::UsualSizes Process::usual_sizes() const {
  const RemeshSettings& settings = *scene_.remesh;
  const double usual = settings.size.value_or(state_.mesh.first_side);
  const double at_contact = settings.size_contact.value_or(usual);
  const double finest = std::min(usual, at_contact);
  // Metal that slides round an edge of a tool turns as sharply as the tool does.
  const double of_usual = scene_.mesh.dimension() == 2 ? 0.125 : 0.25;
  constexpr double of_usual_in_zone = 0.0625;
  const double min = settings.size_min.value_or(of_usual * finest);
  return {usual,
          at_contact,
          min,
          settings.size_max.value_or(usual),
          {min, settings.size_min.value_or(of_usual_in_zone * finest)}};
}

std::function<double(const Vec3&)> Process::wanted_size(double turn, double growth) const {
  std::vector<std::size_t> acting;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t)
    if (contact_ && contact_->acts(t, state_.time))
      acting.push_back(t);
  return [this, acting, sizes = usual_sizes(), turn, growth](const Vec3& x) {
    double size = sizes.usual;
    for (const std::size_t t : acting) {
      const Vec3 at = contact_->pose(t, state_.time, state_.x).to_tool(x);
      geometry::Projection foot;
      constexpr double reach = 4.0; // sizes
      scene_.tools[t].surface->project(std::span(&at, 1), reach * sizes.usual, std::span(&foot, 1));
      if (!foot.found())
        continue;
      // Sides turn with the tool's surface, as far as it is near.
      const double curvature = foot.dnormal_dx.norm();
      const double here =
          std::min(sizes.at_contact, curvature > 0.0 ? turn / curvature : sizes.at_contact);
      size = std::min(size, std::max(here, sizes.min) + growth * std::abs(foot.gap));
    }
    return size;
  };
}

geometry::RemeshSizes Process::remesh_sizes() const {
  geometry::RemeshSizes sizes;
  sizes.min = usual_sizes().min;
  sizes.max = usual_sizes().max;
  sizes.wanted = [wanted = wanted_size(sizes.turn, sizes.growth)](const Vec2& x) {
    return wanted(in_space(x));
  };
  return sizes;
}

geometry::SolidSizes Process::solid_sizes() const {
  geometry::SolidSizes sizes;
  sizes.min = usual_sizes().min;
  sizes.max = usual_sizes().max;
  sizes.wanted = wanted_size(sizes.turn, sizes.growth);
  return sizes;
}

std::optional<Vec3>
Process::onto_tool(std::size_t tool, const Vec3& x, const WayToTool& way) const {
  const geometry::Pose pose = contact_->pose(tool, state_.time, state_.x);
  Vec3 there = x;
  constexpr int most_steps = 20;
  constexpr double near = 1e-10, flat = 0.2;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 at = pose.to_tool(there);
    geometry::Projection foot;
    scene_.tools[tool].surface->project(std::span(&at, 1), state_.mesh.first_side,
                                        std::span(&foot, 1));
    if (!foot.found() || (step == 0 && foot.gap > way.most_gap))
      return std::nullopt;
    const double gap = foot.gap + way.depth;
    Vec3 move = -gap * (pose.rotation * foot.normal);
    if (way.fixed == 0)
      return Vec3(there + move);
    if (std::abs(gap) <= near * state_.mesh.first_side)
      return there;
    for (int i = 0; i < 3; ++i)
      if ((way.fixed >> static_cast<unsigned>(i) & 1U) != 0)
        move[i] = 0.0;
    if (move.norm() < flat * std::abs(gap))
      return std::nullopt;
    there += gap * gap / move.squaredNorm() * move; // into the tangent plane of the foot
  }
  return std::nullopt;
}

Vec3 Process::settled(const contact::PointSource& source,
                      const Vec3& x,
                      std::optional<int> tool,
                      const WayToTool& way) const {
  Vec3 result = x;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    if (!contact_->acts(t, state_.time))
      continue;
    // What touches with nothing near it stays, but not inside the tool.
    const bool touches = tool.value_or(static_cast<int>(t)) == static_cast<int>(t);
    const double gap = touches ? way.most_gap * touching_share(*contact_, t, source) : 0.0;
    const double depth = pressed_depth(*contact_, t, source);
    if (const std::optional<Vec3> there =
            onto_tool(t, result, {.most_gap = gap, .depth = depth, .fixed = way.fixed}))
      result = *there;
  }
  return result;
}

std::vector<geometry::SizeAt> Process::sizes_for_flow() const {
  std::vector<double> grown = state_.plastic_rate;
  // A single increment may be short, and rough.
  if (!state_.snapshots.empty() && state_.snapshots.front().time < state_.time)
    for (std::size_t k = 0; k < grown.size(); ++k)
      grown[k] = std::max(0.0, bulk_->states()[k].plastic_strain -
                                   state_.snapshots.front().states[k].plastic_strain);
  constexpr double of_length = 0.5; // of that over which the rate changes by its mean
  constexpr double of_usual = 0.25; // no shorter: corners of tools have no length of their own
  const UsualSizes usual = usual_sizes();
  const double least = std::max(usual.min, of_usual * usual.usual);
  const std::vector<Vec3> points = mechanics::integration_points(scene_.mesh, positions());
  std::vector<geometry::SizeAt> sizes;
  for (const mechanics::RateGradient& flow :
       mechanics::rate_gradients(scene_.mesh, points, grown, bulk_->volumes()))
    if (of_length * flow.length < usual.usual)
      sizes.push_back({flow.at.head<2>(), std::max(least, of_length * flow.length)});
  return sizes;
}

NewPart Process::new_part(const std::vector<geometry::SizeAt>& at) const {
  return scene_.mesh.dimension() == 2 ? new_plane_part(at) : new_solid_part();
}

NewPart Process::new_plane_part(const std::vector<geometry::SizeAt>& at) const {
  PartBoundary boundary = part_boundary(scene_, positions(), touching_tools(), scene_.remesh->keep);
  return welded_where_needed(
      [&] { return new_plane_part_within(boundary, at); },
      [&](double near, double shortest) { return weld_folds(boundary, near, shortest); },
      usual_sizes().min);
}

NewPart Process::new_plane_part_within(const PartBoundary& boundary,
                                       const std::vector<geometry::SizeAt>& at) const {
  const auto stops = std::make_shared<const ContactStops>(boundary, scene_.contact_faces,
                                                          surface_ ? surface_->line_coordinates()
                                                                   : std::vector<double>());
  const bool revolved = scene_.analysis == mechanics::Analysis::axisymmetric;
  geometry::Settle settle;
  if (contact_)
    settle = [this, &boundary, stops, revolved](
                 std::int32_t part, const geometry::BoundaryPlace& place, const Vec2& x) -> Vec2 {
      const Attachment& attached = boundary.attachments[idx(part)];
      if (!attached.contact)
        return x;
      unsigned fixed = fixed_components(scene_, boundary, part, place);
      if (revolved && x.x() == 0.0)
        fixed |= 1U;
      constexpr unsigned both = 3;
      if (fixed == both)
        return x;
      return settled(stops->around(place), in_space(x), attached.tool,
                     {.most_gap = off * chord_at(boundary, place), .fixed = fixed})
          .head<2>();
    };
  geometry::RemeshSizes sizes = remesh_sizes();
  sizes.at = contact_sizes(boundary, usual_sizes().zones);
  sizes.at.insert(sizes.at.end(), at.begin(), at.end());
  const std::vector<geometry::SizeAt> flow = sizes_for_flow();
  sizes.at.insert(sizes.at.end(), flow.begin(), flow.end());
  RemeshedPart part = remesh_finely_enough(scene_, boundary, sizes, settle);
  const auto with_sizes_times = [&](const OtherSizes& other) -> std::optional<RemeshedPart> {
    geometry::RemeshSizes scaled = sizes;
    scaled.min *= other.shortest;
    scaled.wanted = [&sizes, &other](const Vec2& x) { return other.all * sizes.wanted(x); };
    try {
      return remesh_part(scene_, boundary, scaled, settle);
    } catch (const Error&) {
      return std::nullopt; // the first one is there
    }
  };
  // A side that ends awkwardly beside a corner of a tool can spoil one element: others do not.
  constexpr double good = 0.3;
  constexpr std::array<OtherSizes, 5> other_sizes{
      {{0.93, 1.0}, {1.07, 1.0}, {0.87, 1.0}, {1.0, 0.5}, {0.93, 0.5}}};
  const auto quality = [](const RemeshedPart& of) {
    return worst_quality(of.mesh, mechanics::node_positions(of.mesh));
  };
  for (std::size_t i = 0; i < other_sizes.size() && quality(part) < good; ++i) {
    std::optional<RemeshedPart> other = with_sizes_times(other_sizes[i]);
    if (other && quality(*other) > quality(part))
      part = std::move(*other);
  }
  return {part,
          [stops, places = part.places](const contact::ContactSurface& surface,
                                        std::span<const double> /*x*/) {
            return point_sources(*stops, places, surface.line_coordinates());
          },
          {}};
}

NewPart Process::new_solid_part() const {
  SolidPart old = solid_part(scene_, positions(), touching_tools(), scene_.remesh->keep);
  return welded_where_needed([&] { return new_solid_part_within(old); },
                             [&](double near, double shortest) {
                               return geometry::flatten_creases(old.boundary, near, shortest);
                             },
                             usual_sizes().min);
}

NewPart Process::new_solid_part_within(const SolidPart& old) const {
  const auto neighbours = std::make_shared<const ContactNeighbours>(
      old, surface_ ? surface_->face_coordinates() : std::vector<Vec2>());
  const auto supported = [&](std::span<const std::int32_t> parts, Vec3 x, const Vec3& on) {
    for (const std::int32_t part : parts)
      for (std::size_t s = 0; s < scene_.supports.size(); ++s)
        if (old.attachments[idx(part)].supports[s] != 0)
          x[scene_.supports[s].component] = on[scene_.supports[s].component];
    return x;
  };
  const auto settle = [&](std::span<const std::int32_t> parts, const geometry::SurfacePlace& place,
                          const Vec3& x) -> Vec3 {
    const auto& [a, b, c] = old.boundary.mesh.triangles[idx(place.triangle)];
    const std::vector<Vec3>& points = old.boundary.mesh.points;
    const Vec3& first = points[idx(a)];
    const Vec3 on = first + place.v * (points[idx(b)] - first) + place.w * (points[idx(c)] - first);
    const bool may_touch = contact_ && std::any_of(parts.begin(), parts.end(), [&](auto part) {
                             return old.attachments[idx(part)].contact;
                           });
    Vec3 result = supported(parts, x, on);
    // On a support and a tool at once: a few turns lead to where they meet.
    constexpr int turns = 4;
    for (int i = 0; may_touch && i < turns; ++i)
      result = supported(
          parts, settled(neighbours->around(on), result, {}, {.most_gap = state_.mesh.first_side}),
          on);
    return result;
  };
  RemeshedPart part = remesh_part(scene_, old, solid_sizes(), settle);
  return {std::move(part),
          [neighbours](const contact::ContactSurface& surface, std::span<const double> x) {
            std::vector<Vec3> points(surface.n_points());
            surface.positions(x, points);
            std::vector<contact::PointSource> sources;
            sources.reserve(points.size());
            for (const Vec3& point : points)
              sources.push_back(neighbours->around(point));
            return sources;
          }};
}

} // namespace billet::process
