#include "mechanics/linear_solver.h"
#include "mechanics/single_factor.h"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// Runs a parallel region of OpenMP in the calling thread, in place of libgomp's function.
///
/// CHOLMOD is the only one that has such regions: several hundred in a factorization, each shared
/// among four threads whatever the machine has. On small fronts the threads wait for each other
/// longer than they work, and libgomp ends a region of one thread with a system call as well: a
/// quarter of the time of a small run (docs/decisions/0012-cost-of-small-runs.md).
extern "C" void GOMP_parallel( // NOLINT(readability-identifier-naming)
    void (*region)(void*),
    void* data,
    unsigned /*threads*/,
    unsigned /*flags*/) {
  region(data);
}

namespace billet::mechanics {

namespace {

/// Whether the present factor serves in single precision.
enum class Trust { unknown, yes, no };

/// Whether a rough solution is that of the matrix. A slender body's is not: its soft motions are
/// lost in rounding, and a residual that is small does not show it.
bool agree(std::span<const double> rough, std::span<const double> exact) {
  constexpr double near = 1e-4;
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    difference += (rough[i] - exact[i]) * (rough[i] - exact[i]);
    size += exact[i] * exact[i];
  }
  return difference <= near * near * size;
}

/// The lower triangle of a symmetric matrix by columns, its unknowns in another order.
struct OrderedTriangle {
  std::vector<Index> start;   ///< shape (n + 1)
  std::vector<Index> rows;    ///< ascending within a column
  std::vector<Index> entries; ///< of the matrix that the values are taken from
  std::vector<double> values;

  OrderedTriangle(const BlockPattern& pattern, std::span<const Index> order);
  void take(std::span<const double> of_matrix) {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = of_matrix[idx(entries[k])];
  }
  /// As CHOLMOD sees it, which only reads it.
  [[nodiscard]] cholmod_sparse view();
};

OrderedTriangle::OrderedTriangle(const BlockPattern& pattern, std::span<const Index> order)
    : start{0} {
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[idx(order[i])] = static_cast<Index>(i);
  const auto row_of = [&](Index unknown) {
    const Index first = pattern.row_start[idx(unknown)];
    return std::span(pattern.columns)
        .subspan(idx(first), idx(pattern.row_start[idx(unknown) + 1] - first));
  };
  // The same of the two entries that mirror each other, whatever the order.
  const auto entry = [&](Index a, Index b) {
    const std::span<const Index> row = row_of(std::min(a, b));
    const auto at = std::lower_bound(row.begin(), row.end(), std::max(a, b)) - row.begin();
    return pattern.row_start[idx(std::min(a, b))] + static_cast<Index>(at);
  };
  std::vector<std::pair<Index, Index>> column; // row, entry
  for (std::size_t j = 0; j < order.size(); ++j) {
    column.clear();
    for (const Index other : row_of(order[j]))
      if (place[idx(other)] >= static_cast<Index>(j))
        column.emplace_back(place[idx(other)], entry(order[j], other));
    std::sort(column.begin(), column.end());
    for (const auto& [row, from] : column) {
      rows.push_back(row);
      entries.push_back(from);
    }
    start.push_back(static_cast<Index>(rows.size()));
  }
  values.resize(rows.size());
}

cholmod_sparse OrderedTriangle::view() {
  cholmod_sparse A{};
  A.nrow = start.size() - 1;
  A.ncol = A.nrow;
  A.nzmax = rows.size();
  A.p = start.data();
  A.i = rows.data();
  A.x = values.data();
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

/// Supernodal Cholesky factorization with the order given.
///
/// CHOLMOD transposes a matrix twice to bring it in its order, in each factorization: a fifth of
/// the time of one of some thousand unknowns. So it gets the matrix in that order.
class CholmodFactorization final : public Factorization {
public:
  CholmodFactorization(const BlockPattern& pattern, std::span<const Index> order)
      : order_(order.begin(), order.end()) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
    triangle_.emplace(pattern, order_);
    follow_elimination(pattern);
    common_.postorder = 0; // as it is
    factor_ = analyzed();
  }
  ~CholmodFactorization() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_finish(&common_);
  }
  CholmodFactorization(const CholmodFactorization&) = delete;
  CholmodFactorization& operator=(const CholmodFactorization&) = delete;

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override {
    triangle_->take(matrix.values);
    cholmod_sparse A = triangle_->view();
    const int ok = cholmod_factorize(&A, factor_, &common_);
    trust_ = Trust::unknown;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw std::bad_alloc();
    return ok != 0 && common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  void solve(std::span<double> rhs) override {
    ordered_.resize(rhs.size());
    for (std::size_t i = 0; i < rhs.size(); ++i)
      ordered_[i] = rhs[idx(order_[i])];
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = ordered_.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   &common_);
    const auto* x = static_cast<const double*>(solution_->x);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      rhs[idx(order_[i])] = x[i];
  }

  void solve_roughly(std::span<double> rhs) override {
    constexpr double fewest_entries = 1.3e5; // 1 MB: less stays near the processor anyway
    constexpr double most_entries = 1.6e7;   // 64 MB of copy; beyond it is memory that is short
    if (common_.lnz < fewest_entries || common_.lnz > most_entries)
      return solve(rhs);
    if (trust_ == Trust::unknown) {
      if (!single_)
        single_.emplace(*factor_, order_);
      single_->take(*factor_);
      std::vector<double> rough(rhs.begin(), rhs.end());
      single_->solve(rough);
      solve(rhs);
      trust_ = agree(rough, rhs) ? Trust::yes : Trust::no;
      return;
    }
    if (trust_ == Trust::yes)
      single_->solve(rhs);
    else
      solve(rhs);
  }

  void release() override {
    single_.reset();
    if (factor_->xtype != CHOLMOD_PATTERN)
      cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor_, &common_);
  }

  [[nodiscard]] FactorCost cost() const override { return {common_.fl, common_.lnz}; }

private:
  [[nodiscard]] cholmod_factor* analyzed() {
    cholmod_sparse A = triangle_->view();
    cholmod_factor* factor = cholmod_analyze(&A, &common_);
    if (factor == nullptr)
      throw std::bad_alloc();
    return factor;
  }

  /// Puts the unknowns in the order in which CHOLMOD would eliminate them, fronts one by one.
  void follow_elimination(const BlockPattern& pattern) {
    common_.postorder = 1;
    cholmod_factor* trial = analyzed();
    const auto* then = static_cast<const Index*>(trial->Perm);
    std::vector<Index> order(order_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = order_[idx(then[i])];
    cholmod_free_factor(&trial, &common_);
    order_ = std::move(order);
    triangle_.emplace(pattern, order_);
  }

  std::vector<Index> order_; ///< place i holds unknown order_[i]
  std::optional<OrderedTriangle> triangle_;
  std::vector<double> ordered_; ///< a right-hand side in that order
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  std::optional<SingleFactor> single_;
  Trust trust_ = Trust::unknown;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

} // namespace

std::unique_ptr<Factorization> make_cholmod(const BlockPattern& pattern,
                                            std::span<const Index> order) {
  return std::make_unique<CholmodFactorization>(pattern, order);
}

} // namespace billet::mechanics
