#include "mechanics/linear/elimination.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multifrontal/extend_add.h"
#include "mechanics/linear/multifrontal/front_assembly.h"
#include "mechanics/linear/multifrontal/front_kernels.h"
#include "mechanics/linear/multifrontal/front_vector.h"
#include "mechanics/linear/multifrontal/packed_panel.h"

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
  void measure_stacks();
  void find_scale(const SparseMatrix& matrix);
  void forward();
  void backward();

  std::shared_ptr<const Elimination> elimination_;
  FrontAssembly assembly_;
  ExtendAdd extend_add_;
  std::size_t panel_size_ = 0;              ///< of the largest
  std::vector<std::size_t> triangle_start_; ///< where a front's inverses begin
  std::vector<std::size_t> below_start_;    ///< likewise what is below them
  std::vector<std::vector<std::size_t>> children_;
  std::vector<Place> nodes_;             ///< first unknowns of nodes whose others follow
  std::vector<Place> singles_;           ///< unknowns of the other nodes
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
    : elimination_(std::move(elimination)), assembly_(*elimination_), extend_add_(*elimination_) {
  const std::size_t n = elimination_->order().size();
  inverses_.resize(n);
  signs_.resize(n);
  least_.resize(n);
  x_.resize(n);
  find_places();
  measure_panels();
  find_children();
  find_pairs();
  measure_stacks();
}

void SingleFactorization::measure_panels() {
  std::size_t triangles = 0;
  std::size_t below = 0;
  std::size_t max_rows = 0;
  for (const Front& front : elimination_->fronts()) {
    const std::size_t rows = idx(front.rows + front.columns), columns = idx(front.columns);
    triangle_start_.push_back(triangles);
    below_start_.push_back(below);
    triangles += diagonal_triangles(columns);
    below += packed_size(rows, columns);
    panel_size_ = std::max(panel_size_, padded(rows) * columns);
    max_rows = std::max(max_rows, padded(rows));
  }
  triangle_start_.push_back(triangles);
  below_start_.push_back(below);
  local_.resize(max_rows + front_lanes); // cleared by whole vectors
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
    for (const auto& [place, unknown] : nodes_)
      for (std::uint32_t k = 0; k < decltype(constant)::value; ++k)
        visit(place + k, unknown + k);
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
      extend_add_.to_panel(child, stack_.data() + stack_place_[child], own);
    float* signs = signs_.data() + front.first;
    if (!eliminate(own, least_.data() + front.first, inverses_.data() + front.first, signs, work_))
      return false;
    pack(own, inverses_.data() + front.first, packed(f));
    if (front.rows > 0) {
      float* complement = stack_.data() + stack_place_[f];
      form_complement(own, signs, complement, work_);
      for (const std::size_t child : children_[f])
        extend_add_.to_complement(child, stack_.data() + stack_place_[child], own, complement);
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
  for_each_place([&](std::uint32_t place, std::uint32_t unknown) {
    x_[place] = static_cast<float>(to_one * rhs[unknown]);
  });
  forward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] *= signs_[i];
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
