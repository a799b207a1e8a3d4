// What substitutions need of an eliminated panel, in the order in which they walk through it.
//
// Columns of a panel lie far apart: to walk through eight of them at a time is eight streams, each
// too short for the processor to fetch it ahead. Blocks of eight rows by eight columns, one after
// another, are one stream. Decision: docs/decisions/0018-factorization-in-single-precision.md.

#pragma once

#include "mechanics/linear/multifrontal/front_kernels.h"

#include <array>
#include <cstddef>

namespace billet::mechanics {

/// Inverse of the triangle that as many columns as a vector holds have on the diagonal, with the
/// adjacent rows that fill its last vector: substitutions need products then, where each unknown
/// would wait for the one before. By columns and by rows.
struct DiagonalInverse {
  std::array<float, front_lanes * front_lanes> columns;
  std::array<float, front_lanes * front_lanes> rows;
};

/// Triangles on the diagonal of a panel.
constexpr std::size_t diagonal_triangles(std::size_t columns) {
  return padded(columns) / front_lanes;
}

/// Numbers below the triangles on the diagonal.
///
/// @param rows, columns  of the panel
constexpr std::size_t packed_size(std::size_t rows, std::size_t columns) {
  const std::size_t whole = columns / front_lanes; // groups; the last rows are below all of them
  const std::size_t blocks = whole * (padded(rows) / front_lanes) - whole * (whole + 1) / 2;
  const std::size_t rest = columns % front_lanes;
  return blocks * front_lanes * front_lanes + (padded(rows) - padded(columns)) * rest;
}

/// A panel, packed. Columns are taken eight at a time; of each eight their triangle's inverse, and
/// below it blocks of eight rows, by columns.
struct PackedPanel {
  std::size_t rows;
  std::size_t columns;
  DiagonalInverse* diagonal; ///< shape (diagonal_triangles(columns))
  float* below;              ///< shape (packed_size(rows, columns))
};

/// Packs an eliminated panel.
///
/// @param inverses  of L's diagonal
/// @param packed    out; of the same shape
void pack(const Panel& panel,
          const float* inverses,
          const PackedPanel& packed,
          Threads threads = Threads::one);

/// Solves for the unknowns of a panel and takes them from the equations below.
///
/// @param x  shape (padded(rows)): right-hand side, overwritten with the solution in its first part
void substitute_forward(const PackedPanel& panel, float* x, Threads threads = Threads::one);

/// Solves for the unknowns of a panel when those below are known, with the transpose. With
/// Threads::all sums have another order than with Threads::one, the same for any number of threads.
///
/// @param x  shape (padded(rows)): right-hand side and, below, what is known; its first part is
///           overwritten with the solution
void substitute_backward(const PackedPanel& panel, float* x, Threads threads = Threads::one);

} // namespace billet::mechanics
