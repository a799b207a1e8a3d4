#include "process/remeshing/sizes.h"

#include "geometry/size_field.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/transfer/rate_gradient.h"
#include "process/remeshing/parted_walls.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

UsualSizes usual_sizes(const Run& run) {
  const RemeshSettings& settings = *run.scene.remesh;
  const double usual = settings.size.value_or(run.state.mesh.first_side);
  const double at_contact = settings.size_contact.value_or(usual);
  const double finest = std::min(usual, at_contact);
  // Metal that slides round an edge of a tool turns as sharply as the tool does.
  const double of_usual = run.mesh().dimension() == 2 ? 0.125 : 0.25;
  constexpr double of_usual_in_zone = 0.0625;
  const double min = settings.size_min.value_or(of_usual * finest);
  return {usual,
          at_contact,
          min,
          settings.size_max.value_or(usual),
          {min, settings.size_min.value_or(of_usual_in_zone * finest)}};
}

double shortest_size(const Run& run) {
  const UsualSizes sizes = usual_sizes(run);
  return run.mesh().dimension() == 2
             ? std::min({sizes.min, sizes.zones.min, sizes.zones.min_in_longest})
             : sizes.min;
}

namespace {

/// Size asked for at a place by tools that are near. [mm]
std::function<double(const Vec3&)> wanted_size(const Run& run, double turn, double growth) {
  std::vector<std::size_t> acting;
  for (std::size_t t = 0; t < run.tools().size(); ++t)
    if (run.model.contact && run.model.contact->acts(t, run.state.time))
      acting.push_back(t);
  return [&run, acting, sizes = usual_sizes(run), turn, growth](const Vec3& x) {
    double size = sizes.usual;
    for (const std::size_t t : acting) {
      const Vec3 at = run.model.contact->pose(t, run.state.time, run.state.x).to_tool(x);
      geometry::Projection foot;
      constexpr double reach = 4.0; // sizes
      run.tools()[t].surface->project(std::span(&at, 1), reach * sizes.usual, std::span(&foot, 1));
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

/// Longest side that passes over ripples: of the usual size, and none near walls that touch each
/// other, whose ripples lie in each other.
std::function<double(const Vec2&)> over_ripples(const Run& run) {
  const double usual = usual_sizes(run).usual;
  if (!touches_itself(run))
    return [usual](const Vec2& /*x*/) { return usual; };
  const contact::ContactSurface& surface = *run.model.surface;
  std::vector<Vec3> positions(surface.n_points());
  surface.positions(run.positions(), positions);
  std::vector<geometry::SizeSample> touching;
  const auto& points = run.model.self_contact->state().points;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].closed())
      touching.push_back({positions[k].head<2>(), 0.0});
  const geometry::SizeField distance(std::move(touching), 2.0 * usual, 1.0);
  return [distance, usual](const Vec2& x) { return distance(x) < usual ? 0.0 : usual; };
}

} // namespace

geometry::RemeshSizes remesh_sizes(const Run& run) {
  geometry::RemeshSizes sizes;
  sizes.min = usual_sizes(run).min;
  sizes.max = usual_sizes(run).max;
  sizes.wanted = [wanted = wanted_size(run, sizes.turn, sizes.growth)](const Vec2& x) {
    return wanted(in_space(x));
  };
  sizes.over_ripples = over_ripples(run);
  return sizes;
}

geometry::SolidSizes solid_sizes(const Run& run) {
  geometry::SolidSizes sizes;
  sizes.min = usual_sizes(run).min;
  sizes.max = usual_sizes(run).max;
  sizes.wanted = wanted_size(run, sizes.turn, sizes.growth);
  return sizes;
}

std::vector<geometry::SizeAt> sizes_for_flow(const Run& run) {
  std::vector<double> grown = run.state.plastic_rate;
  // A single increment may be short, and rough.
  if (!run.state.snapshots.empty() && run.state.snapshots.front().time < run.state.time)
    for (std::size_t k = 0; k < grown.size(); ++k)
      grown[k] = std::max(0.0, run.model.bulk->states()[k].plastic_strain -
                                   run.state.snapshots.front().states[k].plastic_strain);
  constexpr double of_length = 0.5; // of that over which the rate changes by its mean
  constexpr double of_usual = 0.25; // no shorter: corners of tools have no length of their own
  const UsualSizes usual = usual_sizes(run);
  const double least = std::max(usual.min, of_usual * usual.usual);
  const std::vector<Vec3> points = mechanics::integration_points(run.mesh(), run.positions());
  std::vector<geometry::SizeAt> sizes;
  for (const mechanics::RateGradient& flow :
       mechanics::rate_gradients(run.mesh(), points, grown, run.model.bulk->volumes()))
    if (of_length * flow.length < usual.usual)
      sizes.push_back({flow.at.head<2>(), std::max(least, of_length * flow.length)});
  return sizes;
}

} // namespace billet::process
