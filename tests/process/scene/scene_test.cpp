#include "process/scene/scene.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

namespace billet::process::scene_test {
namespace {

Scene unheld(ElementKind kind, Analysis analysis) {
  Scene scene;
  scene.part.analysis = analysis;
  scene.part.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3::Ones(), {2, 2, 2}, {1, 1, 1}});
  return scene;
}

TEST(Scene, CountsTheRigidMotionsOfEachAnalysis) {
  EXPECT_EQ(free_rigid_motions(unheld(ElementKind::quad4, Analysis::axisymmetric).part), 1);
  EXPECT_EQ(free_rigid_motions(unheld(ElementKind::quad4, Analysis::plane_strain).part), 3);
  EXPECT_EQ(free_rigid_motions(unheld(ElementKind::hex8, Analysis::solid).part), 6);
}

TEST(Scene, TakesOffWhatTheSupportsHold) {
  Scene scene = unheld(ElementKind::hex8, Analysis::solid);
  scene.part.supports.push_back(held(scene.part.mesh, 0, 0.0)); // a symmetry plane
  EXPECT_EQ(free_rigid_motions(scene.part), 3);
  scene.part.supports.push_back(held(scene.part.mesh, 1, 0.0));
  EXPECT_EQ(free_rigid_motions(scene.part), 1);
  scene.part.supports.push_back(held(scene.part.mesh, 2, 0.0));
  EXPECT_EQ(free_rigid_motions(scene.part), 0);
}

TEST(Scene, KnowsThatOneNodeHoldsNoRotation) {
  Scene scene = unheld(ElementKind::quad4, Analysis::plane_strain);
  scene.part.supports.push_back({{0}, 0, TimeFunction(0.0)});
  scene.part.supports.push_back({{0}, 1, TimeFunction(0.0)});
  EXPECT_EQ(free_rigid_motions(scene.part), 1);
  scene.part.supports.push_back({{2}, 1, TimeFunction(0.0)}); // a second node, to its right
  EXPECT_EQ(free_rigid_motions(scene.part), 0);
}

TEST(Scene, KnowsThatARadiusHoldsNoAxialMotion) {
  Scene scene = unheld(ElementKind::quad8, Analysis::axisymmetric);
  scene.part.supports.push_back(held(scene.part.mesh, 0, 0.0));
  EXPECT_EQ(free_rigid_motions(scene.part), 1);
  scene.part.supports.push_back(held(scene.part.mesh, 1, 0.0));
  EXPECT_EQ(free_rigid_motions(scene.part), 0);
}

} // namespace
} // namespace billet::process::scene_test
