#include "mechanics/linear/elimination.h"
#include "mechanics/linear/linear_solver.h"

#include <cholmod.h>
#include <omp.h>

#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace billet::mechanics {

namespace {

/// CHOLMOD's parallel regions run in the calling thread, as long as this lives. There are several
/// hundred in a factorization, each shared among four threads whatever the machine has, which on
/// small fronts wait for each other longer than they work.
class OneThread {
public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

private:
  int levels_ = omp_get_max_active_levels();
};

/// Supernodal Cholesky factorization with the order given.
///
/// CHOLMOD transposes a matrix twice to bring it in its order, in each factorization: a fifth of
/// the time of one of some thousand unknowns. So it gets the matrix in that order.
class CholmodFactorization final : public Factorization {
public:
  explicit CholmodFactorization(std::shared_ptr<const Elimination> elimination)
      : elimination_(std::move(elimination)) {
    cholmod_start(&common_);
    keep_order(common_);
    common_.quick_return_if_not_posdef = 1;
    cholmod_sparse structure = elimination_->triangle().view({});
    factor_ = cholmod_analyze(&structure, &common_);
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
    const OrderedTriangle& triangle = elimination_->triangle();
    values_.resize(triangle.entries.size());
    for (std::size_t k = 0; k < values_.size(); ++k)
      values_[k] = matrix.values[idx(triangle.entries[k])];
    cholmod_sparse A = triangle.view(values_);
    const OneThread one;
    const int ok = cholmod_factorize(&A, factor_, &common_);
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw std::bad_alloc();
    return ok != 0 && common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  void solve(std::span<double> rhs) override {
    const std::span<const Index> order = elimination_->order();
    ordered_.resize(rhs.size());
    for (std::size_t i = 0; i < rhs.size(); ++i)
      ordered_[i] = rhs[idx(order[i])];
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = ordered_.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    const OneThread one;
    if (cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                       &common_) == 0)
      throw std::bad_alloc();
    const auto* x = static_cast<const double*>(solution_->x);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      rhs[idx(order[i])] = x[i];
  }

  void release() override {
    free_memory(values_);
    if (factor_->xtype != CHOLMOD_PATTERN)
      cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor_, &common_);
  }

  [[nodiscard]] FactorCost cost() const override { return {common_.fl, common_.lnz}; }

private:
  std::shared_ptr<const Elimination> elimination_;
  std::vector<double> values_;  ///< of the triangle
  std::vector<double> ordered_; ///< a right-hand side in that order
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

} // namespace

std::unique_ptr<Factorization> make_cholmod(std::shared_ptr<const Elimination> elimination) {
  return std::make_unique<CholmodFactorization>(std::move(elimination));
}

} // namespace billet::mechanics
