#include "mechanics/elimination.h"
#include "mechanics/front_assembly.h"
#include "mechanics/front_kernels.h"
#include "mechanics/front_vector.h"
#include "mechanics/linear_solver.h"
#include "mechanics/packed_panel.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace billet::mechanics {

namespace {

/// Rows in turn of a front's rectangle, and where they lie in its parent.
struct Rows {
  std::uint32_t from;  ///< the first, of the rectangle
  std::uint32_t count; ///< > 0
  std::uint32_t to;    ///< the first, of the parent's panel
  bool together;       ///< in turn there as well
  bool paired;         ///< or two by two, those of a node
};

void add_pair(const float* from, float* to) {
  FrontPair sum;
  FrontPair more;
  load(to, sum);
  load(from, more);
  store(sum + more, to);
}

/// Adds rows of a column, from the one given on, to the numbers `base` and the rows' places away.
void add(const Rows& rows,
         std::uint32_t first,
         const std::uint32_t* places,
         const float* from,
         float* to,
         std::ptrdiff_t base) {
  const std::uint32_t end = rows.from + rows.count;
  if (rows.together) {
    base += std::ptrdiff_t{rows.to} - std::ptrdiff_t{rows.from};
    for (std::uint32_t i = first; i < end; ++i)
      to[base + i] += from[i];
    return;
  }
  if (rows.paired) {
    if ((end - first) % 2 != 0) { // a node's first row is above the diagonal
      to[base + places[first]] += from[first];
      ++first;
    }
    for (std::uint32_t i = first; i < end; i += 2)
      add_pair(from + i, to + base + places[i]);
    return;
  }
  for (std::uint32_t i = first; i < end; ++i)
    to[base + places[i]] += from[i];
}

/// Copies `count` numbers, few as a rule: a call to the library takes longer.
void copy_few(const float* from, std::size_t count, float* to) {
  const auto copy = [&](auto constant) {
    constexpr std::size_t n = decltype(constant)::value;
    std::memcpy(to, from, n * sizeof(float));
    from += n;
    to += n;
  };
  for (; count >= front_lanes; count -= front_lanes)
    copy(std::integral_constant<std::size_t, front_lanes>{});
  static_assert(front_lanes == 8);
  if ((count & 4) != 0)
    copy(std::integral_constant<std::size_t, 4>{});
  if ((count & 2) != 0)
    copy(std::integral_constant<std::size_t, 2>{});
  if ((count & 1) != 0)
    copy(std::integral_constant<std::size_t, 1>{});
}

/// Zeros, at least `count`: whole vectors.
void clear_vectors(float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; i += front_lanes)
    store(FrontVector{}, values + i);
}

/// L S L^T with the order given, S a diagonal of signs, in single precision and without pivoting.
///
/// Multifrontal: what a front takes from the matrix behind it waits on a stack until its parent is
/// put together (Duff & Reid, 1983).
class SingleFactorization final : public Factorization {
public:
  explicit SingleFactorization(std::shared_ptr<const Elimination> elimination);

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override;
  void solve(std::span<double> rhs) override;
  void release() override {
    free_memory(panel_);
    free_memory(diagonal_);
    free_memory(below_);
    free_memory(stack_);
  }
  [[nodiscard]] FactorCost cost() const override {
    return {elimination_->flops(), elimination_->entries(), sizeof(float)};
  }

private:
  [[nodiscard]] Panel panel(std::size_t f) {
    const Front& front = elimination_->fronts()[f];
    return {panel_.data(), idx(front.rows + front.columns), idx(front.columns)};
  }
  [[nodiscard]] PackedPanel packed(std::size_t f) {
    const Front& front = elimination_->fronts()[f];
    return {idx(front.rows + front.columns), idx(front.columns),
            diagonal_.data() + triangle_start_[f], below_.data() + below_start_[f]};
  }
  void measure_panels();
  void find_rows();
  void find_pairs();
  void measure_stacks();
  void find_scale(const SparseMatrix& matrix);
  /// Adds columns of a child's complement to columns of its parent.
  ///
  /// @param rows    of the child's columns
  /// @param last    of all the child's rows, the end
  /// @param to      values of the parent
  /// @param origin  where its column 0 and row 0 are or would be
  void add_columns(std::size_t child,
                   std::span<const Rows> rows,
                   const Rows* last,
                   float* to,
                   std::ptrdiff_t origin,
                   std::size_t step);
  void add_to_panel(std::size_t child, const Panel& parent);
  void add_to_complement(std::size_t child, const Panel& parent, float* complement);
  void forward();
  void backward();

  std::shared_ptr<const Elimination> elimination_;
  FrontAssembly assembly_;
  std::size_t panel_size_ = 0;              ///< of the largest
  std::vector<std::size_t> triangle_start_; ///< where a front's inverses begin
  std::vector<std::size_t> below_start_;    ///< likewise what is below them
  std::vector<Rows> rows_;                  ///< of all fronts
  std::vector<std::size_t> rows_start_;     ///< shape (fronts + 1)
  std::vector<std::uint32_t> in_parent_;    ///< of each row of all fronts, the parent's
  std::vector<std::size_t> in_parent_start_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<char> paired_;             ///< by front: its rows come two by two, those of a node
  std::vector<std::size_t> stack_place_; ///< where a front's complement waits
  std::size_t stack_size_ = 0;
  std::vector<float> panel_; ///< of the front at hand
  std::vector<DiagonalInverse> diagonal_;
  std::vector<float> below_;
  std::vector<float> inverses_; ///< of the factor's diagonal
  std::vector<float> signs_;
  std::vector<float> least_; ///< pivot by unknown
  std::vector<float> stack_;
  std::vector<float> x_;     ///< in the order of elimination
  std::vector<float> local_; ///< of a panel's rows
  double scale_ = 1.0;       ///< of the matrix
  FrontWork work_;
};

SingleFactorization::SingleFactorization(std::shared_ptr<const Elimination> elimination)
    : elimination_(std::move(elimination)), assembly_(*elimination_) {
  const std::size_t n = elimination_->order().size();
  inverses_.resize(n);
  signs_.resize(n);
  least_.resize(n);
  x_.resize(n);
  measure_panels();
  find_rows();
  measure_stacks();
}

void SingleFactorization::measure_panels() {
  std::size_t triangles = 0;
  std::size_t below = 0;
  std::size_t most_rows = 0;
  for (const Front& front : elimination_->fronts()) {
    const std::size_t rows = idx(front.rows + front.columns), columns = idx(front.columns);
    triangle_start_.push_back(triangles);
    below_start_.push_back(below);
    triangles += diagonal_triangles(columns);
    below += packed_size(rows, columns);
    panel_size_ = std::max(panel_size_, padded(rows) * columns);
    most_rows = std::max(most_rows, padded(rows));
  }
  triangle_start_.push_back(triangles);
  below_start_.push_back(below);
  local_.resize(most_rows + front_lanes); // cleared by whole vectors
}

void SingleFactorization::find_rows() {
  // Fewer rows in turn are not worth a loop of their own.
  constexpr std::uint32_t few = 16;
  const std::span<const Front> fronts = elimination_->fronts();
  children_.resize(fronts.size());
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    rows_start_.push_back(rows_.size());
    in_parent_start_.push_back(in_parent_.size());
    if (fronts[f].parent < 0)
      continue;
    children_[idx(fronts[f].parent)].push_back(f);
    const Front& parent = fronts[idx(fronts[f].parent)];
    const std::span<const Index> below = elimination_->rows(parent);
    const auto columns = static_cast<std::uint32_t>(parent.columns);
    std::uint32_t next = 0;
    std::vector<Rows> runs;
    for (const Index row : elimination_->rows(fronts[f])) {
      auto to = static_cast<std::uint32_t>(row - parent.first);
      if (to >= columns) {
        while (below[next] < row)
          ++next;
        to = columns + next;
      }
      in_parent_.push_back(to);
      if (!runs.empty() && to != columns && runs.back().to + runs.back().count == to)
        ++runs.back().count;
      else
        runs.push_back({static_cast<std::uint32_t>(in_parent_.size() - 1 - in_parent_start_.back()),
                        1, to, true, false});
    }
    for (const Rows& run : runs) {
      const bool joins = rows_.size() > rows_start_.back() && run.count < few &&
                         rows_.back().count < few &&
                         (rows_.back().to < columns) == (run.to < columns);
      if (joins) {
        rows_.back().count += run.count;
        rows_.back().together = false;
      } else {
        rows_.push_back(run);
      }
    }
  }
  rows_start_.push_back(rows_.size());
  find_pairs();
}

void SingleFactorization::find_pairs() {
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const std::uint32_t* places = in_parent_.data() + in_parent_start_[f];
    for (std::size_t r = rows_start_[f]; r < rows_start_[f + 1]; ++r) {
      Rows& rows = rows_[r];
      rows.paired = rows.count % 2 == 0;
      for (std::uint32_t i = rows.from; rows.paired && i < rows.from + rows.count; i += 2)
        rows.paired = places[i + 1] == places[i] + 1;
    }
    const std::span<const Index> below = elimination_->rows(elimination_->fronts()[f]);
    bool paired = below.size() % 2 == 0;
    for (std::size_t i = 0; paired && i < below.size(); i += 2)
      paired = below[i + 1] == below[i] + 1;
    paired_.push_back(paired ? 1 : 0);
  }
}

/// Fronts an even and an odd number of generations below their root have a stack each: a complement
/// is formed in one while those of its front's children lie in the other.
void SingleFactorization::measure_stacks() {
  const std::span<const Front> fronts = elimination_->fronts();
  std::vector<char> odd(fronts.size());
  for (std::size_t f = fronts.size(); f-- > 0;)
    odd[f] = fronts[f].parent >= 0 && odd[idx(fronts[f].parent)] == 0 ? 1 : 0;
  std::array<std::size_t, 2> top{};
  std::array<std::size_t, 2> size{};
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const std::size_t own = idx(odd[f]), other = 1 - own;
    stack_place_.push_back(top[own]);
    top[own] += padded(idx(fronts[f].rows)) * idx(fronts[f].rows);
    size[own] = std::max(size[own], top[own]);
    if (!children_[f].empty())
      top[other] = stack_place_[children_[f].front()];
  }
  for (std::size_t f = 0; f < fronts.size(); ++f)
    if (odd[f] != 0)
      stack_place_[f] += size[0];
  stack_size_ = size[0] + size[1];
}

/// A power of two that brings the largest pivot to about one, whatever the units.
void SingleFactorization::find_scale(const SparseMatrix& matrix) {
  const OrderedTriangle& triangle = elimination_->triangle();
  constexpr float lost = 1e-6F; // of a pivot: rounding has taken all digits
  const auto pivot = [&](std::size_t j) {
    return std::abs(matrix.values[idx(triangle.entries[idx(triangle.start[j])])]);
  };
  double most = 0.0;
  for (std::size_t j = 0; j < least_.size(); ++j)
    most = std::max(most, pivot(j));
  int exponent = 0;
  std::frexp(most, &exponent);
  scale_ = std::ldexp(1.0, -exponent);
  for (std::size_t j = 0; j < least_.size(); ++j)
    least_[j] = lost * static_cast<float>(scale_ * pivot(j));
}

void SingleFactorization::add_columns(std::size_t child,
                                      std::span<const Rows> rows,
                                      const Rows* last,
                                      float* to,
                                      std::ptrdiff_t origin,
                                      std::size_t step) {
  const std::uint32_t* places = in_parent_.data() + in_parent_start_[child];
  const std::size_t child_step = padded(idx(elimination_->fronts()[child].rows));
  for (const Rows& columns : rows)
    for (std::uint32_t j = columns.from; j < columns.from + columns.count; ++j) {
      const float* from = stack_.data() + stack_place_[child] + j * child_step;
      const std::ptrdiff_t column = origin + static_cast<std::ptrdiff_t>(places[j] * step);
      add(columns, j, places, from, to, column);
      for (const Rows* below = &columns + 1; below != last; ++below)
        add(*below, below->from, places, from, to, column);
    }
}

/// Adds the columns of a child's complement that its parent eliminates.
void SingleFactorization::add_to_panel(std::size_t child, const Panel& parent) {
  const auto rows =
      std::span(rows_).subspan(rows_start_[child], rows_start_[child + 1] - rows_start_[child]);
  const auto end =
      std::find_if(rows.begin(), rows.end(), [&](const Rows& r) { return r.to >= parent.columns; });
  add_columns(child, {rows.begin(), end}, rows.data() + rows.size(), parent.values, 0,
              padded(parent.rows));
}

/// Adds the others, which go on to the parent's parent.
void SingleFactorization::add_to_complement(std::size_t child,
                                            const Panel& parent,
                                            float* complement) {
  const auto rows =
      std::span(rows_).subspan(rows_start_[child], rows_start_[child + 1] - rows_start_[child]);
  const auto first =
      std::find_if(rows.begin(), rows.end(), [&](const Rows& r) { return r.to >= parent.columns; });
  const std::size_t step = padded(parent.rows - parent.columns);
  const auto origin = -static_cast<std::ptrdiff_t>(parent.columns * (step + 1));
  add_columns(child, {first, rows.end()}, rows.data() + rows.size(), complement, origin, step);
}

bool SingleFactorization::factorize(const SparseMatrix& matrix) {
  panel_.resize(panel_size_ + front_lanes); // products read a vector beyond the last row
  diagonal_.resize(triangle_start_.back());
  below_.resize(below_start_.back());
  stack_.resize(stack_size_);
  find_scale(matrix);
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const Front& front = elimination_->fronts()[f];
    const Panel own = panel(f);
    assembly_.assemble(f, matrix, scale_, own);
    for (const std::size_t child : children_[f])
      add_to_panel(child, own);
    float* signs = signs_.data() + front.first;
    if (!eliminate(own, least_.data() + front.first, inverses_.data() + front.first, signs, work_))
      return false;
    pack(own, inverses_.data() + front.first, packed(f));
    if (front.rows > 0) {
      float* complement = stack_.data() + stack_place_[f];
      form_complement(own, signs, complement, work_);
      for (const std::size_t child : children_[f])
        add_to_complement(child, own, complement);
    }
  }
  return true;
}

void SingleFactorization::forward() {
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const Front& front = elimination_->fronts()[f];
    const PackedPanel own = packed(f);
    float* local = local_.data();
    copy_few(x_.data() + front.first, own.columns, local);
    clear_vectors(local + own.columns, padded(own.rows) - own.columns);
    substitute_forward(own, local);
    copy_few(local, own.columns, x_.data() + front.first);
    local += own.columns;
    const std::span<const Index> rows = elimination_->rows(front);
    if (paired_[f] != 0)
      for (std::size_t i = 0; i < rows.size(); i += 2)
        add_pair(local + i, x_.data() + rows[i]);
    else
      for (const Index row : rows)
        x_[idx(row)] += *local++;
  }
}

void SingleFactorization::backward() {
  for (std::size_t f = children_.size(); f-- > 0;) {
    const Front& front = elimination_->fronts()[f];
    const PackedPanel own = packed(f);
    float* local = local_.data();
    copy_few(x_.data() + front.first, own.columns, local);
    local += own.columns;
    const std::span<const Index> rows = elimination_->rows(front);
    if (paired_[f] != 0)
      for (std::size_t i = 0; i < rows.size(); i += 2)
        std::memcpy(local + i, x_.data() + rows[i], 2 * sizeof(float));
    else
      for (std::size_t i = 0; i < rows.size(); ++i)
        local[i] = x_[idx(rows[i])];
    clear_vectors(local + rows.size(), padded(own.rows) - own.rows);
    substitute_backward(own, local_.data());
    copy_few(local_.data(), own.columns, x_.data() + front.first);
  }
}

void SingleFactorization::solve(std::span<double> rhs) {
  const double most =
      Eigen::Map<const Eigen::VectorXd>(rhs.data(), static_cast<Eigen::Index>(rhs.size()))
          .lpNorm<Eigen::Infinity>();
  if (most == 0.0)
    return;
  // About one, so that it has all its digits in single precision whatever the units.
  constexpr int smallest = -1000; // whose inverse is a number as well
  const double size = std::ldexp(1.0, std::max(std::ilogb(most), smallest));
  const double to_one = 1.0 / size, back = scale_ * size;
  const std::span<const Index> order = elimination_->order();
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] = static_cast<float>(to_one * rhs[idx(order[i])]);
  forward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] *= signs_[i];
  backward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    rhs[idx(order[i])] = back * static_cast<double>(x_[i]);
}

} // namespace

std::unique_ptr<Factorization> make_single(std::shared_ptr<const Elimination> elimination) {
  return std::make_unique<SingleFactorization>(std::move(elimination));
}

} // namespace billet::mechanics
