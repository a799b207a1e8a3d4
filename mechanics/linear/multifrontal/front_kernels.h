// Elimination of columns of small dense matrices in single precision.
//
// The fronts of a mesh of some thousand unknowns have tens of rows: calls to BLAS, which packs its
// operands first, take longer there than the products themselves. Large products go to it.
//
// A panel is the lower trapezoid of a symmetric matrix, its columns to be eliminated, by columns.
// Rows are padded to whole vectors of the processor; what lies in the padding and above the
// diagonal takes part in the arithmetic and is never looked at. Decision:
// docs/decisions/0018-factorization-in-single-precision.md.

#pragma once

#include "geometry/base/index.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace billet::mechanics {

/// Numbers in a vector of the processor: what rows are padded to.
constexpr std::size_t front_lanes = 8;

/// @return rows, padded
constexpr std::size_t padded(std::size_t rows) {
  return (rows + front_lanes - 1) / front_lanes * front_lanes;
}

/// The lower trapezoid of a symmetric matrix.
struct Panel {
  float* values;       ///< by columns, each padded(rows) apart
  std::size_t rows;    ///< of the first column, its diagonal included
  std::size_t columns; ///< at most rows
};

/// Who works on a front: those of a branch are left to one thread, the work within larger ones is
/// shared.
enum class Threads { one, all };

/// Memory that the products work in.
struct FrontWork {
  std::vector<float> factors;
};

/// That of each of the threads that share a front.
class FrontTeam {
public:
  FrontTeam();
  ~FrontTeam();
  FrontTeam(const FrontTeam&) = delete;
  FrontTeam& operator=(const FrontTeam&) = delete;

  /// Of the thread that asks.
  [[nodiscard]] FrontWork& local();
  /// Gives the memory of all back.
  void clear();

private:
  struct Members;
  std::unique_ptr<Members> members_;
};

/// Overwrites a panel with L of A = L S L^T, S a diagonal of signs, but for L's diagonal.
///
/// @param least     shape (columns): pivots no larger are lost in rounding
/// @param inverses  out, shape (columns): of L's diagonal
/// @param signs     out, shape (columns): S
/// @param team      of threads that share the work; none: it is done here, with `work`
/// @return whether no pivot was lost
[[nodiscard]] bool eliminate(const Panel& panel,
                             const float* least,
                             float* inverses,
                             float* signs,
                             FrontWork& work,
                             FrontTeam* team = nullptr);

/// What an eliminated panel takes from the matrix behind it: -R S R^T, R its rows below the
/// triangle.
///
/// @param signs       of the panel
/// @param complement  out: lower triangle by columns, each padded(rows - columns) apart
/// @param team        as above
void form_complement(const Panel& panel,
                     const float* signs,
                     float* complement,
                     FrontWork& work,
                     FrontTeam* team = nullptr);

} // namespace billet::mechanics
