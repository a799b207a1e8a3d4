#include "mechanics/bulk/bulk.h"

#include "geometry/base/pieces.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/elements/elements.h"
#include "mechanics/elements/mesh_locator.h"

#include <Eigen/LU>
#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for_each.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace billet::mechanics {

namespace {

constexpr std::size_t points_of_piece = 4096; ///< of integration, that a thread takes

/// Calls `work(piece)` for all pieces, each as soon as those are done that it has to wait for.
template <class Work> void for_all_pieces(const Scatter& scatter, const Work& work) {
  const std::vector<Index>& waits = scatter.waits();
  std::vector<std::atomic<Index>> left(waits.size());
  std::vector<Index> first;
  for (std::size_t p = 0; p < waits.size(); ++p) {
    left[p].store(waits[p], std::memory_order_relaxed);
    if (waits[p] == 0)
      first.push_back(static_cast<Index>(p));
  }
  tbb::parallel_for_each(first.begin(), first.end(), [&](Index piece, tbb::feeder<Index>& more) {
    work(piece);
    for (const Index next : scatter.followers(piece))
      if (--left[idx(next)] == 0)
        more.add(next);
  });
}

} // namespace

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
  std::vector<double> volumes(idx(mesh_->n_elements() * points_));
  // Pieces of whole groups: the same elements side by side whoever works on them.
  for_pieces(idx(mesh_->n_elements()), 256 * idx(at_once), [&](std::size_t begin, std::size_t end) {
    std::vector<double> local(idx(at_once) * size);
    for (std::size_t first = begin; first < end; first += idx(at_once)) {
      const std::size_t count = std::min(idx(at_once), end - first);
      for (std::size_t k = 0; k < count; ++k)
        gather(x, mesh_->cell(static_cast<Index>(first + k)), dim, local.data() + k * size);
      point_volumes(mesh_->kind, analysis_, local.data(),
                    std::span(volumes).subspan(first * idx(points_), count * idx(points_)));
    }
  });
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
  const auto work = [&](Index piece) {
    Scratch& mine = scratch.local();
    const std::size_t end = idx(pieces[idx(piece) + 1]);
    for (std::size_t i = idx(pieces[idx(piece)]); i < end; i += at_once) {
      const auto together = order.subspan(i, std::min(at_once, end - i));
      if (add_elements(together, trial, system, mine) == ElementStatus::good)
        continue;
      for (std::size_t k = 0; k < together.size(); ++k)
        if (add_elements(together.subspan(k, 1), trial, system, mine) != ElementStatus::good)
          say_bad(together[k]);
    }
  };
  const Stopwatch timed(assembly_time_);
  for_all_pieces(scatter_, work);
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
  return sum_of_pieces(states_.size(), points_of_piece, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = begin; k < end; ++k)
      sum += volumes_[k] * trial_plastic_work(k);
    return sum;
  });
}

void Bulk::commit(const Trial& trial) {
  trial_dt_ = trial.time - trial.time_old;
  plastic_work_ +=
      sum_of_pieces(states_.size(), points_of_piece, [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t k = begin; k < end; ++k) {
          const double work = trial_plastic_work(k);
          sum += volumes_[k] * work;
          if (!temperatures_.empty())
            temperatures_[k] += material_.heating * work; // (M.29)
        }
        return sum;
      });
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
  const std::size_t piece = std::max(points_of_piece / n, std::size_t{1}) * n; // whole elements
  ElasticEnergy energy;
  energy.shape = sum_of_pieces(volumes_.size(), piece, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = begin; k < end; ++k)
      sum += volumes_[k] * shape_energies[k];
    return sum;
  });
  energy.volume = sum_of_pieces(volumes.size(), piece, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t first = begin; first < end; first += n) {
      const auto current = std::span(volumes).subspan(first, n);
      const auto reference = std::span(volumes_).subspan(first, n);
      double log_J = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        if (k == 0 || !has_mean_dilatation(mesh_->kind))
          log_J = std::log(pressure_ratio(mesh_->kind, current, reference, k));
        sum += reference[k] * half_bulk * log_J * log_J;
      }
    }
    return sum;
  });
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
