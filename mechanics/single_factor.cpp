#include "mechanics/single_factor.h"

#include <Eigen/Dense>
#include <cholmod.h>

#include <algorithm>
#include <cmath>

namespace billet::mechanics {

namespace {

using Rectangle = Eigen::Map<const Eigen::MatrixXf>;
using Column = Eigen::Map<Eigen::VectorXf>;

} // namespace

SingleFactor::SingleFactor(const cholmod_factor_struct& factor, std::span<const Index> order)
    : order_(order.begin(), order.end()) {
  const auto* super = static_cast<const Index*>(factor.super);
  const auto* begin = static_cast<const Index*>(factor.pi);
  const auto* row = static_cast<const Index*>(factor.s);
  std::size_t values = 0;
  Index most_rows = 0;
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const Index columns = super[s + 1] - super[s];
    const Index rows = begin[s + 1] - begin[s] - columns;
    fronts_.push_back({super[s], columns, rows, rows_.size(), values});
    rows_.insert(rows_.end(), row + begin[s] + columns, row + begin[s + 1]);
    values += idx(columns) * idx(columns + rows);
    most_rows = std::max(most_rows, rows);
  }
  values_.resize(values);
  x_.resize(factor.n);
  below_.resize(idx(most_rows));
}

void SingleFactor::take(const cholmod_factor_struct& factor) {
  const auto* start = static_cast<const Index*>(factor.px);
  const auto* value = static_cast<const double*>(factor.x);
  for (std::size_t s = 0; s < fronts_.size(); ++s) {
    const auto& [first, columns, rows, row, triangle] = fronts_[s];
    const Eigen::Map<const Eigen::MatrixXd> both(value + start[s], columns + rows, columns);
    Eigen::Map<Eigen::MatrixXf> top(values_.data() + triangle, columns, columns);
    Eigen::Map<Eigen::MatrixXf> rest(top.data() + top.size(), rows, columns);
    top = both.topRows(columns).cast<float>();
    rest = both.bottomRows(rows).cast<float>();
  }
}

void SingleFactor::forward() {
  for (const auto& [first, columns, rows, row, triangle] : fronts_) {
    const Rectangle top(values_.data() + triangle, columns, columns);
    Column x(x_.data() + first, columns);
    for (Index j = 0; j < columns; ++j) {
      x[j] /= top(j, j);
      x.tail(columns - j - 1) -= x[j] * top.col(j).tail(columns - j - 1);
    }
    if (rows == 0)
      continue;
    Column below(below_.data(), rows);
    below.noalias() = Rectangle(top.data() + top.size(), rows, columns) * x;
    for (Index i = 0; i < rows; ++i)
      x_[idx(rows_[row + idx(i)])] -= below[i];
  }
}

void SingleFactor::backward() {
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const auto& [first, columns, rows, row, triangle] = *front;
    const Rectangle top(values_.data() + triangle, columns, columns);
    Column x(x_.data() + first, columns);
    if (rows > 0) {
      Column below(below_.data(), rows);
      for (Index i = 0; i < rows; ++i)
        below[i] = x_[idx(rows_[row + idx(i)])];
      x.noalias() -= Rectangle(top.data() + top.size(), rows, columns).transpose() * below;
    }
    for (Index j = columns - 1; j >= 0; --j) {
      const Index left = columns - j - 1;
      x[j] = (x[j] - top.col(j).tail(left).dot(x.tail(left))) / top(j, j);
    }
  }
}

void SingleFactor::solve(std::span<double> rhs) {
  double most = 0.0;
  for (const double value : rhs)
    most = std::max(most, std::abs(value));
  if (most == 0.0)
    return;
  // Of size one, so that it has all its digits in single precision whatever the units.
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] = static_cast<float>(rhs[idx(order_[i])] / most);
  forward();
  backward();
  for (std::size_t i = 0; i < x_.size(); ++i)
    rhs[idx(order_[i])] = most * static_cast<double>(x_[i]);
}

} // namespace billet::mechanics
