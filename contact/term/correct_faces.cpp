// What contact sets on faces at the end of an increment for the next one: the levels of straight
// faces; the springs of quadratic ones. (C.43), (C.44)

#include "contact/surface/straight_faces.h"
#include "contact/term/contact_term.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::contact {

std::vector<geometry::Projection> ContactTerm::feet_around_contact(std::size_t tool) const {
  const ToolState& state = states_[tool];
  const auto points = idx(surface_->points());
  const auto touches = [&](std::size_t face) {
    const auto first = state.history.begin() + static_cast<std::ptrdiff_t>(face * points);
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(points),
                       [](const PointHistory& point) { return point.closed(); });
  };
  // What touches next needs the means of its own nodes as well: two rings of faces around contact.
  std::vector<char> near(idx(pattern_->n_nodes()), 0);
  const auto is_near = [&](std::span<const Index> nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [&](Index a) { return near[idx(a)] != 0; });
  };
  const auto mark = [&](const std::vector<Index>& marked) {
    for (const Index f : marked)
      for (const Index node : surface_->scatter().nodes(f))
        near[idx(node)] = 1;
  };
  std::vector<Index> touching, around;
  for (Index f = 0; f < surface_->n_faces(); ++f)
    if (touches(idx(f)))
      touching.push_back(f);
  mark(touching);
  for (Index f = 0; f < surface_->n_faces(); ++f)
    if (is_near(surface_->scatter().nodes(f)))
      around.push_back(f);
  mark(around);
  std::vector<geometry::Projection> feet(state.foot.size());
  std::vector<std::size_t> missing;
  std::vector<Vec3> places;
  std::vector<geometry::Projection> found;
  for (Index f = 0; f < surface_->n_faces(); ++f) {
    if (!is_near(surface_->scatter().nodes(f)))
      continue;
    for (std::size_t k = idx(f) * points; k < (idx(f) + 1) * points; ++k) {
      feet[k] = state.foot[k];
      if (feet[k].found())
        continue;
      missing.push_back(k); // it is known to be open: nobody has asked
      places.push_back(state.history[k].position);
      found.emplace_back();
      found.back().patch = feet[k].patch;
    }
  }
  tools_[tool].surface->project(places, reach_, found);
  for (std::size_t i = 0; i < missing.size(); ++i)
    feet[missing[i]] = found[i];
  return feet;
}

void ContactTerm::level_faces(std::size_t tool,
                              const geometry::Pose& pose,
                              std::span<const double> x) {
  ToolState& state = states_[tool];
  if (!surface_->straight())
    return;
  std::vector<double> level(state.history.size(), 0.0);
  if (state.touches)
    level = levels(*surface_, x.first(idx(pattern_->n_dofs())), pose, feet_around_contact(tool));
  for (std::size_t k = 0; k < level.size(); ++k) {
    PointHistory& history = state.history[k];
    history.faded += history.level - level[k];
    history.level = level[k];
  }
}

void ContactTerm::stabilize(std::size_t tool,
                            const geometry::Pose& pose,
                            std::span<const double> x) {
  ToolState& state = states_[tool];
  if (surface_->form() != Form::mixed || surface_->straight())
    return;
  work_.enforcement -= state.stabilization.energy(*surface_, x);
  state.stabilization.set(*surface_, state.history, {*tools_[tool].surface, pose, reach_}, x,
                          std::min(surface_->stiffness(), surface_->penalty().normal));
  const double stored = state.stabilization.energy(*surface_, x);
  work_.enforcement += stored;
  state.stored += stored;
}

} // namespace billet::contact
