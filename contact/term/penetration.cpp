#include "contact/term/penetration.h"

#include "contact/term/averaged_faces.h"
#include "geometry/collision/penetration_bound.h"

#include <algorithm>
#include <vector>

namespace billet::contact {

namespace {

/// Queries of a tool that a face may cost, on average. Only a face that follows a convex tool comes
/// near it, and then gains little from more.
constexpr std::size_t queries_a_face = 500;

/// Of a limit of penetration: more exactly it need not be known whether it holds.
constexpr double share_of_limit = 0.05;

/// Faces that known distances do not keep clear of a tool, in its frame.
std::vector<geometry::CandidateFace> faces_near(const ContactSurface& surface,
                                                const SearchCache& known,
                                                std::span<const double> x,
                                                const geometry::Pose& pose) {
  const std::size_t points = idx(surface.points());
  std::vector<geometry::CandidateFace> near;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const geometry::BezierPatch shape = surface.patch(x, f).in_tool(pose);
    bool clear = false;
    for (std::size_t k = idx(f) * points; k < (idx(f) + 1) * points && !clear; ++k)
      clear = shape.farthest(known.queried_at[k]) < known.known_gap[k];
    if (!clear)
      near.push_back({shape, surface.depth(f), idx(f)});
  }
  return near;
}

/// Takes the contact points in.
void look_at_points(const ContactView& contact, std::size_t t, Penetration& worst) {
  const auto& [model, state] = contact;
  const ToolContact& tool = state.tools[t];
  const double normal = applied_penalty(*model.surface, state.penalty).penalty.normal;
  for (std::size_t k = 0; k < tool.trial.foot.size(); ++k) {
    const double parent_depth = model.depth_at(k);
    const double depth = -tool.trial.foot[k].gap;
    if (depth > worst.sampled) {
      worst.sampled = depth;
      worst.position = state.positions[k];
      worst.tool = t;
    }
    worst.share = std::max(worst.share, depth / parent_depth);
    if (depth > worst.relative.share * parent_depth)
      worst.relative = {depth / parent_depth, depth, state.positions[k], t, model.face_of(k)};
    const double pressed = pressed_depth(model, tool, k, normal);
    worst.at_points = std::max(worst.at_points, depth);
    worst.pressed = std::max(worst.pressed, pressed);
    worst.share_pressed = std::max(worst.share_pressed, pressed / parent_depth);
  }
}

/// Takes in what is between the points.
void look_at_faces(const ContactModel& model,
                   std::size_t t,
                   const geometry::Pose& pose,
                   const geometry::PenetrationBound& found,
                   Penetration& worst) {
  worst.bound = std::max(worst.bound, found.bound);
  worst.share = std::max(worst.share, found.relative_bound);
  worst.queries += found.queries;
  if (found.deepest.depth > worst.sampled) {
    worst.sampled = found.deepest.depth;
    worst.position = pose.to_space(found.deepest.position);
    worst.tool = t;
  }
  const geometry::DeepestSample& relative = found.deepest_relative;
  if (relative.depth > worst.relative.share) {
    const auto face = static_cast<Index>(relative.face);
    worst.relative = {relative.depth, relative.depth * model.surface->depth(face),
                      pose.to_space(relative.position), t, face};
  }
}

} // namespace

Penetration penetration(const ContactModel& model,
                        ContactState& state,
                        const mechanics::Trial& trial,
                        double limit) {
  const ContactView contact{model, state};
  const ContactSurface& surface = *model.surface;
  Penetration worst;
  geometry::BoundSearch search;
  search.reach = model.reach;
  for (Index f = 0; f < surface.n_faces(); ++f)
    search.floor = std::min(search.floor, share_of_limit * limit / surface.depth(f));
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (contact.acts(t, trial.time))
      look_at_points(contact, t, worst);
  worst.bound = search.known_depth = worst.sampled;
  search.known_relative = worst.share;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    if (!contact.acts(t, trial.time))
      continue;
    const geometry::Pose pose = model.pose(t, trial.time, trial.x);
    const std::vector<geometry::CandidateFace> faces =
        faces_near(surface, state.tools[t].search, trial.x, pose);
    search.most_queries = queries_a_face * faces.size();
    const geometry::PenetrationBound found = geometry::bound_penetration(
        *model.tools[t].surface, faces, search, state.tools[t].search.clear);
    look_at_faces(model, t, pose, found, worst);
    search.known_depth = std::max(search.known_depth, found.deepest.depth);
    search.known_relative = std::max(search.known_relative, found.deepest_relative.depth);
  }
  return worst;
}

} // namespace billet::contact
