// Adds what the fronts of a factorization take from the matrix behind them to their parents'.
//
// A child's rows are among its parent's, in the same order, so a column goes over piece by piece.
// Duff & Reid (1983); decision: docs/decisions/0018-factorization-in-single-precision.md.

#pragma once

#include "mechanics/linear/elimination.h"
#include "mechanics/linear/multifrontal/front_kernels.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace billet::mechanics {

/// The rows of all fronts and where they lie in their parents.
class ExtendAdd {
public:
  explicit ExtendAdd(const Elimination& elimination);

  /// Adds the columns of a child's complement that its parent eliminates.
  ///
  /// @param complement  lower triangle by columns, each padded(rows) apart
  void to_panel(std::size_t child,
                const float* complement,
                const Panel& parent,
                Threads threads = Threads::one) const;

  /// Adds the others, which go on to the parent's parent.
  ///
  /// @param to  complement of the parent
  void to_complement(std::size_t child,
                     const float* complement,
                     const Panel& parent,
                     float* to,
                     Threads threads = Threads::one) const;

private:
  /// Some rows in turn of a child, all of them columns that the parent eliminates or none.
  struct Piece {
    std::uint32_t from;  ///< the first, of the child's
    std::uint32_t count; ///< > 0
    std::uint32_t to;    ///< the first, of the parent's panel
    /// With the widest vectors: which rows of the parent's from there on. Otherwise how they lie.
    std::uint32_t pattern;
  };

  static std::vector<Piece> cut(std::span<const std::uint32_t> places, std::uint32_t columns);
  static void add(const Piece& piece,
                  std::uint32_t first,
                  const std::uint32_t* places,
                  const float* from,
                  float* to);
  /// Adds columns to columns.
  ///
  /// @param columns  pieces that these are the rows of
  /// @param last     of all the child's pieces, the end
  /// @param to       column 0 and row 0 of the parent's panel, or where they would be
  /// @param step     from column to column
  void add_columns(std::size_t child,
                   std::span<const Piece> columns,
                   const Piece* last,
                   const float* complement,
                   float* to,
                   std::ptrdiff_t origin,
                   std::size_t step,
                   Threads threads) const;
  /// The pieces of a child and the first that its parent does not eliminate.
  struct Split {
    std::span<const Piece> all;
    std::size_t eliminated;
  };
  [[nodiscard]] Split split(std::size_t child, std::size_t columns) const;

  std::vector<Piece> pieces_;             ///< of all fronts
  std::vector<std::size_t> pieces_start_; ///< shape (fronts + 1)
  std::vector<std::uint32_t> in_parent_;  ///< of each row of all fronts, the parent's
  std::vector<std::size_t> in_parent_start_;
  std::vector<std::size_t> step_; ///< from column to column of a front's complement
};

} // namespace billet::mechanics
