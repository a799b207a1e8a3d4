// How an increment keeps the limit of penetration: certified, and pressed harder until it holds.
// (P.7)

#include "geometry/base/stopwatch.h"
#include "process/run.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::process {

void Process::certify(double dt) {
  const Stopwatch timed(times_.certificate);
  const mechanics::Trial trial{state_.time, state_.time + dt, state_.x, trial_x_};
  state_.record.penetration =
      contact::penetration(*contact_, trial, scene_.contact.max_penetration.value_or(HUGE_VAL));
  state_.record.narrow_radius = -1.0;
  const DeepTool deepest = narrow_->deepest(*contact_, trial, state_.record.penetration.share);
  state_.record.penetration.bound = std::max(state_.record.penetration.bound, deepest.depth);
  if (deepest.depth > state_.record.penetration.sampled) {
    state_.record.penetration.sampled = deepest.depth;
    state_.record.penetration.position = deepest.place;
    state_.record.penetration.tool = deepest.tool;
  }
  if (!(deepest.share > state_.record.penetration.relative.share))
    return;
  state_.record.penetration.share = std::max(state_.record.penetration.share, deepest.share);
  state_.record.penetration.relative = {deepest.share, deepest.depth, deepest.place, deepest.tool,
                                        deepest.face};
  state_.record.narrow_radius = deepest.radius;
}

void Process::note_deepest_tool() {
  const contact::Penetration::Place& deep = state_.record.penetration.relative;
  if (deep.face < 0)
    return;
  constexpr double slender = 0.7; // elements of another shape are as large as they are thick
  const double size = std::max(surface_->depth(deep.face), slender * narrow_->length(deep.face));
  if (deep.depth > state_.record.deepest_tool.share * size)
    state_.record.deepest_tool = {
        deep.depth / size, deep.depth, state_.record.penetration.at_points,
        state_.time,       deep.tool,  deep.position};
}

double Process::radius_there() const {
  if (state_.record.narrow_radius >= 0.0)
    return state_.record.narrow_radius;
  const contact::Penetration::Place& deep = state_.record.penetration.relative;
  const geometry::RigidSurface& surface = *scene_.tools[deep.tool].surface;
  const double reach = body_size(scene_.mesh);
  Vec3 at = contact_->pose(deep.tool, state_.time, trial_x_).to_tool(deep.position);
  geometry::Projection foot;
  surface.project({&at, 1}, reach, {&foot, 1});
  if (!foot.found())
    return 0.0;
  at = foot.foot;
  surface.project({&at, 1}, reach, {&foot, 1});
  const double curvature = foot.dnormal_dx.selfadjointView<Eigen::Lower>().operatorNorm();
  return foot.found() && curvature > 0.0 ? 1.0 / curvature : 0.0;
}

double Process::most_unfelt() const {
  const Index face = state_.record.penetration.relative.face;
  const double of_depth = deepest_unfelt * surface_->depth(face);
  constexpr double narrow = 0.5, between_points = 0.58; // of the face's length
  const double radius = radius_there();
  if (radius < narrow * narrow_->length(face)) // or flat: it meets them at once
    return of_depth;
  const double spacing = between_points * narrow_->length(face);
  return std::max(of_depth, 0.125 * spacing * spacing / radius);
}

bool Process::lies_in_unfelt(std::string& why) const {
  const contact::Penetration::Place& deep = state_.record.penetration.relative;
  if (deep.face < 0 || !(deep.depth > most_unfelt()) ||
      contact::bears_near(*contact_, deep.tool, deep.face))
    return false;
  why = fmt::format("tool '{}' lies {:.3g} deep in the workpiece near ({:.6g}, {:.6g}, {:.6g}), "
                    "{:.0f} % of the element there ({:.3g}), and no contact point meets it: it is "
                    "narrower than they are apart. ",
                    scene_.tools[deep.tool].name, deep.depth, deep.position[0], deep.position[1],
                    deep.position[2], 100.0 * deep.share, surface_->depth(deep.face));
  constexpr double resolves = 0.25; // an element, of a radius
  if (const double radius = radius_there(); radius > 0.0)
    why += fmt::format("Take elements of about {:.2g} there", resolves * radius);
  else
    why += "Round its corner or edge, and take elements of a quarter of the radius there";
  return true;
}

bool Process::bounds_penetration() const {
  const contact::ContactSettings& settings = scene_.contact;
  return settings.max_penetration || settings.method == contact::Method::augmented;
}

bool Process::too_deep() const {
  const contact::ContactSettings& settings = scene_.contact;
  if (settings.max_penetration)
    return state_.record.penetration.bound > *settings.max_penetration;
  constexpr double unasked = 1e-6; // of the parent element
  return settings.method == contact::Method::augmented &&
         state_.record.penetration.share_pressed > unasked;
}

bool Process::limit_penetration(double dt, std::string& why) {
  if (!contact_)
    return true;
  certify(dt);
  if (!bounds_penetration()) {
    refused_as_too_deep_ = lies_in_unfelt(why);
    return !refused_as_too_deep_;
  }
  constexpr int most_rounds = 8;
  // Once contact points are so much less deep than is allowed, what is too deep lies between them.
  constexpr double negligible = 0.01;
  double gain = HUGE_VAL; // of the last round, at contact points
  for (int round = 0; too_deep(); ++round) {
    const auto& limit = scene_.contact.max_penetration;
    if (round == most_rounds ||
        (limit && state_.record.penetration.pressed <= negligible * *limit)) {
      why = penetration_failure(round);
      refused_as_too_deep_ = true;
      return false;
    }
    press_harder(gain);
    const double before = state_.record.penetration.pressed;
    const auto again =
        newton_->solve(terms_, prescribed(state_.time + dt), state_.time, state_.time + dt,
                       state_.x, trial_x_, mechanics::Continuation::from_solution);
    if (!again) {
      why = penetration_failure(round) + "; when pressed harder: " + again.error().reason;
      return false;
    }
    state_.counters.last_residual = again->residual;
    certify(dt);
    gain = before / state_.record.penetration.pressed;
  }
  refused_as_too_deep_ = lies_in_unfelt(why);
  return !refused_as_too_deep_;
}

/// (P.7) A multiplier gains the ratio of the penalty to the body's own stiffness a round: where the
/// penalty is soft that is little, and the penalty is raised as well.
void Process::press_harder(double gain) {
  constexpr double enough = 4.0;
  const contact::ContactSettings& settings = scene_.contact;
  if (settings.method == contact::Method::augmented) {
    contact_->augment();
    if (gain < enough)
      contact_->stiffen(10.0);
    return;
  }
  // Pressing lifts the contact points; what lies deeper between them comes along with them.
  constexpr double aim = 0.5; // of the room that is left to the contact points
  const double between = state_.record.penetration.bound - state_.record.penetration.pressed;
  const double room = *settings.max_penetration - between;
  constexpr double least = 2.0, most = 100.0;
  contact_->stiffen(room > 0.0
                        ? std::clamp(state_.record.penetration.pressed / (aim * room), least, most)
                        : most);
}

void Process::begin_with_stiffness(double factor) {
  contact_->begin_with_stiffness(factor);
  state_.record.penalty_event = fmt::format("  contact penalty: {:.3g} times that of the case",
                                            contact_->state().penalty.next);
}

/// (C.24)
void Process::adapt_penalty(Progress progress) {
  const contact::ContactSettings& settings = scene_.contact;
  if (!contact_ || bounds_penetration())
    return;
  // Depths of the deepest contact point over that of the parent element, with the penalty that the
  // next increment begins with.
  constexpr double needlessly_small = 1e-6, small = 1e-5, large = 1e-4;
  // Softer lets points sink a little; stiffer throws them out, so it comes in small steps.
  constexpr double softer = 0.1, stiffer = 2.0;
  // Of the stiffness of the parent element over its depth; while nothing says what presses, no
  // softer than the element.
  const bool presses = state_.record.penetration.share_pressed > 0.0;
  const double least = presses ? 1e-3 : 1.0;
  const double next = contact_->state().penalty.next;
  const double share =
      state_.record.penetration.share_pressed * contact_->state().penalty.trial / next;
  const double enough = progress == Progress::none ? small : needlessly_small;
  // At the first touch nothing is pressed yet: only tries that keep failing tell.
  const bool tells = progress == Progress::none || (progress == Progress::laboured && presses);
  if (tells && share < enough && next * settings.penalty > least)
    begin_with_stiffness(softer);
  else if (share > large && next < 1.0)
    begin_with_stiffness(std::min(stiffer, 1.0 / next));
  else if (progress == Progress::easy && share == 0.0 && next < 1.0)
    begin_with_stiffness(1.0 / next); // nothing touches that a stiffer one could throw out
}

std::string Process::penetration_failure(int rounds) const {
  const Vec3& at = state_.record.penetration.position;
  const std::string deep =
      fmt::format("a face lies {:.4g} inside tool '{}' near ({:.6g}, {:.6g}, {:.6g})",
                  state_.record.penetration.bound,
                  scene_.tools[state_.record.penetration.tool].name, at[0], at[1], at[2]);
  if (!scene_.contact.max_penetration)
    return deep + fmt::format(" after {} augmentations", rounds);
  const double limit = *scene_.contact.max_penetration;
  if (state_.record.penetration.at_points <= limit)
    return deep + fmt::format(", more than max_penetration = {:.4g}, though no contact point is "
                              "deeper than {:.2g}: the tool passes between them, and no pressure "
                              "keeps it out. A finer mesh there lessens it, on quadratic elements "
                              "form = \"compatible\" may; else allow more",
                              limit, state_.record.penetration.at_points);
  return deep +
         fmt::format(", more than max_penetration = {:.4g}, and contact points {:.2g}, after "
                     "pressing harder {} times: start with a larger contact.penalty, or "
                     "allow more",
                     limit, state_.record.penetration.at_points, rounds);
}

} // namespace billet::process
