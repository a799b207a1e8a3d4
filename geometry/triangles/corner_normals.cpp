#include "geometry/triangles/corner_normals.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/edge_table.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace billet::geometry {

namespace {

// A flat part this many times wider than another facet of the fan is a plane that the curved part
// runs into, not a strip of it: it keeps its normal, and the fan takes it.
constexpr double wider = 4.0;

/// Disjoint sets of numbers; the smallest member stands for its set.
class Sets {
public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::size_t operator()(std::size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) {
    const std::size_t a = (*this)(i), b = (*this)(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::size_t> parent_;
};

class FanBuilder {
public:
  FanBuilder(const TriangleMesh& mesh,
             double feature_angle,
             std::span<const std::array<std::int32_t, 2>> creases)
      : mesh_(mesh), feature_angle_(feature_angle), creases_(creases),
        fans_(3 * mesh.triangles.size()), parts_(mesh.triangles.size()),
        count_(mesh.triangles.size(), 0) {
    const std::size_t n = mesh.triangles.size();
    normals_.corners.resize(n);
    normals_.is_tip.assign(n, {0, 0, 0});
    normals_.is_sharp.assign(n, {0, 0, 0});
    normals_.is_border.assign(n, {0, 0, 0});
    normals_.neighbours.assign(n, {-1, -1, -1});
    for (std::size_t t = 0; t < n; ++t)
      normals_.faces.push_back(
          (point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 1)).stableNormalized());
  }

  [[nodiscard]] CornerNormals build() && {
    for_each_edge(edge_uses(mesh_), [&](std::span<const EdgeUse> uses) { join(uses); });
    measure_parts();
    collect_fans();
    for (const std::vector<std::size_t>& fan : members_)
      finish_fan(fan);
    continue_over_rims();
    mark_inner_vertices();
    return std::move(normals_);
  }

private:
  [[nodiscard]] const Vec3& point(std::size_t t, std::size_t i) const {
    return mesh_.points[static_cast<std::size_t>(mesh_.triangles[t][i % 3])];
  }
  void join(std::span<const EdgeUse> uses);
  void measure_parts();
  void collect_fans();
  void finish_fan(std::span<const std::size_t> corners);
  void continue_over_rims();
  [[nodiscard]] Vec3 mirrored_normal(std::size_t corner) const;
  void mark_inner_vertices();
  [[nodiscard]] Vec3 weighted_normal(std::size_t corner) const;
  [[nodiscard]] Vec3 fitted_normal(std::span<const std::size_t> corners, const Vec3& normal) const;

  const TriangleMesh& mesh_;
  double feature_angle_;
  std::span<const std::array<std::int32_t, 2>> creases_;
  CornerNormals normals_;
  std::vector<std::vector<std::size_t>> members_; // corners of each fan
  Sets fans_;                                     // of corners 3 t + i
  Sets parts_;                                    // of coplanar triangles
  std::vector<std::int32_t> count_;               // triangles of each part
  std::vector<double> width_;                     // of the part of each triangle [mm]
};

void FanBuilder::join(std::span<const EdgeUse> uses) {
  const auto t = static_cast<std::size_t>(uses[0].triangle);
  const auto s = static_cast<std::size_t>(uses[0].side);
  if (uses.size() == 1) {
    normals_.is_border[t][s] = 1;
    return;
  }
  const auto u = static_cast<std::size_t>(uses[1].triangle);
  const auto r = static_cast<std::size_t>(uses[1].side);
  normals_.neighbours[t][s] = uses[1].triangle;
  normals_.neighbours[u][r] = uses[0].triangle;
  const double turn = angle_between(normals_.faces[t], normals_.faces[u]);
  const std::array ends{uses[0].low, uses[0].high};
  if (turn > feature_angle_ || std::binary_search(creases_.begin(), creases_.end(), ends)) {
    normals_.is_sharp[t][s] = normals_.is_sharp[u][r] = 1;
    return;
  }
  // The triangles run through the edge in opposite directions.
  fans_.unite(3 * t + s, 3 * u + (r + 1) % 3);
  fans_.unite(3 * t + (s + 1) % 3, 3 * u + r);
  if (turn < same_direction)
    parts_.unite(t, u);
}

// Width 2 A / P of each part: the short side of a long strip, half the side of a square.
void FanBuilder::measure_parts() {
  const std::size_t n = mesh_.triangles.size();
  std::vector<double> area2(n, 0.0), perimeter(n, 0.0);
  for (std::size_t t = 0; t < n; ++t) {
    const std::size_t part = parts_(t);
    ++count_[part];
    area2[part] += (point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 0)).norm();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t beyond = normals_.neighbours[t][i];
      if (beyond < 0 || parts_(static_cast<std::size_t>(beyond)) != part)
        perimeter[part] += (point(t, i + 1) - point(t, i)).norm();
    }
  }
  width_.resize(n);
  for (std::size_t t = 0; t < n; ++t)
    width_[t] = area2[parts_(t)] / perimeter[parts_(t)];
}

void FanBuilder::collect_fans() {
  const std::size_t n = 3 * mesh_.triangles.size();
  std::vector<std::vector<std::size_t>> by_root(n);
  for (std::size_t c = 0; c < n; ++c)
    by_root[fans_(c)].push_back(c);
  for (std::vector<std::size_t>& fan : by_root)
    if (!fan.empty())
      members_.push_back(std::move(fan));
}

// A vertex inside one fan: no sharp edge, no border, no tip.
void FanBuilder::mark_inner_vertices() {
  std::vector<int> fans_at(mesh_.points.size(), 0);
  const auto vertex = [&](std::size_t c) {
    return static_cast<std::size_t>(mesh_.triangles[c / 3][c % 3]);
  };
  for (const std::vector<std::size_t>& fan : members_)
    ++fans_at[vertex(fan.front())];
  normals_.one_fan.assign(mesh_.points.size(), 1);
  for (std::size_t c = 0; c < 3 * mesh_.triangles.size(); ++c) {
    const std::size_t t = c / 3, i = c % 3, before = (i + 2) % 3;
    const bool rim = normals_.is_border[t][i] != 0 || normals_.is_border[t][before] != 0 ||
                     normals_.is_sharp[t][i] != 0 || normals_.is_sharp[t][before] != 0;
    if (fans_at[vertex(c)] > 1 || rim || normals_.is_tip[t][i] != 0)
      normals_.one_fan[vertex(c)] = 0;
  }
}

// What the normal at a corner is if the facet is the chord of an arc that began across it.
Vec3 FanBuilder::mirrored_normal(std::size_t corner) const {
  const std::size_t t = corner / 3, i = corner % 3;
  const Vec3& face = normals_.faces[t];
  Vec3 sum = Vec3::Zero();
  for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
    const Vec3& other = normals_.corners[t][j];
    const Vec3 turn = other - other.dot(face) * face;
    if (turn.norm() < same_direction || normals_.is_tip[t][j] != 0)
      continue;
    const Vec3 d = turn.normalized();
    double extent = 0.0; // of the triangle along the turn
    for (std::size_t k = 0; k < 3; ++k)
      extent = std::max(extent, std::abs((point(t, k + 1) - point(t, k)).dot(d)));
    if (std::abs((point(t, j) - point(t, i)).dot(d)) > 0.5 * extent)
      sum += other - 2.0 * turn;
  }
  return sum;
}

// A fan in one plane at a rim sees its facet only, while the shape beneath turns on to the rim.
void FanBuilder::continue_over_rims() {
  std::vector<std::pair<std::size_t, Vec3>> found; // (fan, normal)
  for (std::size_t f = 0; f < members_.size(); ++f) {
    Vec3 sum = Vec3::Zero();
    bool plane = true;
    for (const std::size_t c : members_[f]) {
      const Vec3& normal = normals_.corners[c / 3][c % 3];
      plane = plane && normal == normals_.faces[c / 3] && normals_.is_tip[c / 3][c % 3] == 0;
      sum += mirrored_normal(c);
    }
    if (plane && sum.norm() > 0.5)
      found.emplace_back(f, sum.normalized());
  }
  for (const auto& [fan, normal] : found)
    for (const std::size_t c : members_[fan])
      normals_.corners[c / 3][c % 3] = normal;
}

// Max's weight of the corner, sin / (product of the sides), times the normal: exact on a sphere.
Vec3 FanBuilder::weighted_normal(std::size_t corner) const {
  const std::size_t t = corner / 3, i = corner % 3;
  const Vec3 a = point(t, i + 1) - point(t, i), b = point(t, i + 2) - point(t, i);
  return a.normalized().cross(b.normalized()) / (a.norm() * b.norm());
}

// Normal of the quadratic through the vertex that comes closest to its neighbours; the one given
// if there are too few for that, or if they lie badly. (G.16)
Vec3 FanBuilder::fitted_normal(std::span<const std::size_t> corners, const Vec3& normal) const {
  constexpr Eigen::Index unknowns = 5;
  const auto n = static_cast<Eigen::Index>(corners.size());
  const Vec3& at = point(corners.front() / 3, corners.front() % 3);
  Eigen::Matrix<double, Eigen::Dynamic, 3> way(n, 3);
  std::vector<std::int32_t> next, previous;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t t = corners[static_cast<std::size_t>(k)] / 3;
    const std::size_t i = corners[static_cast<std::size_t>(k)] % 3;
    way.row(k) = (point(t, i + 1) - at).transpose();
    next.push_back(mesh_.triangles[t][(i + 1) % 3]);
    previous.push_back(mesh_.triangles[t][(i + 2) % 3]);
  }
  std::sort(next.begin(), next.end());
  std::sort(previous.begin(), previous.end());
  if (n < unknowns || next != previous) // an open fan
    return normal;
  const Vec3 e = normal.unitOrthogonal(), f = normal.cross(e);
  // Principal axes of the neighbours: long thin triangles become compact.
  const Eigen::MatrixXd flat = way * (Eigen::Matrix<double, 3, 2>() << e, f).finished();
  const Mat2 spread = flat.transpose() * flat / static_cast<double>(n);
  const Mat2 root = spread.llt().matrixL();
  const Eigen::MatrixXd xy =
      root.triangularView<Eigen::Lower>().solve(flat.transpose()).transpose();
  Eigen::MatrixXd terms(n, unknowns);
  Eigen::VectorXd height = way * normal;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = xy(k, 0), y = xy(k, 1), weight = 1.0 / (x * x + y * y);
    terms.row(k) << weight * x, weight * y, weight * x * x, weight * x * y, weight * y * y;
    height[k] *= weight;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(terms);
  constexpr double least_pivot = 0.05; // of the largest: the neighbours determine the quadratic
  if (!(std::abs(fit.matrixR()(unknowns - 1, unknowns - 1)) > least_pivot * fit.maxPivot()))
    return normal;
  const Eigen::VectorXd solution = fit.solve(height);
  const Eigen::Vector2d slope =
      root.transpose().triangularView<Eigen::Upper>().solve(Eigen::Vector2d(solution.head<2>()));
  return Vec3(normal - slope[0] * e - slope[1] * f).normalized();
}

void FanBuilder::finish_fan(std::span<const std::size_t> corners) {
  double widest = 0.0;
  for (const std::size_t c : corners)
    if (count_[parts_(c / 3)] > 1)
      widest = std::max(widest, width_[c / 3]);
  Vec3 sum = Vec3::Zero();
  bool all = true;
  for (const std::size_t c : corners) {
    const bool counts = wider * width_[c / 3] >= widest;
    all = all && counts;
    if (counts)
      sum += weighted_normal(c);
  }
  Vec3 normal = sum.stableNormalized();
  double turn = 0.0; // of the facets about it
  for (const std::size_t c : corners)
    turn = std::max(turn, angle_between(normal, normals_.faces[c / 3]));
  const Vec3 fitted = all && turn > same_direction ? fitted_normal(corners, normal) : normal;
  if (angle_between(normal, fitted) < turn)
    normal = fitted;
  const double largest = std::max(feature_angle_, same_direction);
  bool tip = false;
  for (const std::size_t c : corners)
    tip = tip || !(angle_between(normal, normals_.faces[c / 3]) <= largest);
  for (const std::size_t c : corners) {
    const Vec3& face = normals_.faces[c / 3];
    const bool flat = angle_between(normal, face) < same_direction;
    normals_.corners[c / 3][c % 3] = tip || flat ? face : normal;
    normals_.is_tip[c / 3][c % 3] = tip ? 1 : 0;
  }
}

} // namespace

CornerNormals corner_normals(const TriangleMesh& mesh, double feature_angle) {
  return corner_normals(mesh, feature_angle, {});
}

CornerNormals corner_normals(const TriangleMesh& mesh,
                             double feature_angle,
                             std::span<const std::array<std::int32_t, 2>> creases) {
  return FanBuilder(mesh, feature_angle, creases).build();
}

} // namespace billet::geometry
