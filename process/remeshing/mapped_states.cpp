#include "process/remeshing/mapped_states.h"

#include "mechanics/elements/mesh_locator.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/transfer/state_transfer.h"
#include "process/increment/snapshots.h"
#include "process/remeshing/part_boundary.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

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

FieldIntegrals field_integrals(const mechanics::Bulk& bulk, const Snapshot& at) {
  FieldIntegrals sums;
  double volume = 0.0;
  for (std::size_t k = 0; k < at.states.size(); ++k) {
    const double strain = at.states[k].plastic_strain;
    const double v = bulk.volumes()[k];
    const double temperature =
        at.temperatures.empty() ? bulk.material().temperature : at.temperatures[k];
    if (strain > 0.0)
      sums.plastic_work += v * mechanics::plastic_work(bulk.material().flow, 0.0,
                                                       {strain, at.plastic_rate[k], temperature});
    sums.mean_strain += v * strain;
    sums.largest_strain = std::max(sums.largest_strain, strain);
    volume += v;
  }
  sums.mean_strain /= volume;
  sums.volume = bulk.volume(at.x);
  return sums;
}

MappedStates map_states(const Run& run, const RemeshedPart& part) {
  const mechanics::MeshLocator locator(run.mesh(), run.positions());
  const std::vector<mechanics::MeshLocation> places = locator.locate(part.mesh.points);
  const auto at_nodes = [&](std::span<const double> nodal) {
    return at_new_nodes(run.mesh(), places, nodal);
  };
  const auto positions_in = [&](const Snapshot& state) { // (P.19)
    std::vector<double> way(run.n_nodal());              // from there to now
    for (std::size_t i = 0; i < way.size(); ++i)
      way[i] = run.state.x[i] - state.x[i];
    std::vector<double> x = mechanics::node_positions(part.mesh);
    const std::vector<double> moved = at_nodes(way);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= moved[i];
    return x;
  };
  const auto carry = [&](const Snapshot& from) {
    MappedState result{from, field_integrals(*run.model.bulk, from), 0};
    Snapshot& to = result.state;
    to.x = positions_in(from);
    mechanics::Mesh mesh = part.mesh;
    mesh.points = points_at(to.x, mesh);
    const auto n_nodal = static_cast<std::ptrdiff_t>(run.n_nodal());
    to.x.insert(to.x.end(), from.x.begin() + n_nodal, from.x.end());
    to.velocity = at_nodes(from.velocity);
    if (!from.last_step.empty()) {
      to.last_step = at_nodes(from.last_step);
      to.last_step.insert(to.last_step.end(), from.last_step.begin() + n_nodal,
                          from.last_step.end());
    }
    const std::span<const double> nodes(from.x.data(), run.n_nodal());
    mechanics::TransferredState state = mechanics::transfer_state(
        {&run.part().mesh, nodes, from.states, from.temperatures, from.plastic_rate}, mesh,
        run.part().analysis, run.scene.material);
    to.states = std::move(state.states);
    to.temperatures = std::move(state.temperatures);
    to.plastic_rate = std::move(state.plastic_rate);
    result.returned = state.returned;
    return result;
  };
  MappedStates mapped;
  mapped.now = carry(snapshot(run));
  // Where a side has folded over since then a good element may have come from nowhere.
  constexpr double of_now = 0.5; // of the quality: on a longer way the mesh would not end as made
  const double least = of_now * worst_quality(part.mesh, mechanics::node_positions(part.mesh));
  for (const auto& from : run.state.snapshots)
    if (from.time < run.state.time && worst_quality(part.mesh, positions_in(from)) > least)
      mapped.begun.push_back(carry(from));
  mapped.origins = at_nodes(run.state.origins);
  return mapped;
}

} // namespace billet::process
