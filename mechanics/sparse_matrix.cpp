#include "mechanics/sparse_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace billet::mechanics {

namespace {

std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

/// Sorted neighbours of every node, the node itself included.
std::vector<std::vector<Index>> adjacency(const Mesh& mesh) {
  std::vector<std::vector<Index>> neighbours(mesh.points.size());
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (const Index a : mesh.cell(e))
      for (const Index b : mesh.cell(e))
        neighbours[idx(a)].push_back(b);
  for (Index a = 0; a < mesh.n_points(); ++a) {
    auto& list = neighbours[idx(a)];
    list.push_back(a);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

} // namespace

Index BlockPattern::offset(Index a, Index b) const {
  const auto first = neighbours.begin() + neighbour_start[idx(a)];
  const auto last = neighbours.begin() + neighbour_start[idx(a) + 1];
  const auto found = std::lower_bound(first, last, b);
  assert(found != last && *found == b);
  return static_cast<Index>(found - first);
}

BlockPattern block_pattern(const Mesh& mesh) {
  BlockPattern pattern;
  pattern.dim = mesh.dimension();
  pattern.neighbour_start.push_back(0);
  pattern.row_start.push_back(0);
  for (const auto& list : adjacency(mesh)) {
    pattern.neighbours.insert(pattern.neighbours.end(), list.begin(), list.end());
    pattern.neighbour_start.push_back(static_cast<Index>(pattern.neighbours.size()));
    for (int i = 0; i < pattern.dim; ++i) {
      for (const Index b : list)
        for (int j = 0; j < pattern.dim; ++j)
          pattern.columns.push_back(b * pattern.dim + j);
      pattern.row_start.push_back(static_cast<Index>(pattern.columns.size()));
    }
  }
  return pattern;
}

Scatter::Scatter(const BlockPattern& pattern, std::vector<Index> groups, int size)
    : size_(size), groups_(std::move(groups)) {
  offsets_.reserve(groups_.size() * idx(size));
  for (Index g = 0; g < n_groups(); ++g)
    for (const Index a : nodes(g))
      for (const Index b : nodes(g))
        offsets_.push_back(pattern.offset(a, b));
  colour(pattern.n_nodes());
}

void Scatter::colour(Index n_nodes) {
  // Greedy: each group takes the first colour none of its nodes has yet. 64 colours suffice for
  // any mesh met so far; groups beyond them go to colours of their own, one each.
  constexpr int most = 64;
  std::vector<std::uint64_t> used(idx(n_nodes), 0);
  std::vector<std::vector<Index>> members(most);
  for (Index g = 0; g < n_groups(); ++g) {
    std::uint64_t taken = 0;
    for (const Index a : nodes(g))
      taken |= used[idx(a)];
    int c = 0;
    while (c < most && ((taken >> c) & 1U) != 0)
      ++c;
    if (c == most) {
      members.push_back({g});
      continue;
    }
    members[idx(c)].push_back(g);
    for (const Index a : nodes(g))
      used[idx(a)] |= std::uint64_t{1} << c;
  }
  colour_start_.push_back(0);
  for (const auto& list : members) {
    if (list.empty())
      continue;
    order_.insert(order_.end(), list.begin(), list.end());
    colour_start_.push_back(static_cast<Index>(order_.size()));
  }
}

void Scatter::add(const BlockPattern& pattern,
                  Index group,
                  const double* local,
                  std::span<double> values) const {
  const auto dim = idx(pattern.dim);
  const auto size = idx(size_);
  const Index* offsets = offsets_.data() + at(group) * size;
  for (std::size_t a = 0; a < size; ++a) {
    const auto row = idx(nodes(group)[a]) * dim;
    for (std::size_t i = 0; i < dim; ++i) {
      double* target = values.data() + pattern.row_start[row + i];
      const double* source = local + (a * dim + i) * size * dim;
      for (std::size_t b = 0; b < size; ++b)
        for (std::size_t j = 0; j < dim; ++j)
          target[idx(offsets[a * size + b]) * dim + j] += source[b * dim + j];
    }
  }
}

void Scatter::list(const BlockPattern& pattern,
                   Index group,
                   const double* local,
                   std::vector<EntryPart>& parts) const {
  const auto dim = idx(pattern.dim);
  const auto size = idx(size_);
  const Index* offsets = offsets_.data() + at(group) * size;
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t i = 0; i < dim; ++i) {
      const std::size_t row = idx(nodes(group)[a]) * dim + i;
      for (std::size_t b = 0; b < size; ++b)
        for (std::size_t j = 0; j < dim; ++j, ++local)
          if (*local != 0.0)
            parts.push_back({static_cast<Index>(row),
                             pattern.row_start[row] + offsets[a * size + b] * pattern.dim +
                                 static_cast<Index>(j),
                             *local});
    }
}

void Scatter::add(int dim, Index group, const double* local, std::span<double> vector) const {
  const auto n = idx(dim);
  for (const Index a : nodes(group))
    for (std::size_t i = 0; i < n; ++i)
      vector[idx(a) * n + i] += *local++;
}

void SparseMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < y.size(); ++i) {
    double sum = 0.0;
    for (Index k = pattern->row_start[i]; k < pattern->row_start[i + 1]; ++k)
      sum += values[idx(k)] * x[idx(pattern->columns[idx(k)])];
    y[i] = sum;
  }
}

double SparseMatrix::asymmetry() const {
  double largest = 0.0;
  double difference = 0.0;
  const auto& start = pattern->row_start;
  // The rows are walked in order, so the next unvisited entry of each row above the diagonal is the
  // transpose of the entry at hand.
  std::vector<Index> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i + 1 < start.size(); ++i)
    for (Index k = start[i]; k < start[i + 1]; ++k) {
      const auto j = idx(pattern->columns[idx(k)]);
      largest = std::max(largest, std::abs(values[idx(k)]));
      const Index transposed = next[j]++;
      difference = std::max(difference, std::abs(values[idx(k)] - values[idx(transposed)]));
    }
  return largest > 0.0 ? difference / largest : 0.0;
}

} // namespace billet::mechanics
