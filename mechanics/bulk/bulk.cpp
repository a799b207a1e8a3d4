#include "mechanics/bulk/bulk.h"

#include "geometry/base/stopwatch.h"
#include "mechanics/elements/elements.h"
#include "mechanics/elements/mesh_locator.h"

#include <Eigen/LU>
#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace billet::mechanics {

/// Local arrays of one thread: of elements side by side.
struct Bulk::Scratch {
  std::vector<std::vector<double>> x_old;
  std::vector<std::vector<double>> x;
  std::vector<std::vector<double>> force;
  std::vector<BlockPlaces> places;
  std::vector<ElementInput> in;
  std::vector<ElementOutput> out;

  Scratch(std::size_t elements, std::size_t size)
      : x_old(elements, std::vector<double>(size)), x(x_old), force(x_old), places(elements),
        in(elements), out(elements) {}
};

void gather(std::span<const double> x, std::span<const Index> nodes, int dim, double* out) {
  // Whole nodes at a time, so that their size is known.
  if (dim == 2)
    for (const Index a : nodes)
      out = std::copy_n(x.data() + 2 * idx(a), 2, out);
  else
    for (const Index a : nodes)
      out = std::copy_n(x.data() + 3 * idx(a), 3, out);
}

Bulk::Bulk(const Mesh& mesh, Analysis analysis, Material material, const BlockPattern& pattern)
    : mesh_(&mesh), pattern_(&pattern), analysis_(analysis), material_(std::move(material)),
      kernel_(element_kernel(mesh.kind, analysis)),
      scatter_(pattern, mesh.cells, nodes_per_element(mesh.kind), elements_at_once(mesh.kind)) {
  points_ = points_per_element(mesh.kind);
  volumes_ = volumes_at(node_positions(mesh));
  states_.resize(volumes_.size());
  trial_states_ = states_;
  shape_energies_.resize(states_.size());
  trial_shape_energies_ = shape_energies_;
  if (material_.heating > 0.0)
    temperatures_.assign(volumes_.size(), material_.temperature);
  increments_.resize(idx(mesh.n_elements()));
}

std::vector<double> Bulk::volumes_at(std::span<const double> x) const {
  const int dim = mesh_->dimension();
  const auto size = idx(nodes_per_element(mesh_->kind) * dim);
  const Index at_once = elements_at_once(mesh_->kind);
  std::vector<double> local(idx(at_once) * size);
  std::vector<double> volumes(idx(mesh_->n_elements() * points_));
  for (Index first = 0; first < mesh_->n_elements(); first += at_once) {
    const Index count = std::min(at_once, mesh_->n_elements() - first);
    for (Index k = 0; k < count; ++k)
      gather(x, mesh_->cell(first + k), dim, local.data() + idx(k) * size);
    point_volumes(mesh_->kind, analysis_, local.data(),
                  std::span(volumes).subspan(idx(first * points_), idx(count * points_)));
  }
  return volumes;
}

void Bulk::adopt(std::span<const double> x,
                 std::vector<PointState> states,
                 std::vector<double> temperatures,
                 double plastic_work) {
  assert(states.size() == volumes_.size());
  assert(temperatures.empty() || temperatures.size() == volumes_.size());
  volumes_ = volumes_at(x);
  for (std::size_t k = 0; k < volumes_.size(); ++k)
    volumes_[k] /= std::sqrt(states[k].b_e.determinant());
  states_ = std::move(states);
  trial_states_ = states_;
  elastic_energies(material_.elasticity, states_, mesh_->dimension() == 2, shape_energies_);
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const double log_J = 0.5 * std::log(states_[k].b_e.determinant());
    shape_energies_[k] -= 0.5 * material_.elasticity.bulk() * log_J * log_J;
  }
  trial_shape_energies_ = shape_energies_;
  if (!temperatures.empty())
    temperatures_ = std::move(temperatures);
  else if (material_.heating > 0.0)
    temperatures_.assign(volumes_.size(), material_.temperature);
  plastic_work_ = plastic_work;
}

void Bulk::keep_volume(double sum) {
  const double factor = sum / reference_volume();
  for (double& volume : volumes_)
    volume *= factor;
}

double Bulk::reference_volume() const {
  return std::accumulate(volumes_.begin(), volumes_.end(), 0.0);
}

ElementStatus Bulk::add_elements(std::span<const Index> elements,
                                 const Trial& trial,
                                 System& system,
                                 Scratch& scratch) {
  const int dim = pattern_->dim;
  const auto n = idx(points_);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Index element = elements[k];
    const std::size_t first = idx(element) * n;
    gather(trial.x_old, mesh_->cell(element), dim, scratch.x_old[k].data());
    gather(trial.x, mesh_->cell(element), dim, scratch.x[k].data());
    scratch.in[k] = {
        scratch.x_old[k].data(), scratch.x[k].data(), std::span(volumes_).subspan(first, n),
        std::span<const PointState>(states_).subspan(first, n), trial.time - trial.time_old};
    if (!temperatures_.empty())
      scratch.in[k].temperatures = temperatures().subspan(first, n);
    if (!system.forces_only)
      scatter_.find_places(*pattern_, element, system.tangent.values, scratch.places[k]);
    scratch.out[k] = {scratch.force[k].data(), system.forces_only ? nullptr : &scratch.places[k],
                      std::span(trial_states_).subspan(first, n), 0.0,
                      std::span(trial_shape_energies_).subspan(first, n)};
  }
  const ElementStatus status = kernel_(material_, std::span(scratch.in).first(elements.size()),
                                       std::span(scratch.out).first(elements.size()));
  if (status != ElementStatus::good)
    return status;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    increments_[idx(elements[k])] = scratch.out[k].largest_plastic_increment;
    scatter_.add(dim, elements[k], scratch.force[k].data(), system.residual);
  }
  return status;
}

Outcome<Assembled> Bulk::assemble(const Trial& trial, System& system) {
  trial_dt_ = trial.time - trial.time_old;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::atomic<Index> bad{none};
  // The lowest number wins whatever the order in which threads meet bad elements.
  const auto say_bad = [&bad](Index element) {
    Index known = bad.load();
    while (element < known && !bad.compare_exchange_weak(known, element)) {
    }
  };
  const auto at_once = idx(elements_at_once(mesh_->kind));
  const auto size = idx(scatter_.size() * pattern_->dim);
  tbb::enumerable_thread_specific<Scratch> scratch(
      [at_once, size] { return Scratch(at_once, size); });
  const std::span<const Index> order = scatter_.order();
  const auto& pieces = scatter_.piece_start();
  const auto work = [&](const tbb::blocked_range<std::size_t>& range) {
    Scratch& mine = scratch.local();
    for (std::size_t piece = range.begin(); piece < range.end(); ++piece)
      for (auto i = idx(pieces[piece]); i < idx(pieces[piece + 1]); i += at_once) {
        const auto together = order.subspan(i, std::min(at_once, idx(pieces[piece + 1]) - i));
        if (add_elements(together, trial, system, mine) == ElementStatus::good)
          continue;
        for (std::size_t k = 0; k < together.size(); ++k)
          if (add_elements(together.subspan(k, 1), trial, system, mine) != ElementStatus::good)
            say_bad(together[k]);
      }
  };
  const Stopwatch timed(assembly_time_);
  const auto& start = scatter_.colour_start();
  for (std::size_t c = 0; c + 1 < start.size() && bad.load() == none; ++c)
    tbb::parallel_for(tbb::blocked_range<std::size_t>(idx(start[c]), idx(start[c + 1])), work);
  if (bad.load() != none)
    return Failure{fmt::format("element {} is inverted or distorted beyond use", bad.load())};
  largest_plastic_increment_ = *std::max_element(increments_.begin(), increments_.end());
  return Assembled{};
}

double Bulk::trial_plastic_work(std::size_t point) const {
  const double from = states_[point].plastic_strain;
  const double to = trial_states_[point].plastic_strain;
  return mechanics::plastic_work(material_.flow, from,
                                 {to, (to - from) / trial_dt_, temperature(point)});
}

double Bulk::trial_plastic_work() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < states_.size(); ++k)
    sum += volumes_[k] * trial_plastic_work(k);
  return sum;
}

void Bulk::commit(const Trial& trial) {
  trial_dt_ = trial.time - trial.time_old;
  double sum = 0.0;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const double work = trial_plastic_work(k);
    sum += volumes_[k] * work;
    if (!temperatures_.empty())
      temperatures_[k] += material_.heating * work; // (M.29)
  }
  plastic_work_ += sum;
  states_ = trial_states_;
  shape_energies_ = trial_shape_energies_;
}

std::vector<double> Bulk::shape_energies() const {
  std::vector<double> energies(states_.size());
  for (std::size_t k = 0; k < energies.size(); ++k)
    energies[k] = volumes_[k] * shape_energies_[k];
  return energies;
}

Bulk::ElasticEnergy Bulk::elastic_energy(std::span<const double> x,
                                         std::span<const double> shape_energies) const {
  const auto n = idx(points_);
  const std::vector<double> volumes = volumes_at(x);
  const double half_bulk = 0.5 * material_.elasticity.bulk();
  ElasticEnergy energy;
  for (std::size_t k = 0; k < volumes_.size(); ++k)
    energy.shape += volumes_[k] * shape_energies[k];
  for (std::size_t first = 0; first < volumes.size(); first += n) {
    const auto current = std::span(volumes).subspan(first, n);
    const auto reference = std::span(volumes_).subspan(first, n);
    double log_J = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      if (k == 0 || !has_mean_dilatation(mesh_->kind))
        log_J = std::log(pressure_ratio(mesh_->kind, current, reference, k));
      energy.volume += reference[k] * half_bulk * log_J * log_J;
    }
  }
  return energy;
}

std::vector<Mat3> Bulk::stresses(std::span<const double> x) const {
  const auto n = idx(points_);
  const std::vector<double> volumes = volumes_at(x);
  std::vector<Mat3> sigma(states_.size());
  kirchhoff_stresses(material_.elasticity, states_, pattern_->dim == 2, sigma);
  for (std::size_t first = 0; first < volumes.size(); first += n) {
    const auto current = std::span(volumes).subspan(first, n);
    const auto reference = std::span(volumes_).subspan(first, n);
    for (std::size_t k = 0; k < n; ++k) {
      const Mat3 tau = sigma[first + k];
      const double theta = pressure_ratio(mesh_->kind, current, reference, k);
      const double J = current[k] / reference[k];
      const double p = material_.elasticity.bulk() * std::log(theta) / theta;
      sigma[first + k] = (tau - tau.trace() / 3.0 * Mat3::Identity()) / J + p * Mat3::Identity();
    }
  }
  return sigma;
}

double Bulk::volume(std::span<const double> x) const {
  const std::vector<double> volumes = volumes_at(x);
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

} // namespace billet::mechanics
