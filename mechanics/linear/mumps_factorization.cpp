#include "mechanics/linear/linear_solver.h"

#include <dmumps_c.h>
#include <smumps_c.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

namespace billet::mechanics {

namespace {

struct Double {
  using Data = DMUMPS_STRUC_C;
  using Real = double;
  static void call(Data& data) { dmumps_c(&data); }
};

struct Single {
  using Data = SMUMPS_STRUC_C;
  using Real = float;
  static void call(Data& data) { smumps_c(&data); }
};

double largest_of(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

/// LU, or LDL^T of the lower triangle, by MUMPS (sequential) with the order given.
///
/// MUMPS asks for the numbers of rows and columns of all entries, twice the pattern's memory: they
/// are written anew for each of its calls that reads them.
template <class Precision> class MumpsFactorization final : public Factorization {
  using Real = typename Precision::Real;

public:
  MumpsFactorization(const BlockPattern& pattern, std::span<const Index> order, bool symmetric)
      : pattern_(&pattern), symmetric_(symmetric) {
    position_.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      position_[static_cast<std::size_t>(order[i])] = static_cast<MUMPS_INT>(i) + 1;
    list_entries();
    analyze();
    forget_entries();
  }
  ~MumpsFactorization() override { end(); }
  MumpsFactorization(const MumpsFactorization&) = delete;
  MumpsFactorization& operator=(const MumpsFactorization&) = delete;

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override {
    list_entries();
    if (released_)
      analyze();
    copy_values(matrix.values);
    call(2);
    for (int more = 0; more < 4 && too_small(); ++more) {
      control(14) *= 2;
      call(2);
    }
    forget_entries();
    check_memory();
    note_cost();
    return mumps_.infog[0] >= 0;
  }

  void solve(std::span<double> rhs) override {
    rhs_.assign(rhs.begin(), rhs.end());
    mumps_.rhs = rhs_.data();
    mumps_.nrhs = 1;
    mumps_.lrhs = mumps_.n;
    call(3);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      rhs[i] = unit_ * static_cast<double>(rhs_[i]);
  }

  /// The analysis goes as well: this version of MUMPS cannot keep it alone.
  void release() override { end(); }

  [[nodiscard]] FactorCost cost() const override { return cost_; }

private:
  void end() {
    if (!released_)
      call(-2);
    released_ = true;
  }

  void analyze() {
    mumps_ = {};
    mumps_.sym = symmetric_ ? 2 : 0;
    mumps_.par = 1;
    mumps_.comm_fortran = -987654; // MUMPS' own constant for "all processes"
    call(-1);
    released_ = false;
    for (const int stream : {1, 2, 3, 4})
      control(stream) = stream == 4 ? 0 : -1; // silent
    control(7) = 1;                           // the order is given in perm_in
    control(8) = 0;                           // no scaling: the unknowns are all displacements
    control(14) = 30;                         // room for pivoting, per cent
    control(24) = 0;                          // a null pivot is an error, not a guess
    mumps_.n = pattern_->n_dofs();
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    mumps_.perm_in = position_.data();
    call(1);
    check_memory();
    note_cost();
  }

  /// One past the last entry of row i that MUMPS is given: up to the diagonal where symmetric.
  [[nodiscard]] std::size_t row_end(std::size_t i) const {
    auto end = static_cast<std::size_t>(pattern_->row_start[i + 1]);
    while (symmetric_ && pattern_->columns[end - 1] > static_cast<Index>(i))
      --end;
    return end;
  }

  void list_entries() {
    const auto n = static_cast<std::size_t>(pattern_->n_dofs());
    rows_.reserve(pattern_->n_entries() / (symmetric_ ? 2 : 1) + n);
    columns_.reserve(rows_.capacity());
    for (std::size_t i = 0; i < n; ++i)
      for (auto k = static_cast<std::size_t>(pattern_->row_start[i]); k < row_end(i); ++k) {
        rows_.push_back(static_cast<MUMPS_INT>(i) + 1);
        columns_.push_back(pattern_->columns[k] + 1);
      }
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
  }

  /// In single precision relative to the largest, for numbers of any unit to fit.
  void copy_values(std::span<const double> values) {
    if constexpr (std::is_same_v<Real, double>) {
      if (!symmetric_) {
        mumps_.a = const_cast<double*>(values.data()); // NOLINT: only read
        return;
      }
    } else {
      const double largest = largest_of(values);
      unit_ = largest > 0.0 ? 1.0 / largest : 1.0;
    }
    values_.reserve(rows_.size());
    for (std::size_t i = 0; i + 1 < pattern_->row_start.size(); ++i)
      for (auto k = static_cast<std::size_t>(pattern_->row_start[i]); k < row_end(i); ++k)
        values_.push_back(static_cast<Real>(unit_ * values[k]));
    mumps_.a = values_.data();
  }

  void forget_entries() {
    free_memory(rows_);
    free_memory(columns_);
    free_memory(values_);
    mumps_.irn = nullptr;
    mumps_.jcn = nullptr;
    mumps_.a = nullptr;
  }

  void note_cost() {
    // INFOG(9), of the factors there are, and INFOG(20), of those expected, count millions below
    // zero where they do not fit.
    const double entries = mumps_.infog[8] != 0 ? mumps_.infog[8] : mumps_.infog[19];
    cost_ = {std::max(mumps_.rinfog[0], mumps_.rinfog[2]),
             entries >= 0.0 ? entries : -1e6 * entries, sizeof(Real)};
  }

  void call(int job) {
    mumps_.job = job;
    Precision::call(mumps_);
  }
  /// ICNTL(i) of the manual.
  MUMPS_INT& control(int i) { return mumps_.icntl[i - 1]; }
  [[nodiscard]] bool too_small() const { return mumps_.infog[0] == -8 || mumps_.infog[0] == -9; }
  void check_memory() const {
    if (mumps_.infog[0] == -13 || mumps_.infog[0] == -7)
      throw std::bad_alloc();
  }

  const BlockPattern* pattern_;
  bool symmetric_;
  bool released_ = true;
  typename Precision::Data mumps_{};
  std::vector<MUMPS_INT> position_;
  std::vector<MUMPS_INT> rows_;
  std::vector<MUMPS_INT> columns_;
  std::vector<Real> values_;
  std::vector<Real> rhs_;
  double unit_ = 1.0; ///< what the entries were multiplied with
  FactorCost cost_;
};

} // namespace

std::unique_ptr<Factorization>
make_mumps(const BlockPattern& pattern, std::span<const Index> order, bool symmetric) {
  return std::make_unique<MumpsFactorization<Double>>(pattern, order, symmetric);
}

std::unique_ptr<Factorization> make_single_mumps(const BlockPattern& pattern,
                                                 std::span<const Index> order) {
  return std::make_unique<MumpsFactorization<Single>>(pattern, order, false);
}

} // namespace billet::mechanics
