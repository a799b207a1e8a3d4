// The part meshed anew in the midst of a run: what is carried over. (P.16), (P.17)

#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/mesh_locator.h"
#include "mechanics/state_transfer.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace billet::process {

namespace {

std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

/// Sums over the fields of a bulk.
struct Stock {
  double plastic_work = 0.0;
  double mean_strain = 0.0;
  double largest_strain = 0.0;
};

/// @param rate  plastic strain rates of the points [1/s]
Stock stock_of(const mechanics::Bulk& bulk, std::span<const double> rate) {
  Stock stock;
  double volume = 0.0;
  for (std::size_t k = 0; k < bulk.states().size(); ++k) {
    const double strain = bulk.states()[k].plastic_strain;
    const double v = bulk.volumes()[k];
    if (strain > 0.0)
      stock.plastic_work += v * mechanics::plastic_work(bulk.material().flow, 0.0,
                                                        {strain, rate[k], bulk.temperature(k)});
    stock.mean_strain += v * strain;
    stock.largest_strain = std::max(stock.largest_strain, strain);
    volume += v;
  }
  stock.mean_strain /= volume;
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

std::vector<double> forces_on_tools(const contact::ContactTerm* contact) {
  std::vector<double> forces;
  if (contact != nullptr)
    for (const contact::ToolLoad& load : contact->loads())
      forces.push_back(load.force.norm());
  return forces;
}

} // namespace

std::string Process::remesh(const std::string& cause, const std::vector<Observer*>& observers) {
  const double begun = seconds_now();
  RemeshReport report;
  report.number = static_cast<int>(remeshings_.size()) + 1;
  report.time = time_;
  report.increment = increment_;
  report.cause = cause;
  NewPart part;
  try {
    part = new_part();
  } catch (const Error& error) {
    refused_increment_ = increment_;
    refused_quality_ = 0.5 * worst_quality(scene_.mesh, positions());
    refusals_.push_back({time_, error.complaints().front().message});
    return refusals_.back().why;
  }
  const double written = seconds_now();
  for (Observer* observer : observers)
    observer->remeshing(*this);
  const double output = seconds_now() - written;
  const double missing = energy_.missing();
  exchange_mesh(std::move(part), report);
  const double exchanged = seconds_now();
  restore_balance(report);
  update_energy();
  report.energy = energy_.missing() - missing;
  energy_.remeshing += report.energy;
  report.seconds = seconds_now() - begun - output;
  times_.output += output;
  times_.remeshing += exchanged - begun - output; // the balance counts with the other solutions
  remeshings_.push_back(report);
  for (Observer* observer : observers)
    observer->remeshed(*this, report);
  return {};
}

void Process::exchange_mesh(NewPart anew, RemeshReport& report) {
  RemeshedPart& part = anew.part;
  const Stock before = stock_of(*bulk_, plastic_rate_);
  const std::vector<double> forces = forces_on_tools(contact_.get());
  report.elements[0] = scene_.mesh.n_elements();
  report.nodes[0] = scene_.mesh.n_points();
  report.quality.before = worst_quality(scene_.mesh, positions());
  report.volume.before = bulk_->volume(x_);

  const mechanics::StateField field{&scene_.mesh, positions(), bulk_->states(),
                                    bulk_->temperatures(), plastic_rate_};
  mechanics::TransferredState state =
      mechanics::transfer_state(field, part.mesh, scene_.analysis, scene_.material);
  const mechanics::MeshLocator locator(scene_.mesh, positions());
  const std::vector<mechanics::MeshLocation> places = locator.locate(part.mesh.points);
  std::vector<double> origins = at_new_nodes(scene_.mesh, places, x0_);
  velocity_ = at_new_nodes(scene_.mesh, places, velocity_);
  if (!last_step_.empty()) {
    std::vector<double> step = at_new_nodes(scene_.mesh, places, last_step_);
    step.insert(step.end(), last_step_.begin() + static_cast<std::ptrdiff_t>(x0_.size()),
                last_step_.end());
    last_step_ = std::move(step);
  }
  std::vector<double> x = mechanics::node_positions(part.mesh);
  x.insert(x.end(), x_.begin() + static_cast<std::ptrdiff_t>(x0_.size()), x_.end());

  // Sums of what goes with the old mesh.
  for (const auto& load : loads_)
    load_work_ += load->work();
  for (const auto& load : fading_)
    load_work_ += load->work();
  take_times();
  earlier_times_ = times_;
  earlier_work_ = solver_work();
  const double plastic_work = bulk_->plastic_work();
  const std::unique_ptr<contact::ContactSurface> old_surface = std::move(surface_);
  const std::unique_ptr<contact::ContactTerm> old_contact = std::move(contact_);
  terms_.clear();
  loads_.clear();
  fading_.clear();
  grounding_.reset();
  newton_.reset();
  bulk_.reset();

  scene_.mesh = std::move(part.mesh);
  scene_.supports = std::move(part.supports);
  scene_.loads = std::move(part.loads);
  scene_.contact_faces = part.contact_faces;
  pattern_ = mechanics::block_pattern(scene_.mesh);
  x0_ = std::move(origins);
  x_ = std::move(x);
  const int dim = scene_.mesh.dimension();
  for (const Support& support : scene_.supports)
    for (const Index node : support.nodes) {
      const std::size_t i = idx(dim * node + support.component);
      x0_[i] = x_[i] - support.displacement(time_);
    }
  trial_x_ = x_;
  reactions_.assign(x0_.size(), 0.0);
  make_terms();
  analysis_before_run_ = newton_->solver_work().analysis;
  bulk_->adopt(std::move(state.states), std::move(state.temperatures), plastic_work);
  plastic_rate_ = std::move(state.plastic_rate);
  if (contact_) {
    contact_->start(x_, time_);
    const std::vector<contact::PointSource> sources = anew.sources(*surface_, positions());
    contact_->go_on_from(*old_contact, sources);
    if (wear_)
      wear_->change_surface(*surface_, sources);
  }
  mesh_increment_ = increment_;
  mesh_time_ = time_;
  mesh_quality_ = worst_quality(scene_.mesh, positions());
  refused_quality_ = 1.0;
  mesh_strain_.clear();
  for (const mechanics::PointState& point : bulk_->states())
    mesh_strain_.push_back(point.plastic_strain);

  const Stock after = stock_of(*bulk_, plastic_rate_);
  report.elements[1] = scene_.mesh.n_elements();
  report.nodes[1] = scene_.mesh.n_points();
  report.quality.after = mesh_quality_;
  report.volume.after = bulk_->volume(x_);
  report.plastic_work = {before.plastic_work, after.plastic_work};
  report.mean_strain = {before.mean_strain, after.mean_strain};
  report.largest_strain = {before.largest_strain, after.largest_strain};
  report.returned = state.returned;
  for (const double force : forces)
    report.forces.push_back({force, force});
}

void Process::restore_balance(RemeshReport& report) {
  // In next to no time rate laws neither flow nor relax.
  constexpr double share_of_increment = 1e-6;
  const double dt = share_of_increment * last_dt_;
  trial_x_ = x_;
  if (contact_)
    contact_->restart();
  const auto outcome = newton_->solve(terms_, prescribed(time_), time_ - dt, time_, x_, trial_x_);
  if (!newton_->records().empty())
    report.residual = newton_->records().front().residual;
  if (!outcome)
    return;
  const mechanics::Trial trial{time_ - dt, time_, x_, trial_x_};
  for (mechanics::ForceTerm* term : terms_)
    term->commit(trial);
  for (const Index i : prescribed(time_).unknowns)
    reactions_[idx(i)] = newton_->residual()[idx(i)];
  x_ = trial_x_;
  report.balanced = true;
  const std::vector<double> forces = forces_on_tools(contact_.get());
  for (std::size_t t = 0; t < forces.size(); ++t)
    report.forces[t].after = forces[t];
}

} // namespace billet::process
