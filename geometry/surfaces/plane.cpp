#include "geometry/surface_check.h"
#include "geometry/surfaces/analytic_surfaces.h"

#include <Eigen/Geometry>

#include <limits>

namespace billet::geometry {

namespace {

class Plane final : public RigidSurface {
public:
  Plane(const Vec3& point, const Vec3& normal)
      : point_(point), normal_(normal.stableNormalized()) {}

  [[nodiscard]] Box bounds() const override {
    Box box;
    box.low.setConstant(-std::numeric_limits<double>::infinity());
    box.high.setConstant(std::numeric_limits<double>::infinity());
    return box;
  }

  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override {
    DisplayMesh mesh;
    if (window.empty())
      return mesh;
    const Vec3 middle = 0.5 * (window.low + window.high);
    const Vec3 foot = middle - (middle - point_).dot(normal_) * normal_;
    if (planar) {
      const Vec3 along = window.size() * Vec3::UnitZ().cross(normal_);
      mesh.points = {foot + along, foot - along}; // the tool on the left, as in a profile
      mesh.lines = {{0, 1}};
      return mesh;
    }
    const Vec3 e1 = window.size() * normal_.unitOrthogonal();
    const Vec3 e2 = normal_.cross(e1);
    mesh.points = {foot - e1 - e2, foot + e1 - e2, foot + e1 + e2, foot - e1 + e2};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  }

private:
  // (G.2)
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double gap = (points[i] - point_).dot(normal_);
      out[i] = {};
      if (gap > reach || -gap > reach)
        continue;
      out[i].gap = gap;
      out[i].foot = points[i] - gap * normal_;
      out[i].normal = normal_;
    }
  }

  Vec3 point_;
  Vec3 normal_;
};

} // namespace

SurfacePtr make_plane(const Vec3& point, const Vec3& normal) {
  require_point(point, "point of the plane");
  require_direction(normal, "normal of the plane");
  return std::make_unique<const Plane>(point, normal);
}

} // namespace billet::geometry
