#include "process/loop/early_end.h"

#include "contact/self/laps.h"
#include "process/measures/film.h"
#include "process/measures/squeeze.h"

#include <algorithm>

namespace billet::process {

namespace {

/// By pressures under which no metal is left to flow or tools break. Where an increment cannot be
/// solved less of it is enough.
EndedBy end_by_pressure(const Run& run, double volume, bool failed) {
  if (!has_lost_volume(run, volume, failed ? Squeeze::little_at_failure : Squeeze::little))
    return EndedBy::end_of_time;
  const Squeeze squeeze = squeeze_of(run, volume);
  const StopRules& stop = run.scene.stop;
  if (stop.on_full_cavity && (failed ? squeeze.is_nearly_full() : squeeze.is_full()))
    return EndedBy::full_cavity;
  // With less of the part's volume gone pressures are local, as under an indenter.
  const double squeezed = failed ? Squeeze::little : 0.05;
  return stop.on_tools_overloaded && squeeze.volume_lost > squeezed &&
                 squeeze.tool_pressure > stop.bearable
             ? EndedBy::tools_overloaded
             : EndedBy::end_of_time;
}

/// Of those whose walls are there, and of those that new meshes have welded [mm].
double deepest_lap(const Run& run) {
  double deepest = 0.0;
  if (run.model.self_contact)
    for (const contact::Lap& lap :
         contact::laps(*run.model.surface, run.model.self_contact->state(), run.positions()))
      deepest = std::max(deepest, lap.depth);
  for (const RemeshReport& report : run.state.record.remeshings)
    for (const Lap& lap : report.laps)
      if (!lap.root)
        deepest = std::max(deepest, lap.depth);
  return deepest;
}

} // namespace

EndedBy early_end(const Run& run, const IncrementReport& report) {
  if (report.max_plastic_strain > 0.0)
    if (const EndedBy end = end_by_pressure(run, report.volume, false); end != EndedBy::end_of_time)
      return end;
  if (run.scene.stop.on_tools_together && closing_film(run, report.dt))
    return EndedBy::tools_together;
  return run.scene.stop.on_lap && deepest_lap(run) > *run.scene.stop.on_lap ? EndedBy::lap
                                                                            : EndedBy::end_of_time;
}

EndedBy end_after_failure(const Run& run) {
  return end_by_pressure(run, run.model.bulk->volume(run.state.x), true);
}

bool has_ended(const Run& run) {
  switch (run.state.ended_by) {
  case EndedBy::full_cavity:
    return run.scene.stop.on_full_cavity;
  case EndedBy::tools_overloaded:
    return run.scene.stop.on_tools_overloaded;
  case EndedBy::tools_together:
    return run.scene.stop.on_tools_together;
  case EndedBy::lap:
    return run.scene.stop.on_lap && deepest_lap(run) > *run.scene.stop.on_lap;
  case EndedBy::end_of_time:
  case EndedBy::energy_used_up:
    break;
  }
  return false;
}

} // namespace billet::process
