// Where the entries of a matrix lie in the panels of its fronts.
//
// The unknowns of a node come one after another in the order as well: what couples two nodes is
// copied as one block, with one place to look up. Decision:
// docs/decisions/0018-factorization-in-single-precision.md.

#pragma once

#include "mechanics/linear/elimination.h"
#include "mechanics/linear/multifrontal/front_kernels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace billet::mechanics {

/// Copies columns of a symmetric matrix into the panels that eliminate them.
class FrontAssembly {
public:
  explicit FrontAssembly(const Elimination& elimination);

  /// Overwrites a panel with its columns of the matrix.
  ///
  /// @param f      the panel's front
  /// @param scale  the matrix is multiplied by
  void assemble(std::size_t f, const SparseMatrix& matrix, double scale, const Panel& panel) const;

private:
  /// What couples the unknowns of two nodes.
  struct Block {
    std::uint32_t entry; ///< of the matrix, its first
    std::uint32_t width; ///< of the matrix' rows
    std::uint32_t place; ///< in the panel
  };
  /// Entries that are in no block: of nodes that only some unknowns of are coupled.
  struct Single {
    std::uint32_t entry;
    std::uint32_t place;
  };
  /// Where what belongs to a front begins.
  struct Start {
    std::size_t along;
    std::size_t across;
    std::size_t singles;
  };
  template <std::size_t dim>
  void
  copy_blocks(std::size_t f, const SparseMatrix& matrix, double scale, const Panel& panel) const;

  std::size_t dim_;
  std::vector<Block> along_;  ///< rows of the matrix are columns of the panel
  std::vector<Block> across_; ///< ... and rows of it
  std::vector<Single> singles_;
  std::vector<Start> start_; ///< shape (fronts + 1)
};

} // namespace billet::mechanics
