// The sparsity of a mesh, and a matrix over it that elements write to at known positions.
//
// Tools are rigid, so contact with them couples only nodes of one face: the pattern is the mesh's
// own and is made once per mesh. What couples faces of the part that meet is kept outside of it
// (Coupling). Unknown i of node a has number a * dim + i. Rows are compressed; the pattern is
// symmetric, its values need not be. Constrained unknowns stay in it as rows of the identity.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace billet::mechanics {

/// Which nodes are coupled, and where the entries of their blocks lie.
struct BlockPattern {
  int dim = 0;                        ///< unknowns a node
  std::vector<Index> neighbour_start; ///< shape (n_nodes + 1)
  std::vector<Index> neighbours;      ///< sorted within a node, the node itself included
  std::vector<Index> row_start;       ///< shape (n_dofs + 1)
  std::vector<Index> columns;         ///< shape (n_entries), sorted within a row
  std::vector<Index> diagonal;        ///< shape (n_dofs): the entry of each row on it
  /// By neighbour of a node: as which of that neighbour's own the node comes.
  std::vector<Index> mirror;

  [[nodiscard]] Index n_nodes() const { return static_cast<Index>(neighbour_start.size()) - 1; }
  [[nodiscard]] Index n_dofs() const { return n_nodes() * dim; }
  [[nodiscard]] std::size_t n_entries() const { return columns.size(); }
  /// Position of node b among the neighbours of node a. @pre they are coupled
  [[nodiscard]] Index offset(Index a, Index b) const;
  /// Position of an entry among the values. @pre the nodes of row and column are coupled
  [[nodiscard]] Index entry(Index row, Index column) const;
};

/// Pattern of a mesh whose every cell couples all its nodes.
[[nodiscard]] BlockPattern block_pattern(const Mesh& mesh);

/// Two nodes, the smaller number first.
using NodePair = std::pair<Index, Index>;

/// A pattern with further pairs of nodes coupled.
///
/// @param pairs  sorted
[[nodiscard]] BlockPattern with_pairs(const BlockPattern& pattern, std::span<const NodePair> pairs);

/// A part of one entry of a matrix.
struct EntryPart {
  Index row;
  Index entry; ///< index into the values
  double value;
};

/// A part of an entry that the mesh's pattern may have no place for: it couples nodes that no
/// element has in common.
struct Coupling {
  Index row;
  Index column;
  double value;
};

/// Where the blocks of an element's tangent are added: for each of its nodes the first entry of the
/// rows and how far they lie apart, and which block of them belongs to each node.
struct BlockPlaces {
  static constexpr std::size_t max_nodes = 20;
  std::array<double*, max_nodes> rows;
  std::array<std::size_t, max_nodes> apart;
  const Index* blocks; ///< shape (nodes, nodes)
};

/// Where the blocks of equally large groups of nodes (elements or faces) go in the matrix, and an
/// order in pieces of neighbours: rows are added to while they are at hand. Pieces with a common
/// node are worked on one after another, always in the same order: sums come out the same to the
/// bit for any number of threads.
class Scatter {
public:
  /// @param groups    shape (n_groups, size), node numbers
  /// @param together  pieces hold multiples of it where they can: groups worked on side by side
  Scatter(const BlockPattern& pattern, std::vector<Index> groups, int size, Index together = 1);
  Scatter() = default;

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] Index n_groups() const {
    return size_ == 0 ? 0 : static_cast<Index>(groups_.size()) / size_;
  }
  [[nodiscard]] std::span<const Index> nodes(Index group) const {
    return std::span(groups_).subspan(at(group), static_cast<std::size_t>(size_));
  }
  /// Groups by piece: piece p holds order[piece_start[p] .. piece_start[p + 1]).
  [[nodiscard]] const std::vector<Index>& order() const { return order_; }
  [[nodiscard]] const std::vector<Index>& piece_start() const { return piece_start_; }
  /// Pieces that have to wait for a piece: those with a common node that come after it.
  [[nodiscard]] std::span<const Index> followers(Index piece) const {
    const Index first = follower_start_[idx(piece)];
    return std::span(followers_).subspan(idx(first), idx(follower_start_[idx(piece) + 1] - first));
  }
  /// How many pieces each has to wait for, shape (pieces).
  [[nodiscard]] const std::vector<Index>& waits() const { return waits_; }

  /// Finds where a group's blocks lie in `values`. @pre size() is at most BlockPlaces::max_nodes
  void find_places(const BlockPattern& pattern,
                   Index group,
                   std::span<double> values,
                   BlockPlaces& places) const;
  /// Adds a local matrix, shape (size * dim, size * dim) row by row, to `values`.
  void add(const BlockPattern& pattern,
           Index group,
           const double* local,
           std::span<double> values) const;
  /// Lists the parts of a local matrix, but for zeros.
  void list(const BlockPattern& pattern,
            Index group,
            const double* local,
            std::vector<EntryPart>& parts) const;
  /// Adds a local vector, shape (size * dim), to `vector`.
  void add(int dim, Index group, const double* local, std::span<double> vector) const;

private:
  [[nodiscard]] std::size_t at(Index group) const {
    return static_cast<std::size_t>(group) * static_cast<std::size_t>(size_);
  }
  [[nodiscard]] std::vector<std::vector<Index>> pieces(Index n_nodes, Index together) const;
  void put_in_order(Index n_nodes, const std::vector<std::vector<Index>>& pieces);
  void find_followers(Index n_nodes);

  int size_ = 0;
  std::vector<Index> groups_;
  std::vector<Index> offsets_; ///< shape (n_groups, size, size)
  std::vector<Index> order_;
  std::vector<Index> piece_start_;
  std::vector<Index> followers_;
  std::vector<Index> follower_start_;
  std::vector<Index> waits_;
};

/// Values over a pattern.
struct SparseMatrix {
  const BlockPattern* pattern = nullptr;
  std::vector<double> values; ///< shape (n_entries)
  /// What, taken away, leaves a symmetric matrix close to this one, in any order: what couples slip
  /// to pressure and shear yield stress. Solvers may use it; it is part of the values.
  std::vector<EntryPart> unsymmetric = {};

  /// y = A x, shapes (n_dofs).
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// The symmetric part of what is left without `unsymmetric`.
  ///
  /// @param part  out
  void take_symmetric_part(SparseMatrix& part) const;
  /// Largest |a_ij - a_ji| over the largest |a_ij|.
  [[nodiscard]] double asymmetry() const;
};

} // namespace billet::mechanics
