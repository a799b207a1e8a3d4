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

#include <array>
#include <cstddef>
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

/// Memory that the products work in.
struct FrontWork {
  std::vector<float> factors;
};

/// Overwrites a panel with L of A = L S L^T, S a diagonal of signs, but for L's diagonal.
///
/// @param least     shape (columns): pivots no larger are lost in rounding
/// @param inverses  out, shape (columns): of L's diagonal
/// @param signs     out, shape (columns): S
/// @return whether no pivot was lost
[[nodiscard]] bool
eliminate(const Panel& panel, const float* least, float* inverses, float* signs, FrontWork& work);

/// What an eliminated panel takes from the matrix behind it: -R S R^T, R its rows below the
/// triangle.
///
/// @param signs       of the panel
/// @param complement  out: lower triangle by columns, each padded(rows - columns) apart
void form_complement(const Panel& panel, const float* signs, float* complement, FrontWork& work);

/// Inverse of the triangle that as many columns as a vector holds have on the diagonal, with the
/// rows beside it that fill its last vector: substitutions need products then, where each unknown
/// would wait for the one before. By columns and by rows.
struct DiagonalInverse {
  std::array<float, front_lanes * front_lanes> columns;
  std::array<float, front_lanes * front_lanes> rows;
};

/// Triangles on the diagonal of a panel.
constexpr std::size_t diagonal_triangles(const Panel& panel) {
  return padded(panel.columns) / front_lanes;
}

/// Inverts the triangles of an eliminated panel.
///
/// @param inverses  of L's diagonal
/// @param diagonal  out, shape (diagonal_triangles(panel))
void invert_diagonal(const Panel& panel, const float* inverses, DiagonalInverse* diagonal);

/// Solves for the unknowns of a panel and takes them from the equations below.
///
/// @param x  shape (padded(rows)): right-hand side, overwritten with the solution in its first part
void substitute_forward(const Panel& panel, const DiagonalInverse* diagonal, float* x);

/// Solves for the unknowns of a panel when those below are known, with the transpose.
///
/// @param x  shape (padded(rows)): right-hand side and, below, what is known; its first part is
///           overwritten with the solution
void substitute_backward(const Panel& panel, const DiagonalInverse* diagonal, float* x);

} // namespace billet::mechanics
