#include "mechanics/linear/sparse_matrix.h"

#include "geometry/base/pieces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <deque>
#include <numeric>
#include <type_traits>
#include <utility>

namespace billet::mechanics {

namespace {

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

/// Calls `visit` with the number of unknowns a node as a constant: loops over it are unrolled.
template <class Visit> void visit_dimension(int dim, Visit visit) {
  if (dim == 2)
    visit(std::integral_constant<std::size_t, 2>{});
  else
    visit(std::integral_constant<std::size_t, 3>{});
}

/// Adds the rows of one node of a local matrix.
///
/// @param offsets  which neighbours of that node the nodes of the group are, shape (size)
/// @param local    shape (dim, size * dim)
/// @param width    entries of a row of the node
/// @param values   of the first row of the node
template <std::size_t dim>
void add_rows(std::size_t size,
              const Index* offsets,
              const double* local,
              std::size_t width,
              double* values) {
  for (std::size_t b = 0; b < size; ++b) {
    double* target = values + idx(offsets[b]) * dim;
    const double* source = local + b * dim;
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j)
        target[i * width + j] += source[i * size * dim + j];
  }
}

/// Asks for the numbers that are read next: rows side by side are streams too short for the
/// processor to foresee.
template <std::size_t count> void fetch(const double* next) {
  constexpr std::size_t line = 8; // numbers
  for (std::size_t i = 0; i < count; i += line)
    __builtin_prefetch(next + i);
}

/// Two numbers: the unknowns of a node in the plane.
using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

// By reference, as vectors in single precision are.
void load(const double* from, Pair& pair) { std::memcpy(&pair, from, sizeof pair); }

/// y = A x of a node in the plane, whose unknowns' rows and columns come two by two.
///
/// @param row    of its first unknown, shape (2, 2 n)
/// @param nodes  that its n blocks couple it with
void multiply_pairs(std::size_t n,
                    const double* row,
                    const Index* nodes,
                    const double* x,
                    double* y) {
  constexpr std::size_t ahead = 512; // numbers, 4 kB: half and twice of it are as good
  Pair first{}, second{};
  for (std::size_t b = 0; b < n; ++b) {
    fetch<4>(row + 4 * b + ahead);
    Pair at, upper, lower;
    load(x + 2 * idx(nodes[b]), at);
    load(row + 2 * b, upper);
    load(row + 2 * (n + b), lower);
    first += upper * at;
    second += lower * at;
  }
  y[0] = first[0] + first[1];
  y[1] = second[0] + second[1];
}

/// y = A x for some nodes, the rows of each side by side: their columns are the same.
template <std::size_t dim>
void multiply_blocks(const BlockPattern& pattern,
                     std::size_t begin,
                     std::size_t end,
                     const double* values,
                     const double* x,
                     double* y) {
  constexpr std::size_t ahead = 512; // numbers, 4 kB: half and twice of it are as good
  for (std::size_t a = begin; a < end; ++a) {
    const Index first = pattern.neighbour_start[a];
    const std::size_t n = idx(pattern.neighbour_start[a + 1] - first);
    const double* row = values + pattern.row_start[a * dim];
    if constexpr (dim == 2) {
      multiply_pairs(n, row, pattern.neighbours.data() + first, x, y + a * dim);
      continue;
    }
    std::array<std::array<double, dim>, dim> sums{}; // by row and column: none waits for another
    for (std::size_t b = 0; b < n; ++b) {
      fetch<dim * dim>(row + b * dim * dim + ahead);
      const double* at = x + idx(pattern.neighbours[idx(first) + b]) * dim;
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j)
          sums[i][j] += row[(i * n + b) * dim + j] * at[j];
    }
    for (std::size_t i = 0; i < dim; ++i)
      y[a * dim + i] = std::accumulate(sums[i].begin(), sums[i].end(), 0.0);
  }
}

/// Mean of each entry and of the one across the diagonal, for some nodes.
template <std::size_t dim>
void average_blocks(const BlockPattern& pattern,
                    std::size_t begin,
                    std::size_t end,
                    const double* values,
                    double* means) {
  const auto neighbours = [&](std::size_t node) {
    return idx(pattern.neighbour_start[node + 1] - pattern.neighbour_start[node]);
  };
  for (std::size_t a = begin; a < end; ++a) {
    const std::size_t first = idx(pattern.neighbour_start[a]), n = neighbours(a);
    const std::size_t row = idx(pattern.row_start[a * dim]);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t b = idx(pattern.neighbours[first + k]);
      const std::size_t block = row + k * dim, width = n * dim, other_width = neighbours(b) * dim;
      const std::size_t other =
          idx(pattern.row_start[b * dim]) + idx(pattern.mirror[first + k]) * dim;
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) {
          const std::size_t here = block + i * width + j;
          means[here] = 0.5 * (values[here] + values[other + j * other_width + i]);
        }
    }
  }
}

/// Calls `work(begin, end)` for pieces of nodes that have so many entries, about, that to share
/// them is worth it.
template <class Work> void for_rows(const BlockPattern& pattern, const Work& work) {
  constexpr std::size_t at_once = 1 << 15; // entries
  const std::size_t nodes = idx(pattern.n_nodes());
  const std::size_t per_node = pattern.n_entries() / std::max(nodes, std::size_t{1}) + 1;
  for_pieces(nodes, at_once / per_node + 1, work);
}

} // namespace

Index BlockPattern::offset(Index a, Index b) const {
  const auto first = neighbours.begin() + neighbour_start[idx(a)];
  const auto last = neighbours.begin() + neighbour_start[idx(a) + 1];
  const auto found = std::lower_bound(first, last, b);
  assert(found != last && *found == b);
  return static_cast<Index>(found - first);
}

Index BlockPattern::entry(Index row, Index column) const {
  return row_start[idx(row)] + offset(row / dim, column / dim) * dim + column % dim;
}

namespace {

/// @param neighbours  of every node, sorted, the node itself included
BlockPattern pattern_of(int dim, const std::vector<std::vector<Index>>& neighbours) {
  BlockPattern pattern;
  pattern.dim = dim;
  pattern.neighbour_start.push_back(0);
  pattern.row_start.push_back(0);
  // Nodes are walked in order, so each comes as the next of its neighbours' not met so far.
  std::vector<Index> met(neighbours.size(), 0);
  for (const auto& list : neighbours) {
    for (const Index b : list)
      pattern.mirror.push_back(met[idx(b)]++);
    pattern.neighbours.insert(pattern.neighbours.end(), list.begin(), list.end());
    pattern.neighbour_start.push_back(static_cast<Index>(pattern.neighbours.size()));
    for (int i = 0; i < pattern.dim; ++i) {
      for (const Index b : list)
        for (int j = 0; j < pattern.dim; ++j) {
          if (b * pattern.dim + j == static_cast<Index>(pattern.row_start.size()) - 1)
            pattern.diagonal.push_back(static_cast<Index>(pattern.columns.size()));
          pattern.columns.push_back(b * pattern.dim + j);
        }
      pattern.row_start.push_back(static_cast<Index>(pattern.columns.size()));
    }
  }
  return pattern;
}

} // namespace

BlockPattern block_pattern(const Mesh& mesh) {
  return pattern_of(mesh.dimension(), adjacency(mesh));
}

BlockPattern with_pairs(const BlockPattern& pattern, std::span<const NodePair> pairs) {
  std::vector<std::vector<Index>> neighbours(idx(pattern.n_nodes()));
  for (std::size_t a = 0; a < neighbours.size(); ++a)
    neighbours[a].assign(pattern.neighbours.begin() + pattern.neighbour_start[a],
                         pattern.neighbours.begin() + pattern.neighbour_start[a + 1]);
  std::vector<char> grown(neighbours.size(), 0);
  for (const auto& [a, b] : pairs)
    for (const auto& [from, to] : {NodePair{a, b}, NodePair{b, a}}) {
      neighbours[idx(from)].push_back(to);
      grown[idx(from)] = 1;
    }
  for (std::size_t a = 0; a < neighbours.size(); ++a)
    if (grown[a] != 0) {
      auto& list = neighbours[a];
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  return pattern_of(pattern.dim, neighbours);
}

Scatter::Scatter(const BlockPattern& pattern, std::vector<Index> groups, int size, Index together)
    : size_(size), groups_(std::move(groups)) {
  offsets_.reserve(groups_.size() * idx(size));
  for (Index g = 0; g < n_groups(); ++g)
    for (const Index a : nodes(g))
      for (const Index b : nodes(g))
        offsets_.push_back(pattern.offset(a, b));
  put_in_order(pattern.n_nodes(), pieces(pattern.n_nodes(), together));
  find_followers(pattern.n_nodes());
}

/// Grown from neighbour to neighbour, each piece from where the one before stopped.
std::vector<std::vector<Index>> Scatter::pieces(Index n_nodes, Index together) const {
  // Large for what few rows they share, small enough for some threads to have several of a colour.
  constexpr Index smallest = 4, largest = 64, usual_number = 64;
  const Index about = std::clamp(n_groups() / usual_number, smallest, largest);
  const auto enough = idx((about + together - 1) / together * together);
  std::vector<std::vector<Index>> around(idx(n_nodes));
  for (Index g = 0; g < n_groups(); ++g)
    for (const Index a : nodes(g))
      around[idx(a)].push_back(g);
  enum class State : char { unmet, waiting, taken };
  std::vector<State> state(idx(n_groups()), State::unmet);
  std::deque<Index> waiting; // neighbours of earlier pieces, some of them taken since
  Index lowest = 0;
  const auto seed = [&] {
    while (!waiting.empty() && state[idx(waiting.front())] == State::taken)
      waiting.pop_front();
    if (!waiting.empty())
      return waiting.front();
    while (state[idx(lowest)] == State::taken)
      ++lowest;
    return lowest;
  };
  std::vector<std::vector<Index>> pieces;
  for (std::size_t done = 0; done < state.size(); done += pieces.back().size()) {
    std::vector<Index> piece{seed()};
    state[idx(piece.front())] = State::taken;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const Index a : nodes(piece[k]))
        for (const Index g : around[idx(a)]) {
          State& of_neighbour = state[idx(g)];
          if (of_neighbour == State::taken)
            continue;
          if (piece.size() < enough) {
            of_neighbour = State::taken;
            piece.push_back(g);
          } else if (of_neighbour == State::unmet) {
            of_neighbour = State::waiting;
            waiting.push_back(g);
          }
        }
    std::sort(piece.begin(), piece.end()); // as their states and nodes lie in memory
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// By colour, those of one colour without a common node: few wait for each other.
void Scatter::put_in_order(Index n_nodes, const std::vector<std::vector<Index>>& pieces) {
  // Greedy: each piece takes the first colour none of its nodes has yet. 64 colours suffice for
  // any mesh met so far; pieces beyond them come last, one after another.
  constexpr std::size_t most = 64;
  std::vector<std::uint64_t> used(idx(n_nodes), 0);
  std::vector<std::vector<std::size_t>> members(most + 1);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    std::uint64_t taken = 0;
    for (const Index g : pieces[p])
      for (const Index a : nodes(g))
        taken |= used[idx(a)];
    const auto c = static_cast<std::size_t>(std::countr_one(taken));
    members[c].push_back(p);
    if (c == most)
      continue;
    for (const Index g : pieces[p])
      for (const Index a : nodes(g))
        used[idx(a)] |= std::uint64_t{1} << c;
  }
  piece_start_.push_back(0);
  for (const auto& list : members)
    for (const std::size_t p : list) {
      order_.insert(order_.end(), pieces[p].begin(), pieces[p].end());
      piece_start_.push_back(static_cast<Index>(order_.size()));
    }
}

/// Of the pieces that meet at a node each waits for the one before it.
void Scatter::find_followers(Index n_nodes) {
  constexpr Index none = -1;
  const std::size_t n = piece_start_.size() - 1;
  std::vector<Index> last(idx(n_nodes), none); // piece at a node
  std::vector<std::vector<Index>> before(n);
  waits_.resize(n);
  follower_start_.assign(n + 1, 0);
  for (std::size_t p = 0; p < n; ++p) {
    const auto own = static_cast<Index>(p);
    for (Index k = piece_start_[p]; k < piece_start_[p + 1]; ++k)
      for (const Index a : nodes(order_[idx(k)]))
        if (last[idx(a)] != own) {
          if (last[idx(a)] != none)
            before[p].push_back(last[idx(a)]);
          last[idx(a)] = own;
        }
    std::sort(before[p].begin(), before[p].end());
    before[p].erase(std::unique(before[p].begin(), before[p].end()), before[p].end());
    waits_[p] = static_cast<Index>(before[p].size());
    for (const Index q : before[p])
      ++follower_start_[idx(q) + 1];
  }
  std::partial_sum(follower_start_.begin(), follower_start_.end(), follower_start_.begin());
  followers_.resize(idx(follower_start_.back()));
  std::vector<Index> next(follower_start_.begin(), follower_start_.end() - 1);
  for (std::size_t p = 0; p < n; ++p)
    for (const Index q : before[p])
      followers_[idx(next[idx(q)]++)] = static_cast<Index>(p);
}

void Scatter::find_places(const BlockPattern& pattern,
                          Index group,
                          std::span<double> values,
                          BlockPlaces& places) const {
  assert(idx(size_) <= BlockPlaces::max_nodes);
  places.blocks = offsets_.data() + at(group) * idx(size_);
  for (std::size_t a = 0; a < idx(size_); ++a) {
    const std::size_t row = idx(nodes(group)[a]) * idx(pattern.dim);
    const Index first = pattern.row_start[row];
    places.rows[a] = values.data() + first;
    places.apart[a] = idx(pattern.row_start[row + 1] - first);
  }
}

void Scatter::add(const BlockPattern& pattern,
                  Index group,
                  const double* local,
                  std::span<double> values) const {
  const auto size = idx(size_);
  const Index* offsets = offsets_.data() + at(group) * size;
  visit_dimension(pattern.dim, [&](auto constant) {
    constexpr std::size_t dim = decltype(constant)::value;
    for (std::size_t a = 0; a < size; ++a) {
      const std::size_t row = idx(nodes(group)[a]) * dim;
      const Index first = pattern.row_start[row];
      add_rows<dim>(size, offsets + a * size, local + a * dim * size * dim,
                    idx(pattern.row_start[row + 1] - first), values.data() + first);
    }
  });
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
  visit_dimension(dim, [&](auto constant) {
    constexpr std::size_t n = decltype(constant)::value;
    for (const Index a : nodes(group))
      for (std::size_t i = 0; i < n; ++i)
        vector[idx(a) * n + i] += *local++;
  });
}

void SparseMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  for_rows(*pattern, [&](std::size_t begin, std::size_t end) {
    visit_dimension(pattern->dim, [&](auto constant) {
      multiply_blocks<decltype(constant)::value>(*pattern, begin, end, values.data(), x.data(),
                                                 y.data());
    });
  });
}

void SparseMatrix::take_symmetric_part(SparseMatrix& part) const {
  part.pattern = pattern;
  part.values.resize(values.size());
  for_rows(*pattern, [&](std::size_t begin, std::size_t end) {
    visit_dimension(pattern->dim, [&](auto constant) {
      average_blocks<decltype(constant)::value>(*pattern, begin, end, values.data(),
                                                part.values.data());
    });
  });
  for (const EntryPart& taken : unsymmetric) {
    part.values[idx(taken.entry)] -= 0.5 * taken.value;
    part.values[idx(pattern->entry(pattern->columns[idx(taken.entry)], taken.row))] -=
        0.5 * taken.value;
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
