#include "contact/term/averaged_faces.h"

#include "contact/faces/pressure_oscillation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace billet::contact {

namespace {

/// Stiffness of a face against what gaps of its points differ by: multiples of E / h. A body's own
/// against such pressures is of that order.
constexpr double stiffness_of_deviations = 1.0;
/// What pressure oscillation moves a point by at most: of the parent element (with more the corner
/// of a billet that sticks sinks in), and of a limit of penetration.
constexpr double correction_of_depth = 0.0004;
constexpr double correction_of_limit = 0.25;
/// A point of an averaged face that is farther off than this does not press, whatever the others
/// do: of the parent element.
constexpr double beyond_contact = 0.1;
/// Gap up to which pressure oscillation may have lifted a point off: of the parent element.
constexpr double lifted_off = 0.01;

/// What evening the pressure moves a point by at most [mm].
double max_gap_correction(const ContactModel& model, std::size_t point) {
  return std::min(correction_of_depth * model.depth_at(point),
                  correction_of_limit * model.surface->max_penetration().value_or(HUGE_VAL));
}

/// Whether faces lie on a tool, but for points that pressure oscillation may have lifted off.
std::vector<char> faces_lying_on(const ContactModel& model, const ToolContact& contact) {
  const std::vector<PointHistory>& history = contact.committed.history;
  const std::vector<geometry::Projection>& foot = contact.trial.foot;
  std::vector<char> lying(idx(model.surface->n_faces()), 0);
  const auto points = idx(model.surface->points());
  for (std::size_t k = 0; k < history.size(); ++k)
    if (history[k].closed())
      lying[k / points] = 1;
  for (std::size_t k = 0; k < history.size(); ++k) {
    if (history[k].closed())
      continue;
    // Of a point known to be open, the gap when it was asked last.
    const double gap = foot[k].found() ? foot[k].gap : contact.search.known_gap[k];
    if ((!foot[k].found() && gap <= 0.0) || gap > lifted_off * model.depth_at(k))
      lying[k / points] = 0;
  }
  return lying;
}

} // namespace

const FacePressure* averaged_pressure(const ToolContact& contact, Index face) {
  const Index at = contact.committed.averaged_at[idx(face)];
  return at < 0 ? nullptr : &contact.trial.averaged[idx(at)];
}

SharedPressure
shared_pressure(const ContactModel& model, const FacePressure& face, std::size_t point) {
  const auto i = static_cast<Eigen::Index>(point % idx(model.surface->points()));
  return {face.pressure[i], -face.d_gap(i, i)};
}

double
opening_gap_of_averaged(const ContactModel& model, const PointHistory& history, std::size_t point) {
  const double added = history.offset + history.sagitta_offset;
  return beyond_contact * model.depth_at(point) - added;
}

void forget_averaged_faces(ToolContact& contact) {
  contact.committed.averaged.clear();
  contact.trial.averaged.clear();
  std::fill(contact.committed.averaged_at.begin(), contact.committed.averaged_at.end(), -1);
}

void choose_averaged_faces(const ContactModel& model, ContactState& state, std::size_t tool) {
  ToolContact& contact = state.tools[tool];
  CommittedContact& committed = contact.committed;
  forget_averaged_faces(contact);
  if (model.surface->linear() || !committed.touches)
    return;
  const SmoothedPressure smoothed =
      smoothed_pressure(*model.surface, faces_lying_on(model, contact), committed.history,
                        state.positions, state.areas);
  const std::vector<double> oscillation = pressure_oscillation(smoothed, committed.history);
  const Index points = model.surface->points();
  for (Index f = 0; f < model.surface->n_faces(); ++f) {
    const std::size_t first = idx(f * points);
    if (smoothed.known[idx(f)] == 0 || !(smoothed.mean[first] > 0.0))
      continue;
    const Eigen::Map<const Eigen::VectorXd> areas(&state.areas[first], points);
    AveragedFace face{f, {}};
    // In turn: Eigen's sum of numbers in memory depends on where they lie.
    face.compliance.weights =
        areas / std::accumulate(&state.areas[first], &state.areas[first] + points, 0.0);
    face.compliance.rise = Eigen::Map<const Eigen::VectorXd>(&smoothed.rise[first], points);
    double stiffness = stiffness_of_deviations * model.surface->stiffness();
    for (std::size_t k = first; k < first + idx(points); ++k)
      stiffness = std::max(stiffness, std::abs(oscillation[k]) / max_gap_correction(model, k));
    face.compliance.deviation = stiffness;
    committed.averaged_at[idx(f)] = static_cast<Index>(committed.averaged.size());
    committed.averaged.push_back(std::move(face));
  }
  contact.trial.averaged.resize(committed.averaged.size());
}

void press_averaged_faces(const ContactModel& model,
                          const PenaltyFactors& factors,
                          const AppliedPenalty& penalty,
                          bool keep,
                          ToolContact& contact) {
  const Index points = model.surface->points();
  PointValues gaps(points);
  for (std::size_t f = 0; f < contact.committed.averaged.size(); ++f) {
    const AveragedFace& face = contact.committed.averaged[f];
    FaceCompliance compliance = face.compliance;
    compliance.mean = penalty.penalty.normal;
    // What is pressed harder in this try is pressed harder here, too.
    const double harder = std::max(1.0, factors.trial / factors.committed);
    compliance.deviation = std::min(harder * compliance.deviation, compliance.mean);
    bool pulls = keep;
    for (Index i = 0; i < points; ++i) {
      const std::size_t k = idx(face.face * points + i);
      const PointHistory& history = contact.committed.history[k];
      const geometry::Projection& foot = contact.trial.foot[k];
      gaps[i] = (foot.found() ? foot.gap : model.reach) + history.offset + history.sagitta_offset;
      compliance.multiplier +=
          compliance.weights[i] * penalty.carried(history, contact.trial.multiplier[k]);
      pulls = pulls && foot.found() && history.closed();
    }
    contact.trial.averaged[f] = face_pressure(compliance, gaps, pulls);
  }
}

double gap_correction(const ToolContact& contact, std::size_t point, double normal) {
  const PointHistory& history = contact.committed.history[point];
  const double gap = contact.trial.foot[point].gap + history.offset + history.sagitta_offset;
  const Traction& now = contact.trial.traction[point];
  if (now.status == Status::open)
    return std::max(0.0, -gap);
  return (contact.trial.multiplier[point] - now.pressure) / normal - gap;
}

double pressed_depth(const ContactModel& model,
                     const ToolContact& contact,
                     std::size_t point,
                     double normal) {
  const TrialContact& trial = contact.trial;
  if (averaged_pressure(contact, model.face_of(point)) != nullptr)
    return (trial.traction[point].pressure - trial.multiplier[point]) / normal;
  return -trial.foot[point].gap - contact.committed.history[point].added();
}

} // namespace billet::contact
