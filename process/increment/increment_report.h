// What a run tells of an increment, and of one that could not be solved.

#pragma once

#include "process/reports/observer.h"
#include "process/reports/run_reports.h"
#include "process/state/run.h"

#include <string>
#include <vector>

namespace billet::process {

/// The increment just accepted.
///
/// @param cutbacks  tries that failed before it
[[nodiscard]] IncrementReport report(const Run& run, double dt, int cutbacks);

/// Of an increment that could not be solved.
///
/// @param tried  a line for each try
[[nodiscard]] PostMortem
post_mortem(const Run& run, double dt, const std::string& why, std::vector<std::string> tried);

/// Tells the observers of an accepted increment.
void notify(Run& run, const std::vector<Observer*>& observers, const IncrementReport& report);

} // namespace billet::process
