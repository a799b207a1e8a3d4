#include "app/cost.h"

#include "geometry/base/memory.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multigrid/multigrid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace billet::app {

namespace {

using mechanics::Index;

/// Entries and operations of a Cholesky factor, from its elimination tree's column counts.
struct Elimination {
  double entries = 0.0;
  double operations = 0.0;
};

/// Symbolic elimination on the node graph; costs are those of `dim` unknowns a node.
Elimination elimination(const mechanics::BlockPattern& pattern) {
  const std::vector<Index> order = mechanics::fill_reducing_order(pattern);
  const auto n = static_cast<std::size_t>(pattern.n_nodes());
  const auto dim = static_cast<std::size_t>(pattern.dim);
  std::vector<Index> position(n);
  for (std::size_t k = 0; k < n; ++k)
    position[static_cast<std::size_t>(order[k * dim]) / dim] = static_cast<Index>(k);
  std::vector<std::vector<Index>> below(n);
  for (std::size_t a = 0; a < n; ++a)
    for (Index k = pattern.neighbour_start[a]; k < pattern.neighbour_start[a + 1]; ++k) {
      const Index b =
          position[static_cast<std::size_t>(pattern.neighbours[static_cast<std::size_t>(k)])];
      if (b > position[a])
        below[static_cast<std::size_t>(position[a])].push_back(b);
    }
  Elimination cost;
  for (std::size_t k = 0; k < n; ++k) {
    auto& column = below[k];
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    const double width = static_cast<double>(dim);
    const double height = width * static_cast<double>(column.size()) + 0.5 * width;
    cost.entries += width * height;
    cost.operations += width * height * height;
    if (column.empty())
      continue;
    auto& parent = below[static_cast<std::size_t>(column.front())];
    parent.insert(parent.end(), column.begin() + 1, column.end());
    column.clear();
    column.shrink_to_fit();
  }
  return cost;
}

/// Increments of a run none of which is cut back: as long as they may be, after the first few.
double increments_of(const process::Scene& scene) {
  constexpr double growth = 5.0; // from the first one to the longest
  double increments = 0.0, start = 0.0;
  for (const process::Stage& stage : scene.stages) {
    const double length = stage.end - start;
    const double longest =
        scene.increments.max.value_or(scene.increments.share * process::default_longest(length));
    increments += std::ceil(length / std::min(longest, length)) + growth;
    start = stage.end;
  }
  return increments;
}

/// As the solver will (LinearSolver).
void choose_solver(CostEstimate& cost, int dim, mechanics::SolverChoice choice) {
  cost.systems = {dim, static_cast<double>(cost.entries), cost.factor_entries, cost.operations};
  const double all = std::numeric_limits<double>::infinity();
  cost.by_multigrid =
      choice == mechanics::SolverChoice::multigrid ||
      (choice == mechanics::SolverChoice::automatic &&
       mechanics::prefers_multigrid(cost.systems, available_memory().value_or(all)) &&
       mechanics::Multigrid::is_there());
}

/// In large parts several systems go with one factorization, in small ones hardly any.
double seconds_of_a_system(const CostEstimate& cost) {
  constexpr double per_operation = 1e-10; // [s]
  if (cost.by_multigrid)
    return mechanics::cost_by_multigrid(cost.systems).seconds;
  return mechanics::may_pay(cost.systems) ? mechanics::cost_by_factorization(cost.systems).seconds
                                          : per_operation * cost.operations;
}

/// Memory and time, which follow from the rest.
void add_totals(CostEstimate& cost) {
  // Of an entry: value, column, the symmetric neighbour's value, and the copy that is permuted.
  const double matrix = 30.0 * static_cast<double>(cost.entries);
  // Cholesky's factor, or an LU's two in single precision, plus the working front.
  const double factors = 8.0 * cost.factor_entries * 1.5;
  cost.memory =
      matrix + (cost.by_multigrid ? mechanics::cost_by_multigrid(cost.systems).memory : factors);
  // Measured with the cases that come along: elements, contact and substitutions go with the
  // entries of the tangent, the factorization with its operations.
  constexpr double per_entry = 1.3e-7; // [s]
  cost.seconds = cost.increments * cost.iterations *
                 (per_entry * static_cast<double>(cost.entries) + seconds_of_a_system(cost));
}

} // namespace

CostEstimate cost_estimate(const process::Scene& scene) {
  const mechanics::BlockPattern pattern = mechanics::block_pattern(scene.part.mesh);
  const Elimination factor = elimination(pattern);
  CostEstimate cost;
  cost.unknowns = pattern.n_dofs();
  cost.entries = static_cast<std::int64_t>(pattern.n_entries());
  cost.factor_entries = factor.entries;
  cost.operations = factor.operations;
  cost.increments = increments_of(scene);
  cost.iterations = 4.0;
  choose_solver(cost, pattern.dim, scene.solver.choice);
  add_totals(cost);
  return cost;
}

CostEstimate finer_cost(const CostEstimate& cost, int dim) {
  CostEstimate finer = cost;
  const std::int64_t more = std::int64_t{1} << dim;
  finer.unknowns *= more;
  finer.entries *= more;
  const auto n = static_cast<double>(cost.unknowns), m = static_cast<double>(finer.unknowns);
  const double growth = m / n;
  finer.factor_entries *=
      dim == 2 ? growth * std::log(m) / std::log(std::max(n, 2.0)) : std::pow(growth, 4.0 / 3.0);
  finer.operations *= std::pow(growth, dim == 2 ? 1.5 : 2.0);
  choose_solver(finer, dim,
                cost.by_multigrid ? mechanics::SolverChoice::multigrid
                                  : mechanics::SolverChoice::automatic);
  add_totals(finer);
  return finer;
}

std::optional<std::string> memory_warning(const CostEstimate& cost) {
  constexpr double most = 0.9; // of what is left
  constexpr double megabyte = 1e6;
  const std::optional<double> left = available_memory();
  if (!left || cost.memory <= most * *left)
    return std::nullopt;
  return fmt::format(
      "warning: [memory] the run takes about {:.0f} MB, and {:.0f} MB are left: it may end for "
      "want of memory; larger elements, or a symmetric half of the part, take less",
      cost.memory / megabyte, *left / megabyte);
}

} // namespace billet::app
