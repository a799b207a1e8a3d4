#include "mechanics/linear/elimination.h"

#include <cholmod.h>

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

namespace billet::mechanics {

namespace {

/// CHOLMOD's working state, given back at the end.
class Session {
public:
  Session() {
    cholmod_start(&common_);
    keep_order(common_);
  }
  ~Session() { cholmod_finish(&common_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] cholmod_common& common() { return common_; }

private:
  cholmod_common common_{};
};

struct FreeFactor {
  cholmod_common* common;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common); }
};
using Symbolic = std::unique_ptr<cholmod_factor, FreeFactor>;

Symbolic analyzed(const OrderedTriangle& triangle, cholmod_common& common) {
  cholmod_sparse structure = triangle.view({});
  Symbolic analysis(cholmod_analyze(&structure, &common), FreeFactor{&common});
  if (!analysis)
    throw std::bad_alloc();
  return analysis;
}

std::vector<Index> with_constrained_first(std::span<const Index> order,
                                          std::span<const char> constrained) {
  std::vector<Index> sorted(order.begin(), order.end());
  if (!constrained.empty())
    std::stable_partition(sorted.begin(), sorted.end(),
                          [&](Index unknown) { return constrained[idx(unknown)] != 0; });
  return sorted;
}

} // namespace

OrderedTriangle::OrderedTriangle(const BlockPattern& pattern,
                                 std::span<const Index> order,
                                 std::span<const char> constrained)
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
  const auto coupled = [&](Index a, Index b) {
    return a == b || constrained.empty() || (constrained[idx(a)] == 0 && constrained[idx(b)] == 0);
  };
  std::vector<std::pair<Index, Index>> column; // row, entry
  for (std::size_t j = 0; j < order.size(); ++j) {
    column.clear();
    for (const Index other : row_of(order[j]))
      if (place[idx(other)] >= static_cast<Index>(j) && coupled(order[j], other))
        column.emplace_back(place[idx(other)], entry(order[j], other));
    std::sort(column.begin(), column.end());
    for (const auto& [row, from] : column) {
      rows.push_back(row);
      entries.push_back(from);
    }
    start.push_back(static_cast<Index>(rows.size()));
  }
}

cholmod_sparse OrderedTriangle::view(std::span<const double> values) const {
  const auto lent = [](const auto* array) {
    return const_cast<void*>(static_cast<const void*>(array));
  };
  cholmod_sparse A{};
  A.nrow = start.size() - 1;
  A.ncol = A.nrow;
  A.nzmax = rows.size();
  A.p = lent(start.data());
  A.i = lent(rows.data());
  A.x = lent(values.data());
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

void keep_order(cholmod_common& common) {
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  common.print = 0;
}

Elimination::Elimination(const BlockPattern& pattern,
                         std::span<const Index> order,
                         std::span<const char> constrained)
    : dim_(pattern.dim), order_(with_constrained_first(order, constrained)),
      triangle_(pattern, order_, constrained) {
  Session session;
  follow_elimination(pattern, constrained, session.common());
  find_fronts(session.common());
}

void Elimination::follow_elimination(const BlockPattern& pattern,
                                     std::span<const char> constrained,
                                     cholmod_common& common) {
  common.postorder = 1;
  const Symbolic trial = analyzed(triangle_, common);
  common.postorder = 0;
  const auto* then = static_cast<const Index*>(trial->Perm);
  std::vector<Index> order(order_.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = order_[idx(then[i])];
  order_ = std::move(order);
  triangle_ = OrderedTriangle(pattern, order_, constrained);
}

void Elimination::find_fronts(cholmod_common& common) {
  const Symbolic analysis = analyzed(triangle_, common);
  flops_ = common.fl;
  entries_ = common.lnz;
  const auto* super = static_cast<const Index*>(analysis->super);
  const auto* begin = static_cast<const Index*>(analysis->pi);
  const auto* row = static_cast<const Index*>(analysis->s);
  std::vector<Index> front_of(order_.size());
  for (std::size_t s = 0; s < analysis->nsuper; ++s) {
    const Index columns = super[s + 1] - super[s];
    const Index rows = begin[s + 1] - begin[s] - columns;
    fronts_.push_back({super[s], columns, rows, rows_.size(), -1});
    rows_.insert(rows_.end(), row + begin[s] + columns, row + begin[s + 1]);
    std::fill_n(front_of.begin() + super[s], columns, static_cast<Index>(s));
  }
  for (Front& front : fronts_)
    if (front.rows > 0)
      front.parent = front_of[idx(rows_[front.row])];
}

} // namespace billet::mechanics
