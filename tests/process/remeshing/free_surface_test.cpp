// The free surface, moved to give a part its volume. (P.21)

#include "mechanics/elements/mesh_locator.h"
#include "process/remeshing/free_surface.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace billet::process::free_surface_test {
namespace {

/// The bar of upsetting as it is before the die comes: radius or half sides 5, height 15.
struct Bar {
  Scene scene;
  mechanics::BlockPattern pattern;
  mechanics::Bulk bulk;
  std::vector<double> x;

  explicit Bar(ElementKind kind)
      : scene(upsetting_scene(bar_upsetting(kind))),
        pattern(mechanics::block_pattern(scene.part.mesh)),
        bulk(scene.part.mesh, scene.part.analysis, scene.material, pattern),
        x(mechanics::node_positions(scene.part.mesh)) {}

  [[nodiscard]] double volume() const { return bulk.volume(x); }
};

/// Whether the faces lie on top, where the die is.
std::vector<char> on_top(const Scene& scene) {
  const int up = scene.part.mesh.dimension() - 1;
  std::vector<char> touching;
  for (const mechanics::Face& face : scene.part.contact_faces)
    touching.push_back(std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index node) {
      return scene.part.mesh.points[as_size(node)][up] == 15.0;
    }));
  return touching;
}

TEST(FreeSurface, MovesOutwardWhereNothingTouches) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex8}) {
    const Bar bar(kind);
    const int dim = bar.scene.part.mesh.dimension();
    const std::vector<double> normals = free_normals(bar.scene.part, bar.x, on_top(bar.scene));
    int moved = 0;
    for (Index node = 0; node < bar.scene.part.mesh.n_points(); ++node) {
      const Vec3& at = bar.scene.part.mesh.points[as_size(node)];
      Vec3 normal = Vec3::Zero();
      for (int i = 0; i < dim; ++i)
        normal[i] = normals[as_size(dim * node + i)];
      const double radius = dim == 2 ? at[0] : std::max(at[0], at[1]);
      if (at[dim - 1] == 15.0 || radius < 5.0) {
        EXPECT_EQ(normal, Vec3::Zero()) << at.transpose();
        continue;
      }
      ++moved;
      EXPECT_EQ(normal[dim - 1], 0.0) << at.transpose();
      EXPECT_GT(normal.norm(), 0.7) << at.transpose();
      for (int i = 0; i + 1 < dim; ++i)
        EXPECT_EQ(normal[i] > 0.0, at[i] == 5.0) << at.transpose();
    }
    EXPECT_GT(moved, 3);
  }
}

TEST(FreeSurface, GivesThePartTheVolume) {
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8, ElementKind::hex20})
    for (const double change : {-1e-3, 1e-4, 1e-3}) {
      Bar bar(kind);
      const double wanted = (1.0 + change) * bar.volume();
      const std::vector<double> before = bar.x;
      restore_volume(
          bar.x, free_normals(bar.scene.part, bar.x, on_top(bar.scene)),
          [&](std::span<const double> x) { return bar.bulk.volume(x); }, wanted, 0.02);
      // One straight step: off by the square of the change.
      EXPECT_NEAR(bar.volume(), wanted, 2.0 * change * change * wanted);
      EXPECT_NE(bar.x, before);
    }
}

TEST(FreeSurface, MovesNoFurtherThanItMayAndNotWhereAllTouches) {
  Bar bar(ElementKind::quad8);
  const auto volume = [&](std::span<const double> x) { return bar.bulk.volume(x); };
  const double before = bar.volume();
  const std::vector<char> all(bar.scene.part.contact_faces.size(), 1);
  const std::vector<double> still = bar.x;
  restore_volume(bar.x, free_normals(bar.scene.part, bar.x, all), volume, 1.01 * before, 0.02);
  EXPECT_EQ(bar.x, still);
  restore_volume(bar.x, free_normals(bar.scene.part, bar.x, on_top(bar.scene)), volume,
                 2.0 * before, 0.02);
  double furthest = 0.0;
  for (std::size_t i = 0; i < still.size(); ++i)
    furthest = std::max(furthest, std::abs(bar.x[i] - still[i]));
  EXPECT_NEAR(furthest, 0.02, 1e-15);
}

} // namespace
} // namespace billet::process::free_surface_test
