// A run put back to the mesh before.

#include "process/increment/commit.h"
#include "process/increment/fallbacks.h"
#include "process/increment/force_floor.h"
#include "process/remeshing/mesh_before.h"
#include "process/remeshing/remesh.h"
#include "process/stages/stage_start.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/state/stored_models.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::process::mesh_before_test {
namespace {

void advance(Run& run, int increments) {
  constexpr double dt = 0.01;
  for (int i = 0; i < increments; ++i) {
    run.model.newton->forget(); // bits go with what is left of the factorization before
    ASSERT_TRUE(solve_by_any_way(run, dt, {}));
    accept(run, dt);
  }
}

TEST(MeshBefore, ANewMeshThatIsDroppedLeavesNoTrace) {
  Scene scene = upsetting_scene(billet(ElementKind::quad8, 4, 0.3, contact::Coulomb{0.2}));
  scene.remesh = RemeshSettings{};
  process::Run run(scene);
  run.model.newton->set_force_floor(force_floor(run, run.state.time));
  run.state.mesh.first_side = 1.0;
  start_stage(run, run.scene.stages.front());
  run.model.contact->start(run.state.x, 0.0);
  advance(run, 4);
  const MeshBefore before(run);
  const std::string then = present(run);
  advance(run, 3);
  const std::string later = present(run);
  before.put_back(run);
  ASSERT_EQ(present(run), then);
  ASSERT_TRUE(remesh(run, "a test", {}));
  EXPECT_EQ(run.mesh().kind, ElementKind::tri6);
  before.put_back(run);
  EXPECT_EQ(run.mesh().kind, ElementKind::quad8);
  EXPECT_EQ(present(run), then);
  advance(run, 3);
  EXPECT_EQ(present(run), later);
}

} // namespace
} // namespace billet::process::mesh_before_test
