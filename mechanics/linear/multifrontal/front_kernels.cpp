#include "mechanics/linear/multifrontal/front_kernels.h"

#include "mechanics/linear/multifrontal/front_vector.h"

#include <cblas.h>

#include <algorithm>
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
  for (std::size_t p = 0; p < depth; ++p)
    for (std::size_t v = 0; v < vectors; ++v) {
      FrontVector rows;
      load(l + p * l_step + v * front_lanes, rows);
      for (std::size_t q = 0; q < columns; ++q)
        sum[v][q] -= rows * w[p * columns + q];
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

template <Into into> void subtract_small(const Product& of, FrontWork& work) {
  constexpr std::size_t together = 6; // sums of two vectors each: what registers hold
  work.factors.resize(std::max(work.factors.size(), of.depth * together));
  float* w = work.factors.data();
  const Columns l{of.l.at(of.first, 0), of.l.step};
  const std::size_t end = padded(of.rows - of.first);
  std::size_t q = 0;
  for (; q + together <= of.columns; q += together) {
    of.factors(q, together, w);
    subtract_rows<into, together>(l, w, of.depth, {of.c.at(0, q), of.c.step}, aligned(q), end);
  }
  if (q < of.columns)
    visit_columns<together - 1>(of.columns - q, [&](auto rest) {
      of.factors(q, rest, w);
      subtract_rows<into, rest>(l, w, of.depth, {of.c.at(0, q), of.c.step}, aligned(q), end);
    });
}

/// By BLAS, some columns at a time.
template <Into into> void subtract_large(const Product& of, FrontWork& work) {
  constexpr std::size_t together = 128;
  work.factors.resize(std::max(work.factors.size(), of.depth * together));
  for (std::size_t q = 0; q < of.columns; q += together) {
    const std::size_t count = std::min(together, of.columns - q);
    of.factors(q, count, work.factors.data());
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(of.rows - of.first - q),
                static_cast<int>(count), static_cast<int>(of.depth), -1.0F,
                of.l.at(of.first + q, 0), static_cast<int>(of.l.step), work.factors.data(),
                static_cast<int>(count), into == Into::zero ? 0.0F : 1.0F, of.c.at(q, q),
                static_cast<int>(of.c.step));
  }
}

template <Into into> void subtract(const Product& of, FrontWork& work) {
  constexpr std::size_t many_rows = 384, deep = 48; // from which on BLAS is as fast
  if (of.rows - of.first >= many_rows && of.depth >= deep && of.columns >= deep)
    subtract_large<into>(of, work);
  else
    subtract_small<into>(of, work);
}

/// Eliminates columns that the columns before have been taken from, one after another.
///
/// @param end  of the rows, whole vectors
template <std::size_t count>
bool eliminate_few(Columns a, std::size_t end, const float* least, float* inverses, float* signs) {
  float scales[count];
  float factors[count][count];
  FrontVector column[count];
  const auto read = [&](std::size_t row) {
    for (std::size_t j = 0; j < count; ++j)
      load(a.at(row, j), column[j]);
  };
  const auto write = [&](std::size_t row) {
    for (std::size_t j = 0; j < count; ++j)
      store(column[j], a.at(row, j));
  };
  read(0);
  for (std::size_t j = 0; j < count; ++j) {
    const float pivot = column[j][j];
    if (!(std::abs(pivot) > least[j]))
      return false;
    signs[j] = pivot > 0.0F ? 1.0F : -1.0F;
    inverses[j] = 1.0F / std::sqrt(std::abs(pivot));
    scales[j] = signs[j] * inverses[j];
    column[j] *= scales[j];
    for (std::size_t q = j + 1; q < count; ++q) {
      factors[j][q] = signs[j] * column[j][q];
      column[q] -= factors[j][q] * column[j];
    }
  }
  write(0);
  for (std::size_t row = front_lanes; row < end; row += front_lanes) {
    read(row);
    for (std::size_t j = 0; j < count; ++j) {
      column[j] *= scales[j];
      for (std::size_t q = j + 1; q < count; ++q)
        column[q] -= factors[j][q] * column[j];
    }
    write(row);
  }
  return true;
}

} // namespace

bool eliminate(const Panel& panel,
               const float* least,
               float* inverses,
               float* signs,
               FrontWork& work) {
  constexpr std::size_t few = front_lanes, many = 8 * front_lanes;
  const Columns a{panel.values, padded(panel.rows)};
  for (std::size_t outer = 0; outer < panel.columns; outer += many) {
    const std::size_t outer_end = std::min(outer + many, panel.columns);
    for (std::size_t inner = outer; inner < outer_end; inner += few) {
      const std::size_t inner_end = std::min(inner + few, outer_end);
      const std::size_t count = inner_end - inner;
      const Columns block{a.at(inner, inner), a.step};
      bool good = false;
      visit_columns(count, [&](auto n) {
        good = eliminate_few<n>(block, padded(panel.rows) - inner, least + inner, inverses + inner,
                                signs + inner);
      });
      if (!good)
        return false;
      subtract<Into::present>({block,
                               panel.rows - inner,
                               signs + inner,
                               count,
                               count,
                               outer_end - inner_end,
                               {a.at(inner_end, inner_end), a.step}},
                              work);
    }
    subtract<Into::present>({{a.at(outer, outer), a.step},
                             panel.rows - outer,
                             signs + outer,
                             outer_end - outer,
                             outer_end - outer,
                             panel.columns - outer_end,
                             {a.at(outer_end, outer_end), a.step}},
                            work);
  }
  return true;
}

void form_complement(const Panel& panel, const float* signs, float* complement, FrontWork& work) {
  const std::size_t rows = panel.rows - panel.columns;
  subtract<Into::zero>({{panel.values, padded(panel.rows)},
                        panel.rows,
                        signs,
                        panel.columns,
                        panel.columns,
                        rows,
                        {complement, padded(rows)}},
                       work);
}

} // namespace billet::mechanics
