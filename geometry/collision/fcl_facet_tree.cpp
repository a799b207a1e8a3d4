// The one file that knows FCL, in a library of its own (geometry/CMakeLists.txt).

#include "geometry/base/index.h"
#include "geometry/collision/facet_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cstddef>
#include <limits>
#include <new>

namespace billet::geometry {

namespace {

fcl::Transform3d to_fcl(const FacetTree::Place& place) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      transform.linear()(i, j) = place[idx(3 * i + j)];
    transform.translation()[i] = place[idx(9 + i)];
  }
  return transform;
}

class FclFacetTree final : public FacetTree {
public:
  FclFacetTree(std::span<const double> points, std::span<const Triangle> triangles) {
    std::vector<fcl::Vector3d> corners;
    for (std::size_t i = 0; i < points.size(); i += 3)
      corners.emplace_back(points[i], points[i + 1], points[i + 2]);
    std::vector<fcl::Triangle> facets;
    for (const Triangle& t : triangles)
      facets.emplace_back(t[0], t[1], t[2]);
    // FCL tells of memory that it has not got, and goes on.
    if (model_.beginModel() != fcl::BVH_OK || model_.addSubModel(corners, facets) != fcl::BVH_OK ||
        model_.endModel() != fcl::BVH_OK)
      throw std::bad_alloc();
  }

  [[nodiscard]] double
  distance(const Place& own, const FacetTree& other, const Place& place) const override {
    const fcl::DistanceRequestd request(false, false);
    fcl::DistanceResultd result;
    fcl::distance(&model_, to_fcl(own), &model_of(other), to_fcl(place), request, result);
    return result.min_distance;
  }

  [[nodiscard]] std::vector<Pair>
  cuts(const Place& own, const FacetTree& other, const Place& place) const override {
    constexpr std::size_t all = std::numeric_limits<std::int32_t>::max();
    const fcl::CollisionRequestd request(all, false);
    fcl::CollisionResultd result;
    fcl::collide(&model_, to_fcl(own), &model_of(other), to_fcl(place), request, result);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const fcl::Contactd& contact = result.getContact(i);
      pairs.push_back({static_cast<int>(contact.b1), static_cast<int>(contact.b2)});
    }
    return pairs;
  }

private:
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  static const Model& model_of(const FacetTree& tree) {
    return static_cast<const FclFacetTree&>(tree).model_;
  }

  Model model_;
};

} // namespace

[[gnu::visibility("default")]] std::unique_ptr<const FacetTree>
make_facet_tree(std::span<const double> points, std::span<const FacetTree::Triangle> triangles) {
  return std::make_unique<const FclFacetTree>(points, triangles);
}

} // namespace billet::geometry
