#include "process/loop/process.h"

#include "geometry/base/box.h"
#include "geometry/base/stopwatch.h"
#include "process/increment/force_floor.h"
#include "process/increment/symmetry_walls.h"
#include "process/loop/early_end.h"
#include "process/loop/stage_loop.h"
#include "process/loop/stored_run.h"
#include "process/remeshing/remeshing_due.h"
#include "process/reports/observer.h"
#include "process/scene/scene.h"
#include "process/setup/sudden_loads.h"
#include "process/setup/touch.h"
#include "process/stages/driven_tools.h"
#include "process/stages/overlap.h"
#include "process/stages/stage_start.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// A scene as it starts: loads grow from nothing, tools touch that are to.
Scene prepared(Scene scene) {
  grow_sudden_loads(scene);
  bring_to_touch(scene);
  return scene;
}

} // namespace

Process::Process(Scene scene) : run_(prepared(std::move(scene))) {
  run_.model.newton->set_force_floor(force_floor(run_, run_.state.time));
  run_.state.mesh.first_side = mean_side(run_.mesh());
  find_walls(run_);
  if (run_.scene.remesh)
    start_remeshing(run_);
  start_stage(run_, run_.scene.stages.front()); // only its tools have to lie right at the start
  check_overlap(run_);
  if (!run_.model.contact)
    return;
  run_.model.contact->start(run_.state.x, 0.0);
  if (contact::Wear::wanted(run_.tools()))
    run_.model.wear = std::make_unique<contact::Wear>(*run_.model.surface, run_.tools(),
                                                      box_of(run_.mesh().points));
  check_drives(run_);
}

RunStatus Process::run(const std::vector<Observer*>& observers) {
  run_.clock.analysis_before = run_.model.newton->solver_work().analysis;
  for (Observer* observer : observers)
    resumed_ ? observer->resumed(run_) : observer->started(run_);
  RunStatus status = RunStatus::done;
  const std::vector<Stage>& stages = run_.scene.stages;
  StageProgress& progress = run_.state.progress;
  for (; progress.stage < stages.size(); ++progress.stage) {
    const Stage& stage = stages[progress.stage];
    const double start = progress.stage > 0 ? stages[progress.stage - 1].end : 0.0;
    status = StageLoop(run_, stage, observers).go(start);
    const bool last = &stage == &stages.back();
    write_checkpoint(run_, observers,
                     status == RunStatus::stopped         ? CheckpointReason::stopped
                     : status == RunStatus::not_converged ? CheckpointReason::failed
                     : last || has_ended(run_)            ? CheckpointReason::end
                                                          : CheckpointReason::new_stage);
    if (status != RunStatus::done || last || has_ended(run_))
      break;
    progress.begun = false;
  }
  take_times(run_);
  run_.clock.times.total = run_.clock.before + seconds_now() - run_.clock.started;
  for (Observer* observer : observers)
    observer->finished(run_);
  return status;
}

std::vector<double> Process::take_positions() {
  std::vector<double> copy = run_.state.x;
  return std::exchange(run_.state.x, std::move(copy));
}

std::string Process::store() {
  run_.model.newton->forget();
  return stored(run_);
}

void Process::resume(std::string_view stored) {
  restore(run_, stored);
  if (!has_ended(run_)) // the case asks to go on
    run_.state.ended_by = EndedBy::end_of_time;
  resumed_ = true;
}

} // namespace billet::process
