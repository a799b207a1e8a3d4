#include "mechanics/transfer/local_fit.h"

#include "mechanics/numerics/spectral.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace billet::mechanics {

namespace {

/// Points whose distance sets the radius, and the radius over it.
constexpr std::size_t core(int dim) { return dim == 2 ? 9 : 18; }
constexpr double reach = 1.7;

/// Square of the distance, over that of the radius, within which points weigh alike.
constexpr double closeness = 1e-2;

/// Of a symmetric tensor in space.
constexpr std::size_t max_components = 6;

/// A polynomial term is given up when the terms before it explain all but this share of it.
constexpr double independent = 0.03;

/// Falls from 1 at `from` to 0 at `to`.
double falling(double x, double from, double to) {
  return std::clamp((to - x) / (to - from), 0.0, 1.0);
}

} // namespace

bool LocalFit::measure(const Vec3& place,
                       std::span<const Index> candidates,
                       std::span<const Vec3> positions) {
  Vec3 mean = Vec3::Zero();
  for (const Index p : candidates)
    mean += positions[idx(p)];
  mean /= static_cast<double>(candidates.size());
  Mat3 scatter = Mat3::Zero();
  for (const Index p : candidates) {
    const Vec3 d = positions[idx(p)] - mean;
    scatter += d * d.transpose();
  }
  const Spectral axes = dim_ == 2 ? spectral_plane(scatter) : spectral(scatter);
  double shortest = axes.values[0]; // squares
  double longest = axes.values[0];
  for (int a = 1; a < dim_; ++a) {
    shortest = std::min(shortest, axes.values[a]);
    longest = std::max(longest, axes.values[a]);
  }
  constexpr double flat = 1e-12;
  const bool spread = shortest > flat * longest;
  Vec3 scale = Vec3::Ones();
  for (int a = 0; a < (spread ? dim_ : 0); ++a)
    scale[a] = std::sqrt(static_cast<double>(candidates.size()) / axes.values[a]);
  near_.clear();
  for (const Index p : candidates) {
    const Vec3 offset = scale.cwiseProduct(axes.vectors.transpose() * (positions[idx(p)] - place));
    near_.push_back({offset.squaredNorm(), p, offset});
  }
  return spread;
}

void LocalFit::set(const Vec3& place,
                   std::span<const Index> candidates,
                   std::span<const Vec3> positions) {
  spread_ = measure(place, candidates, positions);
  const auto nearer = [](const Near& a, const Near& b) {
    return std::tie(a.distance2, a.point) < std::tie(b.distance2, b.point);
  };
  const std::size_t n_core = std::min(core(dim_), near_.size());
  std::nth_element(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(n_core - 1),
                   near_.end(), nearer);
  const double core2 = near_[n_core - 1].distance2;
  const double radius2 = reach * reach * core2;
  // Points as far as the last one of the core belong to it too, wherever rounding puts them.
  constexpr double tie = 1.0 + 1e-9;
  const auto within = std::partition(near_.begin(), near_.end(),
                                     [&](const Near& n) { return n.distance2 < radius2; });
  near_.erase(within, near_.end());
  const auto inner = std::partition(near_.begin(), near_.end(),
                                    [&](const Near& n) { return n.distance2 <= core2 * tie; });
  n_inner_ = static_cast<std::size_t>(inner - near_.begin());
  if (near_.empty())
    near_.push_back({0.0, candidates.front(), Vec3::Zero()});
  std::iter_swap(near_.begin(), std::min_element(near_.begin(), near_.end(), nearer));
  constexpr double same_place = 1e-10; // of the radius
  coincides_ = near_.front().distance2 <= same_place * same_place * radius2;
  radius_ = std::sqrt(radius2);
  n_terms_ = 1;
}

void LocalFit::weigh() {
  if (coincides_ || !spread_)
    return;
  root_.clear();
  for (Near& n : near_) {
    n.offset /= radius_;
    const double s2 = n.offset.squaredNorm();
    // (1 - s^2)^2 / (s^2 + closeness): falls smoothly to zero, and a point close by all but
    // decides.
    root_.push_back((1.0 - s2) / std::sqrt(s2 + closeness));
  }
  orthogonalise();
  influence_.assign(near_.size(), 0.0);
  for (std::size_t t = 0; t < n_terms_; ++t)
    for (std::size_t i = 0; i < near_.size(); ++i)
      influence_[i] += root_[i] * at_place_[t] * basis_[t * near_.size() + i];
}

void LocalFit::write_terms() {
  const std::size_t n = near_.size();
  basis_.resize(max_terms * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& x = near_[i].offset;
    double* term = &basis_[i];
    const auto write = [&](double value) {
      *term = root_[i] * value;
      term += n;
    };
    write(1.0);
    for (int a = 0; a < dim_; ++a)
      write(x[a]);
    for (int a = 0; a < dim_; ++a)
      for (int b = a; b < dim_; ++b)
        write(x[a] * x[b]);
  }
}

void LocalFit::orthogonalise() {
  write_terms();
  using Column = Eigen::Map<Eigen::VectorXd>;
  const std::size_t n = near_.size();
  const auto size = static_cast<Eigen::Index>(n);
  const std::size_t linear = linear_terms();
  const std::size_t all = linear * (linear + 1) / 2;
  std::size_t done = 0;
  for (std::size_t next = 0; next < all && done < n; ++next) {
    // Gram and Schmidt's method, modified; the values at the place go along.
    Column q(&basis_[done * n], size);
    q = Column(&basis_[next * n], size);
    double value = next == 0 ? 1.0 : 0.0;
    const double before = q.squaredNorm();
    for (std::size_t t = 0; t < done; ++t) {
      const Column p(&basis_[t * n], size);
      const double product = p.dot(q);
      q -= product * p;
      value -= product * at_place_[t];
    }
    const double after = q.squaredNorm();
    if (after > independent * independent * before) {
      const double scale = 1.0 / std::sqrt(after);
      q *= scale;
      at_place_[done++] = scale * value;
    } else if (next < linear)
      return;
  }
  n_terms_ = done >= linear ? done : 1;
}

bool LocalFit::evaluate(std::span<const double> values,
                        std::size_t stride,
                        std::span<double> out) const {
  assert(out.size() <= max_components);
  const double* own = &values[idx(nearest()) * stride];
  std::copy(own, own + out.size(), out.begin());
  if (n_terms_ == 1)
    return false;
  // What the fit adds to the value of the nearest point, and its size.
  std::array<double, max_components> wanted{};
  double length = 0.0;
  for (std::size_t c = 0; c < out.size(); ++c) {
    for (std::size_t i = 0; i < near_.size(); ++i)
      wanted[c] += influence_[i] * (values[idx(near_[i].point) * stride + c] - own[c]);
    length += wanted[c] * wanted[c];
  }
  length = std::sqrt(length);
  if (length == 0.0)
    return false;
  along_.assign(near_.size(), 0.0);
  for (std::size_t i = 0; i < near_.size(); ++i)
    for (std::size_t c = 0; c < out.size(); ++c)
      along_[i] += (values[idx(near_[i].point) * stride + c] - own[c]) * (wanted[c] / length);
  bool limited = false;
  constexpr double digits = 1e-12; // of the values: differences as small are rounding
  const double rounding =
      digits *
      (Eigen::Map<const Eigen::VectorXd>(own, static_cast<Index>(out.size())).norm() + length);
  const double share = bound(along_, length, rounding, limited) / length;
  for (std::size_t c = 0; c < out.size(); ++c)
    out[c] += share * wanted[c];
  return limited;
}

double LocalFit::unexplained(std::span<const double> values, std::size_t terms) const {
  const std::size_t n = near_.size();
  std::array<double, max_terms> coefficient{};
  for (std::size_t t = 0; t < terms; ++t)
    for (std::size_t i = 0; i < n; ++i)
      coefficient[t] += basis_[t * n + i] * root_[i] * values[i];
  double weights = 0.0;
  double mean = 0.0;
  double squares = 0.0;
  double misfits = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double misfit = root_[i] * values[i];
    for (std::size_t t = 0; t < terms; ++t)
      misfit -= coefficient[t] * basis_[t * n + i];
    // Here no point decides however close it is: it would always seem explained.
    const double share = near_[i].offset.squaredNorm() + closeness;
    const double weight = root_[i] * root_[i] * share;
    weights += weight;
    mean += weight * values[i];
    squares += weight * values[i] * values[i];
    misfits += misfit * misfit * share;
  }
  const double variance = squares - mean * mean / weights;
  return variance > 0.0 ? std::sqrt(misfits / variance) : 0.0;
}

double LocalFit::bound(std::span<const double> along,
                       double wanted,
                       double rounding,
                       bool& limited) const {
  const auto inner = along.first(n_inner_);
  const double highest = *std::max_element(inner.begin(), inner.end());
  if (wanted <= highest)
    return wanted;
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  const double range = *high - *low;
  const double line = falling(unexplained(along, linear_terms()), 0.2, 0.35);
  const double curve = falling(unexplained(along, n_terms_), 0.05, 0.12);
  constexpr double peak = 0.01; // of the range: a smooth top or bottom between points
  const double freedom = curve * std::max(line, peak);
  const double allowed = highest + freedom * range;
  if (wanted <= allowed)
    return wanted;
  limited = wanted - allowed > rounding;
  return allowed;
}

} // namespace billet::mechanics
