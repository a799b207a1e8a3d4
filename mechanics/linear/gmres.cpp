#include "mechanics/linear/gmres.h"

#include "geometry/base/pieces.h"
#include "mechanics/linear/linear_solver.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::mechanics {

namespace {

using Column = Eigen::Map<const Eigen::VectorXd>;

Column column(std::span<const double> a) { return {a.data(), static_cast<Eigen::Index>(a.size())}; }

constexpr std::size_t numbers_at_once = 1 << 14; ///< numbers of a vector that a thread takes

/// Sums as many products at a time as the processor's vectors hold.
double dot(std::span<const double> a, std::span<const double> b) {
  return sum_of_pieces(a.size(), numbers_at_once, [&](std::size_t begin, std::size_t end) {
    return column(a.subspan(begin, end - begin)).dot(column(b.subspan(begin, end - begin)));
  });
}

/// Calls `change(i)` for all numbers of a vector.
template <class Change> void for_all(std::size_t n, const Change& change) {
  for_pieces(n, numbers_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      change(i);
  });
}

/// y += s x.
void add(double s, std::span<const double> x, std::span<double> y) {
  for_all(y.size(), [&](std::size_t i) { y[i] += s * x[i]; });
}

void multiply(std::span<const double> a, std::span<const double> b, std::vector<double>& product) {
  product.resize(a.size());
  for_all(product.size(), [&](std::size_t i) { product[i] = a[i] * b[i]; });
}

void divide(std::span<const double> a, std::span<const double> b, std::vector<double>& quotient) {
  quotient.resize(a.size());
  for_all(quotient.size(), [&](std::size_t i) { quotient[i] = a[i] / b[i]; });
}

void divide(std::vector<double>& values, double by) {
  for_all(values.size(), [&](std::size_t i) { values[i] /= by; });
}

/// Whether a residual that has come down to `residual` in k steps will not reach the tolerance.
bool too_slow(double residual, double tolerance, int k, const Patience& patience) {
  return k >= patience.first_look &&
         k * std::log(tolerance) < patience.gain * patience.most * std::log(residual);
}

} // namespace

/// Orthogonalizes the newest basis vector against the ones before; its length before normalizing.
double Gmres::extend(int k) {
  Vector& w = basis_[idx(k) + 1];
  for (int i = 0; i <= k; ++i) {
    columns_[idx(k)][idx(i)] = dot(w, basis_[idx(i)]);
    add(-columns_[idx(k)][idx(i)], basis_[idx(i)], w);
  }
  return std::sqrt(dot(w, w));
}

/// Turns column k into the triangle with Givens rotations; the residual left, absolute.
double Gmres::reduce(int k) {
  Vector& column = columns_[idx(k)];
  for (std::size_t i = 0; i < idx(k); ++i) {
    const double upper = column[i];
    column[i] = cosines_[i] * upper + sines_[i] * column[i + 1];
    column[i + 1] = -sines_[i] * upper + cosines_[i] * column[i + 1];
  }
  const std::size_t i = idx(k);
  const double length = std::hypot(column[i], column[i + 1]);
  cosines_[i] = length > 0.0 ? column[i] / length : 1.0;
  sines_[i] = length > 0.0 ? column[i + 1] / length : 0.0;
  column[i] = length;
  projected_[i + 1] = -sines_[i] * projected_[i];
  projected_[i] *= cosines_[i];
  return std::abs(projected_[i + 1]);
}

/// Sums up the directions of k columns with the weights of the least-squares solution.
void Gmres::combine(int k, std::span<double> x) const {
  Vector y(idx(k));
  for (int i = k - 1; i >= 0; --i) {
    double rest = projected_[idx(i)];
    for (int j = i + 1; j < k; ++j)
      rest -= columns_[idx(j)][idx(i)] * y[idx(j)];
    y[idx(i)] = rest / columns_[idx(i)][idx(i)];
  }
  std::fill(x.begin(), x.end(), 0.0);
  for (int i = 0; i < k; ++i)
    add(y[idx(i)], directions_[idx(i)], x);
}

GmresReport Gmres::solve(const SparseMatrix& matrix,
                         Factorization& preconditioner,
                         std::span<const double> weights,
                         std::span<const double> rhs,
                         std::span<double> x,
                         double tolerance,
                         const Patience& patience,
                         std::span<const std::vector<double>> known) {
  const int most = patience.most;
  const std::size_t n = rhs.size();
  basis_.resize(idx(most) + 1);
  multiply(weights, rhs, basis_[0]);
  const double scale = std::sqrt(dot(basis_[0], basis_[0]));
  if (!(scale > 0.0) || !std::isfinite(scale))
    return {};
  directions_.resize(idx(most));
  columns_.resize(idx(most));
  cosines_.resize(idx(most));
  sines_.resize(idx(most));
  projected_.assign(idx(most) + 1, 0.0);
  projected_[0] = scale;
  divide(basis_[0], scale);
  GmresReport report;
  for (int k = 0; k < most; ++k) {
    if (idx(k) < known.size()) {
      directions_[idx(k)] = known[idx(k)];
    } else {
      divide(basis_[idx(k)], weights, directions_[idx(k)]);
      preconditioner.solve(directions_[idx(k)]);
      ++report.solves;
    }
    basis_[idx(k) + 1].resize(n);
    matrix.multiply(directions_[idx(k)], basis_[idx(k) + 1]);
    multiply(weights, basis_[idx(k) + 1], basis_[idx(k) + 1]);
    columns_[idx(k)].assign(idx(k) + 2, 0.0);
    const double length = extend(k);
    if (!std::isfinite(length))
      return report;
    columns_[idx(k)][idx(k) + 1] = length;
    report.iterations = k + 1;
    report.residual = reduce(k) / scale;
    report.converged = report.residual <= tolerance;
    if (report.converged || too_slow(report.residual, tolerance, k + 1, patience))
      break;
    divide(basis_[idx(k) + 1], length);
  }
  if (report.converged)
    combine(report.iterations, x);
  return report;
}

} // namespace billet::mechanics
