#include "process/increment/increment_report.h"

#include "geometry/base/stopwatch.h"
#include "process/reports/observer.h"
#include "process/reports/run_reports.h"
#include "process/stages/driven_tools.h"
#include "process/state/run.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

IncrementReport report(const Run& run, double dt, int cutbacks) {
  IncrementReport r;
  r.increment = run.state.increment;
  r.time = run.state.time;
  r.dt = dt;
  r.iterations = run.attempt.iterations;
  r.residual = run.attempt.residual;
  r.cutbacks = cutbacks;
  r.volume = run.model.bulk->volume(run.state.x);
  if (run.model.contact) {
    r.max_penetration = run.attempt.penetration.bound;
    r.penetration_share = run.attempt.penetration.share;
    r.penetration = run.attempt.penetration;
    r.contact_area = run.model.contact->state().area;
  }
  for (const auto& state : run.model.bulk->states())
    r.max_plastic_strain = std::max(r.max_plastic_strain, state.plastic_strain);
  r.min_quality = run.attempt.quality;
  r.wall_time = run.clock.before + seconds_now() - run.clock.started;
  r.energy = run.state.energy;
  r.records = run.model.newton->records();
  r.events = run.state.record.events;
  return r;
}

PostMortem
post_mortem(const Run& run, double dt, const std::string& why, std::vector<std::string> tried) {
  PostMortem post{.time = run.state.time + dt,
                  .dt = dt,
                  .reason = why,
                  .worst_position = run.attempt.penetration.position,
                  .tried = std::move(tried),
                  .drives = drive_states(run, run.state.time + dt),
                  .chattering = run.attempt.chattering,
                  .inside_out = run.attempt.inside_out,
                  .moves_away = run.attempt.moves_away,
                  .too_deep = run.attempt.too_deep,
                  .records = run.model.newton->records()};
  if (!run.attempt.too_deep) {
    post.worst_node = run.model.newton->worst_unknown() / run.mesh().dimension();
    post.worst_position =
        mechanics::node_position(run.state.x, run.mesh().dimension(), post.worst_node);
  }
  return post;
}

void notify(Run& run, const std::vector<Observer*>& observers, const IncrementReport& report) {
  const Stopwatch timed(run.clock.times.output);
  for (Observer* observer : observers)
    observer->incremented(run, report);
}

} // namespace billet::process
