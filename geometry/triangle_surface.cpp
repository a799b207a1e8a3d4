#include "geometry/triangle_surface.h"

#include "geometry/base/error.h"
#include "geometry/mesh_health.h"
#include "geometry/triangle_features.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <utility>

namespace billet::geometry {

namespace {

// CGAL only sorts boxes here: every distance that decides is ours, so its kernel need not be exact.
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// Every operation is monotone, also in rounding: a box is never farther than one it contains. Not
// inlined, so that the compiler contracts it to fused multiply-adds in one way only.
[[gnu::noinline]] double box_distance2(const CGAL::Bbox_3& box, const Vec3& x) {
  const auto outside = [](double low, double high, double value) {
    return std::max({low - value, value - high, 0.0});
  };
  const double dx = outside(box.xmin(), box.xmax(), x.x());
  const double dy = outside(box.ymin(), box.ymax(), x.y());
  const double dz = outside(box.zmin(), box.zmax(), x.z());
  return dx * dx + dy * dy + dz * dz;
}

class TriangleSurface final : public RigidSurface {
public:
  explicit TriangleSurface(const TriangleMesh& mesh);

  [[nodiscard]] Box bounds() const override { return features_.bounds(); }
  [[nodiscard]] DisplayMesh display(const Box& /*window*/, bool /*planar*/) const override {
    return {features_.mesh().points, {}, features_.mesh().triangles};
  }

  // Never less than the distance to the triangle's box, so that leaving out boxes that are farther
  // than the best triangle cannot change the result, whatever the rounding. (G.12)
  [[nodiscard]] ClosestFeature closest(std::int32_t triangle, const Vec3& x) const {
    ClosestFeature closest = features_.closest(triangle, x);
    const CGAL::Bbox_3 box = triangles_[static_cast<std::size_t>(triangle)].bbox();
    closest.distance2 = std::max(closest.distance2, box_distance2(box, x));
    return closest;
  }
  [[nodiscard]] std::int32_t number(const Primitive& primitive) const {
    return static_cast<std::int32_t>(primitive.id() - triangles_.begin());
  }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override;
  [[nodiscard]] Projection project_one(const Vec3& x, double reach, std::int32_t hint) const;

  TriangleFeatures features_;
  Triangles triangles_; // the tree refers to them
  Tree tree_;
};

// Walks the tree, nearest box first, for the smallest (distance, triangle number).
class NearestTriangle {
public:
  using Priority = double;

  NearestTriangle(const TriangleSurface& surface, const Vec3& x, double limit2)
      : surface_(surface), x_(x), limit2_(limit2) {}

  [[nodiscard]] bool go_further() const { return true; }
  template <class Query> void intersection(const Query& /*query*/, const Primitive& primitive) {
    const std::int32_t number = surface_.number(primitive);
    const ClosestFeature candidate = surface_.closest(number, x_);
    if (candidate.distance2 > limit2_ ||
        (candidate.distance2 == limit2_ && triangle_ >= 0 && number > triangle_))
      return;
    closest_ = candidate;
    triangle_ = number;
    limit2_ = candidate.distance2;
  }
  template <class Query, class Node>
  [[nodiscard]] bool do_intersect(const Query& /*query*/, const Node& node) const {
    return box_distance2(node.bbox(), x_) <= limit2_;
  }
  template <class Query, class Node>
  [[nodiscard]] std::pair<bool, Priority> do_intersect_with_priority(const Query& /*query*/,
                                                                     const Node& node) const {
    const double distance2 = box_distance2(node.bbox(), x_);
    return {distance2 <= limit2_, -distance2};
  }

  /// -1: nothing within the limit.
  [[nodiscard]] std::int32_t triangle() const { return triangle_; }
  [[nodiscard]] const ClosestFeature& closest() const { return closest_; }

private:
  const TriangleSurface& surface_;
  const Vec3& x_;
  double limit2_;
  std::int32_t triangle_ = -1;
  ClosestFeature closest_{};
};

TriangleSurface::TriangleSurface(const TriangleMesh& mesh) : features_(mesh) {
  triangles_.reserve(mesh.triangles.size());
  const auto corner = [&](std::int32_t i) {
    return to_cgal(mesh.points[static_cast<std::size_t>(i)]);
  };
  for (const std::array<std::int32_t, 3>& t : mesh.triangles)
    triangles_.emplace_back(corner(t[0]), corner(t[1]), corner(t[2]));
  // CGAL builds both trees lazily under a lock; here they are ready before the first query.
  tree_.insert(triangles_.begin(), triangles_.end());
  tree_.build();
  tree_.accelerate_distance_queries();
}

void TriangleSurface::do_project(std::span<const Vec3> points,
                                 double reach,
                                 std::span<Projection> out) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    out[i] = project_one(points[i], reach, out[i].patch);
}

Projection TriangleSurface::project_one(const Vec3& x, double reach, std::int32_t hint) const {
  const double reach2 = reach * reach;
  if (box_distance2(tree_.bbox(), x) > reach2)
    return {};
  if (hint < 0 || static_cast<std::size_t>(hint) >= triangles_.size())
    hint = static_cast<std::int32_t>(tree_.best_hint(to_cgal(x)).second - triangles_.cbegin());
  NearestTriangle walk(*this, x, std::min(reach2, closest(hint, x).distance2));
  tree_.traversal_with_priority(x, walk);
  if (walk.triangle() < 0)
    return {};
  Projection p = features_.project(walk.closest(), x);
  if (p.found())
    p.patch = walk.triangle();
  return p;
}

} // namespace

SurfacePtr make_triangle_surface(const TriangleMesh& mesh) {
  std::vector<Complaint> found = complaints(health(mesh), "");
  if (!found.empty())
    throw Error(Fault::geometry, std::move(found));
  return std::make_unique<const TriangleSurface>(mesh);
}

} // namespace billet::geometry
