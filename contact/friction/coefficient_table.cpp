#include "contact/friction/coefficient_table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace billet::contact {

namespace {

/// The two grid points around a place on one axis, and the weight of the second.
struct Bracket {
  std::size_t first = 0;
  std::size_t second = 0;
  double weight = 0.0;
  double slope = 0.0; ///< of the weight; 0 outside the axis
};

Bracket bracket(const std::vector<double>& axis, double x) {
  if (axis.size() < 2 || x <= axis.front())
    return {};
  if (x >= axis.back())
    return {axis.size() - 1, axis.size() - 1, 0.0, 0.0};
  const auto above = std::upper_bound(axis.begin(), axis.end(), x);
  const auto i = static_cast<std::size_t>(above - axis.begin());
  const double width = axis[i] - axis[i - 1];
  return {i - 1, i, (x - axis[i - 1]) / width, 1.0 / width};
}

} // namespace

CoefficientTable::CoefficientTable(std::array<std::vector<double>, 3> axes,
                                   std::vector<double> values)
    : axes_(std::move(axes)), values_(std::move(values)) {
  std::size_t size = 1;
  for (const std::vector<double>& axis : axes_) {
    if (std::adjacent_find(axis.begin(), axis.end(), std::greater_equal<>()) != axis.end())
      throw std::invalid_argument("an axis of a coefficient table does not increase");
    size *= std::max<std::size_t>(1, axis.size());
  }
  if (values_.size() != size)
    throw std::invalid_argument("a coefficient table needs one value for each grid point");
}

Coefficient CoefficientTable::operator()(const CoefficientPoint& at) const {
  if (values_.empty())
    return {};
  const std::array<Bracket, 3> b{bracket(axes_[0], at.pressure), bracket(axes_[1], at.speed),
                                 bracket(axes_[2], at.sliding)};
  const std::size_t n1 = std::max<std::size_t>(1, axes_[1].size());
  const std::size_t n2 = std::max<std::size_t>(1, axes_[2].size());
  double value = 0.0;
  std::array<double, 3> slope{};
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<std::size_t, 3> index{};
    std::array<double, 3> weight{};
    std::array<double, 3> d_weight{};
    for (unsigned axis = 0; axis < 3; ++axis) {
      const bool second = ((corner >> axis) & 1U) != 0;
      index[axis] = second ? b[axis].second : b[axis].first;
      weight[axis] = second ? b[axis].weight : 1.0 - b[axis].weight;
      d_weight[axis] = second ? b[axis].slope : -b[axis].slope;
    }
    const double v = values_[(index[0] * n1 + index[1]) * n2 + index[2]];
    value += v * weight[0] * weight[1] * weight[2];
    slope[0] += v * d_weight[0] * weight[1] * weight[2];
    slope[1] += v * weight[0] * d_weight[1] * weight[2];
    slope[2] += v * weight[0] * weight[1] * d_weight[2];
  }
  return {value, slope[0], slope[1], slope[2]};
}

} // namespace billet::contact
