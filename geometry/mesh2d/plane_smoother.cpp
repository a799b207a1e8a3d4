#include "geometry/mesh2d/plane_smoother.h"

#include "geometry/base/angle.h"
#include "geometry/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace billet::geometry {

namespace {

constexpr int smoothing_sweeps = 10;

/// Moves inner corners one after the other to the mean of their neighbours, where the smallest
/// angle around them grows by it.
class Smoother {
public:
  explicit Smoother(PlaneMesh& mesh) : mesh_(mesh), around_(mesh.points.size()) {
    for (const auto& triangle : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        around_[idx(triangle[i])].push_back({triangle[(i + 1) % 3], triangle[(i + 2) % 3]});
    for (const BoundarySide& side : mesh.boundary)
      around_[idx(side.corners[0])].clear();
  }

  void sweep() {
    for (std::size_t i = 0; i < around_.size(); ++i) {
      if (around_[i].empty())
        continue;
      Vec2 mean = Vec2::Zero();
      for (const auto& [b, c] : around_[i]) // each neighbour twice
        mean += mesh_.points[idx(b)] + mesh_.points[idx(c)];
      mean /= 2.0 * static_cast<double>(around_[i].size());
      if (least_around(i, mean) > least_around(i, mesh_.points[i]))
        mesh_.points[i] = mean;
    }
  }

private:
  [[nodiscard]] double least_around(std::size_t i, const Vec2& place) const {
    double least = std::numbers::pi;
    for (const auto& [b, c] : around_[i])
      least = std::min(least, smallest_angle(place, mesh_.points[idx(b)], mesh_.points[idx(c)]));
    return least;
  }

  PlaneMesh& mesh_;
  std::vector<std::vector<std::array<std::int32_t, 2>>> around_; ///< sides opposite; none: boundary
};

} // namespace

double smallest_angle(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto angle = [](const Vec2& u, const Vec2& v) { return std::atan2(cross(u, v), u.dot(v)); };
  return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

void smooth(PlaneMesh& mesh) {
  Smoother smoother(mesh);
  for (int sweep = 0; sweep < smoothing_sweeps; ++sweep)
    smoother.sweep();
}

} // namespace billet::geometry
