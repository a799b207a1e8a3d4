#include "io/results/run_writer.h"

#include "geometry/base/archive.h"
#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "io/case/read_case.h"
#include "io/results/advice.h"
#include "io/results/atomic_file.h"
#include "io/results/earlier_results.h"
#include "io/results/history_row.h"
#include "process/measures/squeeze.h"
#include "process/remeshing/part_boundary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

namespace billet::io {

namespace {

/// Frames of a run whose case says nothing about them.
constexpr double frames_by_default = 25.0;

/// Of the length of a run: times that differ by no more are one.
constexpr double rounding_of_time = 1e-9;

std::string analysis_name(Analysis analysis) {
  switch (analysis) {
  case Analysis::plane_strain:
    return "plane-strain";
  case Analysis::axisymmetric:
    return "axisymmetric";
  case Analysis::solid:
    return "3d";
  }
  return "";
}

/// A cell of a table, quoted: causes are free text.
std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string ledger_header(const process::Scene& scene) {
  std::string line =
      "remeshing,increment,time,cause,elements_before,elements_after,nodes_before,"
      "nodes_after,quality_before,quality_after,volume_before,volume_after,"
      "plastic_work_before,plastic_work_after,mean_plastic_strain_before,"
      "mean_plastic_strain_after,max_plastic_strain_before,"
      "max_plastic_strain_after,energy,residual,balanced,solved_again,force_jump,returned,seconds";
  for (const contact::Tool& tool : scene.tools)
    line += fmt::format(",{0}.force_before,{0}.force_after", tool.name);
  return line + "\n";
}

std::string ledger_row(const process::RemeshReport& r) {
  const auto pair = [](const process::RemeshReport::Pair& p) {
    return fmt::format(",{:.17g},{:.17g}", p.before, p.after);
  };
  std::string line =
      fmt::format("{},{},{:.17g},{},{},{},{},{}", r.number, r.increment, r.time, quoted(r.cause),
                  r.elements[0], r.elements[1], r.nodes[0], r.nodes[1]);
  line += pair(r.quality) + pair(r.volume) + pair(r.plastic_work) + pair(r.mean_strain) +
          pair(r.largest_strain);
  line += fmt::format(",{:.17g},{:.17g},{:d},{:d},{:.17g},{},{:.6g}", r.energy, r.residual,
                      r.balanced, r.again, r.force_jump(), r.returned, r.seconds);
  for (const process::RemeshReport::Pair& force : r.forces)
    line += pair(force);
  return line + "\n";
}

std::vector<std::string> iteration_columns() {
  return {"increment", "time", "iteration", "residual", "correction", "step", "contact_changes"};
}

std::string in_words(process::CheckpointReason reason) {
  switch (reason) {
  case process::CheckpointReason::due:
    return "in the midst of the run";
  case process::CheckpointReason::new_stage:
    return "end of a stage";
  case process::CheckpointReason::end:
    return "end of the run";
  case process::CheckpointReason::stopped:
    return "stopped by a signal";
  case process::CheckpointReason::failed:
    return "an increment could not be solved";
  }
  return "";
}

} // namespace

RunWriter::RunWriter(std::filesystem::path folder,
                     std::string name,
                     const Case& content,
                     RunFacts facts,
                     const RunBeginning& beginning)
    : folder_(std::move(folder)), name_(std::move(name)), content_(&content),
      facts_(std::move(facts)), settings_{content.units, analysis_name(content.analysis),
                                          content.title},
      every_(content.output.every.value_or(content.time.end / frames_by_default)),
      beginning_(beginning), stored_wall_(seconds_now()) {
  make_folder(folder_, Durable::yes);
  lock_.emplace(folder_);
  make_folder(folder_ / "frames");
  write_file(folder_ / "case.resolved.toml", resolved_toml(content));
  if (beginning_.checkpoint != nullptr) {
    ArchiveReader stored(beginning_.checkpoint->results);
    stored(record_);
  }
  // Only now that the folder has proved writable.
  remove_partial_files(folder_);
  if (beginning_.checkpoint != nullptr && beginning_.same_folder) {
    remove_later(folder_, record_.frames, name_);
    remove_checkpoints_after(folder_, beginning_.checkpoint->increment);
  } else {
    remove_earlier_run(folder_);
    record_.entries.clear();
    record_.frames = 0;
    record_.history_rows = record_.iteration_rows = 0;
  }
  synchronize(folder_); // lest a power cut bring an earlier summary back
}

RunWriter::~RunWriter() {
  try {
    if (record_.entries.size() > n_listed_)
      write_list();
  } catch (const std::exception&) { // a full disk, say, of which the run has told
  }
}

void RunWriter::started(const process::Run& run) {
  if (beginning_.checkpoint == nullptr)
    record_.scene = scene_fingerprint(run.scene);
  if (run.scene.remesh) {
    record_.ledger = ledger_header(run.scene);
    write_file(folder_ / "remesh.csv", record_.ledger);
  }
  history_.emplace(folder_ / "history.csv", history_columns(run.scene));
  iterations_.emplace(folder_ / "iterations.csv", iteration_columns());
  write_frame(run);
}

void RunWriter::resumed(const process::Run& run) {
  stored_at_ = run.state.time;
  if (!beginning_.same_folder) {
    started(run);
    return;
  }
  if (run.scene.remesh)
    write_file(folder_ / "remesh.csv", record_.ledger);
  history_ =
      CsvWriter::resume(folder_ / "history.csv", history_columns(run.scene), record_.history_rows);
  iterations_ =
      CsvWriter::resume(folder_ / "iterations.csv", iteration_columns(), record_.iteration_rows);
  write_list();
}

bool RunWriter::wants_checkpoint(const process::Run& run, process::CheckpointReason reason) {
  reason_ = reason;
  if (reason != process::CheckpointReason::due)
    return true;
  const CheckpointInterval& interval = content_->output.checkpoint_every;
  if (interval.wall_clock)
    return seconds_now() - stored_wall_ >= interval.length;
  const double slack = rounding_of_time * content_->time.end;
  return std::floor((run.state.time + slack) / interval.length) >
         std::floor((stored_at_ + slack) / interval.length);
}

void RunWriter::checkpoint(const process::Run& run, const std::string& stored) {
  std::error_code error; // there is none where the run is not logged
  const std::uintmax_t size = std::filesystem::file_size(folder_ / "run.log", error);
  record_.log_size = error ? 0 : size;
  stored_at_ = run.state.time;
  stored_wall_ = seconds_now();
  ArchiveWriter results;
  results(record_);
  const std::time_t now = std::time(nullptr);
  write_checkpoint(folder_, {.version = facts_.version,
                             .title = content_->title,
                             .reason = in_words(reason_),
                             .written = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(now)),
                             .time = run.state.time,
                             .increment = run.state.increment,
                             .stage = run.state.progress.stage,
                             .n_unknowns = run.positions().size(),
                             .scene = record_.scene,
                             .content = resolved_toml(*content_),
                             .run = stored,
                             .results = results.take()});
}

std::optional<std::uintmax_t> RunWriter::size_of_log() const {
  const bool goes_on = beginning_.checkpoint != nullptr && beginning_.same_folder;
  return goes_on ? std::optional(record_.log_size) : std::nullopt;
}

bool RunWriter::frame_due(double time) const {
  const double slack = rounding_of_time * content_->time.end;
  if (std::floor((time + slack) / every_) > std::floor((record_.last_frame + slack) / every_))
    return true;
  for (const double at : content_->output.at)
    if (std::abs(at - time) <= slack)
      return true;
  return false;
}

void RunWriter::incremented(const process::Run& run, const process::IncrementReport& report) {
  history_->row(history_row(run, report));
  ++record_.history_rows;
  record_.iteration_rows += report.records.size();
  note_largest_forces(run, report.time, record_.largest_forces);
  for (const mechanics::IterationRecord& record : report.records)
    iterations_->row(std::array<double, 7>{static_cast<double>(report.increment), report.time,
                                           static_cast<double>(record.iteration), record.residual,
                                           record.correction, record.step,
                                           static_cast<double>(record.contact_changes)});
  record_.largest_penetration = std::max(record_.largest_penetration, report.max_penetration);
  record_.largest_share = std::max(record_.largest_share, report.penetration_share);
  note_unmet_tools(run, report);
  constexpr double bad = 0.1; // below it elements hardly deform as they should
  if (!record_.worn && report.min_quality < bad)
    record_.worn = report;
  if (!record_.squeezed_at && report.max_plastic_strain > 0.0 &&
      process::has_lost_volume(run, report.volume) &&
      process::squeeze_of(run, report.volume).is_full())
    record_.squeezed_at = report.time;
  const double missed =
      report.energy.missing() - (record_.last ? record_.last->energy.missing() : 0.0);
  if (std::abs(missed) > std::abs(record_.most_missed)) {
    record_.most_missed = missed;
    record_.most_missed_at = report.time;
  }
  record_.last = report;
  if (frame_due(report.time))
    write_frame(run);
}

void RunWriter::write_frame(const process::Run& run) {
  const std::vector<Vec3> points = points_of(run.positions(), run.mesh().dimension());
  const std::string number = fmt::format("{:04d}", record_.frames++);
  // The list gets a file's name only once the file is there.
  const auto add = [&](const std::string& part, const auto& write, const auto& frame,
                       const std::string& suffix) {
    const std::filesystem::path file =
        std::filesystem::path("frames") / (part + "_" + number + suffix);
    write(folder_ / file, frame);
    record_.entries.push_back({run.state.time, part, file});
  };
  WorkpieceFrame workpiece = workpiece_frame(run, points, settings_);
  select_fields(workpiece.point_fields, content_->output);
  select_fields(workpiece.cell_fields, content_->output);
  add("workpiece", write_vtu, workpiece, ".vtu");
  if (run.contact() != nullptr) {
    SurfaceFrame contact = contact_frame(run, points, settings_);
    select_fields(contact.cell_fields, content_->output);
    add("contact", write_vtp, contact, ".vtp");
  }
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    SurfaceFrame tool = tool_frame(run, t, points, settings_);
    select_fields(tool.cell_fields, content_->output);
    add("tool-" + run.tools()[t].name, write_vtp, tool, ".vtp");
  }
  record_.last_frame = run.state.time;
  // A list for every frame would be a quarter of what small frames cost.
  constexpr double often = 0.1; // [s]
  if (const double now = seconds_now(); now - listed_ > often) {
    write_list();
    listed_ = now;
  }
}

void RunWriter::write_list() {
  write_pvd(folder_ / (name_ + ".pvd"), record_.entries);
  n_listed_ = record_.entries.size();
}

void RunWriter::failed(const process::Run& run, const process::PostMortem& post) {
  post_ = post;
  make_folder(folder_ / "failure");
  const std::vector<Vec3> points = points_of(run.positions(), run.mesh().dimension());
  write_vtu(folder_ / "failure" / "last_good.vtu", workpiece_frame(run, points, settings_));
  std::string text = fmt::format("time {:.10g} could not be reached (increment {:.4g}): {}\n",
                                 post.time, post.dt, post.reason);
  const std::string worst = post.worst_node < 0
                                ? "deepest in a tool"
                                : fmt::format("largest residual at node {}", post.worst_node);
  text += fmt::format("{} near ({:.6g}, {:.6g}, {:.6g})\n", worst, post.worst_position[0],
                      post.worst_position[1], post.worst_position[2]);
  text += "tried:\n";
  for (const std::string& line : post.tried)
    text += "  " + line + "\n";
  text += "iterations of the last try (residual, correction, step, solver):\n";
  for (const mechanics::IterationRecord& r : post.records)
    text += fmt::format("  {:3d} {:.3e} {:.3e} {:.3f} {}\n", r.iteration, r.residual, r.correction,
                        r.step, r.solver);
  text += "what may help:\n";
  for (const std::string& line : advice(run))
    text += "  " + line + "\n";
  write_file(folder_ / "failure" / "post_mortem.txt", text);
}

std::vector<std::string> RunWriter::advice(const process::Run& run) const {
  return post_ ? io::advice(*content_, run, *post_) : std::vector<std::string>();
}

void RunWriter::remeshing(const process::Run& run) {
  if (run.state.time > record_.last_frame)
    write_frame(run);
}

void RunWriter::remeshed(const process::Run& run, const process::RemeshReport& report) {
  if (record_.worn && record_.worn->increment == report.increment)
    record_.worn.reset(); // replaced before time went on
  record_.ledger += ledger_row(report);
  write_file(folder_ / "remesh.csv", record_.ledger);
  for (std::string& line : report.complaints())
    record_.complaints.push_back(std::move(line));
  write_frame(run);
}

void RunWriter::finished(const process::Run& run) {
  if (run.state.time > record_.last_frame)
    write_frame(run);
}

/// A power cut may take what is not on the disk: everything but the summary, then its folders.
void RunWriter::synchronize_results() const {
  for (const PvdEntry& entry : record_.entries)
    synchronize(folder_ / entry.file);
  const std::string list = name_ + ".pvd";
  for (const char* file : {list.c_str(), "history.csv", "iterations.csv", "remesh.csv", "run.log",
                           "case.resolved.toml", "failure/last_good.vtu", "failure/post_mortem.txt",
                           "failure", "frames", ""})
    synchronize(folder_ / file);
}

void RunWriter::write_summary(const process::Run& run,
                              const RunEnd& end,
                              std::vector<std::string> warnings) {
  if (record_.entries.size() > n_listed_)
    write_list();
  synchronize_results();
  warnings.insert(warnings.begin(), facts_.warnings.begin(), facts_.warnings.end());
  const std::string text =
      summary_text(run, {content_->title, content_->units.name, settings_.analysis, facts_, end,
                         record_.last, record_.largest_penetration, record_.largest_share,
                         record_.largest_forces, std::move(warnings), post_});
  write_file(folder_ / "summary.json", text, Durable::yes);
}

} // namespace billet::io
