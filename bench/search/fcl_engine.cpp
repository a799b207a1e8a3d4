#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <vector>

#include "bench/search/engines.h"

namespace billet::bench {

namespace {

constexpr double radius = 1e-6; // of the sphere that stands for a point [mm]

class FclEngine final : public Engine {
public:
  explicit FclEngine(const geometry::TriangleMesh& mesh) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    model_->beginModel();
    model_->addSubModel(mesh.points, triangles);
    model_->endModel();
  }
  void distances(std::span<const Vec3> points, std::span<double> out) override {
    const fcl::CollisionObject<double> die(model_);
    fcl::CollisionObject<double> point(std::make_shared<fcl::Sphere<double>>(radius));
    for (std::size_t i = 0; i < points.size(); ++i) {
      point.setTranslation(points[i]);
      fcl::DistanceResult<double> result;
      out[i] = fcl::distance(&die, &point, fcl::DistanceRequest<double>(), result) + radius;
    }
  }

private:
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSS<double>>> model_ =
      std::make_shared<fcl::BVHModel<fcl::OBBRSS<double>>>();
};

} // namespace

std::unique_ptr<Engine> make_fcl(const geometry::TriangleMesh& mesh) {
  return std::make_unique<FclEngine>(mesh);
}

} // namespace billet::bench
