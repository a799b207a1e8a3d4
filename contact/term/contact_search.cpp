#include "contact/term/contact_search.h"

#include "contact/term/averaged_faces.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <limits>
#include <vector>

namespace billet::contact {

namespace {

/// Gaps below this share of the parent element are rounding of coordinates.
constexpr double rounding = 1e-10;

/// Points a task should have at least.
constexpr std::size_t grain = 256;

} // namespace

double touching_gap(const ContactModel& model, std::size_t point) {
  return rounding * model.depth_at(point);
}

double opening_gap(const ContactModel& model,
                   const ToolContact& contact,
                   std::size_t point,
                   const AppliedPenalty& penalty) {
  const PointHistory& history = contact.committed.history[point];
  if (averaged_pressure(contact, model.face_of(point)) != nullptr)
    return opening_gap_of_averaged(model, history, point);
  return touching_gap(model, point) +
         penalty.carried(history, contact.trial.multiplier[point]) / penalty.penalty.normal -
         history.added();
}

void search(const ContactModel& model,
            ToolContact& contact,
            const Tool& tool,
            const geometry::Pose& pose,
            std::span<const Vec3> positions,
            const AppliedPenalty& penalty) {
  TrialContact& trial = contact.trial;
  SearchCache& known = contact.search;
  std::vector<std::size_t> asked;
  std::vector<Vec3> points;
  std::vector<geometry::Projection> feet;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    trial.position[k] = pose.to_tool(positions[k]);
    const double moved = (trial.position[k] - known.queried_at[k]).norm();
    if (known.known_gap[k] > moved + opening_gap(model, contact, k, penalty)) {
      trial.foot[k].gap = std::numeric_limits<double>::infinity();
      continue;
    }
    asked.push_back(k);
    points.push_back(trial.position[k]);
    feet.emplace_back();
    feet.back().patch = trial.foot[k].patch;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked.size(), grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const std::size_t count = range.end() - range.begin();
                      tool.surface->project(std::span(points).subspan(range.begin(), count),
                                            model.reach,
                                            std::span(feet).subspan(range.begin(), count));
                    });
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::size_t k = asked[i];
    trial.foot[k] = feet[i];
    known.queried_at[k] = points[i];
    known.known_gap[k] = feet[i].found() ? feet[i].gap : 0.0;
  }
}

} // namespace billet::contact
