#include "mechanics/linear/linear_solver.h"

#include <umfpack.h>

#include <array>
#include <new>

namespace billet::mechanics {

namespace {

/// LU by UMFPACK with the order given and its strategy for symmetric patterns.
class UmfpackFactorization final : public Factorization {
public:
  UmfpackFactorization(const BlockPattern& pattern, std::span<const Index> order)
      : pattern_(&pattern), order_(order.begin(), order.end()) {
    umfpack_di_defaults(control_.data());
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_PRL] = 0;
  }
  ~UmfpackFactorization() override {
    umfpack_di_free_numeric(&numeric_);
    umfpack_di_free_symbolic(&symbolic_);
  }
  UmfpackFactorization(const UmfpackFactorization&) = delete;
  UmfpackFactorization& operator=(const UmfpackFactorization&) = delete;

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override {
    const int n = static_cast<int>(order_.size());
    values_ = matrix.values;
    if (symbolic_ == nullptr)
      check(umfpack_di_qsymbolic(n, n, pattern_->row_start.data(), pattern_->columns.data(),
                                 values_.data(), order_.data(), &symbolic_, control_.data(),
                                 nullptr));
    umfpack_di_free_numeric(&numeric_);
    const int status = check(umfpack_di_numeric(pattern_->row_start.data(),
                                                pattern_->columns.data(), values_.data(), symbolic_,
                                                &numeric_, control_.data(), info_.data()));
    return status == UMFPACK_OK;
  }

  void solve(std::span<double> rhs) override {
    // UMFPACK reads our rows as its columns: it holds the transpose.
    const std::vector<double> b(rhs.begin(), rhs.end());
    check(umfpack_di_solve(UMFPACK_At, pattern_->row_start.data(), pattern_->columns.data(),
                           values_.data(), rhs.data(), b.data(), numeric_, control_.data(),
                           nullptr));
  }

  void release() override {
    umfpack_di_free_numeric(&numeric_);
    free_memory(values_);
  }

  [[nodiscard]] FactorCost cost() const override {
    return {info_[UMFPACK_FLOPS], info_[UMFPACK_LNZ] + info_[UMFPACK_UNZ]};
  }

private:
  static int check(int status) {
    if (status == UMFPACK_ERROR_out_of_memory)
      throw std::bad_alloc();
    return status;
  }

  const BlockPattern* pattern_;
  std::vector<Index> order_;
  std::vector<double> values_;
  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
};

} // namespace

std::unique_ptr<Factorization> make_umfpack(const BlockPattern& pattern,
                                            std::span<const Index> order) {
  return std::make_unique<UmfpackFactorization>(pattern, order);
}

} // namespace billet::mechanics
