#include "mechanics/linear_solver.h"
#include "mechanics/single_factor.h"

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <new>
#include <optional>

namespace billet::mechanics {

namespace {

/// One thread for OpenMP while it lives: CHOLMOD shares loops among four whatever the machine has,
/// and on small fronts they wait for each other longer than they work.
class OneThread {
public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

private:
  int before_ = omp_get_max_active_levels();
};

/// Supernodal Cholesky factorization with the order given.
class CholmodFactorization final : public Factorization {
public:
  CholmodFactorization(const BlockPattern& pattern, std::span<const Index> order)
      : pattern_(&pattern) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
    std::vector<Index> permutation(order.begin(), order.end());
    cholmod_sparse A = view(nullptr);
    factor_ = cholmod_analyze_p(&A, permutation.data(), nullptr, 0, &common_);
    if (factor_ == nullptr)
      throw std::bad_alloc();
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
    const OneThread one;
    cholmod_sparse A = view(matrix.values.data());
    const int ok = cholmod_factorize(&A, factor_, &common_);
    single_is_current_ = false;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw std::bad_alloc();
    return ok != 0 && common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  void solve(std::span<double> rhs) override {
    const OneThread one;
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = rhs.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   &common_);
    const auto* x = static_cast<const double*>(solution_->x);
    std::copy(x, x + rhs.size(), rhs.begin());
  }

  void solve_roughly(std::span<double> rhs) override {
    constexpr double most_entries = 1.6e7; // 64 MB; beyond it is memory that is short
    if (common_.lnz > most_entries)
      return solve(rhs);
    if (!single_)
      single_.emplace(*factor_);
    if (!single_is_current_)
      single_->take(*factor_);
    single_is_current_ = true;
    single_->solve(rhs);
  }

  void release() override {
    single_.reset();
    if (factor_->xtype != CHOLMOD_PATTERN)
      cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor_, &common_);
  }

  [[nodiscard]] FactorCost cost() const override { return {common_.fl, common_.lnz}; }

private:
  /// The matrix as CHOLMOD sees it: its lower triangle by columns. Only read.
  [[nodiscard]] cholmod_sparse view(const double* values) {
    cholmod_sparse A{};
    A.nrow = static_cast<std::size_t>(pattern_->n_dofs());
    A.ncol = A.nrow;
    A.nzmax = pattern_->n_entries();
    // The C interface has no const.
    A.p = const_cast<Index*>(pattern_->row_start.data()); // NOLINT
    A.i = const_cast<Index*>(pattern_->columns.data());   // NOLINT
    A.x = const_cast<double*>(values);                    // NOLINT
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = 1;
    A.packed = 1;
    return A;
  }

  const BlockPattern* pattern_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  std::optional<SingleFactor> single_;
  bool single_is_current_ = false;
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
