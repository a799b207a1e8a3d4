#include "mechanics/linear/multifrontal/packed_panel.h"

#include "mechanics/linear/multifrontal/front_vector.h"

#include <algorithm>
#include <array>

namespace billet::mechanics {

namespace {

/// Inverts the triangles of an eliminated panel.
void invert_diagonal(const Panel& panel, const float* inverses, DiagonalInverse* diagonal) {
  static constexpr std::array<float, front_lanes* front_lanes> identity = [] {
    std::array<float, front_lanes * front_lanes> one{};
    for (std::size_t i = 0; i < front_lanes; ++i)
      one[i * front_lanes + i] = 1.0F;
    return one;
  }();
  const std::size_t step = padded(panel.rows);
  for (std::size_t first = 0; first < panel.columns; first += front_lanes, ++diagonal) {
    const std::size_t columns = std::min(front_lanes, panel.columns - first);
    const std::size_t rows = std::min(front_lanes, panel.rows - first);
    const float* values = panel.values + first * step + first;
    std::array<FrontVector, front_lanes> row; // beyond the panel's columns and rows those of one
    for (std::size_t i = 0; i < front_lanes; ++i) {
      load(identity.data() + i * front_lanes, row[i]); // what is set number by number is waited for
      if (i < rows)
        for (std::size_t k = 0; k < std::min(i, columns); ++k)
          row[i] -= values[k * step + i] * row[k];
      if (i < columns)
        row[i] *= inverses[first + i];
      store(row[i], diagonal->rows.data() + i * front_lanes);
    }
    for (std::size_t i = 0; i < front_lanes; ++i)
      for (std::size_t j = 0; j < front_lanes; ++j)
        diagonal->columns[j * front_lanes + i] = row[i][j];
  }
}

/// sum of x(i) times line i.
void combine(const std::array<float, front_lanes * front_lanes>& lines, float* x) {
  constexpr std::size_t sums = 2; // that do not wait for each other
  std::array<FrontVector, sums> sum{};
  for (std::size_t i = 0; i < front_lanes; ++i) {
    FrontVector line;
    load(lines.data() + i * front_lanes, line);
    sum[i % sums] += x[i] * line;
  }
  store(sum[0] + sum[1], x);
}

/// The sum of each vector's numbers, side by side.
[[gnu::always_inline]] inline void total(const std::array<FrontVector, front_lanes>& v,
                                         FrontVector& sums) {
  static_assert(front_lanes == 8);
  std::array<FrontVector, 4> pairs;
  for (std::size_t k = 0; k < 4; ++k)
    pairs[k] = __builtin_shufflevector(v[2 * k], v[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
               __builtin_shufflevector(v[2 * k], v[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  std::array<FrontVector, 2> fours;
  for (std::size_t k = 0; k < 2; ++k)
    fours[k] = __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
               __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 2, 3, 10, 11, 6, 7, 14, 15);
  sums = __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
}

/// Takes columns times x(0), x(1), … from the rows below.
///
/// @param blocks  number of blocks of rows
/// @param x       of the columns
/// @param below   of the rows
template <std::size_t columns>
void take_columns(const float* values, std::size_t blocks, const float* x, float* below) {
  std::array<float, columns> factors;
  std::copy_n(x, columns, factors.data());
  for (std::size_t b = 0; b < blocks; ++b, below += front_lanes) {
    FrontVector sum;
    load(below, sum);
    for (std::size_t j = 0; j < columns; ++j, values += front_lanes) {
      FrontVector column;
      load(values, column);
      sum -= factors[j] * column;
    }
    store(sum, below);
  }
}

/// Takes from x(0), x(1), … the columns times what is known below, from the last row on.
template <std::size_t columns>
void take_rows(const float* values, std::size_t blocks, const float* below, float* x) {
  std::array<FrontVector, front_lanes> sum{};
  values += blocks * columns * front_lanes;
  for (std::size_t b = blocks; b-- > 0;) {
    FrontVector known;
    load(below + b * front_lanes, known);
    for (std::size_t j = columns; j-- > 0;) {
      values -= front_lanes;
      FrontVector column;
      load(values, column);
      sum[j] += column * known;
    }
  }
  FrontVector all;
  FrontVector taken;
  load(x, all);
  total(sum, taken);
  store(all - taken, x);
}

} // namespace

void pack(const Panel& panel, const float* inverses, const PackedPanel& packed) {
  invert_diagonal(panel, inverses, packed.diagonal);
  const std::size_t step = padded(panel.rows);
  float* to = packed.below;
  for (std::size_t first = 0; first < panel.columns; first += front_lanes) {
    const std::size_t columns = std::min(front_lanes, panel.columns - first);
    for (std::size_t i = first + front_lanes; i < step; i += front_lanes)
      for (std::size_t j = first; j < first + columns; ++j, to += front_lanes)
        std::copy_n(panel.values + j * step + i, front_lanes, to);
  }
}

void substitute_forward(const PackedPanel& panel, float* x) {
  const std::size_t step = padded(panel.rows);
  const DiagonalInverse* diagonal = panel.diagonal;
  const float* values = panel.below;
  for (std::size_t first = 0; first < panel.columns; first += front_lanes, ++diagonal) {
    const std::size_t columns = std::min(front_lanes, panel.columns - first);
    const std::size_t blocks = (step - first) / front_lanes - 1;
    combine(diagonal->columns, x + first);
    visit_columns(columns, [&](auto n) {
      take_columns<n>(values, blocks, x + first, x + first + front_lanes);
    });
    values += blocks * columns * front_lanes;
  }
}

void substitute_backward(const PackedPanel& panel, float* x) {
  const std::size_t step = padded(panel.rows);
  const DiagonalInverse* diagonal = panel.diagonal + diagonal_triangles(panel.columns);
  const float* values = panel.below + packed_size(panel.rows, panel.columns);
  for (std::size_t end = padded(panel.columns); end > 0; end -= front_lanes) {
    const std::size_t first = end - front_lanes;
    const std::size_t columns = std::min(front_lanes, panel.columns - first);
    const std::size_t blocks = (step - end) / front_lanes;
    values -= blocks * columns * front_lanes;
    visit_columns(columns, [&](auto n) { take_rows<n>(values, blocks, x + end, x + first); });
    combine((--diagonal)->rows, x + first);
  }
}

} // namespace billet::mechanics
