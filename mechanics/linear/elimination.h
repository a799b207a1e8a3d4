// How a symmetric matrix over a pattern is eliminated: the order, the entries in it, the fronts.
//
// CHOLMOD's symbolic analysis finds the fronts; they serve its own factorization and the one in
// single precision.

#pragma once

#include "mechanics/linear/sparse_matrix.h"

#include <cstddef>
#include <span>
#include <vector>

struct cholmod_common_struct;
struct cholmod_sparse_struct;

namespace billet::mechanics {

/// The lower triangle of a symmetric matrix by columns, its unknowns in another order.
struct OrderedTriangle {
  std::vector<Index> start;   ///< shape (n + 1)
  std::vector<Index> rows;    ///< ascending within a column
  std::vector<Index> entries; ///< of the matrix that the values are taken from

  /// @param constrained  by unknown, not 0: it is coupled with no other
  OrderedTriangle(const BlockPattern& pattern,
                  std::span<const Index> order,
                  std::span<const char> constrained);
  /// As CHOLMOD sees it, which only reads it.
  ///
  /// @param values  of the rows; empty: the structure alone
  [[nodiscard]] cholmod_sparse_struct view(std::span<const double> values) const;
};

/// Columns in turn with the same rows below them: a dense triangle on a dense rectangle.
struct Front {
  Index first;     ///< column
  Index columns;   ///< of both
  Index rows;      ///< of the rectangle
  std::size_t row; ///< where its rows begin
  Index parent;    ///< front that its rectangle is handed to; -1: none
};

/// Order, triangle and fronts of a pattern. A front's children come just before it, each with its
/// own before.
class Elimination {
public:
  /// @param order  fill-reducing: place i holds unknown order[i]
  /// @param constrained  by unknown, not 0: it is coupled with no other, whatever the pattern says,
  /// and
  ///               comes first; empty: none
  /// @throws std::bad_alloc
  Elimination(const BlockPattern& pattern,
              std::span<const Index> order,
              std::span<const char> constrained = {});

  [[nodiscard]] int dim() const { return dim_; } ///< unknowns a node
  /// As it was given, but for branches of the elimination tree that now come one after another.
  [[nodiscard]] std::span<const Index> order() const { return order_; }
  [[nodiscard]] const OrderedTriangle& triangle() const { return triangle_; }
  [[nodiscard]] std::span<const Front> fronts() const { return fronts_; }
  /// Of a front's rectangle, ascending.
  [[nodiscard]] std::span<const Index> rows(const Front& front) const {
    return std::span(rows_).subspan(front.row, idx(front.rows));
  }
  [[nodiscard]] double flops() const { return flops_; }     ///< of a Cholesky factorization
  [[nodiscard]] double entries() const { return entries_; } ///< of its factor

private:
  void follow_elimination(const BlockPattern& pattern,
                          std::span<const char> constrained,
                          cholmod_common_struct& common);
  void find_fronts(cholmod_common_struct& common);

  int dim_;
  std::vector<Index> order_;
  OrderedTriangle triangle_;
  std::vector<Front> fronts_;
  std::vector<Index> rows_; ///< of all rectangles
  double flops_ = 0.0;
  double entries_ = 0.0;
};

/// Settings with which CHOLMOD keeps an order as it is.
///
/// @pre cholmod_start has been called
void keep_order(cholmod_common_struct& common);

} // namespace billet::mechanics
