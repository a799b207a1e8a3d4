#include "io/results/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace billet::io {

namespace {

using process::DriveState;
using Lines = std::vector<std::string>;

/// Whether a tool is of flat facets that stand for a curved shape.
bool is_faceted(const Case& content, const process::Scene& scene, std::size_t tool) {
  const auto of_case = std::find_if(content.tools.begin(), content.tools.end(), [&](const Tool& t) {
    return t.name == scene.tools[tool].name;
  });
  if (of_case == content.tools.end() || !(scene.tools[tool].chord_error > 0.0))
    return false;
  const auto* const stl = std::get_if<StlSurface>(&of_case->surface);
  const auto* const step = std::get_if<StepSurface>(&of_case->surface);
  return (stl != nullptr && !stl->smooth) || (step != nullptr && !step->smooth);
}

/// What the metal yields at, with the largest plastic strain so far.
double yield_stress_of(const process::Run& run) {
  const mechanics::Material& material = run.model.bulk->material();
  double strain = 0.0;
  for (const auto& state : run.model.bulk->states())
    strain = std::max(strain, state.plastic_strain);
  return mechanics::yield_stress(material.flow, {strain, 0.0, material.temperature});
}

void on_drives(const process::Run& run, const process::PostMortem& post, Lines& lines) {
  for (const DriveState& drive : post.drives) {
    if (drive.load == 0.0)
      continue;
    const std::string& name = run.tools()[drive.tool].name;
    if (drive.turns) {
      lines.push_back(fmt::format(
          "[drive-turns] a torque of {:.6g} turns tool {}: one that friction cannot hold, or more "
          "than the part "
          "bears, spins it freely; a smaller torque, more friction, or a prescribed rotation in "
          "its place goes on beyond",
          drive.load, name));
    } else if (drive.contact != DriveState::Contact::presses) {
      lines.push_back(fmt::format(
          "[drive-leaves] the force of {:.6g} takes tool {} away from the part, and contact only "
          "pushes: turn its "
          "direction round or give it the other sign, end its time to act (active, stages) before "
          "it lets go, or prescribe its motion",
          drive.load, name));
    } else {
      const double area = contact::bearing_area(*run.contact());
      const double yield = yield_stress_of(run);
      lines.push_back(fmt::format("[drive-presses] tool {} is under a force of {:.6g} there", name,
                                  drive.load));
      if (area > 0.0 && std::isfinite(yield))
        lines.back() += fmt::format(", all tools touch on {:.4g}: {:.3g} times the yield stress on "
                                    "average if it were this force alone",
                                    area, std::abs(drive.load) / area / yield);
    }
  }
}

/// Pressures that no metal bears: a unit has gone wrong, most likely.
void on_pressures(const process::Run& run, const process::PostMortem& post, Lines& lines) {
  constexpr double many = 3.0; // times the yield stress: what a dent bears
  const double yield = yield_stress_of(run);
  double largest = 0.0;
  double asked = 0.0;
  for (const process::LoadSpec& load : run.part().loads)
    if (const auto* const pressure = std::get_if<process::PressureOn>(&load)) {
      largest = std::max(largest, std::abs(pressure->pressure(post.time)));
      for (const auto& [time, value] : pressure->pressure.points())
        asked = std::max(asked, std::abs(value));
    }
  if (!std::isfinite(yield) || !(asked > many * yield))
    return;
  lines.push_back(fmt::format(
      "[pressure-too-high] a pressure of {:.4g} acts there, {:.3g} times the yield stress of the "
      "metal, and up to "
      "{:.4g} are asked for: more than a part bears that it does not enclose; check its unit, or "
      "let a tool press in its place",
      largest, largest / yield, asked));
}

bool driven_by_load(const process::Run& run, const process::PostMortem& post) {
  return !run.part().loads.empty() ||
         std::any_of(post.drives.begin(), post.drives.end(), [](const DriveState& drive) {
           return drive.contact == DriveState::Contact::presses;
         });
}

/// Contact points that go to and fro: between facets, or between stick and slip.
void on_chattering_points(const Case& content,
                          const process::Run& run,
                          const process::PostMortem& post,
                          Lines& lines) {
  const process::Scene& scene = run.scene;
  const auto on_facets =
      std::find_if(post.chattering.begin(), post.chattering.end(),
                   [&](const auto& point) { return is_faceted(content, scene, point.tool); });
  if (on_facets != post.chattering.end())
    lines.push_back(fmt::format(
        "[facets] contact points went to and fro between the facets of tool {}, which are off the "
        "curved "
        "shape that they stand for by up to {:.2g}: smooth = true in its surface curves them; "
        "facets smaller than the elements help less",
        scene.tools[on_facets->tool].name, scene.tools[on_facets->tool].chord_error));
  if (post.chattering.empty())
    return;
  const std::string& name = scene.tools[post.chattering.front().tool].name;
  lines.push_back(fmt::format("[chattering] {} contact point(s) kept changing between open, stick "
                              "and slip, most of them on tool {}: "
                              "smaller elements there let fewer change at once{}",
                              post.chattering.size(), name,
                              std::holds_alternative<contact::Frictionless>(
                                  scene.tools[post.chattering.front().tool].friction.law)
                                  ? ""
                                  : ", and so does less friction"));
}

void on_free_part(const process::PostMortem& post, Lines& lines) {
  if (post.moves_away)
    lines.push_back("[free-part] a load or a tool pushes the part where neither a support nor "
                    "contact with friction holds it: a [[support]] for that motion, friction on a "
                    "tool, or a tool in its way");
}

void on_elements(const Case& content, const process::PostMortem& post, Lines& lines) {
  if (post.inside_out)
    lines.push_back(
        content.remesh
            ? "[element-inside-out] an element turned inside out: smaller elements (remesh.size, "
              "remesh.size.min) follow the metal further"
            : "[element-inside-out] an element turned inside out: a [remesh] section replaces "
              "the mesh in time, smaller elements go a little further");
  if (post.too_deep)
    lines.push_back("[face-too-deep] a face lies too deep in a tool between its contact points: "
                    "smaller elements "
                    "there follow the tool, contact.form = \"compatible\" has more points on "
                    "faces of quadratic elements, a larger contact.max_penetration lets it be");
}

void on_increments(const process::Run& run, const process::PostMortem& post, Lines& lines) {
  constexpr double of_no_more_use = 1e-5; // of the run: shorter ones would have failed as well
  if (const std::optional<double>& min = run.scene.increments.min;
      min && post.dt < 2.0 * *min && post.dt > of_no_more_use * run.scene.stages.back().end)
    lines.push_back(fmt::format("[shortest-increment] time.increments.min = {:.4g} allows none "
                                "shorter: leave it out, and the run "
                                "finds its own",
                                *min));
}

} // namespace

std::vector<std::string>
advice(const Case& content, const process::Run& run, const process::PostMortem& post) {
  Lines lines;
  on_pressures(run, post, lines);
  on_free_part(post, lines);
  on_elements(content, post, lines);
  on_chattering_points(content, run, post, lines);
  on_drives(run, post, lines);
  on_increments(run, post, lines);
  if (driven_by_load(run, post) && !post.moves_away)
    lines.push_back("[load-driven] a load drives this part: it may be at the most that the part "
                    "bears (it necks, "
                    "bulges, buckles or leaves the tool); a prescribed motion in its place goes on "
                    "beyond");
  lines.push_back(
      content.remesh
          ? "[finer-mesh] smaller elements there (remesh.size), a check of the tools' motion"
          : "[finer-mesh] a finer mesh there, a [remesh] section, a check of the tools' motion");
  return lines;
}

} // namespace billet::io
