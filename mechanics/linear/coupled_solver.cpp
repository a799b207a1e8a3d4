#include "mechanics/linear/coupled_solver.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace billet::mechanics {

namespace {

/// Pairs of different nodes that couplings are between, sorted.
std::vector<NodePair> pairs_of(std::span<const Coupling> couplings, int dim) {
  std::vector<NodePair> pairs;
  pairs.reserve(couplings.size());
  for (const Coupling& coupling : couplings) {
    const Index a = coupling.row / dim, b = coupling.column / dim;
    if (a != b)
      pairs.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Entries of a pattern in one that has grown out of it.
std::vector<Index> entries_in(const BlockPattern& grown, const BlockPattern& pattern) {
  std::vector<Index> entries(pattern.n_entries());
  for (Index row = 0; row < pattern.n_dofs(); ++row) {
    Index there = grown.row_start[idx(row)];
    for (Index k = pattern.row_start[idx(row)]; k < pattern.row_start[idx(row) + 1]; ++k) {
      while (grown.columns[idx(there)] != pattern.columns[idx(k)])
        ++there;
      entries[idx(k)] = there;
    }
  }
  return entries;
}

} // namespace

CoupledSolver::CoupledSolver(const BlockPattern& pattern, SolverSettings settings)
    : pattern_(&pattern), settings_(settings), plain_(pattern, settings) {}

void CoupledSolver::set_constrained(std::span<const char> constrained) {
  constrained_.assign(constrained.begin(), constrained.end());
  plain_.set_constrained(constrained);
  if (grown_)
    grown_->solver->set_constrained(constrained);
}

void CoupledSolver::grow(std::span<const Coupling> couplings) {
  std::vector<NodePair> pairs = pairs_of(couplings, pattern_->dim);
  if (grown_) {
    const std::vector<NodePair>& old = grown_->pairs;
    if (std::includes(old.begin(), old.end(), pairs.begin(), pairs.end()))
      return;
    // What has met before may meet again; what has moved on for long only makes fill.
    constexpr std::size_t most_idle = 2;
    std::vector<NodePair> both;
    std::set_union(old.begin(), old.end(), pairs.begin(), pairs.end(), std::back_inserter(both));
    if (both.size() <= (1 + most_idle) * pairs.size())
      pairs = std::move(both);
    gone_ = grown_->solver->work().after(gone_);
  }
  BlockPattern pattern = with_pairs(*pattern_, pairs);
  std::vector<Index> entries = entries_in(pattern, *pattern_);
  grown_ = std::make_unique<Grown>(Grown{
      .pairs = std::move(pairs), .pattern = std::move(pattern), .entries = std::move(entries)});
  grown_->matrix.pattern = &grown_->pattern;
  grown_->matrix.values.resize(grown_->pattern.n_entries());
  grown_->solver = std::make_unique<LinearSolver>(grown_->pattern, settings_);
  if (!constrained_.empty())
    grown_->solver->set_constrained(constrained_);
}

void CoupledSolver::add(const SparseMatrix& matrix, std::span<const Coupling> couplings) {
  SparseMatrix& sum = grown_->matrix;
  std::fill(sum.values.begin(), sum.values.end(), 0.0);
  for (std::size_t k = 0; k < matrix.values.size(); ++k)
    sum.values[idx(grown_->entries[k])] = matrix.values[k];
  for (const Coupling& coupling : couplings)
    sum.values[idx(grown_->pattern.entry(coupling.row, coupling.column))] += coupling.value;
  sum.unsymmetric.clear();
  for (const EntryPart& part : matrix.unsymmetric)
    sum.unsymmetric.push_back({part.row, grown_->entries[idx(part.entry)], part.value});
}

Outcome<SolveReport> CoupledSolver::solve(const SparseMatrix& matrix,
                                          std::span<const Coupling> couplings,
                                          bool symmetric,
                                          std::span<const double> rhs,
                                          std::span<double> x,
                                          const SolveOptions& options) {
  coupled_ = !couplings.empty();
  if (!coupled_)
    return plain_.solve(matrix, symmetric, rhs, x, options);
  grow(couplings);
  add(matrix, couplings);
  return grown_->solver->solve(grown_->matrix, symmetric, rhs, x, options);
}

Outcome<SolveReport> CoupledSolver::solve_again(const SparseMatrix& matrix,
                                                bool symmetric,
                                                std::span<const double> rhs,
                                                std::span<double> x,
                                                double tolerance) {
  if (coupled_)
    return grown_->solver->solve_again(grown_->matrix, symmetric, rhs, x, tolerance);
  return plain_.solve_again(matrix, symmetric, rhs, x, tolerance);
}

void CoupledSolver::forget() {
  plain_.forget();
  if (grown_)
    gone_ = grown_->solver->work().after(gone_);
  grown_.reset();
}

SolverWork CoupledSolver::work() const {
  if (!grown_)
    return plain_.work().after(gone_);
  // The last factorization is that of the solver that was asked last.
  const SolverWork& plain = plain_.work();
  const SolverWork& grown = grown_->solver->work();
  return (coupled_ ? grown.after(plain) : plain.after(grown)).after(gone_);
}

} // namespace billet::mechanics
