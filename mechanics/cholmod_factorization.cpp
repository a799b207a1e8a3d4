#include "mechanics/linear_solver.h"
#include "mechanics/single_factor.h"

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <new>
#include <optional>
#include <vector>

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
    trust_ = Trust::unknown;
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
    constexpr double fewest_entries = 1.3e5; // 1 MB: less stays near the processor anyway
    constexpr double most_entries = 1.6e7;   // 64 MB of copy; beyond it is memory that is short
    if (common_.lnz < fewest_entries || common_.lnz > most_entries)
      return solve(rhs);
    if (trust_ == Trust::unknown) {
      if (!single_)
        single_.emplace(*factor_);
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
