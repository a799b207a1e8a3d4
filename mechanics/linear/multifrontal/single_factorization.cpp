#include "geometry/base/pieces.h"
#include "mechanics/linear/elimination.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multifrontal/branches.h"
#include "mechanics/linear/multifrontal/extend_add.h"
#include "mechanics/linear/multifrontal/front_assembly.h"
#include "mechanics/linear/multifrontal/front_kernels.h"
#include "mechanics/linear/multifrontal/front_vector.h"
#include "mechanics/linear/multifrontal/packed_panel.h"

#include <Eigen/Core>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace billet::mechanics {

namespace {

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

/// What a thread works in.
struct Workspace {
  std::vector<float> panel; ///< of the front at hand
  std::vector<float> stack; ///< of complements
  std::vector<float> local; ///< of a panel's rows
  FrontWork work;
};

/// L S L^T with the order given, S a diagonal of signs, in single precision and without pivoting.
///
/// Multifrontal: what a front takes from the matrix behind it waits until its parent is put
/// together (Duff & Reid, 1983): on a stack within a branch, in memory of its own where it is
/// handed up.
class SingleFactorization final : public Factorization {
public:
  explicit SingleFactorization(std::shared_ptr<const Elimination> elimination);

  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override;
  void solve(std::span<double> rhs) override;
  void release() override {
    workspaces_.clear();
    team_.clear();
    free_memory(diagonal_);
    below_.reset();
  }
  [[nodiscard]] FactorCost cost() const override {
    return {elimination_->flops(), elimination_->entries(), sizeof(float)};
  }

private:
  [[nodiscard]] const Front& front(std::size_t f) const { return elimination_->fronts()[f]; }
  [[nodiscard]] PackedPanel packed(std::size_t f) {
    return {idx(front(f).rows + front(f).columns), idx(front(f).columns),
            diagonal_.data() + triangle_start_[f], below_.get() + below_start_[f]};
  }
  /// Of a front, in the memory for it.
  [[nodiscard]] float* complement(std::size_t f, Workspace& workspace) {
    return handed_up_[f] ? handed_up_[f].get() : workspace.stack.data() + stack_place_[f];
  }
  /// An unknown, and its place in the order of elimination.
  struct Place {
    std::uint32_t place;
    std::uint32_t unknown;
  };
  void find_places();
  /// Calls `visit(place, unknown)` for all unknowns, those of a node together.
  template <class Visit> void for_each_place(Visit visit) const;
  void measure_panels();
  void find_children();
  void find_pairs();
  void measure_stacks(const Branch& branch, std::span<const char> odd);
  void find_targets();
  void find_scale(const SparseMatrix& matrix);
  [[nodiscard]] bool
  eliminate_front(std::size_t f, const SparseMatrix& matrix, Workspace& own, Threads threads);
  void forward();
  void backward();
  /// Whether substitutions take long enough for threads to share the branches.
  [[nodiscard]] Threads sharing() const {
    constexpr std::size_t many = 1 << 18; // numbers
    return below_start_.back() > many ? Threads::all : Threads::one;
  }
  void forward(std::size_t f, Workspace& own);
  void backward(std::size_t f, Workspace& own);
  /// Calls `work(branch, workspace)` for the branches of a level.
  template <class Work> void for_branches(std::size_t level, Threads threads, const Work& work);

  std::shared_ptr<const Elimination> elimination_;
  FrontAssembly assembly_;
  ExtendAdd extend_add_;
  Branches branches_;
  std::size_t max_rows_ = 0;                ///< of a panel, padded
  std::vector<std::size_t> triangle_start_; ///< where a front's inverses begin
  std::vector<std::size_t> below_start_;    ///< where what is below them begins
  std::vector<std::vector<std::size_t>> children_;
  std::vector<Place> nodes_;             ///< first unknowns of nodes whose others follow
  std::vector<Place> singles_;           ///< unknowns of the other nodes
  std::vector<char> paired_;             ///< by front: its rows and targets come two by two
  std::vector<std::size_t> stack_place_; ///< where a front's complement waits
  std::size_t stack_size_ = 0;           ///< of the largest branch
  std::vector<std::unique_ptr<float[]>>
      handed_up_; ///< complements that go to other branches, by front
  /// What a branch contributes to unknowns of other branches is summed separately, so that branches
  /// do not write to the same place.
  struct Beside {
    std::vector<Index> unknowns;    ///< that each sum goes to
    std::vector<std::size_t> start; ///< of a branch's sums
  };
  std::vector<Index> target_; ///< by row of all fronts: what a substitution adds to
  Beside beside_;
  std::vector<DiagonalInverse> diagonal_;
  std::unique_ptr<float[]> below_; ///< first touched by the threads that fill it
  std::vector<float> inverses_;    ///< of the factor's diagonal
  std::vector<float> signs_;
  std::vector<float> least_; ///< pivot by unknown
  std::vector<float> x_;     ///< unknowns in the order of elimination, then the separate sums
  double scale_ = 1.0;       ///< of the matrix
  oneapi::tbb::enumerable_thread_specific<Workspace> workspaces_;
  FrontTeam team_;
};

SingleFactorization::SingleFactorization(std::shared_ptr<const Elimination> elimination)
    : elimination_(std::move(elimination)), assembly_(*elimination_), extend_add_(*elimination_),
      branches_(*elimination_) {
  const std::size_t n = elimination_->order().size();
  inverses_.resize(n);
  signs_.resize(n);
  least_.resize(n);
  find_places();
  measure_panels();
  find_children();
  find_targets();
  find_pairs();
  x_.resize(n + beside_.unknowns.size());
  const std::span<const Front> fronts = elimination_->fronts();
  std::vector<char> odd(fronts.size());
  for (std::size_t f = fronts.size(); f-- > 0;)
    odd[f] = fronts[f].parent >= 0 && odd[idx(fronts[f].parent)] == 0 ? 1 : 0;
  stack_place_.resize(fronts.size());
  for (const Branch& branch : branches_.all())
    measure_stacks(branch, odd);
  handed_up_.resize(fronts.size());
}

void SingleFactorization::measure_panels() {
  std::size_t triangles = 0;
  std::size_t below = 0;
  for (const Front& front : elimination_->fronts()) {
    const std::size_t rows = idx(front.rows + front.columns), columns = idx(front.columns);
    triangle_start_.push_back(triangles);
    below_start_.push_back(below);
    triangles += diagonal_triangles(columns);
    below += packed_size(rows, columns);
    max_rows_ = std::max(max_rows_, padded(rows));
  }
  triangle_start_.push_back(triangles);
  below_start_.push_back(below);
}

void SingleFactorization::find_places() {
  const std::span<const Index> order = elimination_->order();
  const auto dim = idx(elimination_->dim());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t count = 1;
    while (count < dim && i + count < order.size() && order[i + count] == order[i + count - 1] + 1)
      ++count;
    auto& kind = count == dim ? nodes_ : singles_;
    const std::size_t many = count == dim ? count : 1;
    kind.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(order[i])});
    i += many;
  }
}

template <class Visit> void SingleFactorization::for_each_place(Visit visit) const {
  const auto visit_nodes = [&](auto constant) {
    for_pieces(nodes_.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (const auto& [place, unknown] : std::span(nodes_).subspan(begin, end - begin))
        for (std::uint32_t k = 0; k < decltype(constant)::value; ++k)
          visit(place + k, unknown + k);
    });
  };
  if (elimination_->dim() == 2)
    visit_nodes(std::integral_constant<std::uint32_t, 2>{});
  else
    visit_nodes(std::integral_constant<std::uint32_t, 3>{});
  for (const auto& [place, unknown] : singles_)
    visit(place, unknown);
}

void SingleFactorization::find_children() {
  const std::span<const Front> fronts = elimination_->fronts();
  children_.resize(fronts.size());
  for (std::size_t f = 0; f < fronts.size(); ++f)
    if (fronts[f].parent >= 0)
      children_[idx(fronts[f].parent)].push_back(f);
}

void SingleFactorization::find_pairs() {
  for (std::size_t f = 0; f < children_.size(); ++f) {
    const std::span<const Index> rows = elimination_->rows(front(f));
    const auto targets = std::span(target_).subspan(front(f).row, rows.size());
    bool paired = rows.size() % 2 == 0;
    for (std::size_t i = 0; paired && i < rows.size(); i += 2)
      paired = rows[i + 1] == rows[i] + 1 && targets[i + 1] == targets[i] + 1;
    paired_.push_back(paired ? 1 : 0);
  }
}

/// Fronts an even and an odd number of generations below their root have a stack each: a complement
/// is formed in one while those of its front's children lie in the other.
void SingleFactorization::measure_stacks(const Branch& branch, std::span<const char> odd) {
  std::array<std::size_t, 2> top{};
  std::array<std::size_t, 2> size{};
  for (std::size_t f = branch.begin; f < branch.end; ++f) {
    const std::size_t own = idx(odd[f]), other = 1 - own;
    if (!branches_.is_handed_up(f)) {
      stack_place_[f] = top[own];
      top[own] += padded(idx(front(f).rows)) * idx(front(f).rows);
      size[own] = std::max(size[own], top[own]);
    }
    if (!children_[f].empty())
      top[other] = stack_place_[children_[f].front()];
  }
  for (std::size_t f = branch.begin; f < branch.end; ++f)
    if (odd[f] != 0)
      stack_place_[f] += size[0];
  stack_size_ = std::max(stack_size_, size[0] + size[1]);
}

void SingleFactorization::find_targets() {
  const std::size_t n = elimination_->order().size();
  for (const Front& front : elimination_->fronts())
    target_.insert(target_.end(), elimination_->rows(front).begin(),
                   elimination_->rows(front).end());
  std::vector<Index> place(n);
  std::vector<Index> met;
  for (const Branch& branch : branches_.all()) {
    beside_.start.push_back(beside_.unknowns.size());
    const Front& last = front(branch.end - 1);
    const Index end = last.first + last.columns;
    const std::size_t first_row = front(branch.begin).row;
    const auto rows = std::span(target_).subspan(first_row, last.row + idx(last.rows) - first_row);
    met.clear();
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(met),
                 [&](Index row) { return row >= end; });
    std::sort(met.begin(), met.end());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    for (const Index row : met) {
      place[idx(row)] = static_cast<Index>(n + beside_.unknowns.size());
      beside_.unknowns.push_back(row);
    }
    for (Index& row : rows)
      if (row >= end)
        row = place[idx(row)];
  }
  beside_.start.push_back(beside_.unknowns.size());
}

template <class Work>
void SingleFactorization::for_branches(std::size_t level, Threads threads, const Work& work) {
  const auto some = branches_.all().subspan(branches_.begin(level),
                                            branches_.begin(level + 1) - branches_.begin(level));
  for_pieces(some.size(), threads == Threads::all ? 1 : some.size(),
             [&](std::size_t begin, std::size_t end) {
               Workspace& own = workspaces_.local();
               own.local.resize(max_rows_ + front_lanes); // cleared by whole vectors
               // A thread that waits for others within a front must not begin another in the same
               // memory.
               oneapi::tbb::this_task_arena::isolate([&] {
                 for (const Branch& branch : some.subspan(begin, end - begin))
                   work(branch, own);
               });
             });
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

bool SingleFactorization::eliminate_front(std::size_t f,
                                          const SparseMatrix& matrix,
                                          Workspace& own,
                                          Threads threads) {
  const std::size_t columns = idx(front(f).columns), rows = columns + idx(front(f).rows);
  const std::size_t size = padded(rows) * columns + front_lanes; // products read a vector beyond
  if (own.panel.size() < size)
    own.panel.resize(size);
  const Panel panel{own.panel.data(), rows, columns};
  FrontTeam* team = threads == Threads::all ? &team_ : nullptr;
  assembly_.assemble(f, matrix, scale_, panel);
  for (const std::size_t child : children_[f])
    extend_add_.to_panel(child, complement(child, own), panel, threads);
  float* signs = signs_.data() + front(f).first;
  float* inverses = inverses_.data() + front(f).first;
  if (!eliminate(panel, least_.data() + front(f).first, inverses, signs, own.work, team))
    return false;
  pack(panel, inverses, packed(f), threads);
  if (front(f).rows > 0) {
    if (branches_.is_handed_up(f))
      handed_up_[f] =
          std::make_unique_for_overwrite<float[]>(padded(rows - columns) * (rows - columns));
    form_complement(panel, signs, complement(f, own), own.work, team);
    for (const std::size_t child : children_[f])
      extend_add_.to_complement(child, complement(child, own), panel, complement(f, own), threads);
  }
  for (const std::size_t child : children_[f])
    handed_up_[child].reset();
  return true;
}

bool SingleFactorization::factorize(const SparseMatrix& matrix) {
  diagonal_.resize(triangle_start_.back());
  if (!below_)
    below_ = std::make_unique_for_overwrite<float[]>(below_start_.back());
  find_scale(matrix);
  std::atomic<bool> good = true;
  for (std::size_t level = 0; level < branches_.levels() && good; ++level)
    for_branches(level, Threads::all, [&](const Branch& branch, Workspace& own) {
      if (level == 0 && own.stack.size() < stack_size_)
        own.stack.resize(stack_size_);
      for (std::size_t f = branch.begin; f < branch.end && good; ++f)
        if (!eliminate_front(f, matrix, own, level == 0 ? Threads::one : Threads::all))
          good = false;
    });
  if (!good)
    for (auto& complement : handed_up_)
      complement.reset();
  return good;
}

/// Whether a substitution by a panel takes long enough for threads to share it.
Threads sharing_of(const PackedPanel& panel) {
  constexpr std::size_t many = 1 << 17; // numbers
  return packed_size(panel.rows, panel.columns) > many ? Threads::all : Threads::one;
}

void SingleFactorization::forward(std::size_t f, Workspace& own) {
  const PackedPanel panel = packed(f);
  float* local = own.local.data();
  copy_few(x_.data() + front(f).first, panel.columns, local);
  clear_vectors(local + panel.columns, padded(panel.rows) - panel.columns);
  substitute_forward(panel, local, sharing_of(panel));
  copy_few(local, panel.columns, x_.data() + front(f).first);
  local += panel.columns;
  const auto targets = std::span(target_).subspan(front(f).row, idx(front(f).rows));
  if (paired_[f] != 0)
    for (std::size_t i = 0; i < targets.size(); i += 2)
      add_pair(local + i, x_.data() + targets[i]);
  else
    for (const Index to : targets)
      x_[idx(to)] += *local++;
}

void SingleFactorization::forward() {
  const std::size_t n = elimination_->order().size();
  std::fill(x_.begin() + static_cast<std::ptrdiff_t>(n), x_.end(), 0.0F);
  for (std::size_t level = 0; level < branches_.levels(); ++level) {
    for_branches(level, sharing(), [&](const Branch& branch, Workspace& own) {
      for (std::size_t f = branch.begin; f < branch.end; ++f)
        forward(f, own);
    });
    for (std::size_t i = beside_.start[branches_.begin(level)];
         i < beside_.start[branches_.begin(level + 1)]; ++i)
      x_[idx(beside_.unknowns[i])] += x_[n + i];
  }
}

void SingleFactorization::backward(std::size_t f, Workspace& own) {
  const PackedPanel panel = packed(f);
  float* local = own.local.data();
  copy_few(x_.data() + front(f).first, panel.columns, local);
  local += panel.columns;
  const std::span<const Index> rows = elimination_->rows(front(f));
  if (paired_[f] != 0)
    for (std::size_t i = 0; i < rows.size(); i += 2)
      std::memcpy(local + i, x_.data() + rows[i], 2 * sizeof(float));
  else
    for (std::size_t i = 0; i < rows.size(); ++i)
      local[i] = x_[idx(rows[i])];
  clear_vectors(local + rows.size(), padded(panel.rows) - panel.rows);
  substitute_backward(panel, own.local.data(), sharing_of(panel));
  copy_few(own.local.data(), panel.columns, x_.data() + front(f).first);
}

void SingleFactorization::backward() {
  for (std::size_t level = branches_.levels(); level-- > 0;)
    for_branches(level, sharing(), [&](const Branch& branch, Workspace& own) {
      for (std::size_t f = branch.end; f-- > branch.begin;)
        backward(f, own);
    });
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
  for_each_place([&](std::uint32_t place, std::uint32_t unknown) {
    x_[place] = static_cast<float>(to_one * rhs[unknown]);
  });
  forward();
  for_pieces(signs_.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      x_[i] *= signs_[i];
  });
  backward();
  for_each_place([&](std::uint32_t place, std::uint32_t unknown) {
    rhs[unknown] = back * static_cast<double>(x_[place]);
  });
}

} // namespace

std::unique_ptr<Factorization> make_single(std::shared_ptr<const Elimination> elimination) {
  return std::make_unique<SingleFactorization>(std::move(elimination));
}

} // namespace billet::mechanics
