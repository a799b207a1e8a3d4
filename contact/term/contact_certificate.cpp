// The certificate of an increment: how deep the workpiece lies inside tools, at most. (C.13)

#include "contact/term/contact_term.h"

#include <algorithm>

namespace billet::contact {

namespace {

/// Queries of a tool that a face may cost, on average. Only a face that follows a convex tool comes
/// near it, and then gains little from more.
constexpr std::size_t queries_a_face = 500;

/// Of a limit of penetration: more exactly it need not be known whether it holds.
constexpr double share_of_limit = 0.05;

} // namespace

std::vector<geometry::CandidateFace> ContactTerm::faces_near(const ToolState& state,
                                                             const mechanics::Trial& trial,
                                                             const geometry::Pose& pose) const {
  const std::size_t points = idx(surface_->points());
  std::vector<geometry::CandidateFace> near;
  for (Index f = 0; f < surface_->n_faces(); ++f) {
    const geometry::BezierPatch shape = surface_->patch(trial.x, f).in_tool(pose);
    bool clear = false;
    for (std::size_t k = idx(f) * points; k < (idx(f) + 1) * points && !clear; ++k)
      clear = shape.farthest(state.queried_at[k]) < state.known_gap[k];
    if (!clear)
      near.push_back({shape, surface_->depth(f), idx(f)});
  }
  return near;
}

Penetration ContactTerm::penetration(const mechanics::Trial& trial, double limit) const {
  Penetration worst;
  geometry::BoundSearch search;
  search.reach = reach_;
  for (Index f = 0; f < surface_->n_faces(); ++f)
    search.floor = std::min(search.floor, share_of_limit * limit / surface_->depth(f));
  for (std::size_t t = 0; t < tools_.size(); ++t)
    for (std::size_t k = 0; acts(t, trial.time) && k < states_[t].foot.size(); ++k) {
      const double beneath = surface_->depth(face_of(k));
      const double depth = -states_[t].foot[k].gap;
      if (depth > worst.sampled) {
        worst.sampled = depth;
        worst.position = positions_[k];
        worst.tool = t;
      }
      worst.share = std::max(worst.share, depth / beneath);
      if (depth > worst.relative.share * beneath)
        worst.relative = {depth / beneath, depth, positions_[k], t, face_of(k)};
      const double pressed = pressed_depth(states_[t], k);
      worst.at_points = std::max(worst.at_points, depth);
      worst.pressed = std::max(worst.pressed, pressed);
      worst.share_pressed = std::max(worst.share_pressed, pressed / beneath);
    }
  worst.bound = search.known_depth = worst.sampled;
  search.known_relative = worst.share;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (!acts(t, trial.time))
      continue;
    const geometry::Pose pose = this->pose(t, trial.time, trial.x);
    const std::vector<geometry::CandidateFace> faces = faces_near(states_[t], trial, pose);
    search.most_queries = queries_a_face * faces.size();
    const geometry::PenetrationBound found =
        geometry::bound_penetration(*tools_[t].surface, faces, search);
    worst.bound = std::max(worst.bound, found.bound);
    worst.share = std::max(worst.share, found.relative_bound);
    worst.queries += found.queries;
    if (found.deepest.depth > worst.sampled) {
      worst.sampled = search.known_depth = found.deepest.depth;
      worst.position = pose.to_space(found.deepest.position);
      worst.tool = t;
    }
    const geometry::DeepestSample& relative = found.deepest_relative;
    search.known_relative = std::max(search.known_relative, relative.depth);
    if (relative.depth > worst.relative.share) {
      const auto face = static_cast<Index>(relative.face);
      worst.relative = {relative.depth, relative.depth * surface_->depth(face),
                        pose.to_space(relative.position), t, face};
    }
  }
  return worst;
}

} // namespace billet::contact
