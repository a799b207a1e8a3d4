#include "process/increment/acceptance.h"

#include "geometry/base/outcome.h"
#include "mechanics/elements/mesh_check.h"
#include "process/increment/penetration_limit.h"
#include "process/increment/symmetry_walls.h"
#include "process/scene/scene.h"
#include "process/state/mesh_quality.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/tools/passage_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace billet::process {

namespace {

/// An increment with more plastic strain than this at a point is cut: the return map stays exact,
/// but the path of strain is lost.
constexpr double most_plastic_increment = 0.5;

/// Furthest that a tool or support goes within the increment. [mm]
double furthest_led(const Run& run, double dt, double size) {
  const double from = run.state.time, to = from + dt;
  double way = 0.0;
  for (const contact::Tool& tool : run.tools()) {
    const double turned = std::abs(tool.motion.angle(to) - tool.motion.angle(from));
    way = std::max(way, (tool.motion.translation(to) - tool.motion.translation(from)).norm() +
                            turned * size);
  }
  for (const Support& support : run.part().supports)
    way = std::max(way, std::abs(support.displacement(to) - support.displacement(from)));
  return way;
}

/// Whether the attempt carries the workpiece away, by more than its size and whatever moves it.
bool flies_away(const Run& run, double dt, double size) {
  double furthest = 0.0;
  for (std::size_t i = 0; i < run.n_nodal(); ++i)
    furthest = std::max(furthest, std::abs(run.attempt.x[i] - run.state.x[i]));
  return furthest > size && furthest > size + 2.0 * furthest_led(run, dt, size);
}

Outcome<Done> plausible(Run& run, double dt, double force_scale) {
  if (run.model.bulk->largest_plastic_increment() > most_plastic_increment)
    return Failure{fmt::format("plastic strain increment {:.3g} is too large",
                               run.model.bulk->largest_plastic_increment())};
  const double size = body_size(run.mesh());
  for (std::size_t i = run.n_nodal(); i < run.state.x.size(); ++i)
    if (std::abs(run.attempt.x[i] - run.state.x[i]) > 0.5 * size)
      return Failure{"a driven tool moves away: nothing holds it against its load"};
  if (run.model.stabilization) {
    // The stabilization may carry rounding, never a load: in steps of a share of the body it may go
    // with a tool that pushes it.
    constexpr double most_share = 1e-3;
    constexpr double floor = 1e-7;
    const double scale =
        std::max(force_scale, floor * body_stiffness(run.scene, run.part()) * size);
    if (flies_away(run, dt, size) || run.model.stabilization->force_in(run.trial(dt)) >
                                         most_share * run.model.stabilization->share() * scale) {
      run.attempt.moves_away = true;
      return Failure{"the workpiece moves away freely: neither supports nor contact hold it"};
    }
  }
  return Done{};
}

} // namespace

Outcome<Done> check_shape(Run& run) {
  constexpr double inside_out = -0.05; // quality; where sides fold onto a die it may come to zero
  const mechanics::Mesh& mesh = run.mesh();
  const auto qualities =
      mechanics::element_qualities(mesh, as_points(run.trial_positions(), mesh.dimension()));
  const auto worst = std::min_element(qualities.begin(), qualities.end());
  run.attempt.quality = *worst;
  if (*worst > inside_out || *worst >= worst_quality(mesh, run.positions()))
    return Done{};
  const auto element = static_cast<Index>(worst - qualities.begin());
  const auto nodes = mesh.cell(element);
  const auto dim = idx(mesh.dimension());
  Vec3 middle = Vec3::Zero();
  for (const Index node : nodes)
    for (std::size_t d = 0; d < dim; ++d)
      middle[static_cast<Index>(d)] +=
          run.attempt.x[idx(node) * dim + d] / static_cast<double>(nodes.size());
  std::string why =
      fmt::format("element {} near ({:.6g}, {:.6g}, {:.6g}) turns inside out (quality {:.2g})",
                  element, middle[0], middle[1], middle[2], *worst);
  if (!run.scene.remesh)
    why += ": one mesh cannot follow the metal any further, a [remesh] section goes on from there";
  return Failure{std::move(why)};
}

Outcome<Done> check_passages(const Run& run, double dt) {
  if (!run.model.contact)
    return Done{};
  const mechanics::Trial trial = run.trial(dt);
  Outcome<Done> outside =
      check_passages(run.tools(), *run.model.surface, *run.model.contact, trial);
  if (!outside)
    return outside;
  const auto met = run.model.narrow->met_on_the_way(*run.model.contact, trial);
  if (met)
    return Failure{fmt::format(
        "tool '{}' goes into the workpiece on the way of the increment, at ({:.6g}, {:.6g}, "
        "{:.6g})",
        run.tools()[met->tool].name, met->place[0], met->place[1], met->place[2])};
  return Done{};
}

namespace {

/// No point of the surface may have gone through another face of the part.
Outcome<Done> check_self_passages(const Run& run, double dt) {
  if (!run.model.self_contact)
    return Done{};
  const auto passage = run.model.self_contact->passage(run.trial(dt));
  if (!passage)
    return Done{};
  return Failure{fmt::format("the workpiece goes through itself on the way of the increment, at "
                             "({:.6g}, {:.6g}, {:.6g})",
                             passage->place[0], passage->place[1], passage->place[2])};
}

} // namespace

Outcome<Done> check_solution(Run& run, double dt, double force_scale) {
  run.attempt.inside_out = run.attempt.moves_away = false;
  if (Outcome<Done> sound = plausible(run, dt, force_scale); !sound)
    return sound;
  if (Outcome<Done> outside = check_walls(run); !outside)
    return outside;
  if (Outcome<Done> outside = check_self_passages(run, dt); !outside)
    return outside;
  if (Outcome<Done> outside = check_passages(run, dt); !outside)
    return outside;
  if (Outcome<Done> within_limit = limit_penetration(run, dt); !within_limit)
    return within_limit;
  Outcome<Done> sound = check_shape(run);
  run.attempt.inside_out = !sound;
  return sound;
}

} // namespace billet::process
