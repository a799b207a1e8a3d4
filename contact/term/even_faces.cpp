// Faces of quadratic elements on which pressure shall not be high and low in turn: their points
// press by what the gaps of all of them say. (C.45)

#include "contact/faces/uneven_pressure.h"
#include "contact/term/contact_term.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace billet::contact {

namespace {

/// Stiffness of a face against what gaps of its points differ by: multiples of E / h. A body's own
/// against such pressures is of that order.
constexpr double stiffness_of_deviations = 1.0;
/// What uneven pressure moves a point by at most: of the element beneath (with more the corner of a
/// billet that sticks sinks in), and of a limit of penetration.
constexpr double relief_of_depth = 0.0004;
constexpr double relief_of_limit = 0.25;
/// A point of an even face that is farther off than this does not press, whatever the others do:
/// of the element beneath.
constexpr double beyond_contact = 0.1;
/// Gap up to which uneven pressure may have lifted a point off, likewise.
constexpr double lifted_off = 0.01;

} // namespace

double ContactTerm::most_relief(std::size_t point) const {
  return std::min(relief_of_depth * surface_->depth(face_of(point)),
                  relief_of_limit * surface_->max_penetration().value_or(HUGE_VAL));
}

double ContactTerm::opening_gap(const ToolState& state, std::size_t point) const {
  const double added = state.history[point].offset + state.history[point].level;
  if (even_face(state, point) != nullptr)
    return beyond_contact * surface_->depth(face_of(point)) - added;
  return touching_gap(point) + carried(state, point) / penalty().normal -
         state.history[point].added();
}

std::vector<char> ContactTerm::faces_lying_on(std::size_t tool) const {
  const ToolState& state = states_[tool];
  std::vector<char> lying(idx(surface_->n_faces()), 0);
  const auto points = idx(surface_->points());
  for (std::size_t k = 0; k < state.history.size(); ++k)
    if (state.history[k].closed())
      lying[k / points] = 1;
  for (std::size_t k = 0; k < state.history.size(); ++k) {
    if (state.history[k].closed())
      continue;
    // Of a point known to be open, the gap when it was asked last.
    const double gap = state.foot[k].found() ? state.foot[k].gap : state.known_gap[k];
    if ((!state.foot[k].found() && gap <= 0.0) || gap > lifted_off * surface_->depth(face_of(k)))
      lying[k / points] = 0;
  }
  return lying;
}

void ContactTerm::choose_even_faces(std::size_t tool) {
  ToolState& state = states_[tool];
  state.even.clear();
  std::fill(state.even_at.begin(), state.even_at.end(), -1);
  if (surface_->straight() || !state.touches)
    return;
  const EvenPressure even =
      even_pressure(*surface_, faces_lying_on(tool), state.history, positions_, areas_);
  const std::vector<double> uneven = uneven_pressure(even, state.history);
  const Index points = surface_->points();
  for (Index f = 0; f < surface_->n_faces(); ++f) {
    const std::size_t first = idx(f * points);
    if (even.known[idx(f)] == 0 || !(even.mean[first] > 0.0))
      continue;
    const Eigen::Map<const Eigen::VectorXd> areas(&areas_[first], points);
    EvenFace face{f, {}, {}};
    face.compliance.weights = areas / areas.sum();
    face.compliance.rise = Eigen::Map<const Eigen::VectorXd>(&even.rise[first], points);
    double stiffness = stiffness_of_deviations * surface_->stiffness();
    for (std::size_t k = first; k < first + idx(points); ++k)
      stiffness = std::max(stiffness, std::abs(uneven[k]) / most_relief(k));
    face.compliance.deviation = stiffness;
    state.even_at[idx(f)] = static_cast<Index>(state.even.size());
    state.even.push_back(std::move(face));
  }
}

void ContactTerm::press_even_faces(ToolState& state, bool keep) const {
  const Index points = surface_->points();
  PointValues gaps(points);
  for (EvenFace& even : state.even) {
    FaceCompliance compliance = even.compliance;
    compliance.mean = penalty().normal;
    // What is pressed harder in this try is pressed harder here, too.
    const double harder = std::max(1.0, stiffening_ / stiffening_old_);
    compliance.deviation = std::min(harder * compliance.deviation, compliance.mean);
    bool pulls = keep;
    for (Index i = 0; i < points; ++i) {
      const std::size_t k = idx(even.face * points + i);
      const PointHistory& history = state.history[k];
      const bool found = state.foot[k].found();
      gaps[i] = (found ? state.foot[k].gap : reach_) + history.offset + history.level;
      compliance.multiplier += compliance.weights[i] * carried(state, k);
      pulls = pulls && found && history.closed();
    }
    even.now = face_pressure(compliance, gaps, pulls);
  }
}

SharedPressure ContactTerm::shared_pressure(const EvenFace& face, std::size_t point) const {
  const auto i = static_cast<Eigen::Index>(point % idx(surface_->points()));
  return {face.now.pressure[i], -face.now.d_gap(i, i)};
}

double ContactTerm::relief(const ToolState& state, std::size_t point) const {
  const PointHistory& history = state.history[point];
  const double gap = state.foot[point].gap + history.offset + history.level;
  const Traction& now = state.trial[point];
  if (now.status == Status::open)
    return std::max(0.0, -gap);
  return (state.multiplier[point] - now.pressure) / penalty().normal - gap;
}

double ContactTerm::pressed_depth(const ToolState& state, std::size_t point) const {
  if (even_face(state, point) != nullptr)
    return (state.trial[point].pressure - state.multiplier[point]) / penalty().normal;
  return -state.foot[point].gap - state.history[point].added();
}

} // namespace billet::contact
