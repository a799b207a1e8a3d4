#include "process/stages/unloading.h"

#include "geometry/base/error.h"
#include "process/scene/scene.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Whether tools press so that metal could flow under their forces: what they only bend springs
/// back under forces that fade.
bool is_squeezed(const Run& run) {
  constexpr double little = 1e-2; // of the stress at which it begins to flow
  double force = 0.0;
  for (const contact::ToolLoad& load : run.model.contact->loads())
    force += load.force.norm();
  const mechanics::Material& material = run.scene.material;
  return force > little * contact::bearing_area(*run.model.contact) *
                     mechanics::yield_stress(material.flow, {0.0, 0.0, material.temperature});
}

/// Tools have their own surfaces again, and rest where they are.
void put_tools_back(Run& run) {
  for (const Retreating& each : run.model.retreating) {
    run.model.tools[each.tool].surface = run.scene.tools[each.tool].surface;
    run.model.contact->retreat(each.tool, 0.0, 0.0);
    run.model.contact->activity().rest(each.tool, false);
  }
  run.model.retreating.clear();
  run.state.leaving.retreating.clear();
}

} // namespace

void put_on_retreating_surface(Run& run, std::size_t tool) {
  auto surface = std::make_shared<geometry::RetreatingSurface>(run.scene.tools[tool].surface);
  run.model.retreating.push_back({tool, surface});
  run.model.tools[tool].surface = std::move(surface);
}

/// Tools that touch stay where they are, those that a load drives as well, and their surfaces draw
/// back until nothing touches them. (P.5)
void draw_tools_back(Run& run, double until) {
  std::vector<char> stay(run.model.tools.size(), 0);
  if (!is_squeezed(run)) {
    run.model.contact->activity().enable(std::move(stay));
    return;
  }
  for (std::size_t t = 0; t < run.model.tools.size(); ++t) {
    if (!contact::lies_on(*run.model.contact, t) || !run.model.contact->acts(t, run.state.time))
      continue;
    put_on_retreating_surface(run, t);
    run.state.leaving.retreating.push_back(t);
    run.model.tools[t].motion.rests_from = run.state.time;
    run.model.contact->activity().rest(t, true);
    stay[t] = 1;
  }
  run.model.contact->activity().enable(std::move(stay));
  run.state.leaving.retreat_begins = run.state.time;
  run.state.leaving.retreat_ends = until;
  run.state.leaving.decay_until = until;
}

/// At first by less than what contact is pressed in by, at last by the size of the body: as the
/// logarithm grows, so that a thousandth of a millimetre and a tenth of the body take as long.
void draw_back_to(Run& run, double time) {
  const double size = body_size(run.mesh());
  constexpr double least = 1e-7; // of the body
  const auto distance = [&](double t) {
    const double share = (t - run.state.leaving.retreat_begins) /
                         (run.state.leaving.retreat_ends - run.state.leaving.retreat_begins);
    return least * size * std::expm1(share * std::log1p(1.0 / least));
  };
  for (const Retreating& each : run.model.retreating) {
    each.surface->set_distance(distance(time));
    run.model.contact->retreat(each.tool, distance(time) - distance(run.state.time),
                               distance(time));
  }
}

void set_tools_going(Run& run) {
  for (contact::Tool& tool : run.model.tools)
    tool.motion.rests_from = std::numeric_limits<double>::infinity();
}

void let_tools_go(Run& run) {
  put_tools_back(run);
  if (run.model.contact)
    run.model.contact->activity().enable(std::vector<char>(run.model.tools.size(), 0));
}

void end_unloading_by(Run& run, double end) {
  LeavingTools& leaving = run.state.leaving;
  const double now = run.state.time;
  if (leaving.decay_until > end && now == end)
    throw Error(Fault::case_file, "",
                fmt::format("at time {:.6g} tools are still being drawn back: a stage cannot end "
                            "there",
                            now),
                "give the stage a later end, or go on from an earlier checkpoint");
  // Begins so that now as much has been done as has been.
  const auto begin = [&](double from, double until) {
    const double done = (now - from) / (until - from);
    return (now - done * end) / (1.0 - done);
  };
  if (!leaving.retreating.empty() && leaving.retreat_ends > end) {
    leaving.retreat_begins = begin(leaving.retreat_begins, leaving.retreat_ends);
    leaving.retreat_ends = end;
  }
  for (LeavingTools::Forces& forces : leaving.decaying)
    if (forces.until > end) {
      forces.from = begin(forces.from, forces.until);
      forces.until = end;
    }
  leaving.decay_until = std::min(leaving.decay_until, end);
}

void add_decaying(Run& run, const LeavingTools::Forces& forces) {
  run.model.decaying.push_back(mechanics::make_dead_load(
      forces.nodal, TimeFunction({{forces.from, 1.0}, {forces.until, 0.0}})));
  run.model.terms.push_back(run.model.decaying.back().get());
}

void release_tools(Run& run, double next_time, double gone_time) {
  if (!run.model.contact)
    return;
  for (std::size_t t = 0; t < run.model.tools.size(); ++t) {
    if (!contact::leaves(*run.model.contact, t, next_time))
      continue;
    // Its forces stay as they are and fade: equilibrium without them is reached on the way.
    const double stored = run.model.contact->work().stored;
    const LeavingTools::Forces forces{run.model.contact->release(t), run.state.time, gone_time};
    run.state.works.tools_gone += stored - run.model.contact->work().stored;
    add_decaying(run, forces);
    run.state.leaving.decaying.push_back(forces);
    run.state.leaving.decay_until = std::max(run.state.leaving.decay_until, gone_time);
    run.state.last_step.clear();
    run.state.snapshots.clear();
  }
}

} // namespace billet::process
