#include "io/results/summary.h"

#include "contact/self/laps.h"
#include "contact/self/self_report.h"
#include "mechanics/linear/distributed/processes.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/time.h>

#include <algorithm>

namespace billet::io {

namespace {

using nlohmann::ordered_json;

ordered_json energy_json(const process::EnergyBalance& e) {
  return {{"external_work", e.external},
          {"elastic_energy", e.elastic},
          {"plastic_work", e.plastic},
          {"friction_work", e.friction},
          {"contact_energy", e.contact},
          {"grounding_work", e.stabilization},
          {"enforcement_work", e.penalty_update},
          {"lost_in_remeshing", e.remeshing},
          {"relative_error", e.error()}};
}

ordered_json wear_json(const process::Run& run, std::size_t tool) {
  const contact::WearMap& map = *run.model.wear->map(tool);
  const double strokes = run.tools()[tool].wear->strokes;
  const std::optional<contact::WearCell> deepest = map.deepest();
  const double depth = deepest ? deepest->depth : 0.0;
  ordered_json json{{"volume", map.volume()}, {"largest_depth", depth}};
  if (deepest) {
    const Vec3 at = deepest->shape.middle();
    const Vec3 now = run.contact()->pose(tool, run.state.time, run.state.x).to_space(at);
    json["at"] = {now[0], now[1], now[2]};
    json["at_in_tool_frame"] = {at[0], at[1], at[2]};
  }
  json["strokes"] = strokes;
  json["volume_extrapolated"] = strokes * map.volume();
  json["largest_depth_extrapolated"] = strokes * depth;
  if (const auto& workpiece = run.model.wear->workpiece(tool))
    json["workpiece"] = {
        {"volume", workpiece->volume},
        {"largest_depth", *std::max_element(workpiece->depth.begin(), workpiece->depth.end())}};
  return json;
}

/// Of a pair that never touched only that.
ordered_json window_json(const contact::Window& window) {
  ordered_json json{{"contact_time", window.contact_time}};
  if (window.contact_time > 0.0) {
    json["mean_area"] = window.mean_area;
    for (std::size_t q = 0; q < contact::n_window_quantities; ++q) {
      const contact::WindowRange& range = window.ranges[q];
      json[std::string(contact::window_names[q])] = {{"mean", range.mean},
                                                     {"lowest", range.lowest},
                                                     {"highest", range.highest},
                                                     {"last_mean", range.last_mean}};
    }
  }
  return json;
}

ordered_json largest_force_json(const LargestForce& largest) {
  const Vec3& force = largest.force;
  return {
      {"value", force.norm()}, {"vector", {force[0], force[1], force[2]}}, {"time", largest.time}};
}

ordered_json tools_json(const process::Run& run, std::span<const LargestForce> largest) {
  ordered_json tools = ordered_json::object();
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const contact::ToolLoad& load = run.contact()->loads()[t];
    const geometry::Motion& motion = run.tools()[t].motion;
    const Vec3 way = motion.translation(run.state.time, run.driven(t));
    const Vec3& offset = run.tools()[t].motion.offset;
    tools[run.tools()[t].name] = {
        {"force", {load.force[0], load.force[1], load.force[2]}},
        {"largest_force", largest_force_json(t < largest.size() ? largest[t] : LargestForce{})},
        {"torque", {load.torque[0], load.torque[1], load.torque[2]}},
        {"displacement", {way[0], way[1], way[2]}},
        {"turned", motion.angle(run.state.time, run.driven(t))},
        {"touch_offset", {offset[0], offset[1], offset[2]}}};
    if (const double error = run.tools()[t].chord_error; error > 0.0)
      tools[run.tools()[t].name]["chord_error"] = error;
    if (run.model.wear.get() != nullptr && run.model.wear->map(t))
      tools[run.tools()[t].name]["wear"] = wear_json(run, t);
    tools[run.tools()[t].name]["process_window"] = window_json(run.state.record.window.tool(t));
  }
  return tools;
}

ordered_json supports_json(const process::Run& run) {
  ordered_json supports = ordered_json::object();
  for (const process::SupportForce& support : process::support_forces(run))
    supports[support.name] = {{"force", {support.force[0], support.force[1], support.force[2]}}};
  return supports;
}

/// Where the workpiece touches itself.
ordered_json self_contact_json(const process::Run& run) {
  const contact::SelfContactState& state = run.model.self_contact->state();
  ordered_json json{{"area", state.area}, {"deepest_point", state.depth}};
  json["places"] = ordered_json::array();
  for (const contact::MeetingWalls& walls :
       contact::meeting_walls(*run.model.surface, state, run.positions()))
    json["places"].push_back({{"at", {walls.place[0], walls.place[1], walls.place[2]}},
                              {"since", walls.since},
                              {"area", walls.area},
                              {"length", walls.length},
                              {"mean_pressure", walls.mean_pressure}});
  return json;
}

/// Pockets that a tool closes off, and what is in them.
ordered_json trapped_json(const process::Run& run) {
  const contact::TrappedState& state = run.model.trapped->state();
  ordered_json json{{"closed", state.n_closed},
                    {"vented", state.n_vented},
                    {"filled", state.n_filled},
                    {"highest_pressure", state.highest},
                    {"work", state.work}};
  json["pockets"] = ordered_json::array();
  for (const contact::Pocket& pocket : state.pockets)
    json["pockets"].push_back({{"at", {pocket.place.centre[0], pocket.place.centre[1]}},
                               {"tool", run.tools()[pocket.place.tool].name},
                               {"since", pocket.since},
                               {"volume", pocket.volume},
                               {"volume_at_rest", pocket.rest_volume},
                               {"pressure", pocket.pressure}});
  return json;
}

/// Walls that have met: those that are there, and those that new meshes have welded.
ordered_json laps_json(const process::Run& run) {
  ordered_json all = ordered_json::array();
  if (run.model.self_contact)
    for (const contact::Lap& lap :
         contact::laps(*run.model.surface, run.model.self_contact->state(), run.positions()))
      all.push_back({{"at", {lap.place[0], lap.place[1], lap.place[2]}},
                     {"since", lap.since},
                     {"depth", lap.depth},
                     {"area", lap.area},
                     {"state", lap.closed ? "closed" : "open"}});
  for (const process::RemeshReport& report : run.state.record.remeshings)
    for (const process::Lap& lap : report.laps)
      if (!lap.root)
        all.push_back({{"at", {lap.at[0], lap.at[1], lap.at[2]}},
                       {"since", report.time},
                       {"depth", lap.depth},
                       {"state", "welded"}});
  return all;
}

ordered_json met_walls_json(const process::Run& run) {
  ordered_json all = ordered_json::array();
  for (const process::Wall& wall : run.state.walls)
    if (wall.met) {
      const auto& [low, high] = wall.met->box;
      all.push_back({{"wall", process::name_of_wall(wall)},
                     {"since", wall.met->since},
                     {"from", {low[0], low[1], low[2]}},
                     {"to", {high[0], high[1], high[2]}}});
    }
  return all;
}

ordered_json blows_json(const process::Run& run) {
  ordered_json blows = ordered_json::array();
  for (const process::BlowReport& blow : run.blows())
    blows.push_back({{"tool", run.tools()[blow.tool].name},
                     {"stage", blow.stage},
                     {"begun", blow.begun},
                     {"time", blow.time},
                     {"energy", blow.energy},
                     {"driven", blow.driven},
                     {"energy_used", blow.used},
                     {"energy_left", blow.left},
                     {"stroke", blow.stroke},
                     {"end_speed", blow.speed},
                     {"over", blow.over}});
  return blows;
}

ordered_json remeshings_json(const process::Run& run) {
  double volume = 0.0;
  double work = 0.0;
  double force = 0.0;
  double unbalanced = 0.0;
  for (const process::RemeshReport& r : run.state.record.remeshings) {
    volume = std::max(volume, r.volume.change());
    work = std::max(work, r.work_change());
    force = std::max(force, r.force_jump());
    unbalanced += r.balanced ? 0.0 : 1.0;
  }
  return {{"number", run.state.record.remeshings.size()},
          {"largest_change_of_volume", volume},
          {"largest_change_of_plastic_work", work},
          {"largest_force_jump", force},
          {"without_equilibrium", unbalanced},
          {"refused", run.state.record.refusals.size()}};
}

ordered_json timings_json(const process::PhaseTimes& t) {
  return {{"total", t.total},
          {"search", t.search},
          {"contact", t.contact},
          {"elements", t.elements},
          {"assembly", t.assembly},
          {"analysis", t.analysis},
          {"factorization", t.factorization},
          {"solve", t.solve},
          {"certificate", t.certificate},
          {"output", t.output},
          {"remeshing", t.remeshing},
          {"rest", t.rest()}};
}

ordered_json solver_json(const mechanics::SolverWork& work) {
  constexpr double giga = 1e9;
  constexpr double mega = 1e6;
  return {{"systems", work.systems},
          {"factorizations", work.factorizations},
          {"substitutions", work.substitutions},
          {"reused", work.reused},
          {"nearly_symmetric", work.nearly_symmetric},
          {"multigrid", work.multigrid},
          {"multigrid_failed", work.multigrid_failed},
          {"gigaflop", work.flops / giga},
          {"gigaflop_per_second",
           work.factorization > 0.0 ? work.flops / giga / work.factorization : 0.0},
          {"last",
           {{"method", work.last_method},
            {"gigaflop", work.last_flops / giga},
            {"megabytes", work.last_factor_bytes / mega}}}};
}

/// What the program as a whole has taken so far.
ordered_json resources_json() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  constexpr double kilobyte = 1024.0;
  ordered_json resources{{"processor_seconds", seconds(used.ru_utime) + seconds(used.ru_stime)},
                         {"peak_memory_bytes", kilobyte * static_cast<double>(used.ru_maxrss)}};
  for (const mechanics::ProcessMemory& memory : mechanics::memory_of_processes())
    resources["processes"].push_back({{"peak_memory_bytes", memory.peak},
                                      {"after_distribution_bytes", memory.after_distribution},
                                      {"after_set_up_bytes", memory.after_set_up},
                                      {"after_solve_bytes", memory.after_solve}});
  return resources;
}

} // namespace

std::string_view words_of(process::EndedBy reason) {
  switch (reason) {
  case process::EndedBy::energy_used_up:
    return "energy used up";
  case process::EndedBy::full_cavity:
    return "full cavity";
  case process::EndedBy::tools_overloaded:
    return "tools overloaded";
  case process::EndedBy::tools_together:
    return "tools together";
  case process::EndedBy::lap:
    return "lap";
  case process::EndedBy::end_of_time:
    break;
  }
  return "end of time";
}

std::string summary_text(const process::Run& run, const SummaryFacts& about) {
  const mechanics::Mesh& mesh = run.mesh();
  ordered_json summary;
  summary["title"] = about.title;
  summary["status"] = about.end.status;
  summary["exit_status"] = about.end.exit_status;
  summary["billet"] = about.facts.version;
  summary["units"] = about.units;
  summary["analysis"] = about.analysis;
  summary["element"] = mechanics::name(mesh.kind);
  summary["elements"] = mesh.n_elements();
  summary["nodes"] = mesh.n_points();
  summary["unknowns"] = mesh.n_points() * mesh.dimension();
  summary["threads"] = about.facts.threads;
  summary["blas_kernels"] = about.facts.blas_core;
  summary["time"] = run.state.time;
  summary["increments"] = run.state.increment;
  summary["iterations"] = run.state.counters.iterations;
  summary["cutbacks"] = run.state.counters.cutbacks;
  summary["iterations_of_failed_tries"] = run.state.counters.wasted_iterations;
  summary["iterations_on_new_meshes"] = run.state.counters.remeshing_iterations;
  if (about.last) {
    summary["volume"] = about.last->volume;
    summary["max_plastic_strain"] = about.last->max_plastic_strain;
    summary["min_quality"] = about.last->min_quality;
    summary["penetration"] = {{"last", about.last->max_penetration},
                              {"largest", about.largest_penetration},
                              {"largest_share_of_element", about.largest_share},
                              {"last_sampled", about.last->penetration.sampled},
                              {"last_at_contact_points", about.last->penetration.at_points},
                              {"penalty_raised_by", run.contact() != nullptr
                                                        ? run.contact()->state().penalty.trial
                                                        : 1.0},
                              {"how", "upper bound over every point of every face"}};
  }
  if (run.model.self_contact)
    if (ordered_json self = self_contact_json(run); !self["places"].empty())
      summary["self_contact"] = std::move(self);
  if (run.model.trapped)
    summary["trapped"] = trapped_json(run);
  if (ordered_json laps = laps_json(run); !laps.empty())
    summary["laps"] = std::move(laps);
  if (ordered_json walls = met_walls_json(run); !walls.empty())
    summary["met_walls"] = std::move(walls);
  summary["energy"] = energy_json(run.state.energy);
  summary["ended_by"] = words_of(run.state.ended_by);
  if (!run.blows().empty())
    summary["blows"] = blows_json(run);
  if (run.scene.remesh)
    summary["remeshings"] = remeshings_json(run);
  summary["grounded_rigid_motions"] = run.model.free_motions;
  summary["tools"] = tools_json(run, about.largest_forces);
  if (ordered_json supports = supports_json(run); !supports.empty())
    summary["supports"] = std::move(supports);
  if (!run.tools().empty())
    summary["process_window"] = window_json(run.state.record.window.total());
  summary["warnings"] = about.warnings;
  summary["failed_checks"] = ordered_json::array();
  for (const process::FailedCheck& check : about.end.failed)
    summary["failed_checks"].push_back({{"check", check.name}, {"what", check.what}});
  if (about.post)
    summary["failure"] = {{"time", about.post->time}, {"reason", about.post->reason}};
  summary["seconds"] = timings_json(run.clock.times);
  summary["resources"] = resources_json();
  summary["linear_solver"] = solver_json(run.solver_work());
  return summary.dump(2) + "\n";
}

} // namespace billet::io
