#include "geometry/corner_normals.h"

#include "geometry/edge_table.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace billet::geometry {

namespace {

// A flat part this many times wider than another facet of the fan is a plane that the curved part
// runs into, not a strip of it: it keeps its normal, and the fan takes it.
constexpr double wider = 4.0;

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

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
  FanBuilder(const TriangleMesh& mesh, double feature_angle)
      : mesh_(mesh), feature_angle_(feature_angle), fans_(3 * mesh.triangles.size()),
        parts_(mesh.triangles.size()), count_(mesh.triangles.size(), 0) {
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
  [[nodiscard]] Vec3 weighted_normal(std::size_t corner) const;

  const TriangleMesh& mesh_;
  double feature_angle_;
  CornerNormals normals_;
  Sets fans_;                       // of corners 3 t + i
  Sets parts_;                      // of coplanar triangles
  std::vector<std::int32_t> count_; // triangles of each part
  std::vector<double> width_;       // of the part of each triangle [mm]
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
  if (turn > feature_angle_) {
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
  std::vector<std::pair<std::size_t, std::size_t>> members; // (fan, corner)
  for (std::size_t c = 0; c < n; ++c)
    members.emplace_back(fans_(c), c);
  std::sort(members.begin(), members.end());
  std::vector<std::size_t> corners;
  std::vector<int> fans_at(mesh_.points.size(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    corners.push_back(members[i].second);
    if (i + 1 < n && members[i + 1].first == members[i].first)
      continue;
    const std::size_t c = corners.front();
    ++fans_at[static_cast<std::size_t>(mesh_.triangles[c / 3][c % 3])];
    finish_fan(corners);
    corners.clear();
  }
  normals_.one_fan.assign(mesh_.points.size(), 1);
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t t = c / 3, i = c % 3;
    const auto v = static_cast<std::size_t>(mesh_.triangles[t][i]);
    const bool rim = normals_.is_border[t][i] != 0 || normals_.is_border[t][(i + 2) % 3] != 0 ||
                     normals_.is_sharp[t][i] != 0 || normals_.is_sharp[t][(i + 2) % 3] != 0;
    if (fans_at[v] > 1 || rim || normals_.is_tip[t][i] != 0)
      normals_.one_fan[v] = 0;
  }
}

// Max's weight of the corner, sin / (product of the sides), times the normal: exact on a sphere.
Vec3 FanBuilder::weighted_normal(std::size_t corner) const {
  const std::size_t t = corner / 3, i = corner % 3;
  const Vec3 a = point(t, i + 1) - point(t, i), b = point(t, i + 2) - point(t, i);
  return a.normalized().cross(b.normalized()) / (a.norm() * b.norm());
}

void FanBuilder::finish_fan(std::span<const std::size_t> corners) {
  double widest = 0.0;
  for (const std::size_t c : corners)
    if (count_[parts_(c / 3)] > 1)
      widest = std::max(widest, width_[c / 3]);
  Vec3 sum = Vec3::Zero();
  for (const std::size_t c : corners)
    if (wider * width_[c / 3] >= widest)
      sum += weighted_normal(c);
  const Vec3 normal = sum.stableNormalized();
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
  return FanBuilder(mesh, feature_angle).build();
}

} // namespace billet::geometry
