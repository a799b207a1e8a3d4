#include "process/remeshing/remesh.h"

#include "geometry/base/error.h"
#include "geometry/base/outcome.h"
#include "geometry/base/stopwatch.h"
#include "process/energy/balance.h"
#include "process/increment/force_floor.h"
#include "process/increment/increment_report.h"
#include "process/increment/snapshots.h"
#include "process/increment/symmetry_walls.h"
#include "process/remeshing/mapped_states.h"
#include "process/remeshing/mesh_before.h"
#include "process/remeshing/new_part.h"
#include "process/remeshing/re_equilibrate.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/remeshing_due.h"
#include "process/remeshing/sizes.h"
#include "process/reports/observer.h"
#include "process/reports/run_reports.h"
#include "process/scene/scene.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Puts a new mesh in the place of the present one, with all that is built on a mesh.
/// @return where its contact points come from
std::vector<contact::PointSource>
exchange_mesh(Run& run, NewPart anew, const MappedStates& mapped) {
  run.state.snapshots.clear();
  run.state.leaving.decaying.clear();
  run.state.velocity = mapped.now.state.velocity;
  run.state.origins = mapped.origins;
  take_held_nodes(run.state.walls, anew.part.supports);
  Part part{run.part().analysis, std::move(anew.part.mesh), std::move(anew.part.supports),
            std::move(anew.part.loads), std::move(anew.part.contact_faces)};
  const int dim = part.mesh.dimension();
  for (const Support& support : part.supports)
    for (const Index node : support.nodes) {
      const std::size_t i = idx(dim * node + support.component);
      run.state.origins[i] = mapped.now.state.x[i] - support.displacement(run.state.time);
    }
  rebuild(run, std::move(part), mapped.now.state.x);
  note_nodes_off_walls(run);
  run.model.newton->set_force_floor(force_floor(run, run.state.time));
  if (!run.model.surface)
    return {};
  std::vector<contact::PointSource> sources = anew.sources(*run.model.surface, run.positions());
  if (run.model.wear)
    run.model.wear->change_surface(*run.model.surface, sources);
  return sources;
}

/// Begins the page of the ledger with what the mesh has been.
RemeshReport report_of_old(const Run& run, const std::string& cause) {
  RemeshReport report;
  report.number = static_cast<int>(run.state.record.remeshings.size()) + 1;
  report.time = run.state.time;
  report.increment = run.state.increment;
  report.cause = cause;
  report.work_of_run = run.model.bulk->plastic_work();
  report.elements[0] = run.mesh().n_elements();
  report.nodes[0] = run.mesh().n_points();
  report.quality.before = worst_quality(run.mesh(), run.positions());
  return report;
}

/// Completes it with what the new one is.
///
/// @param missing  of the balance of energy before [N mm]
/// @param forces   on the tools before [N]
void add_new(Run& run, double missing, std::span<const double> forces, RemeshReport& report) {
  update_energy(run);
  report.energy = run.state.energy.missing() - missing;
  run.state.energy.remeshing += report.energy;
  report.elements[1] = run.mesh().n_elements();
  report.nodes[1] = run.mesh().n_points();
  report.quality.after = run.state.mesh.quality;
  const std::vector<double> balanced = forces_on_tools(run);
  for (std::size_t t = 0; t < forces.size(); ++t)
    report.forces.push_back({forces[t], report.balanced ? balanced[t] : forces[t]});
}

/// Keeps what the mesh is now that it is new.
void note_mesh(Run& run) {
  MeshRecord& mesh = run.state.mesh;
  mesh.increment = run.state.increment;
  mesh.turned_inside_out = 0;
  mesh.time = run.state.time;
  mesh.shortest = shortest_size(run);
  mesh.quality = worst_quality(run.mesh(), run.positions());
  mesh.aspect = aspect(run);
  mesh.excess = most_outgrown_side(run).excess;
  mesh.coarse = coarse_contact(run);
  mesh.refused_quality = 1.0;
  mesh.strain.clear();
  for (const mechanics::PointState& point : run.model.bulk->states())
    mesh.strain.push_back(point.plastic_strain);
}

/// The part on a new mesh, with what is on walls held there. Nothing has changed if there is none.
/// @throws Error(Fault::geometry) if it cannot be meshed
/// @pre somebody keeps the present part, the model's, until that is built anew
NewPart meshed_anew(Run& run, const AskedSizes& sizes) {
  const std::shared_ptr<const Part> before = run.state.part;
  run.state.part = part_held_on_walls(run);
  try {
    return new_part(run, sizes);
  } catch (const Error&) {
    run.state.part = before;
    throw;
  }
}

/// Puts a new part in the place of the present one, and goes on there from where the run is.
///
/// @param forces  on the tools before [N]
/// @return time that it took but for balancing [s]
double carry_over(Run& run, NewPart part, std::span<const double> forces, RemeshReport& report) {
  const double begun = seconds_now();
  report.laps = part.laps;
  MappedStates mapped = map_states(run, part.part);
  BlowRecord blows = run.model.blows ? run.model.blows->record() : BlowRecord{};
  mapped.sources = exchange_mesh(run, std::move(part), mapped);
  const double exchanged = seconds_now();
  re_equilibrate(run, mapped, forces, report);
  run.attempt.led.clear();
  if (run.model.blows)
    run.model.blows->go_on_from(std::move(blows), run.state.time);
  return exchanged - begun;
}

/// Where there is no equilibrium on a new mesh, maybe on one whose nodes lie elsewhere: tries other
/// sizes, and takes the first mesh after all if there is none on any.
///
/// @param first  what is known of the mesh before
/// @return as `carry_over`
double carry_over_to_another(Run& run,
                             const MeshBefore& before,
                             const std::vector<geometry::SizeAt>& at,
                             std::span<const double> forces,
                             const RemeshReport& first,
                             RemeshReport& report) {
  constexpr std::array<double, 4> shares{0.93, 0.87, 0.8, 1.0}; // of the sizes asked for
  double seconds = 0.0;
  for (const double share : shares) {
    before.put_back(run);
    const std::shared_ptr<const Part> of_model = run.state.part; // until it is built anew
    const double begun = seconds_now();
    try {
      NewPart part = meshed_anew(run, {at, share});
      report = first;
      seconds += seconds_now() - begun;
      seconds += carry_over(run, std::move(part), forces, report);
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry)
        throw;
      continue; // of other sizes there is one
    }
    if (report.balanced)
      break;
  }
  return seconds;
}

} // namespace

Outcome<Done> remesh(Run& run,
                     const std::string& cause,
                     const std::vector<Observer*>& observers,
                     const std::vector<geometry::SizeAt>& at) {
  const double begun = seconds_now();
  RemeshReport report = report_of_old(run, cause);
  const MeshBefore before(run);
  NewPart part;
  try {
    part = meshed_anew(run, {at});
  } catch (const Error& error) {
    run.state.mesh.refused_increment = run.state.increment;
    run.state.mesh.refused_quality = 0.5 * worst_quality(run.mesh(), run.positions());
    run.state.record.refusals.push_back({run.state.time, error.complaints().front().message});
    return Failure{run.state.record.refusals.back().why};
  }
  double seconds = seconds_now() - begun; // but for output and balancing
  for (Observer* observer : observers)
    observer->remeshing(run);
  const double output = seconds_now() - begun - seconds;
  const double missing = run.state.energy.missing();
  const std::vector<double> forces = forces_on_tools(run);
  const long systems = run.solver_work().systems;
  const int iterations = run.state.counters.remeshing_iterations;
  const int wasted = run.state.counters.wasted_iterations;
  const RemeshReport of_old = report;
  seconds += carry_over(run, std::move(part), forces, report);
  if (!report.balanced)
    seconds += carry_over_to_another(run, before, at, forces, of_old, report);
  run.state.counters.remeshing_iterations =
      iterations + static_cast<int>(run.solver_work().systems - systems);
  run.state.counters.wasted_iterations = wasted; // its failed tries are among them
  note_mesh(run);
  add_new(run, missing, forces, report);
  report.seconds = seconds_now() - begun - output;
  run.clock.times.output += output;
  // The balance counts with the other solutions.
  run.clock.times.remeshing += seconds;
  run.attempt.none = true;
  run.state.record.remeshings.push_back(report);
  for (Observer* observer : observers)
    observer->remeshed(run, report);
  return Done{};
}

} // namespace billet::process
