#include "process/loop/run_checks.h"

#include "contact/corners/corner_search.h"
#include "process/remeshing/contact_zones.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/remeshing_due.h"
#include "process/reports/energy_balance.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/tools/narrow_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

constexpr double percent = 100.0;

std::optional<FailedCheck> energy_balance(const Run& run) {
  constexpr double most = 0.05; // of the largest of its terms
  const EnergyBalance& energy = run.state.energy;
  if (!(energy.error() > most))
    return std::nullopt;
  return FailedCheck{
      "energy-balance",
      fmt::format("the balance of energy misses {:.3g} % (allowed: {:g} %): the work of the tools "
                  "is not what the part has taken up. Shorter increments (time.increments.max) "
                  "show whether forces jump, supports whether the part moves freely",
                  percent * energy.error(), percent * most)};
}

std::optional<FailedCheck> stabilization(const Run& run) {
  constexpr double most = 0.05; // of the largest term of the balance
  const EnergyBalance& energy = run.state.energy;
  if (!(energy.scale() > energy.nothing))
    return std::nullopt;
  const double share = energy.stabilization / energy.scale();
  if (!(share > most))
    return std::nullopt;
  return FailedCheck{
      "stabilization",
      fmt::format("{:.3g} % of the work (allowed: {:g} %) went into the stabilization of {} rigid "
                  "motion(s) that no support holds: add a [[support]] that does (a symmetry plane, "
                  "the axis), or let tools hold the part",
                  percent * share, percent * most, run.model.free_motions)};
}

std::optional<FailedCheck> tool_in_part(const Run& run) {
  constexpr double soft = 0.5; // of it, at contact points: it is contact that gives way
  const DeepestTool& deepest = run.state.record.deepest_tool;
  if (!(deepest.share > deepest_unfelt))
    return std::nullopt;
  return FailedCheck{
      "tool-in-part",
      fmt::format("at t = {:.6g} tool '{}' lay {:.3g} deep in the part near ({:.6g}, {:.6g}, "
                  "{:.6g}), {:.0f} % of the element there (allowed: {:.0f} %), {}",
                  deepest.time, run.tools()[deepest.tool].name, deepest.depth, deepest.place[0],
                  deepest.place[1], deepest.place[2], percent * deepest.share,
                  percent * deepest_unfelt,
                  deepest.at_points > soft * deepest.depth
                      ? "as deep as contact points: raise contact.penalty, or set max_penetration"
                      : "between contact points that it presses on: take smaller elements there, a "
                        "[remesh] section, or a larger radius on the tool")};
}

/// In the plane: a tool that indents the part with corners and small roundings alone. What bends
/// over a corner presses on it far less than what it is pushed into.
std::optional<FailedCheck> contact_resolution(const Run& run) {
  constexpr double share_of_corners = 0.9, indents = 3.0; // of the flow stress there
  const CornerLoad load = most_at_corner(run);
  if (!(load.share > share_of_corners))
    return std::nullopt;
  double hardest = 0.0; // pressure over flow stress
  const contact::ContactSurface& surface = *run.model.surface;
  for (const contact::CornerState& corner : contact::corners(*run.contact(), load.tool))
    if (const auto& foot = corner.press.foot) {
      const std::size_t point = surface.bulk_point(contact::nearest_point(surface, *foot));
      hardest =
          std::max(hardest, corner.history.pressure / run.model.bulk->trial_flow_stress(point));
    }
  if (!(hardest > indents))
    return std::nullopt;
  return FailedCheck{
      "contact-resolution",
      fmt::format("tool '{}' indents the part with corners, or roundings smaller than a quarter of "
                  "an element, alone: its force is that of elements of this size, which can be "
                  "several times too high. Take smaller elements there, a [remesh] section, or a "
                  "larger rounding",
                  run.tools()[load.tool].name)};
}

std::optional<FailedCheck> volume(const Run& run) {
  constexpr double most = 0.01;
  // Plastic flow keeps volume: what the elastic ratios of the points do not say is lost.
  const mechanics::Bulk& bulk = *run.model.bulk;
  double elastic = 0.0;
  for (std::size_t k = 0; k < bulk.states().size(); ++k)
    elastic += bulk.volumes()[k] * std::sqrt(bulk.states()[k].b_e.determinant());
  const double lost = 1.0 - bulk.volume(run.state.x) / elastic;
  if (std::abs(lost) <= most)
    return std::nullopt;
  return FailedCheck{"volume",
                     fmt::format("{:.3g} % of the volume is lost (negative: gained) that no "
                                 "pressure explains (allowed: {:g} %)",
                                 percent * lost, percent * most)};
}

std::optional<FailedCheck> inside_out(const Run& run) {
  constexpr double least = -0.05; // quality; where edges fold onto a die it may come to zero
  const double quality = worst_quality(run.mesh(), run.positions());
  if (quality >= least)
    return std::nullopt;
  return FailedCheck{"inside-out",
                     fmt::format("an element is inside out (quality {:.2g}): a [remesh] section "
                                 "replaces a mesh before that",
                                 quality)};
}

} // namespace

std::vector<FailedCheck> failed_checks(const Run& run) {
  std::vector<FailedCheck> failed;
  for (const auto& check :
       {energy_balance, stabilization, tool_in_part, contact_resolution, volume, inside_out})
    if (std::optional<FailedCheck> found = check(run))
      failed.push_back(std::move(*found));
  return failed;
}

} // namespace billet::process
