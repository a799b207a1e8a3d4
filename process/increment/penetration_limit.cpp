#include "process/increment/penetration_limit.h"

#include "geometry/base/outcome.h"
#include "geometry/base/stopwatch.h"
#include "process/scene/scene.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"
#include "process/tools/narrow_tools.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

void certify(Run& run, double dt) {
  const Stopwatch timed(run.clock.times.certificate);
  const mechanics::Trial trial = run.trial(dt);
  run.attempt.penetration =
      run.model.contact->certify(trial, run.scene.contact.max_penetration.value_or(HUGE_VAL));
  run.attempt.narrow_radius = -1.0;
  const DeepTool deepest =
      run.model.narrow->deepest(*run.model.contact, trial, run.attempt.penetration.share);
  run.attempt.penetration.bound = std::max(run.attempt.penetration.bound, deepest.depth);
  if (deepest.depth > run.attempt.penetration.sampled) {
    run.attempt.penetration.sampled = deepest.depth;
    run.attempt.penetration.position = deepest.place;
    run.attempt.penetration.tool = deepest.tool;
  }
  if (!(deepest.share > run.attempt.penetration.relative.share))
    return;
  run.attempt.penetration.share = std::max(run.attempt.penetration.share, deepest.share);
  run.attempt.penetration.relative = {deepest.share, deepest.depth, deepest.place, deepest.tool,
                                      deepest.face};
  run.attempt.narrow_radius = deepest.radius;
}

/// The tool where the part is deepest in it, in its frame; may not be found.
geometry::Projection tool_there(const Run& run) {
  const contact::Penetration::Place& deep = run.attempt.penetration.relative;
  const geometry::RigidSurface& surface = *run.tools()[deep.tool].surface;
  const double reach = body_size(run.mesh());
  Vec3 at =
      run.model.contact->pose(deep.tool, run.state.time, run.attempt.x).to_tool(deep.position);
  geometry::Projection foot;
  surface.project({&at, 1}, reach, {&foot, 1});
  if (!foot.found())
    return foot;
  at = foot.foot;
  surface.project({&at, 1}, reach, {&foot, 1});
  return foot;
}

double radius_there(const Run& run) {
  if (run.attempt.narrow_radius >= 0.0)
    return run.attempt.narrow_radius;
  const geometry::Projection foot = tool_there(run);
  if (!foot.found())
    return 0.0;
  const double curvature = foot.dnormal_dx.selfadjointView<Eigen::Lower>().operatorNorm();
  return curvature > 0.0 ? 1.0 / curvature : 0.0;
}

/// The tool where the part is deepest in it, if it is broad.
std::optional<geometry::Projection> broad_tool_there(const Run& run) {
  if (run.attempt.narrow_radius >= 0.0)
    return std::nullopt;
  const geometry::Projection there = tool_there(run);
  return there.found() ? std::optional(there) : std::nullopt;
}

/// How deep the end of a face that stands at an angle to a broad tool may be before the first of
/// contact points, which are away from the end, meets the tool; 0 where the tool is not broad.
/// [mm] (P.41)
///
/// @param faces  those whose points may be the first
double ahead_of_points(const Run& run, std::span<const Index> faces) {
  const std::optional<geometry::Projection> there = broad_tool_there(run);
  if (!there)
    return 0.0;
  const contact::Penetration::Place& deep = run.attempt.penetration.relative;
  const contact::ContactSurface& surface = *run.model.surface;
  const geometry::Pose pose = run.model.contact->pose(deep.tool, run.state.time, run.attempt.x);
  constexpr double one_way = 0.94; // cosine between its normals before the whole face
  const Vec3 into_tool = -(pose.rotation * there->normal);
  double deepest_point = -HUGE_VAL, deepest_end = -HUGE_VAL;
  const std::size_t points = idx(surface.points());
  for (const Index face : faces)
    for (std::size_t k = idx(face) * points; k < (idx(face) + 1) * points; ++k) {
      const Vec3& position = run.model.contact->state().positions[k];
      const Vec3 at = pose.to_tool(position);
      geometry::Projection foot;
      run.tools()[deep.tool].surface->project({&at, 1}, body_size(run.mesh()), {&foot, 1});
      if (!foot.found() || foot.normal.dot(there->normal) < one_way)
        return 0.0;
      deepest_point = std::max(deepest_point, into_tool.dot(position));
    }
  for (const Vec3& end : surface.samples(run.attempt.x, deep.face, 1))
    deepest_end = std::max(deepest_end, into_tool.dot(end));
  return deepest_end - deepest_point;
}

/// The face that is deepest in a tool, and those that share a node with it.
std::vector<Index> faces_around_deepest(const Run& run) {
  const contact::ContactSurface& surface = *run.model.surface;
  const mechanics::Scatter& all = surface.scatter();
  const auto own = all.nodes(run.attempt.penetration.relative.face);
  std::vector<Index> faces;
  const auto n_faces = static_cast<Index>(surface.n_points()) / surface.points();
  for (Index face = 0; face < n_faces; ++face) {
    const auto nodes = all.nodes(face);
    if (std::find_first_of(own.begin(), own.end(), nodes.begin(), nodes.end()) != own.end())
      faces.push_back(face);
  }
  return faces;
}

/// Whether the deepest place is deeper than where contact points could have met the tool.
bool is_unfelt(const Run& run) {
  const contact::Penetration::Place& deep = run.attempt.penetration.relative;
  if (deep.face < 0 || !(deep.depth > deepest_unfelt * run.model.surface->depth(deep.face)))
    return false;
  constexpr double narrow = 0.5, between_points = 0.58; // of the face's length
  const double length = run.model.narrow->length(deep.face);
  const double radius = radius_there(run); // 0 if flat, too
  const double spacing = between_points * length;
  if (radius >= narrow * length && !(deep.depth > 0.125 * spacing * spacing / radius))
    return false;
  return deep.depth > ahead_of_points(run, {&deep.face, 1});
}

Outcome<Done> check_unfelt(const Run& run) {
  const contact::Penetration::Place& deep = run.attempt.penetration.relative;
  if (!is_unfelt(run) || contact::bears_near(*run.model.contact, deep.tool, deep.face))
    return Done{};
  std::string why = fmt::format(
      "tool '{}' lies {:.3g} deep in the workpiece near ({:.6g}, {:.6g}, {:.6g}), {:.0f} % of the "
      "element there ({:.3g}), and no contact point meets it: it is narrower than they are apart. ",
      run.tools()[deep.tool].name, deep.depth, deep.position[0], deep.position[1], deep.position[2],
      100.0 * deep.share, run.model.surface->depth(deep.face));
  constexpr double resolves = 0.25; // an element, of a radius
  if (const double radius = radius_there(run); radius > 0.0)
    why += fmt::format("Take elements of about {:.2g} there", resolves * radius);
  else
    why += "Round its corner or edge, and take elements of a quarter of the radius there";
  return Failure{std::move(why)};
}

bool too_deep(const Run& run) {
  const contact::ContactSettings& settings = run.scene.contact;
  if (settings.max_penetration)
    return run.attempt.penetration.bound > *settings.max_penetration;
  constexpr double unasked = 1e-6; // of the parent element
  return settings.method == contact::Method::augmented &&
         run.attempt.penetration.share_pressed > unasked;
}

std::string penetration_failure(const Run& run, int rounds) {
  const Vec3& at = run.attempt.penetration.position;
  const std::string deep =
      fmt::format("a face lies {:.4g} inside tool '{}' near ({:.6g}, {:.6g}, {:.6g})",
                  run.attempt.penetration.bound, run.tools()[run.attempt.penetration.tool].name,
                  at[0], at[1], at[2]);
  if (!run.scene.contact.max_penetration)
    return deep + fmt::format(" after {} augmentations", rounds);
  const double limit = *run.scene.contact.max_penetration;
  if (run.attempt.penetration.at_points <= limit)
    return deep + fmt::format(", more than max_penetration = {:.4g}, though no contact point is "
                              "deeper than {:.2g}: the tool passes between them, and no pressure "
                              "keeps it out. A finer mesh there lessens it, on quadratic elements "
                              "form = \"compatible\" may; else allow more",
                              limit, run.attempt.penetration.at_points);
  return deep +
         fmt::format(", more than max_penetration = {:.4g}, and contact points {:.2g}, after "
                     "pressing harder {} times: start with a larger contact.penalty, or "
                     "allow more",
                     limit, run.attempt.penetration.at_points, rounds);
}

/// (P.7) A multiplier gains the ratio of the penalty to the body's own stiffness a round: where the
/// penalty is soft that is little, and the penalty is raised as well.
void press_harder(Run& run, double gain) {
  constexpr double enough = 4.0;
  const contact::ContactSettings& settings = run.scene.contact;
  if (settings.method == contact::Method::augmented) {
    run.model.contact->augment();
    if (gain < enough)
      run.model.contact->stiffen(10.0);
    return;
  }
  // Pressing lifts the contact points; what lies deeper between them comes along with them.
  constexpr double aim = 0.5; // of the room that is left to the contact points
  const double between = run.attempt.penetration.bound - run.attempt.penetration.pressed;
  const double room = *settings.max_penetration - between;
  constexpr double least = 2.0, most = 100.0;
  run.model.contact->stiffen(
      room > 0.0 ? std::clamp(run.attempt.penetration.pressed / (aim * room), least, most) : most);
}

/// Presses harder, round by round, until the attempt is no deeper than is allowed.
Outcome<Done> press_until_allowed(Run& run, double dt) {
  constexpr int most_rounds = 8;
  // Once contact points are so much less deep than is allowed, what is too deep lies between them.
  constexpr double negligible = 0.01;
  double gain = HUGE_VAL; // of the last round, at contact points
  for (int round = 0; too_deep(run); ++round) {
    const auto& limit = run.scene.contact.max_penetration;
    if (round == most_rounds || (limit && run.attempt.penetration.pressed <= negligible * *limit)) {
      run.attempt.too_deep = true;
      return Failure{penetration_failure(run, round)};
    }
    press_harder(run, gain);
    const double before = run.attempt.penetration.pressed;
    const auto again = run.model.newton->solve(
        run.model.terms, prescribed(run, run.state.time + dt), run.state.time, run.state.time + dt,
        run.state.x, run.attempt.x, mechanics::Continuation::from_solution);
    if (!again)
      return Failure{penetration_failure(run, round) +
                     "; when pressed harder: " + again.error().reason};
    run.attempt.residual = again->residual;
    certify(run, dt);
    gain = before / run.attempt.penetration.pressed;
  }
  return Done{};
}

} // namespace

bool bounds_penetration(const Run& run) {
  const contact::ContactSettings& settings = run.scene.contact;
  return settings.max_penetration || settings.method == contact::Method::augmented;
}

Outcome<Done> limit_penetration(Run& run, double dt) {
  if (!run.model.contact)
    return Done{};
  certify(run, dt);
  if (bounds_penetration(run))
    if (Outcome<Done> allowed = press_until_allowed(run, dt); !allowed)
      return allowed;
  Outcome<Done> felt = check_unfelt(run);
  run.attempt.too_deep = !felt;
  return felt;
}

void note_deepest_tool(Run& run) {
  const contact::Penetration::Place& deep = run.attempt.penetration.relative;
  if (deep.face < 0)
    return;
  constexpr double slender = 0.7; // elements of another shape are as large as they are thick
  // A splinter of a new mesh, far smaller than any size asked for, is no measure.
  const double size =
      std::max({run.model.surface->depth(deep.face), slender * run.model.narrow->length(deep.face),
                run.state.mesh.shortest});
  DeepestTool& deepest = run.state.record.deepest_tool;
  if (!(deep.depth > deepest.share * size))
    return;
  // The end of a face that meets a broad tool at an angle, as in the bite of a roll, comes first on
  // any mesh; where it comes much too early the mesh is too coarse.
  const double ahead = std::max(0.0, ahead_of_points(run, faces_around_deepest(run)));
  const double share = (deep.depth - (ahead < deepest_unfelt * size ? ahead : 0.0)) / size;
  if (share > deepest.share)
    deepest = {share,          deep.depth, run.attempt.penetration.at_points,
               run.state.time, deep.tool,  deep.position};
}

} // namespace billet::process
