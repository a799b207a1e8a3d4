#include "contact/term/contact_state.h"

#include <limits>

namespace billet::contact {

namespace {

ToolContact untouched(const ContactModel& model, std::size_t tool) {
  const std::size_t n = model.surface->n_points();
  ToolContact made;
  made.committed.history.resize(n);
  made.committed.force.resize(n, Vec3::Zero());
  made.committed.corners.resize(model.corners[tool].size());
  made.committed.averaged_at.resize(idx(model.surface->n_faces()), -1);
  made.trial.traction.resize(n);
  made.trial.position.resize(n, Vec3::Zero());
  made.trial.foot.resize(n);
  made.trial.corners.resize(model.corners[tool].size());
  made.trial.multiplier.resize(n, 0.0);
  made.trial.changes.resize(n, 0);
  made.trial.friction_lagged.resize(n, 0);
  made.trial.touching.resize(n);
  made.search.queried_at.resize(n, Vec3::Zero());
  made.search.known_gap.resize(n, -std::numeric_limits<double>::infinity());
  return made;
}

} // namespace

ContactState::ContactState(const ContactModel& model)
    : activity(model.tools.size()), loads(model.tools.size()), closed(model.tools.size()),
      areas(model.surface->n_points(), 0.0), positions(model.surface->n_points(), Vec3::Zero()) {
  predicted.positions.resize(model.surface->n_points(), Vec3::Zero());
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    tools.push_back(untouched(model, t));
}

} // namespace billet::contact
