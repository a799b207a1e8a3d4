#include "mechanics/linear/multifrontal/front_kernels.h"

#include "geometry/base/pieces.h"
#include "mechanics/linear/multifrontal/front_vector.h"

#include <cblas.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace billet::mechanics {

namespace {

/// First row of the vector that holds a row.
constexpr std::size_t aligned(std::size_t row) { return row / front_lanes * front_lanes; }

/// Columns by columns, `step` apart.
struct Columns {
  float* values;
  std::size_t step;
  [[nodiscard]] float* at(std::size_t row, std::size_t column) const {
    return values + column * step + row;
  }
};

/// What is done with the columns a product is taken from.
enum class Into { zero, present };

/// c(i, q) -= sum over p < depth of l(i, p) w(p, q) for some vectors of rows and some columns.
template <Into into, std::size_t vectors, std::size_t columns>
void subtract_block(const float* l,
                    std::size_t l_step,
                    const float* w,
                    std::size_t depth,
                    Columns c) {
  FrontVector sum[vectors][columns] = {};
  if constexpr (into == Into::present)
    for (std::size_t v = 0; v < vectors; ++v)
      for (std::size_t q = 0; q < columns; ++q)
        load(c.at(v * front_lanes, q), sum[v][q]);
  for (std::size_t p = 0; p < depth; ++p) {
    FrontVector rows[vectors];
    for (std::size_t v = 0; v < vectors; ++v)
      load(l + p * l_step + v * front_lanes, rows[v]);
    // A factor after the other: all of them and the sums are more than sixteen registers hold.
    for (std::size_t q = 0; q < columns; ++q) {
      const float factor = w[p * columns + q];
      for (std::size_t v = 0; v < vectors; ++v)
        sum[v][q] -= rows[v] * factor;
    }
  }
  for (std::size_t v = 0; v < vectors; ++v)
    for (std::size_t q = 0; q < columns; ++q)
      store(sum[v][q], c.at(v * front_lanes, q));
}

/// The same for rows `from` to `to`, whole vectors.
template <Into into, std::size_t columns>
void subtract_rows(Columns l,
                   const float* w,
                   std::size_t depth,
                   Columns c,
                   std::size_t from,
                   std::size_t to) {
  std::size_t i = from;
  for (; i + 2 * front_lanes <= to; i += 2 * front_lanes)
    subtract_block<into, 2, columns>(l.at(i, 0), l.step, w, depth, {c.at(i, 0), c.step});
  for (; i < to; i += front_lanes)
    subtract_block<into, 1, columns>(l.at(i, 0), l.step, w, depth, {c.at(i, 0), c.step});
}

/// C -= L S R^T below the diagonal, R the rows of L from `first` on, one for each column of C.
struct Product {
  Columns l;
  std::size_t rows; ///< of L
  const float* signs;
  std::size_t depth; ///< columns of L
  std::size_t first;
  std::size_t columns; ///< of C
  Columns c;           ///< its row and column 0 are row `first` of L

  /// S R^T for columns `q` to `q + count` of C, each row's numbers side by side.
  void factors(std::size_t q, std::size_t count, float* w) const {
    for (std::size_t p = 0; p < depth; ++p)
      for (std::size_t i = 0; i < count; ++i)
        w[p * count + i] = signs[p] * *l.at(first + q + i, p);
  }
};

/// Some in turn.
struct Range {
  std::size_t begin;
  std::size_t end;
};

constexpr std::size_t small_columns = 6;   // sums of two vectors each: what registers hold
constexpr std::size_t large_columns = 128; // that BLAS is given at a time

/// @param rows     of C, whole vectors; none above the diagonal are looked at
/// @param columns  of C; the first is a multiple of `small_columns`
template <Into into>
void subtract_small(const Product& of, Range rows, Range columns, FrontWork& work) {
  work.factors.resize(std::max(work.factors.size(), of.depth * small_columns));
  float* w = work.factors.data();
  const Columns l{of.l.at(of.first, 0), of.l.step};
  const auto take = [&](auto count, std::size_t q) {
    of.factors(q, count, w);
    subtract_rows<into, count>(l, w, of.depth, {of.c.at(0, q), of.c.step},
                               std::max(rows.begin, aligned(q)), rows.end);
  };
  std::size_t q = columns.begin;
  for (; q + small_columns <= columns.end; q += small_columns)
    take(std::integral_constant<std::size_t, small_columns>{}, q);
  if (q < columns.end)
    visit_columns<small_columns - 1>(columns.end - q, [&](auto rest) { take(rest, q); });
}

/// By BLAS.
///
/// @param columns  of C, at most `large_columns`
template <Into into> void subtract_large(const Product& of, Range columns, FrontWork& work) {
  const std::size_t q = columns.begin, count = columns.end - columns.begin;
  work.factors.resize(std::max(work.factors.size(), of.depth * large_columns));
  of.factors(q, count, work.factors.data());
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(of.rows - of.first - q),
              static_cast<int>(count), static_cast<int>(of.depth), -1.0F, of.l.at(of.first + q, 0),
              static_cast<int>(of.l.step), work.factors.data(), static_cast<int>(count),
              into == Into::zero ? 0.0F : 1.0F, of.c.at(q, q), static_cast<int>(of.c.step));
}

template <Into into> void subtract(const Product& of, FrontWork& work, FrontTeam* team) {
  constexpr std::size_t many_rows = 384, deep = 48; // from which on BLAS is as fast
  const bool large = of.rows - of.first >= many_rows && of.depth >= deep && of.columns >= deep;
  const Range rows{0, padded(of.rows - of.first)};
  const auto take = [&](Range columns, FrontWork& own) {
    if (large)
      subtract_large<into>(of, columns, own);
    else
      subtract_small<into>(of, rows, columns, own);
  };
  constexpr std::size_t some = 8 * small_columns;
  if (team != nullptr)
    for_pieces(of.columns, large ? large_columns : some, [&](std::size_t begin, std::size_t end) {
      take({begin, end}, team->local());
    });
  else if (large)
    for (std::size_t q = 0; q < of.columns; q += large_columns)
      take({q, std::min(q + large_columns, of.columns)}, work);
  else
    take({0, of.columns}, work);
}

constexpr std::size_t few_columns = front_lanes; // columns that are eliminated one after another
constexpr std::size_t block_columns = 8 * front_lanes; // after which those to the right are changed

/// How some columns have been eliminated.
struct Together {
  std::array<float, few_columns> scales;
  std::array<std::array<float, few_columns>, few_columns> factors;
};

/// Does to further rows of columns what was done to the rows of their triangle.
///
/// @param from, end  rows, whole vectors
template <std::size_t count>
void eliminate_rows(const Together& done, Columns a, std::size_t from, std::size_t end) {
  FrontVector column[count];
  for (std::size_t row = from; row < end; row += front_lanes) {
    for (std::size_t j = 0; j < count; ++j)
      load(a.at(row, j), column[j]);
    for (std::size_t j = 0; j < count; ++j) {
      column[j] *= done.scales[j];
      for (std::size_t q = j + 1; q < count; ++q)
        column[q] -= done.factors[j][q] * column[j];
    }
    for (std::size_t j = 0; j < count; ++j)
      store(column[j], a.at(row, j));
  }
}

/// Eliminates columns that the columns before have been taken from, one after another.
///
/// @param end  of the rows, whole vectors
template <std::size_t count>
bool eliminate_few(Columns a,
                   std::size_t end,
                   const float* least,
                   float* inverses,
                   float* signs,
                   Together& done) {
  FrontVector column[count];
  for (std::size_t j = 0; j < count; ++j)
    load(a.at(0, j), column[j]);
  for (std::size_t j = 0; j < count; ++j) {
    const float pivot = column[j][j];
    if (!(std::abs(pivot) > least[j]))
      return false;
    signs[j] = pivot > 0.0F ? 1.0F : -1.0F;
    inverses[j] = 1.0F / std::sqrt(std::abs(pivot));
    done.scales[j] = signs[j] * inverses[j];
    column[j] *= done.scales[j];
    for (std::size_t q = j + 1; q < count; ++q) {
      done.factors[j][q] = signs[j] * column[j][q];
      column[q] -= done.factors[j][q] * column[j];
    }
  }
  for (std::size_t j = 0; j < count; ++j)
    store(column[j], a.at(0, j));
  eliminate_rows<count>(done, a, front_lanes, end);
  return true;
}

/// Up to `block_columns` columns of a panel, which those to the left have been taken from.
struct Block {
  Panel panel;
  std::size_t first;
  std::size_t end;
  const float* least; ///< of the panel, as the following
  float* inverses;
  float* signs;

  /// Columns in turn that are eliminated together.
  [[nodiscard]] Columns at(std::size_t column) const {
    const std::size_t step = padded(panel.rows);
    return {panel.values + column * step + column, step};
  }
  [[nodiscard]] std::size_t count(std::size_t column) const {
    return std::min(few_columns, end - column);
  }
  /// What those take from the block's columns to the right.
  [[nodiscard]] Product product(std::size_t column) const {
    const std::size_t next = column + count(column);
    return {at(column),    panel.rows - column, signs + column, count(column),
            count(column), end - next,          at(next)};
  }
};

/// Eliminates a block's columns.
///
/// @param last  row, whole vectors: those below are left as they are
bool eliminate_block(const Block& block,
                     std::size_t last,
                     std::array<Together, block_columns / few_columns>& done,
                     FrontWork& work) {
  for (std::size_t column = block.first; column < block.end; column += few_columns) {
    bool good = false;
    visit_columns(block.count(column), [&](auto n) {
      good = eliminate_few<n>(block.at(column), last - column, block.least + column,
                              block.inverses + column, block.signs + column,
                              done[(column - block.first) / few_columns]);
    });
    if (!good)
      return false;
    const Product product = block.product(column);
    if (product.columns > 0)
      subtract_small<Into::present>(product, {0, last - column - few_columns}, {0, product.columns},
                                    work);
  }
  return true;
}

/// The same for rows that were left.
void eliminate_below(const Block& block,
                     Range rows,
                     const std::array<Together, block_columns / few_columns>& done,
                     FrontWork& work) {
  for (std::size_t column = block.first; column < block.end; column += few_columns) {
    visit_columns(block.count(column), [&](auto n) {
      eliminate_rows<n>(done[(column - block.first) / few_columns], block.at(column),
                        rows.begin - column, rows.end - column);
    });
    const Product product = block.product(column);
    if (product.columns > 0)
      subtract_small<Into::present>(
          product, {rows.begin - column - few_columns, rows.end - column - few_columns},
          {0, product.columns}, work);
  }
}

} // namespace

struct FrontTeam::Members {
  oneapi::tbb::enumerable_thread_specific<FrontWork> works;
};

FrontTeam::FrontTeam() : members_(std::make_unique<Members>()) {}
FrontTeam::~FrontTeam() = default;
FrontWork& FrontTeam::local() { return members_->works.local(); }
void FrontTeam::clear() { members_->works.clear(); }

bool eliminate(const Panel& panel,
               const float* least,
               float* inverses,
               float* signs,
               FrontWork& work,
               FrontTeam* team) {
  constexpr std::size_t rows_at_once = 32 * front_lanes;
  const std::size_t rows = padded(panel.rows);
  std::array<Together, block_columns / few_columns> done;
  for (std::size_t first = 0; first < panel.columns; first += block_columns) {
    const std::size_t end = std::min(first + block_columns, panel.columns);
    const Block block{panel, first, end, least, inverses, signs};
    const std::size_t last = team != nullptr ? padded(end) : rows;
    if (!eliminate_block(block, last, done, work))
      return false;
    if (team != nullptr)
      for_pieces(rows - last, rows_at_once, [&](std::size_t from, std::size_t to) {
        eliminate_below(block, {last + from, last + to}, done, team->local());
      });
    subtract<Into::present>({block.at(first), panel.rows - first, signs + first, end - first,
                             end - first, panel.columns - end, block.at(end)},
                            work, team);
  }
  return true;
}

void form_complement(const Panel& panel,
                     const float* signs,
                     float* complement,
                     FrontWork& work,
                     FrontTeam* team) {
  const std::size_t rows = panel.rows - panel.columns;
  subtract<Into::zero>({{panel.values, padded(panel.rows)},
                        panel.rows,
                        signs,
                        panel.columns,
                        panel.columns,
                        rows,
                        {complement, padded(rows)}},
                       work, team);
}

} // namespace billet::mechanics
