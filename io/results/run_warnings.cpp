// What a run reports about itself at its end: figures that are off, and what corrects them.

#include "contact/self/laps.h"
#include "io/case/material_range.h"
#include "io/results/run_writer.h"
#include "process/measures/film.h"
#include "process/measures/squeeze.h"
#include "process/remeshing/contact_zones.h"
#include "process/remeshing/laps.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/remeshing_due.h"
#include "process/setup/tool_meetings.h"
#include "process/stages/overlap.h"
#include "process/state/mesh_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace billet::io {

namespace {

constexpr double tolerated_penetration = 0.02; // of the parent element

bool moves(const geometry::Motion& motion) {
  return motion.velocity || motion.displacement || motion.crank || motion.rotation ||
         motion.force || motion.torque;
}

using Lines = std::vector<std::string>;

void on_refused_meshes(const process::Run& run, const UnitSystem& units, Lines& lines) {
  if (const auto refused = run.state.record.refusals; !refused.empty())
    lines.push_back(fmt::format(
        "warning: [new-mesh-refused] {} time(s) a new mesh was wanted and could not be made, "
        "first at t = {:.6g} {}: {}",
        refused.size(), refused.front().time, units.time, refused.front().why));
}

/// Where the balance of energy missed the most.
struct MostMissed {
  double work; ///< of the balance, in one increment [N mm]
  double at;   ///< the end of that increment [s]
};

void on_work_missing(const process::Run& run,
                     const UnitSystem& units,
                     const MostMissed& most,
                     Lines& lines) {
  const process::EnergyBalance& energy = run.state.energy;
  constexpr double budget = 0.005;
  if (energy.error() > budget && std::abs(energy.missing()) > energy.nothing)
    lines.push_back(fmt::format(
        "warning: [energy-missing] the balance of energy misses {:.1f} % ({:.3g} {} {}), most in "
        "the increment that "
        "ends at t = {:.6g} {} ({:.3g}): a part that slips off an edge or buckles loses energy, "
        "and forces that change much within an increment are integrated badly; a shorter "
        "time.increments.max shows which",
        100.0 * energy.error(), energy.missing(), units.force, units.length, most.at, units.time,
        most.work));
  if (energy.stabilization > budget * energy.scale())
    lines.push_back(fmt::format(
        "warning: [stabilization-work] {:.1f} % of the work ({:.3g} {} {}) went into the "
        "stabilization, which holds the "
        "part "
        "where neither supports nor tools do: forces and shape are off by as much and more; a "
        "[[support]] for its free motions helps",
        100.0 * energy.stabilization / energy.scale(), energy.stabilization, units.force,
        units.length));
}

/// Of work that new meshes or contact itself have done.
void on_work_made(const process::Run& run, const UnitSystem& units, Lines& lines) {
  const process::EnergyBalance& energy = run.state.energy;
  constexpr double most_lost = 0.02; // hub-forging-3d, of Coulomb's friction: 0.5 %
  if (std::abs(energy.remeshing) > std::max(energy.nothing, most_lost * energy.scale()))
    lines.push_back(fmt::format(
        "warning: [work-lost-remeshing] {:.1f} % of the work ({:.3g} {} {}) was lost (negative: "
        "made) by carrying the "
        "part over to new meshes: energy in remesh.csv tells which; finer meshes lose less",
        100.0 * energy.remeshing / energy.scale(), energy.remeshing, units.force, units.length));
  constexpr double unpaid = 0.02;
  if (std::abs(energy.penalty_update) > std::max(energy.nothing, unpaid * energy.scale()))
    lines.push_back(fmt::format(
        "warning: [work-by-contact] {:.1f} % of the work ({:.3g} {} {}) was done by no tool's "
        "motion but by contact "
        "itself, which holds faces out of tools (C.44) or presses harder: faces are too long for "
        "the tools' curvature, and metal is bent that no tool bends; smaller elements (for "
        "quadratic ones also contact.form = \"compatible\") help",
        100.0 * energy.penalty_update / energy.scale(), energy.penalty_update, units.force,
        units.length));
}

/// Of systems that multigrid did not solve: they cost time, and right they are all the same.
void on_multigrid(const process::Run& run, Lines& lines) {
  const mechanics::SolverWork work = run.solver_work();
  if (work.multigrid_failed > 0)
    lines.push_back(fmt::format(
        "warning: [multigrid-failed] multigrid did not solve {} of {} systems that it was set up "
        "for: they were "
        "factorized, or the increment was taken shorter where no factorization has room; with "
        "many of them solver.linear = \"cholmod\" may be faster",
        work.multigrid_failed, work.multigrid_failed + work.multigrid));
}

void on_lagged_friction(const process::Run& run, Lines& lines) {
  if (const int increments = run.state.counters.friction_lagged; increments > 0)
    lines.push_back(fmt::format(
        "warning: [friction-lagged] in {} of {} increments contact points that kept changing "
        "between stick and slip slid with the friction of their pressure at the start of the "
        "increment, and the friction of a tool was more than 1 % off: no other equilibrium was "
        "found. With more than a few per cent of the increments compare with shorter ones "
        "(time.increments.max)",
        increments, run.state.increment));
}

/// A stage or the run that ended before a blow did.
void on_cut_blows(const process::Run& run, const UnitSystem& units, Lines& lines) {
  constexpr double little = 0.01; // of the energy
  const double end = run.scene.stages.back().end;
  for (const process::BlowReport& blow : run.blows())
    if (!blow.over && blow.left > little * blow.energy &&
        (blow.time < run.state.time || run.state.time == end))
      lines.push_back(
          fmt::format("warning: [blow-cut] the blow of {} that began at t = {:.6g} {} had {:.3g} % "
                      "of its energy "
                      "left when its stage ended, at {:.6g} {}: give the stage a later end",
                      run.tools()[blow.tool].name, blow.begun, units.time,
                      100.0 * blow.left / blow.energy, blow.time, units.time));
}

/// Tools whose points touch anew in every increment, as under a narrow contact that travels.
void on_unexpected_touches(const process::Run& run, const Case& content, Lines& lines) {
  constexpr double much = 0.1;
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const process::TouchRecord& touches = run.state.record.touches[t];
    if (touches.unexpected > much * touches.impulse &&
        !std::holds_alternative<contact::Frictionless>(content.tools[t].friction.law))
      lines.push_back(fmt::format(
          "warning: [new-touches] on tool {} {:.0f} % of the normal force lay at points that came "
          "to "
          "touch within their increment and have no friction there: its friction and wear are too "
          "low by about as much; take shorter increments (time.increments.max) or a finer mesh",
          run.tools()[t].name, 100.0 * touches.unexpected / touches.impulse));
  }
}

void on_fading_forces(const process::Run& run, Lines& lines) {
  constexpr double springback = 0.01; // of the plastic work: reverse flow of a bend is less
  if (const double flow = run.state.leaving.flow_in_decay;
      flow > springback * run.state.energy.plastic)
    lines.push_back(fmt::format(
        "warning: [fading-forces] {:.2g} % of the plastic work was done while forces of tools that "
        "had left faded: "
        "they keep their direction, and a thin part pressed from both sides folds under them as no "
        "part does whose tools move back; end the stage before with unload, or let the tools move "
        "back",
        100.0 * flow / run.state.energy.plastic));
}

void on_resolution(const process::Run& run, const Case& content, Lines& lines) {
  for (const process::ContactZone& zone : process::poorly_resolved_tools(run))
    lines.push_back(fmt::format("warning: [few-elements-touch] at the end {} touches on {} of "
                                "elements only, {:.3g} {} long: too few for its "
                                "force, which can be far too high; {}",
                                run.tools()[static_cast<std::size_t>(zone.tool)].name,
                                process::sides_of(zone), zone.length, content.units.length,
                                content.remesh
                                    ? "a smaller remesh.size.min would let a new mesh follow it"
                                    : "a finer mesh there or a [remesh] section helps"));
  constexpr double most_of_corner = 0.5;
  if (const process::CornerLoad load = process::most_at_corner(run); load.share > most_of_corner)
    lines.push_back(fmt::format(
        "warning: [corner-pressure] at the end {:.0f} % of the pressure on {} is that of its "
        "corners on single "
        "faces: "
        "its force is that of elements of this size, a sharper tool or a finer mesh gets another "
        "one; round the edge, and let elements be smaller than the rounding",
        100.0 * load.share, run.tools()[load.tool].name));
}

void on_overlapping_tools(const process::Run& run, const UnitSystem& units, Lines& lines) {
  for (const process::ToolMeeting& overlap : process::overlapping_tools(run))
    lines.push_back(fmt::format(
        "warning: [tools-overlap] at the end tools '{}' and '{}' overlap by {:.3g} {} at ({:.6g}, "
        "{:.6g}, {:.6g}): "
        "they do not feel each other, and nothing stops what a load drives once the part has left "
        "it; what was found since is wrong: let it act no longer than it holds the part (stages, "
        "active)",
        run.tools()[overlap.first].name, run.tools()[overlap.second].name, overlap.depth,
        units.length, overlap.place[0], overlap.place[1], overlap.place[2]));
}

void on_initial_penetrations(const process::Run& run, const UnitSystem& units, Lines& lines) {
  for (const process::InitialPenetration& penetration : run.state.record.initial_penetrations)
    lines.push_back(fmt::format(
        "warning: [starts-inside] tool {} began to act at t = {:.6g} {} inside the workpiece, {}: "
        "{}; a tool goes "
        "on its way while it does not act, so let it begin where it is clear",
        run.tools()[penetration.tool].name, penetration.time, units.time, penetration.where,
        run.state.time <= penetration.time ? "it could not be pushed out in one increment"
                                           : "it was pushed out in one increment"));
}

/// Walls that have met remain a defect, whether or not they touch now.
void on_walls_that_met(const process::Run& run, const Case& content, Lines& lines) {
  if (!run.model.self_contact)
    return;
  std::vector<contact::Lap> laps =
      contact::laps(*run.model.surface, run.model.self_contact->state(), run.positions());
  constexpr double noticed = 0.25; // of an element
  std::erase_if(laps, [&](const contact::Lap& lap) {
    return lap.depth < noticed * process::mean_side(run.mesh());
  });
  if (laps.empty())
    return;
  const contact::Lap& deepest =
      *std::max_element(laps.begin(), laps.end(), [](const contact::Lap& a, const contact::Lap& b) {
        return a.depth < b.depth;
      });
  lines.push_back(fmt::format(
      "warning: [walls-met] walls of the part have met: {}, {:.3g} {} deep near ({:.6g}, {:.6g}, "
      "{:.6g}), "
      "since "
      "t = {:.6g} {}, at the end {}; lap_depth in the frames shows it, laps of summary.json lists "
      "all",
      laps.size() == 1 ? "a lap" : fmt::format("{} laps, the deepest", laps.size()), deepest.depth,
      content.units.length, deepest.place.x(), deepest.place.y(), deepest.place.z(), deepest.since,
      content.units.time, deepest.closed ? "closed" : "open"));
}

/// What is left in a pocket at the end keeps the die from being filled there.
void on_trapped(const process::Run& run, const Case& content, Lines& lines) {
  if (!run.model.trapped || run.model.trapped->state().pockets.empty())
    return;
  const std::vector<contact::Pocket>& pockets = run.model.trapped->state().pockets;
  const contact::Pocket& largest =
      *std::max_element(pockets.begin(), pockets.end(),
                        [](const auto& a, const auto& b) { return a.volume < b.volume; });
  lines.push_back(fmt::format(
      "warning: [pocket-closed] {} closed off at the end, {}near ({:.6g}, {:.6g}) on tool {}: "
      "{:.3g} of {:.3g} "
      "{}^3 left, {:.4g} {} above the surroundings; a vent there would let it out, trapped in "
      "summary.json lists all",
      pockets.size() == 1 ? "a pocket is" : fmt::format("{} pockets are", pockets.size()),
      pockets.size() == 1 ? "" : "the largest ", largest.place.centre.x(), largest.place.centre.y(),
      run.tools()[largest.place.tool].name, largest.volume, largest.rest_volume,
      content.units.length, largest.pressure, content.units.stress));
}

void on_met_walls(const process::Run& run, const Case& content, Lines& lines) {
  for (const process::Wall& wall : run.state.walls)
    if (wall.met)
      lines.push_back(fmt::format(
          "warning: [symmetry-wall-met] metal came to {} from outside, between ({:.6g}, {:.6g}, "
          "{:.6g}) and ({:.6g}, "
          "{:.6g}, {:.6g}) {}, first at t = {:.6g} {}: {}",
          process::name_of_wall(wall), wall.met->box.low.x(), wall.met->box.low.y(),
          wall.met->box.low.z(), wall.met->box.high.x(), wall.met->box.high.y(),
          wall.met->box.high.z(), content.units.length, wall.met->since, content.units.time,
          wall.axis ? "a bore is closed there" : "there it has met its image, a lap"));
}

void on_laps(const process::Run& run, const Case& content, Lines& lines) {
  for (const process::Lap& lap : process::laps(run))
    lines.push_back(
        fmt::format("warning: [boundary-crosses] at the end the boundary of the part crosses "
                    "itself near {}, {:.3g} {} deep: "
                    "{}; {}",
                    lap.place, lap.depth, content.units.length,
                    run.model.self_contact
                        ? "a crease there is narrower than the elements at its root"
                        : "contact.self = false, so metal that folds over does not feel itself",
                    content.remesh ? "the next new mesh would have welded the lap"
                                   : "a [remesh] section welds laps and says where"));
}

} // namespace

void RunWriter::note_unmet_tools(const process::Run& run, const process::IncrementReport& report) {
  if (run.contact() == nullptr)
    return;
  record_.unmet.resize(run.tools().size());
  for (std::size_t t = 0; t < record_.unmet.size(); ++t) {
    record_.unmet[t].acts = record_.unmet[t].acts || run.contact()->acts(t, report.time);
    record_.unmet[t].met = record_.unmet[t].met || contact::lies_on(*run.contact(), t);
  }
  UnmetTool& deepest = record_.unmet[report.penetration.tool];
  constexpr double noticed = 2e-3; // of the parent element
  if (report.penetration_share > noticed) {
    if (deepest.depth == 0.0)
      deepest.time = report.time;
    deepest.depth = std::max(deepest.depth, report.penetration.sampled);
  }
}

void RunWriter::warn_of_unmet_tools(const process::Run& run,
                                    std::vector<std::string>& lines) const {
  for (std::size_t t = 0; t < record_.unmet.size(); ++t)
    if (!record_.unmet[t].met && record_.unmet[t].depth > 0.0)
      lines.push_back(fmt::format(
          "warning: [tool-unfelt] from t = {:.6g} {} on tool {} is in the part, up to {:.3g} {} "
          "deep, and no "
          "contact point meets it, so it has no force: it is narrower than they are apart, or a "
          "hollow that element edges are too long for; take smaller elements there",
          record_.unmet[t].time, content_->units.time, run.tools()[t].name, record_.unmet[t].depth,
          content_->units.length));
  for (std::size_t t = 0; t < record_.unmet.size(); ++t)
    if (record_.unmet[t].acts && !record_.unmet[t].met && record_.unmet[t].depth == 0.0 &&
        moves(run.tools()[t].motion) && run.state.time == run.scene.stages.back().end)
      lines.push_back(fmt::format(
          "warning: [tool-untouched] tool {} has not touched the workpiece: does it move "
          "far enough, and the right way?",
          run.tools()[t].name));
}

void RunWriter::warn_of_penetration(std::vector<std::string>& lines) const {
  if (record_.largest_share > tolerated_penetration)
    lines.push_back(fmt::format(
        "warning: [face-in-tool] between its contact points a face lay up to {:.3g} {} inside a "
        "tool, "
        "{:.1f} % of the parent element; a finer mesh there (for quadratic elements also "
        "contact.form = \"compatible\") lessens it",
        record_.largest_penetration, content_->units.length, 100.0 * record_.largest_share));
}

void RunWriter::warn_of_elements(const process::Run& run, std::vector<std::string>& lines) const {
  if (record_.worn)
    lines.push_back(
        fmt::format("warning: [bad-elements] from t = {:.6g} {} on elements are badly distorted "
                    "(quality {:.2g}, at the end {:.2g}): their results cannot be trusted; {}",
                    record_.worn->time, content_->units.time, record_.worn->min_quality,
                    record_.last->min_quality,
                    !content_->remesh ? "a [remesh] section would have replaced the mesh"
                    : run.state.record.refusals.empty()
                        ? "new meshes were not better for long (remesh.csv: quality_after), sharp "
                          "edges of tools do that: a smaller remesh.size.min may help"
                        : "no new mesh could be made in time: the log says why"));
}

/// Why a run ended before its time; empty: it did not.
std::string RunWriter::early_end(const process::Run& run) const {
  const UnitSystem& units = content_->units;
  const auto ended = [&](std::string_view code, const std::string& why, std::string_view key) {
    return fmt::format(
        "warning: [{}] the run ended at t = {:.6g} {}, before its time: {}. stop.{} = "
        "false goes on",
        code, run.state.time, units.time, why, key);
  };
  const auto squeezed = [&](std::string_view what) {
    const process::Squeeze now = process::squeeze_of(run, record_.last->volume);
    return fmt::format(
        "{}; the metal is squeezed by {:.2g} % of its volume, under {:.3g} {} on "
        "average, {:.2g} times its flow stress, and a tool presses with {:.3g} {} on "
        "average",
        what, 100.0 * now.volume_lost, now.pressure, units.stress, now.pressure / now.flow_stress,
        now.tool_pressure, units.stress);
  };
  switch (run.state.ended_by) {
  case process::EndedBy::full_cavity:
    return ended("full-cavity", squeezed("the cavity is full, or its outlet is too small"),
                 "on_full_cavity");
  case process::EndedBy::tools_overloaded:
    return ended("tools-overloaded", squeezed("no tool bears what the tools would have to"),
                 "on_tools_overloaded");
  case process::EndedBy::tools_together:
    if (const auto film = process::closing_film(run, run.state.last_dt))
      return ended(
          "tools-together",
          fmt::format("tools '{}' and '{}' lie on each other near ({:.6g}, {:.6g}, {:.6g}), "
                      "but for a film of metal {:.3g} {} thick",
                      run.tools()[film->first].name, run.tools()[film->second].name,
                      film->place.x(), film->place.y(), film->place.z(), film->thickness,
                      units.length),
          "on_tools_together");
    break;
  case process::EndedBy::lap:
    return fmt::format(
        "warning: [lap-limit] the run ended at t = {:.6g} {}, before its time: a lap is deeper "
        "than stop.on_lap = {:.6g} {}; laps of summary.json tells where",
        run.state.time, units.time, run.scene.stop.on_lap.value_or(0.0), units.length);
  case process::EndedBy::end_of_time:
  case process::EndedBy::energy_used_up:
    break;
  }
  return "";
}

void RunWriter::warn_of_metal(const process::Run& run, std::vector<std::string>& lines) const {
  if (const std::string end = early_end(run); !end.empty())
    lines.push_back(end);
  else if (record_.squeezed_at) {
    const process::Squeeze now = process::squeeze_of(run, record_.last->volume);
    lines.push_back(fmt::format(
        "warning: [metal-squeezed] from t = {:.6g} {} on the metal is squeezed by more than 1 % of "
        "its volume, at "
        "the end by {:.2g} %, under {:.3g} {} on average, {:.2g} times its flow stress: the cavity "
        "is full, or its outlet is too small",
        *record_.squeezed_at, content_->units.time, 100.0 * now.volume_lost, now.pressure,
        content_->units.stress, now.pressure / now.flow_stress));
  }
  if (record_.last) {
    const mechanics::Material& material = run.model.bulk->material();
    const double left = mechanics::flow_stress_left(
        material.flow, {record_.last->max_plastic_strain, 1.0, material.temperature});
    constexpr double soft = 0.5;
    if (left < soft)
      lines.push_back(
          fmt::format("warning: [softening] at the largest plastic strain, {:.3g}, the flow law "
                      "has {:.0f} % of "
                      "its largest stress left: metal that "
                      "softens so far flows in bands as thin as its elements, and forces depend on "
                      "their size; let the law "
                      "end where its measured curves do (eps_max of hansel-spittel, a table)",
                      record_.last->max_plastic_strain, 100.0 * left));
  }
  if (const auto left =
          left_range(content_->materials.at(content_->workpiece.material), *run.model.bulk))
    lines.push_back(*left);
}

std::vector<std::string> RunWriter::warnings(const process::Run& run) const {
  Lines lines;
  warn_of_unmet_tools(run, lines);
  on_refused_meshes(run, content_->units, lines);
  warn_of_penetration(lines);
  on_work_missing(run, content_->units, {record_.most_missed, record_.most_missed_at}, lines);
  on_work_made(run, content_->units, lines);
  on_lagged_friction(run, lines);
  on_multigrid(run, lines);
  on_unexpected_touches(run, *content_, lines);
  on_fading_forces(run, lines);
  on_cut_blows(run, content_->units, lines);
  on_resolution(run, *content_, lines);
  on_overlapping_tools(run, content_->units, lines);
  on_initial_penetrations(run, content_->units, lines);
  on_walls_that_met(run, *content_, lines);
  on_met_walls(run, *content_, lines);
  on_trapped(run, *content_, lines);
  on_laps(run, *content_, lines);
  warn_of_elements(run, lines);
  warn_of_metal(run, lines);
  lines.insert(lines.end(), record_.complaints.begin(), record_.complaints.end());
  return lines;
}

} // namespace billet::io
