// Cholesky's factor in single precision: what GMRES asks of a preconditioner, for half the bytes.
//
// A substitution reads the factor twice and does little else, so it costs what its bytes cost; in
// small problems the calls to BLAS for every front cost as much again. Decision: docs/decisions/
// 0014-substitutions-in-single-precision.md.

#pragma once

#include "mechanics/sparse_matrix.h"

#include <cstddef>
#include <span>
#include <vector>

struct cholmod_factor_struct;

namespace billet::mechanics {

class SingleFactor {
public:
  /// Takes the structure of a supernodal factor; `take` takes its values.
  ///
  /// @param order  place i of the factor holds unknown order[i]
  SingleFactor(const cholmod_factor_struct& factor, std::span<const Index> order);

  /// @param factor  of the same structure
  void take(const cholmod_factor_struct& factor);
  /// Overwrites the right-hand side with the solution, to some six digits.
  void solve(std::span<double> rhs);

private:
  /// Columns in turn with the same rows below them: a dense triangle on a dense rectangle.
  struct Front {
    Index first;          ///< column
    Index columns;        ///< of both
    Index rows;           ///< of the rectangle
    std::size_t row;      ///< where its rows begin
    std::size_t triangle; ///< where its values begin, by columns; the rectangle's follow
  };

  void forward();
  void backward();

  std::vector<Front> fronts_;
  std::vector<Index> rows_; ///< of all rectangles
  std::vector<float> values_;
  std::vector<Index> order_; ///< position i holds unknown order_[i]
  std::vector<float> x_;     ///< in that order
  std::vector<float> below_; ///< of a rectangle's rows
};

} // namespace billet::mechanics
