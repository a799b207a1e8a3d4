#include "process/tools/narrow_tools.h"
#include "process/tools/part_depth.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace billet::process::narrow_tools_test {
namespace {

/// A block of 4 x 4 elements of size 1 that stands on y = 0 or z = 0.
Scene block(ElementKind kind) {
  const bool solid = kind == ElementKind::hex8 || kind == ElementKind::hex20;
  Scene scene;
  scene.part.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh(
      {kind, Vec3::Zero(), Vec3(4, 4, solid ? 4 : 0), {4, 4, solid ? 4 : 1}, {1, 1, 1}});
  scene.material = elastic_body(1000.0, 0.3);
  for (const int axis : {0, 1, 2})
    if (axis < scene.part.mesh.dimension())
      scene.part.supports.push_back(
          {nodes_at(scene.part.mesh, up(scene.part.analysis), 0.0), axis, {0.0}});
  scene.part.contact_faces = faces_on(scene.part.mesh, up(scene.part.analysis), 0.0, true);
  scene.stages.push_back({"press", 1.0, {1}, false});
  return scene;
}

/// Above the middle of the block, its centre so high.
geometry::SurfacePtr needle(Analysis analysis, double height, double radius) {
  return analysis == Analysis::solid ? geometry::make_sphere(Vec3(1.6, 2.3, height), radius, false)
                                     : geometry::make_circle(Vec3(1.6, height, 0), radius, false);
}

TEST(PartDepth, IsTheDistanceFromTheFacesWithItsSide) {
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8, ElementKind::hex20}) {
    Scene scene = block(kind);
    scene.tools.push_back(moving_tool("needle", needle(scene.part.analysis, 4.5, 0.01),
                                      -Vec3::Unit(up(scene.part.analysis))));
    scene.touch = {0};
    const Process process(std::move(scene));
    PartDepth part(process.view().mesh(), *process.view().model.surface,
                   process.view().positions());
    const bool solid = process.view().part().analysis == Analysis::solid;
    const auto at = [&](double x, double height) {
      return part.at(solid ? Vec3(x, 2.1, height) : Vec3(x, height, 0), 1.0).depth;
    };
    EXPECT_NEAR(at(2.1, 3.7), 0.3, 1e-12) << "beneath the top";
    EXPECT_NEAR(at(0.2, 1.0), 0.2, 1e-12) << "beside the left face";
    EXPECT_NEAR(at(2.1, 0.1), 1.9, 1e-12) << "the base is no candidate";
    EXPECT_NEAR(at(2.1, 4.25), -0.25, 1e-12) << "outside";
    const Vec3 far_above = 40.0 * Vec3::Unit(solid ? 2 : 1);
    EXPECT_EQ(part.at(far_above, 1.0).face, -1) << "out of reach";
  }
}

/// What is found when the needle has gone down by that much.
std::pair<DeepTool, std::optional<DeepTool>> found_after(ElementKind kind, double way) {
  constexpr double radius = 0.01;
  Scene scene = block(kind);
  const int axis = up(scene.part.analysis);
  scene.tools.push_back(moving_tool("needle", needle(scene.part.analysis, 4.0 + radius, radius),
                                    -way * Vec3::Unit(axis)));
  scene.touch = {0};
  const Process process(std::move(scene));
  const NarrowTools narrow(process.view().mesh(), process.view().tools(),
                           *process.view().model.surface, process.view().positions());
  const mechanics::Trial trial{0.0, 1.0, process.view().state.x, process.view().state.x};
  return {narrow.deepest(*process.view().contact(), trial, 0.0),
          narrow.met_on_the_way(*process.view().contact(), trial)};
}

TEST(NarrowTools, ANeedleIsAsDeepAsItsTip) {
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8, ElementKind::hex20})
    for (const double way : {0.05, 0.3, 1.2}) {
      const DeepTool deepest = found_after(kind, way).first;
      // The deepest point of a ball that has passed the nearest face is at its far side.
      EXPECT_NEAR(deepest.depth, way, 1e-9) << way;
      EXPECT_NEAR(deepest.share, way, 1e-9) << "elements of size 1";
      EXPECT_EQ(deepest.radius, 0.01);
      EXPECT_GE(deepest.face, 0);
    }
  EXPECT_EQ(found_after(ElementKind::hex8, 0.015).first.depth, 0.0) << "no more than chords do";
}

TEST(NarrowTools, OneThatGoesThroughThePartIsMetOnTheWay) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex8}) {
    const auto [deepest, met] = found_after(kind, 9.0);
    EXPECT_EQ(deepest.depth, 0.0) << "it is beneath the block by then";
    ASSERT_TRUE(met);
    EXPECT_EQ(met->tool, 0u);
    EXPECT_GT(met->share, deepest_unfelt);
    EXPECT_FALSE(found_after(kind, 0.09).second) << "in the part by less";
  }
}

} // namespace
} // namespace billet::process::narrow_tools_test
