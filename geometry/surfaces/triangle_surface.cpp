#include "geometry/surfaces/triangle_surface.h"

#include "geometry/base/error.h"
#include "geometry/collision/narrow_parts.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/box_tree.h"
#include "geometry/triangles/triangle_features.h"
#include "geometry/triangles/triangle_surroundings.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

Box box_of(const TriangleMesh& mesh, std::size_t triangle) {
  Box box;
  for (const std::int32_t corner : mesh.triangles[triangle])
    box.add(mesh.points[static_cast<std::size_t>(corner)]);
  return box;
}

BoxTree tree_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    boxes.push_back(box_of(mesh, t));
  return {boxes, [&](std::int32_t t) {
            const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)];
            const auto point = [&](std::int32_t i) {
              return mesh.points[static_cast<std::size_t>(i)];
            };
            return SlabFacet{{point(a), point(b), point(c)}};
          }};
}

class TriangleSurface final : public RigidSurface {
public:
  TriangleSurface(const TriangleMesh& mesh, double worst_aspect)
      : features_(mesh), tree_(tree_of(mesh)),
        height_rounding_((1.0 + worst_aspect) * features_.rounding()),
        surroundings_(mesh.triangles.size()) {
    for (std::atomic<Surroundings>& around : surroundings_)
      around.store(never_asked, std::memory_order_relaxed);
  }

  [[nodiscard]] Box bounds() const override { return features_.bounds(); }
  [[nodiscard]] DisplayMesh display(const Box& /*window*/, bool /*planar*/) const override {
    return {features_.mesh().points, {}, features_.mesh().triangles};
  }
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override {
    return geometry::narrow_parts(features_.mesh(), search);
  }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override;
  [[nodiscard]] Projection project_one(const Vec3& x, double reach, std::int32_t hint) const;

  // Never less than the distance to the triangle's box, so that leaving out boxes that are farther
  // than the best triangle cannot change the result, whatever the rounding. (G.12)
  [[nodiscard]] ClosestFeature closest(std::int32_t triangle, const Vec3& x) const {
    ClosestFeature closest = features_.closest(triangle, x);
    const Box box = box_of(features_.mesh(), static_cast<std::size_t>(triangle));
    closest.distance2 = std::max(closest.distance2, distance2(box, x));
    return closest;
  }

  [[nodiscard]] Projection
  projection(std::int32_t triangle, const ClosestFeature& closest, const Vec3& x) const;
  [[nodiscard]] std::int32_t triangle_below(std::int32_t hint, const Vec3& x) const;
  [[nodiscard]] bool is_certain(const ClosestFeature& closest, const Vec3& x) const;
  [[nodiscard]] Surroundings surroundings(std::int32_t triangle) const;

  static constexpr Surroundings never_asked{-2.0F, 0.0F}, asked_once{-1.0F, 0.0F};

  TriangleFeatures features_;
  BoxTree tree_;
  double height_rounding_; // of distances from planes [mm]
  // Found when asked for the second time: most triangles of a die never meet the workpiece, and on
  // a fine one many are met once. Whichever thread comes first, the values are the same.
  mutable std::vector<std::atomic<Surroundings>> surroundings_;
};

void TriangleSurface::do_project(std::span<const Vec3> points,
                                 double reach,
                                 std::span<Projection> out) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    out[i] = project_one(points[i], reach, out[i].patch);
}

// Smallest (distance, triangle number). (G.12)
Projection TriangleSurface::project_one(const Vec3& x, double reach, std::int32_t hint) const {
  double limit2 = reach * reach;
  if (hint >= 0 && static_cast<std::size_t>(hint) < features_.mesh().triangles.size()) {
    const std::int32_t below = triangle_below(hint, x);
    const ClosestFeature there = closest(below, x);
    if (there.distance2 <= limit2 && is_certain(there, x))
      return projection(below, there, x);
    limit2 = std::min(limit2, there.distance2);
  }
  std::int32_t nearest = -1;
  ClosestFeature best{};
  double limit = std::sqrt(limit2);
  tree_.walk(x, limit2, [&](std::int32_t triangle) {
    // Far above a hollow thousands of triangles have boxes that are near enough.
    if (features_.height(triangle, x) > limit + height_rounding_)
      return limit2;
    const ClosestFeature candidate = closest(triangle, x);
    if (candidate.distance2 < limit2 ||
        (candidate.distance2 == limit2 && (nearest < 0 || triangle < nearest))) {
      best = candidate;
      nearest = triangle;
      limit2 = candidate.distance2;
      limit = std::sqrt(limit2);
    }
    return limit2;
  });
  return nearest < 0 ? Projection{} : projection(nearest, best, x);
}

Projection TriangleSurface::projection(std::int32_t triangle,
                                       const ClosestFeature& closest,
                                       const Vec3& x) const {
  Projection p = features_.project(closest, x);
  if (p.found())
    p.patch = triangle;
  return p;
}

// From the hint across the sides that x lies beyond; ends over an edge or a vertex, too.
std::int32_t TriangleSurface::triangle_below(std::int32_t hint, const Vec3& x) const {
  constexpr int most_steps = 8; // a point that has moved farther is better searched for
  std::int32_t from = -1, at = hint;
  for (int step = 0; step < most_steps; ++step) {
    const Inside inside = features_.inside(at, x);
    const std::int32_t next = features_.neighbour(at, inside.side);
    if (inside.distance >= 0.0 || next < 0 || next == from)
      break;
    from = std::exchange(at, next);
  }
  return at;
}

// Whether the search would find this face, by far more than rounding. (G.34)
bool TriangleSurface::is_certain(const ClosestFeature& closest, const Vec3& x) const {
  constexpr double clearly = 1e3; // times the rounding of coordinates
  if (closest.feature != Feature::face)
    return false;
  return is_nearest(surroundings(closest.number), std::sqrt(closest.distance2),
                    features_.inside(closest.number, x).distance, clearly * features_.rounding());
}

Surroundings TriangleSurface::surroundings(std::int32_t triangle) const {
  std::atomic<Surroundings>& known = surroundings_[static_cast<std::size_t>(triangle)];
  Surroundings around = known.load(std::memory_order_relaxed);
  if (around.slope >= 0.0F)
    return around;
  if (around.slope == never_asked.slope) {
    known.store(asked_once, std::memory_order_relaxed);
    return {std::numeric_limits<float>::infinity(), 0.0F};
  }
  SurroundingsOf gathered(features_.mesh(), triangle);
  const double limit2 = gathered.radius() * gathered.radius();
  tree_.walk(gathered.middle(), limit2, [&](std::int32_t other) {
    gathered.add(other);
    return limit2;
  });
  around = gathered.result();
  known.store(around, std::memory_order_relaxed);
  return around;
}

} // namespace

SurfacePtr make_triangle_surface(const TriangleMesh& mesh) {
  const MeshHealth state = health(mesh);
  std::vector<Complaint> found = complaints(state, "");
  if (!found.empty())
    throw Error(Fault::geometry, std::move(found));
  return std::make_unique<const TriangleSurface>(mesh, state.worst_aspect);
}

} // namespace billet::geometry
