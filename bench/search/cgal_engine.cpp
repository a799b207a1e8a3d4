#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <vector>

#include "bench/search/engines.h"

namespace billet::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

class CgalEngine final : public Engine {
public:
  explicit CgalEngine(const geometry::TriangleMesh& mesh) {
    const auto corner = [&](std::int32_t i) {
      return to_cgal(mesh.points[static_cast<std::size_t>(i)]);
    };
    for (const auto& t : mesh.triangles)
      triangles_.emplace_back(corner(t[0]), corner(t[1]), corner(t[2]));
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    tree_.accelerate_distance_queries();
  }
  void distances(std::span<const Vec3> points, std::span<double> out) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Kernel::Point_3 x = to_cgal(points[i]);
      out[i] = std::sqrt(CGAL::squared_distance(x, tree_.closest_point(x)));
    }
  }

private:
  Triangles triangles_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

} // namespace

std::unique_ptr<Engine> make_cgal(const geometry::TriangleMesh& mesh) {
  return std::make_unique<CgalEngine>(mesh);
}

} // namespace billet::bench
