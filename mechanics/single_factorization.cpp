#include "mechanics/elimination.h"
#include "mechanics/front_kernels.h"
#include "mechanics/linear_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace billet::mechanics {

namespace {

/// Rows in turn of a front's rectangle that lie in turn in its parent as well.
struct Run {
  std::size_t from; ///< row of the rectangle
  std::size_t to;   ///< row of the parent's panel
  std::size_t rows;
};

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
    free_memory(values_);
    free_memory(diagonal_);
    free_memory(stack_);
  }
  [[nodiscard]] FactorCost cost() const override {
    return {elimination_->flops(), elimination_->entries(), sizeof(float)};
  }

private:
  [[nodiscard]] Panel panel(std::size_t f) {
    const Front& front = elimination_->fronts()[f];
    return {values_.data() + panel_start_[f], idx(front.rows + front.columns), idx(front.columns)};
  }
  void find_places();
  void find_runs();
  void measure_stack();
  void find_scale(const SparseMatrix& matrix);
  void assemble(std::size_t f, const SparseMatrix& matrix);
  void add_to_panel(std::size_t child, const Panel& parent);
  void add_to_complement(std::size_t child, const Panel& parent, float* complement);
  void forward();
  void backward();

  std::shared_ptr<const Elimination> elimination_;
  std::vector<std::size_t> panel_start_;    ///< where a front's values begin
  std::vector<std::size_t> triangle_start_; ///< likewise its inverses
  std::vector<std::size_t> places_;         ///< of the triangle's entries among the values
  std::vector<Run> runs_;                   ///< of all fronts
  std::vector<std::size_t> run_start_;      ///< shape (fronts + 1)
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> stack_place_; ///< where a front's complement waits
  std::size_t stack_size_ = 0;
  std::vector<float> values_;
  std::vector<DiagonalInverse> diagonal_;
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
    : elimination_(std::move(elimination)) {
  const std::size_t n = elimination_->order().size();
  inverses_.resize(n);
  signs_.resize(n);
  least_.resize(n);
  x_.resize(n);
  find_places();
  find_runs();
  measure_stack();
}

void SingleFactorization::find_places() {
  const OrderedTriangle& triangle = elimination_->triangle();
  std::size_t values = 0;
  std::size_t triangles = 0;
  std::size_t most_rows = 0;
  places_.resize(triangle.rows.size());
  std::vector<std::size_t> local(elimination_->order().size());
  for (const Front& front : elimination_->fronts()) {
    const std::span<const Index> below = elimination_->rows(front);
    for (std::size_t i = 0; i < below.size(); ++i)
      local[idx(below[i])] = idx(front.columns) + i;
    const std::size_t step = padded(idx(front.columns + front.rows));
    for (Index j = front.first; j < front.first + front.columns; ++j) {
      local[idx(j)] = idx(j - front.first);
      for (Index k = triangle.start[idx(j)]; k < triangle.start[idx(j) + 1]; ++k) {
        const Index row = triangle.rows[idx(k)];
        const std::size_t at =
            row < front.first + front.columns ? idx(row - front.first) : local[idx(row)];
        places_[idx(k)] = values + idx(j - front.first) * step + at;
      }
    }
    panel_start_.push_back(values);
    triangle_start_.push_back(triangles);
    triangles += diagonal_triangles({nullptr, idx(front.rows + front.columns), idx(front.columns)});
    values += step * idx(front.columns);
    most_rows = std::max(most_rows, step);
  }
  panel_start_.push_back(values);
  triangle_start_.push_back(triangles);
  local_.resize(most_rows);
}

void SingleFactorization::find_runs() {
  const std::span<const Front> fronts = elimination_->fronts();
  children_.resize(fronts.size());
  run_start_.push_back(0);
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    if (fronts[f].parent >= 0) {
      children_[idx(fronts[f].parent)].push_back(f);
      const Front& parent = fronts[idx(fronts[f].parent)];
      const std::span<const Index> in_parent = elimination_->rows(parent);
      const std::span<const Index> rows = elimination_->rows(fronts[f]);
      std::size_t next = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        std::size_t to = 0;
        if (rows[i] < parent.first + parent.columns) {
          to = idx(rows[i] - parent.first);
        } else {
          while (in_parent[next] < rows[i])
            ++next;
          to = idx(parent.columns) + next;
        }
        const bool more = runs_.size() > run_start_.back() && to != idx(parent.columns) &&
                          runs_.back().to + runs_.back().rows == to;
        if (more)
          ++runs_.back().rows;
        else
          runs_.push_back({i, to, 1});
      }
    }
    run_start_.push_back(runs_.size());
  }
}

/// A complement is formed above those of its front's children, then takes their place.
void SingleFactorization::measure_stack() {
  const std::span<const Front> fronts = elimination_->fronts();
  std::size_t top = 0;
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const std::size_t rows = idx(fronts[f].rows);
    const std::size_t size = padded(rows) * rows;
    stack_size_ = std::max(stack_size_, top + size);
    const std::size_t place = children_[f].empty() ? top : stack_place_[children_[f].front()];
    stack_place_.push_back(place);
    top = place + size;
  }
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

void SingleFactorization::assemble(std::size_t f, const SparseMatrix& matrix) {
  const OrderedTriangle& triangle = elimination_->triangle();
  const Front& front = elimination_->fronts()[f];
  std::fill(values_.begin() + static_cast<std::ptrdiff_t>(panel_start_[f]),
            values_.begin() + static_cast<std::ptrdiff_t>(panel_start_[f + 1]), 0.0F);
  const std::size_t last = idx(triangle.start[idx(front.first + front.columns)]);
  for (std::size_t k = idx(triangle.start[idx(front.first)]); k < last; ++k)
    values_[places_[k]] = static_cast<float>(scale_ * matrix.values[idx(triangle.entries[k])]);
}

/// Adds the columns of a child's complement that its parent eliminates.
void SingleFactorization::add_to_panel(std::size_t child, const Panel& parent) {
  const std::size_t child_step = padded(idx(elimination_->fronts()[child].rows));
  const std::size_t step = padded(parent.rows);
  const auto runs =
      std::span(runs_).subspan(run_start_[child], run_start_[child + 1] - run_start_[child]);
  for (std::size_t r = 0; r < runs.size() && runs[r].to < parent.columns; ++r)
    for (std::size_t j = 0; j < runs[r].rows; ++j) {
      const float* from = stack_.data() + stack_place_[child] + (runs[r].from + j) * child_step;
      float* to = parent.values + (runs[r].to + j) * step;
      for (std::size_t i = j; i < runs[r].rows; ++i)
        to[runs[r].to + i] += from[runs[r].from + i];
      for (const Run& run : runs.subspan(r + 1))
        for (std::size_t i = 0; i < run.rows; ++i)
          to[run.to + i] += from[run.from + i];
    }
}

/// Adds the others, which go on to the parent's parent.
void SingleFactorization::add_to_complement(std::size_t child,
                                            const Panel& parent,
                                            float* complement) {
  const std::size_t child_step = padded(idx(elimination_->fronts()[child].rows));
  const std::size_t step = padded(parent.rows - parent.columns);
  const auto runs =
      std::span(runs_).subspan(run_start_[child], run_start_[child + 1] - run_start_[child]);
  std::size_t r = 0;
  while (r < runs.size() && runs[r].to < parent.columns)
    ++r;
  for (; r < runs.size(); ++r)
    for (std::size_t j = 0; j < runs[r].rows; ++j) {
      const float* from = stack_.data() + stack_place_[child] + (runs[r].from + j) * child_step;
      const std::size_t column = runs[r].to - parent.columns;
      float* to = complement + (column + j) * step;
      for (std::size_t i = j; i < runs[r].rows; ++i)
        to[column + i] += from[runs[r].from + i];
      for (const Run& run : runs.subspan(r + 1))
        for (std::size_t i = 0; i < run.rows; ++i)
          to[run.to - parent.columns + i] += from[run.from + i];
    }
}

bool SingleFactorization::factorize(const SparseMatrix& matrix) {
  values_.resize(panel_start_.back() + front_lanes); // products read a vector beyond the last row
  diagonal_.resize(triangle_start_.back());
  stack_.resize(stack_size_);
  find_scale(matrix);
  std::size_t top = 0;
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const Front& front = elimination_->fronts()[f];
    const Panel own = panel(f);
    assemble(f, matrix);
    for (const std::size_t child : children_[f])
      add_to_panel(child, own);
    float* signs = signs_.data() + front.first;
    if (!eliminate(own, least_.data() + front.first, inverses_.data() + front.first, signs, work_))
      return false;
    invert_diagonal(own, inverses_.data() + front.first, diagonal_.data() + triangle_start_[f]);
    const std::size_t size = padded(idx(front.rows)) * idx(front.rows);
    if (size > 0) {
      float* complement = stack_.data() + top;
      form_complement(own, signs, complement, work_);
      for (const std::size_t child : children_[f])
        add_to_complement(child, own, complement);
      if (stack_place_[f] < top)
        std::copy(complement, complement + size, stack_.data() + stack_place_[f]);
    }
    top = stack_place_[f] + size;
  }
  return true;
}

void SingleFactorization::forward() {
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const Front& front = elimination_->fronts()[f];
    const Panel own = panel(f);
    float* local = local_.data();
    std::copy_n(x_.data() + front.first, own.columns, local);
    std::fill(local + own.columns, local + padded(own.rows), 0.0F);
    substitute_forward(own, diagonal_.data() + triangle_start_[f], local);
    std::copy_n(local, own.columns, x_.data() + front.first);
    local += own.columns;
    for (const Index row : elimination_->rows(front))
      x_[idx(row)] += *local++;
  }
}

void SingleFactorization::backward() {
  for (std::size_t f = children_.size(); f-- > 0;) {
    const Front& front = elimination_->fronts()[f];
    const Panel own = panel(f);
    float* local = std::copy_n(x_.data() + front.first, own.columns, local_.data());
    for (const Index row : elimination_->rows(front))
      *local++ = x_[idx(row)];
    std::fill(local, local_.data() + padded(own.rows), 0.0F);
    substitute_backward(own, diagonal_.data() + triangle_start_[f], local_.data());
    std::copy_n(local_.data(), own.columns, x_.data() + front.first);
  }
}

void SingleFactorization::solve(std::span<double> rhs) {
  double most = 0.0;
  for (const double value : rhs)
    most = std::max(most, std::abs(value));
  if (most == 0.0)
    return;
  // Of size one, so that it has all its digits in single precision whatever the units.
  const std::span<const Index> order = elimination_->order();
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] = static_cast<float>(rhs[idx(order[i])] / most);
  forward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] *= signs_[i];
  backward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    rhs[idx(order[i])] = scale_ * most * static_cast<double>(x_[i]);
}

} // namespace

std::unique_ptr<Factorization> make_single(std::shared_ptr<const Elimination> elimination) {
  return std::make_unique<SingleFactorization>(std::move(elimination));
}

} // namespace billet::mechanics
