#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "process/loop/process.h"
#include "process/tools/passage_guard.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace billet::process::passage_guard_test {
namespace {

/// An upright blade, its front at x = -1, as high as the block and a little more.
geometry::SurfacePtr blade(double thickness) {
  const std::vector<Vec2> corners{
      {-1.0 - thickness, -1.0}, {-1.0, -1.0}, {-1.0, 11.0}, {-1.0 - thickness, 11.0}};
  return geometry::make_profile(geometry::polygon(corners, true));
}

/// An elastic block of side 10 that stands on y = 0, and a blade to its left that moves 1.5 in
/// 0.3 s: 1 to the block and 0.5 into it. In one increment it would come to stand inside the block
/// with the nodes of the side behind it.
Scene blade_scene(const geometry::Motion& motion) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  scene.material = elastic_body(1000.0, 0.3);
  for (const int axis : {0, 1})
    scene.part.supports.push_back({nodes_at(scene.part.mesh, 1, 0.0), axis, TimeFunction(0.0)});
  scene.tools.push_back(moving_tool("blade", blade(0.2), Vec3::Zero()));
  scene.tools[0].motion = motion;
  scene.touch = {0};
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.stages.push_back({"press", 0.3, {1}, false});
  scene.increments.first = scene.increments.max = 0.3;
  return scene;
}

void expect_pressed(Scene scene) {
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_GT(done.process->view().state.counters.cutbacks, 0);
  EXPECT_LT(done.last().loads[0].force[0], -1.0) << "the block pushes back";
  // The side has gone along with the blade.
  const auto left = nodes_at(done.process->view().mesh(), 0, 0.0);
  EXPECT_GT(done.last().positions[as_size(2 * left.back())], 0.4);
}

TEST(PassageGuard, AThinDieDoesNotPassTheWorkpieceInOneIncrement) {
  geometry::Motion motion;
  motion.velocity = Vec3(5, 0, 0);
  expect_pressed(blade_scene(motion));
}

TEST(PassageGuard, APaddleThatTurnsDoesNotEither) {
  geometry::Motion motion; // about a point far above: the lower end swings to the right
  motion.rotation = geometry::Rotation{Vec3(-1.1, 41, 0), Vec3::UnitZ(), 1.0 / 6.5};
  expect_pressed(blade_scene(motion));
}

TEST(PassageGuard, TheReasonNamesToolAndPlace) {
  geometry::Motion motion;
  motion.velocity = Vec3(5, 0, 0);
  Scene scene = blade_scene(motion);
  scene.increments.min = 0.2; // one try
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::not_converged);
  const std::string& reason = done.recorder.failures.at(0).reason;
  EXPECT_NE(reason.find("through tool 'blade' at ("), std::string::npos) << reason;
}

TEST(PassageGuard, ASurfaceThatMovesThroughAStandingDieIsSeen) {
  const Process process(blade_scene({}));
  const std::vector<double> before(process.view().positions().begin(),
                                   process.view().positions().end());
  for (const double shift : {-0.9, -1.05, -1.15, -3.0}) {
    std::vector<double> after = before;
    for (std::size_t i = 0; i < after.size(); i += 2)
      after[i] += shift;
    const Outcome<Done> outside =
        check_passages(process.view().tools(), *process.view().model.surface,
                       *process.view().contact(), {0.0, 0.1, before, after});
    EXPECT_EQ(outside.has_value(), shift > -1.1) << shift << ": the middle of the blade is at -1.1";
  }
}

TEST(PassageGuard, AThinPlateOfTrianglesDoesNotPassASolid) {
  geometry::TriangleMesh plate = geometry::cube();
  for (Vec3& p : plate.points)
    p = Vec3(-1.2, -1, -1) + Vec3(0.2, 12, 12).cwiseProduct(p);
  geometry::Motion motion;
  motion.velocity = Vec3(5, 0, 0);
  Scene scene = blade_scene(motion);
  scene.part.analysis = Analysis::solid;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::hex8, Vec3::Zero(), Vec3(10, 10, 10), {3, 3, 3}, {1, 1, 1}});
  scene.part.supports.clear();
  for (const int axis : {0, 1, 2})
    scene.part.supports.push_back({nodes_at(scene.part.mesh, 2, 0.0), axis, TimeFunction(0.0)});
  scene.tools[0].surface = geometry::make_triangle_surface(plate);
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_GT(done.process->view().state.counters.cutbacks, 0);
  EXPECT_LT(done.last().loads[0].force[0], -1.0);
}

TEST(PassageGuard, ATravelOfADrivenDieCounts) {
  geometry::Motion motion;
  motion.force = geometry::Drive{Vec3::Zero(), Vec3::UnitX(), TimeFunction(1.0)};
  motion.place.translation = Vec3(1, 0, 0); // it touches
  const Process process(blade_scene(motion));
  std::vector<double> before(process.view().positions().begin(), process.view().positions().end());
  before.push_back(0.0);
  std::vector<double> after = before;
  const auto stays_outside = [&](double travel) {
    after.back() = travel;
    return check_passages(process.view().tools(), *process.view().model.surface,
                          *process.view().contact(), {0.0, 0.1, before, after})
        .has_value();
  };
  EXPECT_TRUE(stays_outside(0.05));
  EXPECT_FALSE(stays_outside(0.15));
  EXPECT_FALSE(stays_outside(5.0));
  EXPECT_TRUE(stays_outside(-5.0));
}

} // namespace
} // namespace billet::process::passage_guard_test
