#include "process/run_checks.h"

#include "mechanics/materials/j2_hencky.h"
#include "process/narrow_tools.h"
#include "process/remeshing.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

namespace billet::process {

namespace {

constexpr double percent = 100.0;

std::optional<FailedCheck> energy_balance(const Process& process) {
  constexpr double most = 0.05; // of the largest of its terms
  const EnergyBalance& energy = process.energy();
  if (!(energy.error() > most))
    return std::nullopt;
  return FailedCheck{
      "energy-balance",
      fmt::format("the balance of energy misses {:.3g} % (allowed: {:g} %): the work of the tools "
                  "is not what the part has taken up. Shorter increments (time.increments.max) "
                  "show whether forces jump, supports whether the part moves freely",
                  percent * energy.error(), percent * most)};
}

std::optional<FailedCheck> stabilization(const Process& process) {
  constexpr double most = 0.05; // of the largest term of the balance
  const EnergyBalance& energy = process.energy();
  if (!(energy.scale() > energy.nothing))
    return std::nullopt;
  const double rigid = energy.grounding / energy.scale();
  if (rigid > most)
    return FailedCheck{
        "stabilization",
        fmt::format(
            "{:.3g} % of the work (allowed: {:g} %) went into the stabilization of {} rigid "
            "motion(s) that no support holds: add a [[support]] that does (a symmetry "
            "plane, the axis), or let tools hold the part",
            percent * rigid, percent * most, process.grounded_motions())};
  const contact::ContactSettings& contact = process.scene().contact;
  const double faces = std::abs(energy.enforcement) / energy.scale();
  if (faces > most && !contact.max_penetration && contact.method == contact::Method::penalty)
    return FailedCheck{
        "stabilization",
        fmt::format(
            "{:.3g} % of the work (allowed: {:g} %) was done by the springs that hold faces "
            "out of tools (C.44), not by the tools: take smaller elements where tools are "
            "curved, or contact.form = \"compatible\"",
            percent * faces, percent * most)};
  return std::nullopt;
}

std::optional<FailedCheck> tool_in_part(const Process& process) {
  const Process::DeepestTool& deepest = process.deepest_tool();
  if (!(deepest.share > deepest_unfelt))
    return std::nullopt;
  return FailedCheck{
      "tool-in-part",
      fmt::format("at t = {:.6g} tool '{}' lay {:.3g} deep in the part near ({:.6g}, {:.6g}, "
                  "{:.6g}), {:.0f} % of the element there (allowed: {:.0f} %), between contact "
                  "points that it presses on: take smaller elements there, a [remesh] section, "
                  "or a larger radius on the tool",
                  deepest.time, process.scene().tools[deepest.tool].name, deepest.depth,
                  deepest.place[0], deepest.place[1], deepest.place[2], percent * deepest.share,
                  percent * deepest_unfelt)};
}

/// Whether a tool still bears a good part of the largest force that it has borne.
bool bears(const Process& process, std::size_t tool) {
  constexpr double share = 0.5;
  return process.contact() != nullptr &&
         process.contact()->loads()[tool].force.norm() > share * process.peak_forces()[tool];
}

/// The most that a tool's surface curves at what it presses on [1/mm].
double curvature(const Process& process, std::size_t tool) {
  std::vector<Vec3> places;
  for (const contact::ClosedPoint& at : process.contact()->closed()[tool])
    places.push_back(at.to);
  std::vector<geometry::Projection> feet(places.size());
  process.scene().tools[tool].surface->project(places, body_size(process.scene().mesh), feet);
  double most = 0.0;
  for (const geometry::Projection& foot : feet)
    most = std::max(most, foot.dnormal_dx.norm());
  return most;
}

/// Faces that a tool presses on.
std::set<std::size_t> faces_pressed(const Process& process, std::size_t tool) {
  const auto points = static_cast<std::size_t>(process.surface()->points());
  std::set<std::size_t> faces;
  for (const contact::ClosedPoint& at : process.contact()->closed()[tool])
    faces.insert(at.point / points);
  return faces;
}

/// In space: whether a tool presses on so few faces, round beside their size, that they cannot
/// follow it.
bool too_round(const Process& process, std::size_t tool) {
  constexpr std::size_t fewest_faces = 4;
  constexpr double tightest = 0.5; // of the turn of the tool over a face [rad]
  const std::size_t n_faces = faces_pressed(process, tool).size();
  if (n_faces == 0 || n_faces > fewest_faces)
    return false;
  double area = 0.0; // of a face
  for (const contact::ClosedPoint& at : process.contact()->closed()[tool])
    area = std::max(area, at.area * process.surface()->points());
  return std::sqrt(area) * curvature(process, tool) > tightest;
}

FailedCheck unresolved(const Process& process, std::size_t tool, const std::string& how) {
  return {"contact-resolution",
          fmt::format("tool '{}' presses {}: its force is that of elements of this size, which can "
                      "be several times too high. Take smaller elements there, or a [remesh] "
                      "section",
                      process.scene().tools[tool].name, how)};
}

std::optional<FailedCheck> contact_resolution(const Process& process) {
  constexpr double most_of_corner = 0.9;
  if (const CornerLoad load = process.most_at_corner();
      load.share > most_of_corner && bears(process, load.tool))
    return unresolved(process, load.tool,
                      "with corners, or roundings smaller than a quarter of an element, alone");
  constexpr std::size_t fewest_edges = 3; // in one zone or more
  for (const ContactZone& zone : process.poorly_resolved_tools()) {
    const auto tool = static_cast<std::size_t>(zone.tool);
    const std::size_t pressed = faces_pressed(process, tool).size();
    if (bears(process, tool) && pressed < fewest_edges)
      return unresolved(process, tool, fmt::format("on {} edge(s) of elements only", pressed));
  }
  if (process.scene().mesh.dimension() == 3 && process.contact() != nullptr)
    for (std::size_t t = 0; t < process.scene().tools.size(); ++t)
      if (bears(process, t) && too_round(process, t))
        return unresolved(process, t,
                          "on four faces or fewer, each of which it turns along by more than 30 "
                          "degrees");
  return std::nullopt;
}

std::optional<FailedCheck> volume(const Process& process) {
  constexpr double most = 0.01;
  // Plastic flow keeps volume: what the elastic ratios of the points do not say is lost.
  const mechanics::Bulk& bulk = process.bulk();
  double elastic = 0.0;
  for (std::size_t k = 0; k < bulk.states().size(); ++k)
    elastic += bulk.volumes()[k] * std::sqrt(bulk.states()[k].b_e.determinant());
  const double lost = 1.0 - bulk.volume(process.unknowns()) / elastic;
  if (std::abs(lost) <= most)
    return std::nullopt;
  return FailedCheck{"volume",
                     fmt::format("{:.3g} % of the volume is lost (negative: gained) that no "
                                 "pressure explains (allowed: {:g} %)",
                                 percent * lost, percent * most)};
}

std::optional<FailedCheck> inside_out(const Process& process) {
  constexpr double least = -0.05; // quality; where edges fold onto a die it may come to zero
  const double quality = worst_quality(process.scene().mesh, process.positions());
  if (quality >= least)
    return std::nullopt;
  return FailedCheck{"inside-out",
                     fmt::format("an element is inside out (quality {:.2g}): a [remesh] section "
                                 "replaces a mesh before that",
                                 quality)};
}

} // namespace

std::vector<FailedCheck> failed_checks(const Process& process) {
  std::vector<FailedCheck> failed;
  for (const auto& check :
       {energy_balance, stabilization, tool_in_part, contact_resolution, volume, inside_out})
    if (std::optional<FailedCheck> found = check(process))
      failed.push_back(std::move(*found));
  return failed;
}

} // namespace billet::process
