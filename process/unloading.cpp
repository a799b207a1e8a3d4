// How tools leave: their surfaces draw back, or their forces fade. (P.5), (P.5a)

#include "geometry/surfaces/retreating_surface.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace billet::process {

/// Whether tools press so that metal could flow under their forces: what they only bend springs
/// back under forces that fade.
bool Process::is_squeezed() const {
  constexpr double little = 1e-2; // of the stress at which it begins to flow
  double force = 0.0;
  for (const contact::ToolLoad& load : contact_->loads())
    force += load.force.norm();
  const mechanics::Material& material = scene_.material;
  return force > little * contact::bearing_area(*contact_) *
                     mechanics::yield_stress(material.flow, {0.0, 0.0, material.temperature});
}

/// Tools that touch stay where they are, those that a load drives as well, and their surfaces draw
/// back until nothing touches them. (P.5)
void Process::draw_tools_back(double until) {
  std::vector<char> stay(scene_.tools.size(), 0);
  if (!is_squeezed()) {
    contact_->activity().enable(std::move(stay));
    return;
  }
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    if (!contact::lies_on(*contact_, t) || !contact_->acts(t, state_.time))
      continue;
    put_on_retreating_surface(t);
    state_.leaving.retreating.push_back(t);
    scene_.tools[t].motion.rests_from = state_.time;
    contact_->activity().rest(t, true);
    stay[t] = 1;
  }
  contact_->activity().enable(std::move(stay));
  state_.leaving.retreat_begins = state_.time;
  state_.leaving.retreat_ends = until;
  state_.leaving.fading_until = until;
}

void Process::put_on_retreating_surface(std::size_t tool) {
  geometry::SurfacePtr& present = scene_.tools[tool].surface;
  auto surface = std::make_unique<geometry::RetreatingSurface>(std::move(present));
  retreating_.push_back({tool, surface.get()});
  present = std::move(surface);
}

/// At first by less than what contact is pressed in by, at last by the size of the body: as the
/// logarithm grows, so that a thousandth of a millimetre and a tenth of the body take as long.
void Process::draw_back_to(double time) {
  const double size = body_size(scene_.mesh);
  constexpr double least = 1e-7; // of the body
  const auto distance = [&](double t) {
    const double share = (t - state_.leaving.retreat_begins) /
                         (state_.leaving.retreat_ends - state_.leaving.retreat_begins);
    return least * size * std::expm1(share * std::log1p(1.0 / least));
  };
  for (const Retreating& each : retreating_) {
    each.surface->set_distance(distance(time));
    contact_->retreat(each.tool, distance(time) - distance(state_.time), distance(time));
  }
}

void Process::put_tools_back() {
  for (const Retreating& each : retreating_) {
    contact::Tool& tool = scene_.tools[each.tool];
    tool.surface = each.surface->give_back();
    tool.motion.rests_from = std::numeric_limits<double>::infinity();
    contact_->retreat(each.tool, 0.0, 0.0);
    contact_->activity().rest(each.tool, false);
  }
  retreating_.clear();
  state_.leaving.retreating.clear();
}

void Process::add_fading(const LeavingTools::Forces& forces) {
  fading_.push_back(mechanics::make_dead_load(
      forces.nodal, TimeFunction({{forces.from, 1.0}, {forces.until, 0.0}})));
  terms_.push_back(fading_.back().get());
}

void Process::release_tools(double next_time, double gone_time) {
  if (!contact_)
    return;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    if (!contact::leaves(*contact_, t, next_time))
      continue;
    // Its forces stay as they are and fade: equilibrium without them is reached on the way.
    const double stored = contact_->work().stored;
    const LeavingTools::Forces forces{contact_->release(t), state_.time, gone_time};
    state_.works.tools_gone += stored - contact_->work().stored;
    add_fading(forces);
    state_.leaving.fading.push_back(forces);
    state_.leaving.fading_until = gone_time;
    state_.last_step.clear();
    state_.snapshots.clear();
  }
}

} // namespace billet::process
