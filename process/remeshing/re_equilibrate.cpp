#include "process/remeshing/re_equilibrate.h"

#include "process/control/increment_control.h"
#include "process/energy/balance.h"
#include "process/increment/bent_increment.h"
#include "process/increment/commit.h"
#include "process/increment/fallbacks.h"
#include "process/increment/increment_report.h"
#include "process/increment/snapshots.h"
#include "process/increment/symmetry_walls.h"
#include "process/remeshing/free_surface.h"
#include "process/remeshing/mapped_states.h"
#include "process/reports/run_reports.h"
#include "process/stages/stage_start.h"
#include "process/stages/turning_tools.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/state/stored_models.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Gives the part on its new mesh a volume by moving the surface that touches no tool. (P.21)
void restore_part_volume(Run& run,
                         double volume,
                         const contact::ContactSnapshot& contact,
                         std::span<const contact::PointSource> sources) {
  const auto touches = [&](const contact::PointSource& source) {
    return std::any_of(contact.history.begin(), contact.history.end(),
                       [&](const auto& tool) { return tool[source.nearest()].closed(); });
  };
  std::vector<char> touching(run.part().contact_faces.size(), 0);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (touches(sources[i]))
      touching[i / idx(run.model.surface->points())] = 1;
  constexpr double furthest = 0.01; // of an element: what the shape may change by unseen
  constexpr double of_quality =
      0.5; // at a place much smaller than elements it turns them inside out
  const std::vector<double> before = run.state.x;
  const double least = of_quality * worst_quality(run.mesh(), run.positions());
  restore_volume(
      run.state.x, free_normals(run.part(), run.positions(), touching),
      [&run](std::span<const double> x) { return run.model.bulk->volume(x); }, volume,
      furthest * run.state.mesh.first_side);
  if (worst_quality(run.mesh(), run.positions()) < least)
    run.state.x = before;
}

/// The way of a press that strikes from where it was in a state to where it is now: a parabola with
/// the speed of the last increment, or even where it would have turned back on that. (P.47)
LedPress led_press(std::size_t unknown, const Snapshot& from, const Snapshot& now) {
  const double way = now.x[unknown] - from.x[unknown], time = now.time - from.time;
  const double even = time > 0.0 ? way / time : 0.0;
  if (now.last_step.empty() || time <= now.last_dt)
    return {unknown, now.time, now.x[unknown], even, 0.0};
  const double last = now.last_step[unknown] / now.last_dt;
  const double acceleration = 2.0 * (last - even) / (time - now.last_dt);
  const double speed = last + 0.5 * acceleration * now.last_dt; // the last one was in its middle
  const double first = speed - acceleration * time;
  if (speed * way < 0.0 || first * way < 0.0)
    return {unknown, now.time, now.x[unknown], even, 0.0};
  return {unknown, now.time, now.x[unknown], speed, acceleration};
}

/// Leads presses that strike from where they were in a state to where they are now. What a blow has
/// done stays as it was.
void lead_presses(Run& run, const Snapshot& from, const Snapshot& now) {
  run.attempt.led.clear();
  if (!run.model.blows)
    return;
  for (const std::size_t tool : run.model.blows->tools())
    run.attempt.led.push_back(led_press(run.model.blows->unknown(tool), from, now));
}

/// Goes on from a state that has been mapped to the present mesh, and notes what that has changed.
///
/// @param end  of the way that is gone from there
void start_from(Run& run,
                const MappedState& at,
                const Snapshot& end,
                std::span<const contact::PointSource> sources,
                RemeshReport& report) {
  const Snapshot& to = at.state;
  run.state.time = to.time;
  run.state.x = to.x;
  if (std::all_of(report.laps.begin(), report.laps.end(), [](const Lap& lap) { return lap.root; }))
    // What lay in a lap that has been welded is gone.
    restore_part_volume(run, at.before.volume, to.contact, sources);
  run.attempt.x = run.state.x;
  run.state.velocity = to.velocity;
  run.state.last_step = to.last_step;
  run.state.last_dt = to.last_dt;
  run.model.bulk->adopt(run.state.x, to.states, to.temperatures, to.plastic_work);
  run.model.bulk->keep_volume(to.reference_volume);
  run.state.plastic_rate = to.plastic_rate;
  run.state.reactions.assign(run.n_nodal(), 0.0);
  run.state.works.supports = to.support_work;
  run.state.works.loads_before = to.load_work;
  for (const auto& load : run.model.loads)
    run.state.works.loads_before -= load->work(); // of a way that is not taken
  run.state.energy.stabilization = to.stabilization;
  if (run.model.contact) {
    run.model.contact->start(run.state.x, run.state.time);
    run.model.contact->go_on_from(to.contact, {sources, run.state.x, run.state.time});
  }
  if (run.model.self_contact)
    run.model.self_contact->go_on_from(to.self_contact, sources, run.state.x);
  if (run.model.trapped)
    run.model.trapped->go_on_from(to.trapped, run.state.x, run.state.time);
  lead_presses(run, to, end);
  hold_where_on_walls(run);
  FieldIntegrals after = field_integrals(*run.model.bulk, to);
  after.volume = run.model.bulk->volume(run.state.x);
  report.returned = at.returned;
  report.volume = {at.before.volume, after.volume};
  report.plastic_work = {at.before.plastic_work, after.plastic_work};
  report.mean_strain = {at.before.mean_strain, after.mean_strain};
  report.largest_strain = {at.before.largest_strain, after.largest_strain};
}

double jump_from(const Run& run, std::span<const double> before) {
  const std::vector<double> now = forces_on_tools(run);
  RemeshReport report;
  for (std::size_t t = 0; t < now.size(); ++t)
    report.forces.push_back({before[t], now[t]});
  return report.force_jump();
}

bool restore_balance(Run& run, RemeshReport& report) {
  // In next to no time rate laws neither flow nor relax.
  constexpr double share_of_increment = 1e-6;
  const double dt = share_of_increment * run.state.last_dt;
  run.attempt.x = run.state.x;
  if (run.model.contact)
    run.model.contact->restart();
  const auto outcome =
      run.model.newton->solve(run.model.terms, prescribed(run, run.state.time), run.state.time - dt,
                              run.state.time, run.state.x, run.attempt.x);
  if (!run.model.newton->records().empty())
    report.residual = run.model.newton->records().front().residual;
  if (!outcome)
    return false;
  const mechanics::Trial trial{run.state.time - dt, run.state.time, run.state.x, run.attempt.x};
  for (mechanics::ForceTerm* term : run.model.terms)
    term->commit(trial);
  for (const Index i : prescribed_by_supports(run, run.state.time).unknowns)
    run.state.reactions[idx(i)] = run.model.newton->residual()[idx(i)];
  run.state.x = run.attempt.x;
  return true;
}

int solve_again(Run& run, const Snapshot& end) {
  const double length = end.time - run.state.time;
  constexpr double shortest = 1.0 / 1024.0; // of that
  const double longest = std::min(run.state.longest, length);
  IncrementControl control({std::min(run.state.last_dt, longest), shortest * length, longest});
  run.state.last_step = end.x;
  for (std::size_t i = 0; i < run.state.x.size(); ++i)
    run.state.last_step[i] -= run.state.x[i];
  run.state.last_dt = length;
  const int iterations = run.attempt.iterations;
  int solved = 0, failures = 0;
  while (run.state.time < end.time && !control.exhausted()) {
    const double landing = next_landing(run, end.time);
    const double left = landing - run.state.time;
    const double step = control.in_parts() ? part_towards(left, control.next())
                                           : step_towards(left, up_to_turn(run, control.next()));
    const bool lands = step == landing - run.state.time;
    run.attempt.too_deep = run.attempt.inside_out = false;
    const bool is_shortest = 0.5 * step < shortest * length;
    if (solve_by_any_way(run, step, {.failed_before = failures > 0 || is_shortest})) {
      if (const std::optional<Bend> bend =
              bend_within(run, step, run.state.progress.length, shortest * length)) {
        control.split(step, bend->share, run.attempt.iterations);
        continue;
      }
      commit(run, step);
      hold_on_walls(run);
      if (lands)
        run.state.time = landing;
      control.accepted(step, run.attempt.iterations);
      ++solved;
      failures = 0;
    } else {
      ++failures;
      control.failed(step);
    }
  }
  run.attempt.iterations = iterations;
  return run.state.time == end.time ? solved : 0;
}

/// States to begin from in the order in which they are tried: in the plane the two latest, which
/// are the least work, then the earliest on; in space, where forces jump by more after a short way,
/// the earliest on.
std::vector<const MappedState*> in_order_of_trial(const std::vector<MappedState>& begun,
                                                  bool plane) {
  constexpr std::size_t late = 2;
  std::vector<const MappedState*> order;
  for (std::size_t k = 1; plane && k <= late && k < begun.size(); ++k)
    order.push_back(&begun[begun.size() - k]);
  const std::size_t rest = begun.size() - order.size();
  for (std::size_t k = 0; k < rest; ++k)
    order.push_back(&begun[k]);
  return order;
}

/// Whether the way from a state to the present can be gone again on the new mesh.
bool goes_through(Run& run,
                  const MappedState& from,
                  const MappedStates& mapped,
                  RemeshReport& report) {
  start_from(run, from, mapped.now.state, mapped.sources, report);
  run.state.last_dt = mapped.now.state.last_dt; // the way ends at the pace that there is now
  if (!restore_balance(run, report))
    return false;
  update_energy(run); // increments on the way are compared with that
  report.again = solve_again(run, mapped.now.state);
  return report.again > 0;
}

/// A way to the present that has been gone again.
struct WayGone {
  bool distorted = false; ///< its mesh ended far from how it was made
  double jump = 0.0;      ///< of a tool's force [-]
  RemeshReport report;
  std::string end; ///< the run there; empty: as it is
};

} // namespace

void re_equilibrate(Run& run,
                    const MappedStates& mapped,
                    std::span<const double> forces,
                    RemeshReport& report) {
  // On a long way, by a small radius above all, the mesh may end far from how it was made. In space
  // qualities are halved by less than that, and the force changes more after a shorter way.
  const bool plane = run.mesh().dimension() == 2;
  constexpr double of_made = 0.5;
  const double least =
      of_made * worst_quality(run.mesh(), std::span(mapped.now.state.x).first(run.n_nodal()));
  const std::string new_mesh = present(run);
  const std::vector<const MappedState*> ways = in_order_of_trial(mapped.begun, plane);
  std::optional<WayGone> best;
  for (const MappedState* from : ways) {
    put_back(run, new_mesh);
    RemeshReport way = report;
    if (!goes_through(run, *from, mapped, way))
      continue;
    const bool distorted = plane && worst_quality(run.mesh(), run.positions()) <= least;
    const double jump = jump_from(run, forces);
    // How metal finds its way into a gap is partly chance: from another beginning it goes
    // otherwise.
    const bool last = !distorted && (!plane || jump <= force_budget);
    if (!best || std::pair(distorted, jump) < std::pair(best->distorted, best->jump))
      best = WayGone{distorted, jump, way, last ? std::string() : present(run)};
    if (last)
      break;
  }
  if (best) {
    if (!best->end.empty())
      put_back(run, best->end);
    report = best->report;
    report.balanced = true;
    return;
  }
  put_back(run, new_mesh);
  start_from(run, mapped.now, mapped.now.state, mapped.sources, report);
  const bool at_rest = run.state.increment == 0; // nothing has acted on the part yet
  report.balanced = at_rest || restore_balance(run, report);
}

} // namespace billet::process
