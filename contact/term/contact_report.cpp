// What a contact term says of its points: their committed state, and those that would not settle.

#include "contact/term/contact_term.h"

#include <algorithm>
#include <limits>

namespace billet::contact {

std::vector<ContactTerm::ChatteringPoint> ContactTerm::chattering() const {
  std::vector<ChatteringPoint> points;
  for (std::size_t t = 0; t < states_.size(); ++t)
    for (std::size_t k = 0; k < positions_.size(); ++k)
      if (states_[t].changes[k] >= chattering_changes)
        points.push_back({t, positions_[k], states_[t].changes[k]});
  std::stable_sort(
      points.begin(), points.end(),
      [](const ChatteringPoint& a, const ChatteringPoint& b) { return a.changes > b.changes; });
  return points;
}

std::vector<PointResult> ContactTerm::results() const {
  std::vector<PointResult> results(positions_.size());
  for (PointResult& point : results)
    point.gap = std::numeric_limits<double>::infinity();
  std::vector<geometry::Projection> feet(positions_.size());
  for (std::size_t t = 0; t < states_.size(); ++t) {
    const ToolState& state = states_[t];
    // Not those of the last trial: it may have failed, and knows nothing of points that are far.
    std::vector<Vec3> positions;
    for (const PointHistory& history : state.history)
      positions.push_back(history.position);
    tools_[t].surface->project(positions, reach_, feet);
    for (std::size_t k = 0; k < results.size(); ++k) {
      PointResult& point = results[k];
      const PointHistory& history = state.history[k];
      point.gap = std::min(point.gap, feet[k].gap);
      point.sliding = std::max(point.sliding, history.sliding);
      point.pressure += history.pressure;
      point.shear += state.committed_rotation * history.shear;
      point.status = std::max(point.status, history.status());
    }
  }
  return results;
}

} // namespace billet::contact
