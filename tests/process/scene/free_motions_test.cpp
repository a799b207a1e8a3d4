// Which rigid motions supports leave free, by name.

#include "mechanics/mesh/mesh_generators.h"
#include "process/scene/scene.h"

#include <gtest/gtest.h>

namespace billet::process::free_motions_test {
namespace {

using Three = std::array<bool, 3>;

/// A block of two elements along each side, held in a component on some of its sides.
Scene block(mechanics::Analysis analysis,
            const std::vector<std::pair<std::string, int>>& supports) {
  const bool solid = analysis == mechanics::Analysis::solid;
  Scene scene;
  scene.part.analysis = analysis;
  scene.part.mesh =
      mechanics::box_mesh({solid ? mechanics::ElementKind::hex8 : mechanics::ElementKind::quad4,
                           Vec3::Zero(),
                           Vec3(1, 2, solid ? 3 : 0),
                           {2, 2, solid ? 2 : 1},
                           {1, 1, 1}});
  for (const auto& [set, component] : supports)
    scene.part.supports.push_back(
        {scene.part.mesh.node_sets.at(set), component, TimeFunction(0.0)});
  return scene;
}

TEST(FreeMotions, in_space) {
  const FreeMotions all = free_motions(block(mechanics::Analysis::solid, {}).part);
  EXPECT_EQ(all.along, (Three{true, true, true}));
  EXPECT_EQ(all.about, (Three{true, true, true}));
  const Scene quarter = block(mechanics::Analysis::solid, {{"x-min", 0}, {"y-min", 1}});
  EXPECT_EQ(free_motions(quarter.part).along, (Three{false, false, true}));
  EXPECT_EQ(free_motions(quarter.part).about, (Three{false, false, false}));
  const Scene half = block(mechanics::Analysis::solid, {{"x-min", 0}});
  EXPECT_EQ(free_motions(half.part).along, (Three{false, true, true}));
  EXPECT_EQ(free_motions(half.part).about, (Three{true, false, false}));
  EXPECT_EQ(free_rigid_motions(half.part), 3);
}

TEST(FreeMotions, in_the_plane_and_of_a_round_part) {
  const Scene plane = block(mechanics::Analysis::plane_strain, {{"y-min", 1}});
  EXPECT_EQ(free_motions(plane.part).along, (Three{true, false, false}));
  EXPECT_EQ(free_motions(plane.part).about, (Three{false, false, false}));
  const FreeMotions loose = free_motions(block(mechanics::Analysis::plane_strain, {}).part);
  EXPECT_EQ(loose.about, (Three{false, false, true}));
  const FreeMotions round =
      free_motions(block(mechanics::Analysis::axisymmetric, {{"x-min", 0}}).part);
  EXPECT_EQ(round.along, (Three{false, true, false}));
  EXPECT_EQ(round.about, (Three{false, false, false}));
  const Scene held = block(mechanics::Analysis::axisymmetric, {{"y-min", 1}});
  EXPECT_EQ(free_motions(held.part).along, (Three{false, false, false}));
  EXPECT_EQ(free_rigid_motions(held.part), 0);
}

} // namespace
} // namespace billet::process::free_motions_test
