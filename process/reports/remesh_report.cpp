// What a remeshing may change, and what is said of it. (P.16)

#include "process/reports/run_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::process {

namespace {

/// What a remeshing may change (RM-01): of the volume, of a tool's force, of the plastic work.
constexpr double volume_budget = 1e-4;
constexpr double work_budget = 5e-3;

} // namespace

double RemeshReport::Pair::change() const {
  return before != 0.0 ? std::abs(after - before) / std::abs(before) : std::abs(after);
}

double RemeshReport::work_change() const {
  constexpr double next_to_none = 1e-3; // of the work of the run
  const double scale = std::max(plastic_work.before, next_to_none * work_of_run);
  return scale > 0.0 ? std::abs(plastic_work.after - plastic_work.before) / scale
                     : plastic_work.after;
}

double RemeshReport::force_jump() const {
  double largest = 0.0;
  double jump = 0.0;
  for (const Pair& force : forces) {
    largest = std::max(largest, force.before);
    jump = std::max(jump, std::abs(force.after - force.before));
  }
  return largest > 0.0 ? jump / largest : 0.0;
}

std::vector<std::string> RemeshReport::complaints() const {
  std::vector<std::string> lines;
  const auto check = [&](const char* what, double change, double budget) {
    if (change > budget)
      lines.push_back(fmt::format(
          "warning: [remeshing-changed] remeshing {} changed the {} by {:.2g} %, more than "
          "{:.2g} %",
          number, what, 100.0 * change, 100.0 * budget));
  };
  check("volume", volume.change(), volume_budget);
  check("plastic work", work_change(), work_budget);
  for (const Lap& lap : laps)
    lines.push_back(
        lap.root
            ? fmt::format("note: remeshing {} closed the root of a crease, {:.3g} deep, near {}: "
                          "no mesh was fine enough for it; its walls go on touching each other",
                          number, lap.depth, lap.place)
            : fmt::format(
                  "warning: [fold-welded] remeshing {} welded a fold, {:.3g} deep, whose walls met "
                  "near {}: the part there is a lap, which the mesh no longer shows",
                  number, lap.depth, lap.place));
  if (balanced)
    check("force on a tool", force_jump(), force_budget);
  else
    lines.push_back(fmt::format("warning: [remeshing-unbalanced] remeshing {} was not followed by "
                                "equilibrium before time went on",
                                number));
  return lines;
}

} // namespace billet::process
