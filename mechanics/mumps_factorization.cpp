#include "mechanics/linear_solver.h"

#include <dmumps_c.h>

#include <algorithm>
#include <new>

namespace billet::mechanics {

namespace {

/// LU, or LDL^T of the lower triangle, by MUMPS (sequential) with the order given.
class MumpsFactorization final : public Factorization {
public:
  MumpsFactorization(const BlockPattern& pattern, std::span<const Index> order, bool symmetric)
      : symmetric_(symmetric) {
    list_entries(pattern);
    position_.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      position_[static_cast<std::size_t>(order[i])] = static_cast<MUMPS_INT>(i) + 1;
    mumps_.sym = symmetric ? 2 : 0;
    mumps_.par = 1;
    mumps_.comm_fortran = -987654; // MUMPS' own constant for "all processes"
    call(-1);
    for (const int stream : {1, 2, 3, 4})
      control(stream) = stream == 4 ? 0 : -1; // silent
    control(7) = 1;                           // the order is given in perm_in
    control(8) = 0;                           // no scaling: the unknowns are all displacements
    control(14) = 30;                         // room for pivoting, per cent
    control(24) = 0;                          // a null pivot is an error, not a guess
    mumps_.n = pattern.n_dofs();
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    mumps_.perm_in = position_.data();
    call(1);
    check_memory();
  }
  ~MumpsFactorization() override { call(-2); }
  MumpsFactorization(const MumpsFactorization&) = delete;
  MumpsFactorization& operator=(const MumpsFactorization&) = delete;

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override {
    for (std::size_t k = 0; k < entries_.size(); ++k)
      values_[k] = matrix.values[entries_[k]];
    mumps_.a = values_.data();
    call(2);
    for (int more = 0; more < 4 && too_small(); ++more) {
      control(14) *= 2;
      call(2);
    }
    check_memory();
    return mumps_.infog[0] >= 0;
  }

  void solve(std::span<double> rhs) override {
    mumps_.rhs = rhs.data();
    mumps_.nrhs = 1;
    mumps_.lrhs = mumps_.n;
    call(3);
  }

  [[nodiscard]] FactorCost cost() const override {
    // INFOG(9) counts millions below zero when it does not fit.
    const double entries = mumps_.infog[8];
    return {std::max(mumps_.rinfog[0], mumps_.rinfog[2]), entries >= 0.0 ? entries : -1e6 * entries};
  }

private:
  void list_entries(const BlockPattern& pattern) {
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      for (Index k = pattern.row_start[static_cast<std::size_t>(i)];
           k < pattern.row_start[static_cast<std::size_t>(i) + 1]; ++k) {
        const Index j = pattern.columns[static_cast<std::size_t>(k)];
        if (symmetric_ && j > i)
          continue;
        rows_.push_back(i + 1);
        columns_.push_back(j + 1);
        entries_.push_back(static_cast<std::size_t>(k));
      }
    values_.resize(entries_.size());
  }
  void call(int job) {
    mumps_.job = job;
    dmumps_c(&mumps_);
  }
  /// ICNTL(i) of the manual.
  MUMPS_INT& control(int i) { return mumps_.icntl[i - 1]; }
  [[nodiscard]] bool too_small() const { return mumps_.infog[0] == -8 || mumps_.infog[0] == -9; }
  void check_memory() const {
    if (mumps_.infog[0] == -13 || mumps_.infog[0] == -7)
      throw std::bad_alloc();
  }

  bool symmetric_;
  DMUMPS_STRUC_C mumps_{};
  std::vector<MUMPS_INT> rows_;
  std::vector<MUMPS_INT> columns_;
  std::vector<MUMPS_INT> position_;
  std::vector<std::size_t> entries_; ///< where MUMPS' entries lie among the matrix's
  std::vector<double> values_;
};

} // namespace

std::unique_ptr<Factorization>
make_mumps(const BlockPattern& pattern, std::span<const Index> order, bool symmetric) {
  return std::make_unique<MumpsFactorization>(pattern, order, symmetric);
}

} // namespace billet::mechanics
