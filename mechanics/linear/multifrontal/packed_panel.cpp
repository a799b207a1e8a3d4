#include "mechanics/linear/multifrontal/packed_panel.h"

#include "geometry/base/pieces.h"
#include "mechanics/linear/multifrontal/front_vector.h"

#include <algorithm>
#include <array>

namespace billet::mechanics {

namespace {

/// Inverts the triangle of an eliminated panel that begins in column `first`.
void invert_triangle(const Panel& panel,
                     std::size_t first,
                     const float* inverses,
                     DiagonalInverse& diagonal) {
  static constexpr std::array<float, front_lanes* front_lanes> identity = [] {
    std::array<float, front_lanes * front_lanes> one{};
    for (std::size_t i = 0; i < front_lanes; ++i)
      one[i * front_lanes + i] = 1.0F;
    return one;
  }();
  const std::size_t step = padded(panel.rows);
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
    store(row[i], diagonal.rows.data() + i * front_lanes);
  }
  for (std::size_t i = 0; i < front_lanes; ++i)
    for (std::size_t j = 0; j < front_lanes; ++j)
      diagonal.columns[j * front_lanes + i] = row[i][j];
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

/// As many columns as a vector holds, or what is left of them, and blocks of rows below.
struct Group {
  std::size_t first; ///< column
  std::size_t columns;
  const float* values; ///< of the block below the triangle

  /// Blocks of rows are counted from the panel's first on.
  [[nodiscard]] const float* at(std::size_t block) const {
    return values + (block - first / front_lanes - 1) * columns * front_lanes;
  }
};

Group group(const PackedPanel& panel, std::size_t g) {
  const std::size_t blocks = padded(panel.rows) / front_lanes;
  const std::size_t before = g * blocks - g * (g + 1) / 2;
  const std::size_t first = g * front_lanes;
  return {first, std::min(front_lanes, panel.columns - first),
          panel.below + before * front_lanes * front_lanes};
}

void take_forward(const Group& group, std::size_t begin, std::size_t end, float* x) {
  visit_columns(group.columns, [&](auto n) {
    take_columns<n>(group.at(begin), end - begin, x + group.first, x + begin * front_lanes);
  });
}

void take_backward(const Group& group, std::size_t begin, std::size_t end, float* x) {
  visit_columns(group.columns, [&](auto n) {
    take_rows<n>(group.at(begin), end - begin, x + begin * front_lanes, x + group.first);
  });
}

constexpr std::size_t together = 16; ///< groups between which threads wait for each other

// Most panels are small: what threads need to share one costs as much as the substitution.

void forward_by_one(const PackedPanel& panel, float* x) {
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

void backward_by_one(const PackedPanel& panel, float* x) {
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

} // namespace

void pack(const Panel& panel, const float* inverses, const PackedPanel& packed, Threads threads) {
  const std::size_t step = padded(panel.rows);
  const auto pack_groups = [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const auto [first, columns, values] = group(packed, g);
      invert_triangle(panel, first, inverses, packed.diagonal[g]);
      float* to = packed.below + (values - packed.below);
      for (std::size_t i = first + front_lanes; i < step; i += front_lanes)
        for (std::size_t j = first; j < first + columns; ++j, to += front_lanes)
          std::copy_n(panel.values + j * step + i, front_lanes, to);
    }
  };
  const std::size_t groups = diagonal_triangles(panel.columns);
  for_pieces(groups, threads == Threads::all ? 2 : groups, pack_groups);
}

void substitute_forward(const PackedPanel& panel, float* x, Threads threads) {
  if (threads == Threads::one) {
    forward_by_one(panel, x);
    return;
  }
  const std::size_t groups = diagonal_triangles(panel.columns);
  const std::size_t blocks = padded(panel.rows) / front_lanes;
  for (std::size_t g = 0; g < groups; g += together) {
    const std::size_t end = std::min(g + together, groups);
    for (std::size_t k = g; k < end; ++k) {
      combine(panel.diagonal[k].columns, x + k * front_lanes);
      take_forward(group(panel, k), k + 1, end, x);
    }
    constexpr std::size_t rows_at_once = 32; // blocks
    for_pieces(blocks - end, rows_at_once, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = g; k < end; ++k)
        take_forward(group(panel, k), end + from, end + to, x);
    });
  }
}

void substitute_backward(const PackedPanel& panel, float* x, Threads threads) {
  if (threads == Threads::one) {
    backward_by_one(panel, x);
    return;
  }
  const std::size_t groups = diagonal_triangles(panel.columns);
  const std::size_t blocks = padded(panel.rows) / front_lanes;
  for (std::size_t end = groups; end > 0;) {
    const std::size_t g = end > together ? (end - 1) / together * together : 0;
    for_pieces(end < blocks ? end - g : 0, 2, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = g + from; k < g + to; ++k)
        take_backward(group(panel, k), end, blocks, x);
    });
    for (std::size_t k = end; k-- > g;) {
      take_backward(group(panel, k), k + 1, end, x);
      combine(panel.diagonal[k].rows, x + k * front_lanes);
    }
    end = g;
  }
}

} // namespace billet::mechanics
