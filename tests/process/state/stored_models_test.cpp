// A run put back to where it was on the same mesh.

#include "process/increment/commit.h"
#include "process/increment/fallbacks.h"
#include "process/increment/force_floor.h"
#include "process/stages/stage_start.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/state/stored_models.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::process::stored_models_test {
namespace {

void start(Run& run) {
  run.model.newton->set_force_floor(force_floor(run, run.state.time));
  start_stage(run, run.scene.stages.front());
  run.model.contact->start(run.state.x, 0.0);
}

void advance(Run& run, int increments) {
  constexpr double dt = 0.01;
  for (int i = 0; i < increments; ++i) {
    run.model.newton->forget(); // bits go with what is left of the factorization before
    ASSERT_TRUE(solve_by_any_way(run, dt, {}));
    accept(run, dt);
  }
}

TEST(StoredModels, ARunThatIsPutBackLeavesNoTraceOfWhatItDid) {
  process::Run run(upsetting_scene(billet(ElementKind::quad8, 4, 0.3, contact::Coulomb{0.2})));
  start(run);
  advance(run, 4);
  const std::string before = present(run);
  advance(run, 3);
  const std::string after = present(run);
  EXPECT_NE(after, before);
  put_back(run, before);
  EXPECT_EQ(present(run), before);
  (void)solve_by_any_way(run, 1.0, {}); // a try that is dropped, of all the rest of the way
  put_back(run, before);
  advance(run, 3);
  EXPECT_EQ(present(run), after);
}

} // namespace
} // namespace billet::process::stored_models_test
