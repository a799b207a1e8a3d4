// The sections of a report that are text and tables; each is empty where the results have nothing
// for it.

#pragma once

#include "app/report/curves.h"
#include "app/report/results_folder.h"

#include <string>
#include <vector>

namespace billet::report {

/// Status, what ended the run, failed checks, warnings, advice.
[[nodiscard]] std::string status_section(const ResultsFolder& results);
/// The largest figures of the run.
[[nodiscard]] std::string key_figures(const ResultsFolder& results,
                                      const std::vector<NamedChart>& charts);
/// Program, machine, time, command; the case.
[[nodiscard]] std::string run_section(const ResultsFolder& results);
[[nodiscard]] std::string tools_section(const ResultsFolder& results);
/// Wear of tools and workpiece.
[[nodiscard]] std::string wear_section(const ResultsFolder& results);
[[nodiscard]] std::string window_section(const ResultsFolder& results);
/// How far dies are filled, and other figures of the shape at the end.
[[nodiscard]] std::string measures_section(const ResultsFolder& results);
[[nodiscard]] std::string remeshing_section(const ResultsFolder& results);
/// Laps, walls that have met, contact of the part with itself.
[[nodiscard]] std::string laps_section(const ResultsFolder& results);
/// Blows of hammers and screw presses.
[[nodiscard]] std::string blows_section(const ResultsFolder& results);
/// Where the time went; the linear solver.
[[nodiscard]] std::string effort_section(const ResultsFolder& results);

} // namespace billet::report
