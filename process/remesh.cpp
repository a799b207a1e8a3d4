// The part meshed anew in the midst of a run: what is carried over. (P.16), (P.17), (P.19)–(P.21)

#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/transfer/state_transfer.h"
#include "process/free_surface.h"
#include "process/increment_control.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace billet::process {

namespace {

/// Sums over the fields of a bulk in a state that may not be its own.
Stock stock_of(const mechanics::Bulk& bulk, const Snapshot& at) {
  Stock stock;
  double volume = 0.0;
  for (std::size_t k = 0; k < at.states.size(); ++k) {
    const double strain = at.states[k].plastic_strain;
    const double v = bulk.volumes()[k];
    const double temperature =
        at.temperatures.empty() ? bulk.material().temperature : at.temperatures[k];
    if (strain > 0.0)
      stock.plastic_work += v * mechanics::plastic_work(bulk.material().flow, 0.0,
                                                        {strain, at.plastic_rate[k], temperature});
    stock.mean_strain += v * strain;
    stock.largest_strain = std::max(stock.largest_strain, strain);
    volume += v;
  }
  stock.mean_strain /= volume;
  stock.volume = bulk.volume(at.x);
  return stock;
}

/// Values of nodal fields of an old mesh at the nodes of a new one.
std::vector<double> at_new_nodes(const mechanics::Mesh& old,
                                 std::span<const mechanics::MeshLocation> places,
                                 std::span<const double> nodal) {
  const std::size_t dim = idx(old.dimension());
  std::vector<double> result(dim * places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    mechanics::interpolate(old, places[i], nodal, std::span(result).subspan(dim * i, dim));
  return result;
}

/// Positions of the nodes of a mesh as points in space.
std::vector<Vec3> points_at(std::span<const double> x, const mechanics::Mesh& mesh) {
  const std::size_t dim = idx(mesh.dimension());
  std::vector<Vec3> points = mesh.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(dim * i), dim, points[i].data());
  return points;
}

} // namespace

std::string Process::remesh(const std::string& cause,
                            const std::vector<Observer*>& observers,
                            const std::vector<geometry::SizeAt>& at) {
  const double begun = seconds_now();
  RemeshReport report;
  report.number = static_cast<int>(state_.record.remeshings.size()) + 1;
  report.time = state_.time;
  report.increment = state_.increment;
  report.cause = cause;
  report.work_of_run = bulk_->plastic_work();
  NewPart part;
  try {
    part = new_part(at);
  } catch (const Error& error) {
    state_.mesh.refused_increment = state_.increment;
    state_.mesh.refused_quality = 0.5 * worst_quality(scene_.mesh, positions());
    state_.record.refusals.push_back({state_.time, error.complaints().front().message});
    return state_.record.refusals.back().why;
  }
  const double written = seconds_now();
  for (Observer* observer : observers)
    observer->remeshing(*this);
  const double output = seconds_now() - written;
  const double missing = state_.energy.missing();
  const std::vector<double> forces = forces_on_tools();
  report.elements[0] = scene_.mesh.n_elements();
  report.nodes[0] = scene_.mesh.n_points();
  report.quality.before = worst_quality(scene_.mesh, positions());
  report.laps = part.laps;
  CarriedOver carried = carry_over(part.part);
  carried.sources = exchange_mesh(std::move(part), carried);
  const double exchanged = seconds_now();
  const long systems = solver_work().systems;
  const int wasted = state_.counters.wasted_iterations;
  settle(carried, forces, report);
  state_.counters.remeshing_iterations += static_cast<int>(solver_work().systems - systems);
  state_.counters.wasted_iterations = wasted; // its failed tries are among them
  state_.mesh.increment = state_.increment;
  state_.mesh.turned_inside_out = 0;
  state_.mesh.time = state_.time;
  state_.mesh.quality = worst_quality(scene_.mesh, positions());
  state_.mesh.aspect = aspect();
  state_.mesh.excess = most_outgrown_side().excess;
  state_.mesh.coarse = coarse_contact();
  state_.mesh.refused_quality = 1.0;
  state_.mesh.strain.clear();
  for (const mechanics::PointState& point : bulk_->states())
    state_.mesh.strain.push_back(point.plastic_strain);
  update_energy();
  report.energy = state_.energy.missing() - missing;
  state_.energy.remeshing += report.energy;
  report.elements[1] = scene_.mesh.n_elements();
  report.nodes[1] = scene_.mesh.n_points();
  report.quality.after = state_.mesh.quality;
  const std::vector<double> balanced = forces_on_tools();
  for (std::size_t t = 0; t < forces.size(); ++t)
    report.forces.push_back({forces[t], report.balanced ? balanced[t] : forces[t]});
  report.seconds = seconds_now() - begun - output;
  times_.output += output;
  times_.remeshing += exchanged - begun - output; // the balance counts with the other solutions
  between_increments_ = true;
  state_.record.remeshings.push_back(report);
  for (Observer* observer : observers)
    observer->remeshed(*this, report);
  return {};
}

std::vector<double> Process::forces_on_tools() const {
  std::vector<double> forces;
  if (contact_)
    for (const contact::ToolLoad& load : contact_->loads())
      forces.push_back(load.force.norm());
  return forces;
}

Snapshot Process::snapshot() const {
  Snapshot s;
  s.time = state_.time;
  s.increment = state_.increment;
  s.x = state_.x;
  s.states.assign(bulk_->states().begin(), bulk_->states().end());
  s.temperatures.assign(bulk_->temperatures().begin(), bulk_->temperatures().end());
  s.velocity = state_.velocity;
  s.last_step = state_.last_step;
  s.last_dt = state_.last_dt;
  s.plastic_rate = state_.plastic_rate;
  if (contact_)
    s.contact = contact::snapshot(contact_->state());
  s.reference_volume = bulk_->reference_volume();
  s.plastic_work = bulk_->plastic_work();
  s.support_work = state_.works.supports;
  s.load_work = state_.works.loads_before;
  for (const auto& load : loads_)
    s.load_work += load->work();
  for (const auto& load : fading_)
    s.load_work += load->work();
  s.stabilization = state_.energy.stabilization;
  return s;
}

double Process::flowing_energy() const {
  const std::vector<double> shape = bulk_->shape_energies();
  double energy = 0.0;
  for (std::size_t k = 0; k < shape.size(); ++k)
    if (state_.plastic_rate[k] > 0.0)
      energy += shape[k];
  return energy;
}

void Process::take_snapshot() {
  if (state_.time < state_.leaving.fading_until)
    return; // a new mesh does not know the forces of tools that have left
  // What the transfer has left too low is back where it was after that much flow.
  const bool in_space = scene_.mesh.dimension() == 3;
  const double flow = in_space ? 64.0 : 16.0;      // plastic work over (P.20)'s elastic energy
  const int most_increments = in_space ? 120 : 40; // where little flows nothing is too low
  constexpr int parts = 3;                         // of the way: how closely its length is met
  const auto flowed_on = [&](const Snapshot& since) {
    return (state_.increment - since.increment) * parts >= most_increments ||
           (bulk_->plastic_work() - since.plastic_work) * parts >= flow * flowing_energy();
  };
  if (!state_.snapshots.empty() && !flowed_on(state_.snapshots.back()))
    return;
  state_.snapshots.push_back(snapshot());
  if (state_.snapshots.size() > parts + 1)
    state_.snapshots.erase(state_.snapshots.begin());
}

CarriedOver Process::carry_over(const RemeshedPart& part) const {
  const mechanics::MeshLocator locator(scene_.mesh, positions());
  const std::vector<mechanics::MeshLocation> places = locator.locate(part.mesh.points);
  const auto at_nodes = [&](std::span<const double> nodal) {
    return at_new_nodes(scene_.mesh, places, nodal);
  };
  const auto positions_in = [&](const Snapshot& state) { // (P.19)
    std::vector<double> way(state_.origins.size());      // from there to now
    for (std::size_t i = 0; i < way.size(); ++i)
      way[i] = state_.x[i] - state.x[i];
    std::vector<double> x = mechanics::node_positions(part.mesh);
    const std::vector<double> moved = at_nodes(way);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= moved[i];
    return x;
  };
  const auto carry = [&](const Snapshot& from) {
    CarriedState result{from, stock_of(*bulk_, from), 0};
    Snapshot& to = result.state;
    to.x = positions_in(from);
    mechanics::Mesh mesh = part.mesh;
    mesh.points = points_at(to.x, mesh);
    const auto n_nodal = static_cast<std::ptrdiff_t>(state_.origins.size());
    to.x.insert(to.x.end(), from.x.begin() + n_nodal, from.x.end());
    to.velocity = at_nodes(from.velocity);
    if (!from.last_step.empty()) {
      to.last_step = at_nodes(from.last_step);
      to.last_step.insert(to.last_step.end(), from.last_step.begin() + n_nodal,
                          from.last_step.end());
    }
    const std::span<const double> nodes(from.x.data(), state_.origins.size());
    mechanics::TransferredState state = mechanics::transfer_state(
        {&scene_.mesh, nodes, from.states, from.temperatures, from.plastic_rate}, mesh,
        scene_.analysis, scene_.material);
    to.states = std::move(state.states);
    to.temperatures = std::move(state.temperatures);
    to.plastic_rate = std::move(state.plastic_rate);
    result.returned = state.returned;
    return result;
  };
  CarriedOver carried;
  carried.now = carry(snapshot());
  // Where a side has folded over since then a good element may have come from nowhere.
  constexpr double of_now = 0.5; // of the quality: on a longer way the mesh would not end as made
  const double least = of_now * worst_quality(part.mesh, mechanics::node_positions(part.mesh));
  for (const auto& from : state_.snapshots)
    if (from.time < state_.time && worst_quality(part.mesh, positions_in(from)) > least)
      carried.begun.push_back(carry(from));
  carried.origins = at_nodes(state_.origins);
  return carried;
}

std::vector<contact::PointSource> Process::exchange_mesh(NewPart anew, const CarriedOver& carried) {
  take_times(); // of what goes with the old mesh
  earlier_times_ = times_;
  earlier_work_ = solver_work();
  state_.snapshots.clear();
  const std::unique_ptr<contact::ContactSurface> old_surface = std::move(surface_);
  terms_.clear();
  loads_.clear();
  fading_.clear();
  state_.leaving.fading.clear();
  stabilization_.reset();
  newton_.reset();
  contact_.reset();
  bulk_.reset();

  scene_.mesh = std::move(anew.part.mesh);
  scene_.supports = std::move(anew.part.supports);
  scene_.loads = std::move(anew.part.loads);
  scene_.contact_faces = std::move(anew.part.contact_faces);
  pattern_ = mechanics::block_pattern(scene_.mesh);
  state_.origins = carried.origins;
  state_.x = carried.now.state.x;
  state_.velocity = carried.now.state.velocity;
  const int dim = scene_.mesh.dimension();
  for (const Support& support : scene_.supports)
    for (const Index node : support.nodes) {
      const std::size_t i = idx(dim * node + support.component);
      state_.origins[i] = state_.x[i] - support.displacement(state_.time);
    }
  make_terms();
  analysis_before_run_ = newton_->solver_work().analysis;
  if (!contact_)
    return {};
  std::vector<contact::PointSource> sources = anew.sources(*surface_, positions());
  if (wear_)
    wear_->change_surface(*surface_, sources);
  return sources;
}

void Process::start_from(const CarriedState& at,
                         std::span<const contact::PointSource> sources,
                         RemeshReport& report) {
  const Snapshot& to = at.state;
  state_.time = to.time;
  state_.x = to.x;
  if (report.laps.empty()) // what lay in a lap that has been welded is gone
    restore_volume(at.before.volume, to.contact, sources);
  trial_x_ = state_.x;
  state_.velocity = to.velocity;
  state_.last_step = to.last_step;
  state_.last_dt = to.last_dt;
  bulk_->adopt(state_.x, to.states, to.temperatures, to.plastic_work);
  bulk_->keep_volume(to.reference_volume);
  state_.plastic_rate = to.plastic_rate;
  state_.reactions.assign(state_.origins.size(), 0.0);
  state_.works.supports = to.support_work;
  state_.works.loads_before = to.load_work;
  for (const auto& load : loads_)
    state_.works.loads_before -= load->work(); // of a way that is not taken
  state_.energy.stabilization = to.stabilization;
  if (contact_) {
    contact_->start(state_.x, state_.time);
    contact_->go_on_from(to.contact, {sources, state_.x, state_.time});
  }
  Stock after = stock_of(*bulk_, to);
  after.volume = bulk_->volume(state_.x);
  report.returned = at.returned;
  report.volume = {at.before.volume, after.volume};
  report.plastic_work = {at.before.plastic_work, after.plastic_work};
  report.mean_strain = {at.before.mean_strain, after.mean_strain};
  report.largest_strain = {at.before.largest_strain, after.largest_strain};
}

void Process::restore_volume(double volume,
                             const contact::ContactSnapshot& contact,
                             std::span<const contact::PointSource> sources) {
  const auto touches = [&](const contact::PointSource& source) {
    return std::any_of(contact.history.begin(), contact.history.end(),
                       [&](const auto& tool) { return tool[source.nearest()].closed(); });
  };
  std::vector<char> touching(scene_.contact_faces.size(), 0);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (touches(sources[i]))
      touching[i / idx(surface_->points())] = 1;
  constexpr double furthest = 0.01; // of an element: what the shape may change by unseen
  constexpr double of_quality =
      0.5; // at a place much smaller than elements it turns them inside out
  const std::vector<double> before = state_.x;
  const double least = of_quality * worst_quality(scene_.mesh, positions());
  process::restore_volume(
      state_.x, free_normals(scene_, positions(), touching),
      [this](std::span<const double> x) { return bulk_->volume(x); }, volume,
      furthest * state_.mesh.first_side);
  if (worst_quality(scene_.mesh, positions()) < least)
    state_.x = before;
}

double Process::jump_from(std::span<const double> before) const {
  const std::vector<double> now = forces_on_tools();
  RemeshReport report;
  for (std::size_t t = 0; t < now.size(); ++t)
    report.forces.push_back({before[t], now[t]});
  return report.force_jump();
}

void Process::settle(const CarriedOver& carried,
                     std::span<const double> forces,
                     RemeshReport& report) {
  // On a long way, by a small radius above all, the mesh may end far from how it was made. In space
  // qualities are halved by less than that, and the force changes more after a shorter way.
  const bool plane = scene_.mesh.dimension() == 2;
  constexpr double of_made = 0.5;
  const double least =
      of_made *
      worst_quality(scene_.mesh, std::span(carried.now.state.x).first(state_.origins.size()));
  const auto goes_through = [&](const CarriedState& from) {
    start_from(from, carried.sources, report);
    state_.last_dt = carried.now.state.last_dt; // the way ends at the pace that there is now
    report.again = restore_balance(report) ? solve_again(carried.now.state) : 0;
    return report.again > 0;
  };
  const CarriedState* best = nullptr;
  const CarriedState* here = nullptr; // what was gone through last
  for (const CarriedState& from : carried.begun) {
    here = goes_through(from) ? &from : nullptr;
    const bool sound = here != nullptr && (!plane || here == &carried.begun.back() ||
                                           worst_quality(scene_.mesh, positions()) > least);
    if (!sound)
      continue;
    // How metal finds its way into a gap is partly chance: from another beginning it goes
    // otherwise. Where none is within the budget the longest way is the best.
    const bool meets = jump_from(forces) <= force_budget;
    if (best == nullptr || meets)
      best = here;
    if (!plane || meets)
      break;
  }
  if (best != nullptr && best != here)
    (void)goes_through(*best); // as it did before
  report.balanced = report.again > 0;
  if (report.balanced)
    return;
  start_from(carried.now, carried.sources, report);
  const bool at_rest = state_.increment == 0; // nothing has acted on the part yet
  report.balanced = at_rest || restore_balance(report);
}

bool Process::restore_balance(RemeshReport& report) {
  // In next to no time rate laws neither flow nor relax.
  constexpr double share_of_increment = 1e-6;
  const double dt = share_of_increment * state_.last_dt;
  trial_x_ = state_.x;
  if (contact_)
    contact_->restart();
  const auto outcome = newton_->solve(terms_, prescribed(state_.time), state_.time - dt,
                                      state_.time, state_.x, trial_x_);
  if (!newton_->records().empty())
    report.residual = newton_->records().front().residual;
  if (!outcome)
    return false;
  const mechanics::Trial trial{state_.time - dt, state_.time, state_.x, trial_x_};
  for (mechanics::ForceTerm* term : terms_)
    term->commit(trial);
  for (const Index i : prescribed(state_.time).unknowns)
    state_.reactions[idx(i)] = newton_->residual()[idx(i)];
  state_.x = trial_x_;
  return true;
}

int Process::solve_again(const Snapshot& end) {
  const double length = end.time - state_.time;
  constexpr double shortest = 1.0 / 1024.0; // of that
  const double longest = std::min(state_.longest, length);
  IncrementControl control({std::min(state_.last_dt, longest), shortest * length, longest});
  state_.last_step = end.x;
  for (std::size_t i = 0; i < state_.x.size(); ++i)
    state_.last_step[i] -= state_.x[i];
  state_.last_dt = length;
  const int iterations = state_.counters.last_iterations;
  int solved = 0, failures = 0;
  while (state_.time < end.time && !control.exhausted()) {
    const double landing = next_landing(end.time);
    const double step = step_towards(landing - state_.time, control.next());
    const bool lands = step == landing - state_.time;
    std::string why;
    refused_as_too_deep_ = refused_inside_out_ = false;
    const bool is_shortest = 0.5 * step < shortest * length;
    if (try_increment(step, mechanics::Continuation::none, why) ||
        ((failures > 0 || is_shortest) && try_softened(step, false, why))) {
      commit(step);
      if (lands)
        state_.time = landing;
      control.accepted(step, state_.counters.last_iterations);
      ++solved;
      failures = 0;
    } else {
      ++failures;
      control.failed(step);
    }
  }
  state_.counters.last_iterations = iterations;
  return state_.time == end.time ? solved : 0;
}

} // namespace billet::process
