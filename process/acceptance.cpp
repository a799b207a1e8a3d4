// Whether an increment that Newton's method has solved may be accepted. (P.3), (P.9), (P.41)

#include "mechanics/elements/mesh_check.h"
#include "process/passage_guard.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::process {

namespace {

/// An increment with more plastic strain than this at a point is cut: the return map stays exact,
/// but the path of strain is lost.
constexpr double most_plastic_increment = 0.5;

} // namespace

bool Process::plausible(double dt, double force_scale, std::string& why) const {
  if (bulk_->largest_plastic_increment() > most_plastic_increment) {
    why = fmt::format("plastic strain increment {:.3g} is too large",
                      bulk_->largest_plastic_increment());
    return false;
  }
  for (std::size_t i = state_.origins.size(); i < state_.x.size(); ++i)
    if (std::abs(trial_x_[i] - state_.x[i]) > 0.5 * body_size(scene_.mesh)) {
      why = "a driven tool moves away: nothing holds it against its load";
      return false;
    }
  if (stabilization_) {
    // The stabilization may carry rounding, never a load: in steps of a share of the body it may go
    // with a tool that pushes it.
    constexpr double most_share = 1e-3;
    constexpr double floor = 1e-7;
    const double scale = std::max(force_scale, floor * body_stiffness() * body_size(scene_.mesh));
    if (stabilization_->force_in({state_.time, state_.time + dt, state_.x, trial_x_}) >
        most_share * stabilization_->share() * scale) {
      why = "the workpiece moves away freely: neither supports nor contact hold it";
      return false;
    }
  }
  return true;
}

bool Process::turns_inside_out(std::string& why) {
  constexpr double inside_out = -0.05; // quality; where sides fold onto a die it may come to zero
  const auto qualities = mechanics::element_qualities(
      scene_.mesh,
      as_points(std::span(trial_x_).first(state_.origins.size()), scene_.mesh.dimension()));
  const auto worst = std::min_element(qualities.begin(), qualities.end());
  state_.record.trial_quality = *worst;
  if (*worst > inside_out || *worst >= worst_quality(scene_.mesh, positions()))
    return false;
  const auto element = static_cast<Index>(worst - qualities.begin());
  const auto nodes = scene_.mesh.cell(element);
  const auto dim = idx(scene_.mesh.dimension());
  Vec3 middle = Vec3::Zero();
  for (const Index node : nodes)
    for (std::size_t d = 0; d < dim; ++d)
      middle[static_cast<Index>(d)] +=
          trial_x_[idx(node) * dim + d] / static_cast<double>(nodes.size());
  why = fmt::format("element {} near ({:.6g}, {:.6g}, {:.6g}) turns inside out (quality {:.2g})",
                    element, middle[0], middle[1], middle[2], *worst);
  if (!scene_.remesh)
    why += ": one mesh cannot follow the metal any further, a [remesh] section goes on from there";
  return true;
}

bool Process::passes_through(double dt, std::string& why) const {
  if (contact_)
    why = passage_complaint(scene_.tools, *surface_, *contact_,
                            {state_.time, state_.time + dt, state_.x, trial_x_});
  if (!contact_ || !why.empty())
    return contact_ != nullptr;
  const auto met =
      narrow_->met_on_the_way(*contact_, {state_.time, state_.time + dt, state_.x, trial_x_});
  if (met)
    why = fmt::format("tool '{}' goes into the workpiece on the way of the increment, at ({:.6g}, "
                      "{:.6g}, {:.6g})",
                      scene_.tools[met->tool].name, met->place[0], met->place[1], met->place[2]);
  return met.has_value();
}

} // namespace billet::process
