#include "process/loop/early_end.h"

#include "process/measures/film.h"
#include "process/measures/squeeze.h"

namespace billet::process {

namespace {

/// By pressures under which tools break or no metal is left to flow; shares of the part's volume
/// that is gone: with less of it pressures are local, as under an indenter.
///
/// @param share  of the volume from which on overloaded tools end the run
EndedBy end_by_pressure(const Run& run, double volume, double share) {
  if (volume > (1.0 - Squeeze::little) * run.model.bulk->reference_volume())
    return EndedBy::end_of_time;
  const Squeeze squeeze = squeeze_of(run, volume);
  const StopRules& stop = run.scene.stop;
  if (stop.on_full_cavity && squeeze.is_full())
    return EndedBy::full_cavity;
  return stop.on_tools_overloaded && squeeze.volume_lost > share &&
                 squeeze.tool_pressure > stop.bearable
             ? EndedBy::tools_overloaded
             : EndedBy::end_of_time;
}

} // namespace

EndedBy early_end(const Run& run, const IncrementReport& report) {
  constexpr double far_squeezed = 0.05;
  if (report.max_plastic_strain > 0.0)
    if (const EndedBy end = end_by_pressure(run, report.volume, far_squeezed);
        end != EndedBy::end_of_time)
      return end;
  if (run.scene.stop.on_tools_together && closing_film(run, report.dt))
    return EndedBy::tools_together;
  return EndedBy::end_of_time;
}

EndedBy end_after_failure(const Run& run) {
  constexpr double squeezed = 0.02;
  return end_by_pressure(run, run.model.bulk->volume(run.state.x), squeezed);
}

bool has_ended(const Run& run) {
  switch (run.state.ended_by) {
  case EndedBy::full_cavity:
    return run.scene.stop.on_full_cavity;
  case EndedBy::tools_overloaded:
    return run.scene.stop.on_tools_overloaded;
  case EndedBy::tools_together:
    return run.scene.stop.on_tools_together;
  case EndedBy::end_of_time:
  case EndedBy::energy_used_up:
    break;
  }
  return false;
}

} // namespace billet::process
