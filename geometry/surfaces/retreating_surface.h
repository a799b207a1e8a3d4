// A tool's surface that draws back from the workpiece along its normals: a tool opened in every
// direction at once. (P.5)

#pragma once

#include "geometry/rigid_surface.h"

#include <utility>

namespace billet::geometry {

/// Another surface, `distance` further off everywhere; it is drawn where it was.
class RetreatingSurface final : public RigidSurface {
public:
  explicit RetreatingSurface(SurfacePtr surface) : surface_(std::move(surface)) {}

  [[nodiscard]] double distance() const { return distance_; }
  void set_distance(double distance) { distance_ = distance; }

  [[nodiscard]] Box bounds() const override { return surface_->bounds(); }
  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override {
    return surface_->display(window, planar);
  }
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override {
    return surface_->narrow_parts(search); // where it was
  }
  [[nodiscard]] std::vector<ToolCorner> corners(double angle) const override {
    return surface_->corners(angle); // where they were
  }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override {
    surface_->project(points, reach, out);
    for (Projection& projection : out)
      if (projection.found()) {
        projection.gap += distance_;
        projection.foot -= distance_ * projection.normal;
      }
  }

  SurfacePtr surface_;
  double distance_ = 0.0;
};

} // namespace billet::geometry
