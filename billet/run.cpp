#include "billet/run.h"

#include "geometry/base/archive.h"
#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/case/suggestion.h"
#include "io/results/checkpoint.h"
#include "io/results/checksum.h"
#include "io/results/frames.h"
#include "io/results/history_row.h"
#include "io/results/summary.h"
#include "io/scene/scene_builder.h"
#include "mechanics/linear/blas.h"
#include "mechanics/linear/helper_signals.h"
#include "process/loop/early_end.h"
#include "process/loop/process.h"
#include "process/loop/run_checks.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "billet/case_inside.h"
#include "billet/translated.h"

namespace billet {

namespace {

Increment increment_of(const process::IncrementReport& report) {
  Increment increment{report.increment, report.time, report.dt,    report.iterations,
                      report.cutbacks,  {},          report.events};
  for (const mechanics::IterationRecord& record : report.records)
    increment.residuals.push_back(record.residual);
  return increment;
}

/// What a run has told of its increments.
struct Told {
  Increment last;
  std::vector<double> history; ///< shape (n_increments, n_columns)

  template <class Archive> void fields(Archive& archive) {
    archive(last.number, last.time, last.length, last.iterations, last.cutbacks, last.residuals,
            last.events, history);
  }
};

/// Ends a run after each increment; keeps what was told of it, and why one could not be solved.
class OneIncrement final : public process::Observer {
public:
  Told told;
  std::string reason;

  void begin() { solved_ = false; }
  void incremented(const process::Run& run, const process::IncrementReport& report) override {
    solved_ = true;
    told.last = increment_of(report);
    const std::vector<double> row = io::history_row(run, report);
    told.history.insert(told.history.end(), row.begin(), row.end());
  }
  void failed(const process::Run&, const process::PostMortem& post) override {
    reason = post.reason;
  }
  [[nodiscard]] bool stop_requested() const override { return solved_; }

private:
  bool solved_ = false;
};

/// A run as it was saved, and of what.
struct Saved {
  std::string content; ///< the resolved case
  std::string scene;   ///< fingerprint of mesh and tools
  std::size_t stage = 0;
  Told told;
  std::int32_t status = 0; ///< a Status
  std::string reason;
  std::string run; ///< of the process

  template <class Archive> void fields(Archive& archive) {
    archive(content, scene, stage, told, status, reason, run);
  }
};

constexpr std::string_view saved_by = "billet run " BILLET_VERSION;

/// In front of it.
struct SavedHeader {
  std::string version{saved_by};
  std::uint32_t checksum = 0; ///< of what follows

  template <class Archive> void fields(Archive& archive) { archive(version, checksum); }
};

std::string bytes_of(const Saved& saved) {
  const std::string content = archived(saved);
  SavedHeader header;
  header.checksum = io::checksum(content);
  return archived(header) + content;
}

Saved saved_of(std::string_view bytes) {
  if (!bytes.starts_with(archived(std::string(saved_by))))
    throw Error(Fault::input_output, "",
                "these bytes are not those of a run that billet " BILLET_VERSION " saved");
  const std::size_t size = archived(SavedHeader{}).size();
  SavedHeader header;
  ArchiveReader(bytes.substr(0, size))(header);
  bytes.remove_prefix(std::min(size, bytes.size()));
  if (io::checksum(bytes) != header.checksum)
    throw Error(Fault::input_output, "", "the bytes of this saved run are damaged",
                "load bytes that have been kept whole");
  Saved saved;
  ArchiveReader reader(bytes);
  reader(saved);
  return saved;
}

/// A process that goes on from a saved run.
/// @throws Error if that is of another case
void go_on_from(const Saved& saved, const io::Case& content, process::Process& process) {
  std::vector<Complaint> complaints;
  for (std::string& change :
       io::changes_of_case(saved.content, io::resolved_toml(content), saved.stage))
    complaints.push_back({"", "the run was saved of another case: " + change,
                          "it may go on with another time.end and later stages only"});
  if (!complaints.empty())
    throw Error(Fault::case_file, std::move(complaints));
  if (saved.scene != io::scene_fingerprint(process.view().scene))
    throw Error(Fault::case_file, "",
                "the mesh or a tool's surface is not that of the run that was saved");
  process.resume(saved.run);
}

Case with_overrides(Case content, const std::vector<std::string>& overrides) {
  if (!overrides.empty())
    content.set(overrides);
  return content;
}

/// More are of no use on any machine, and an arena of very many cannot be made.
constexpr int most_threads = 4096;

int threads_of(const RunOptions& options) {
  if (options.threads < 1)
    throw RunError(fmt::format("RunOptions::threads is {}, at least 1 is needed", options.threads));
  return std::min(options.threads, most_threads);
}

std::array<double, 3> as_array(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace

struct Run::Inside {
  Case source;
  RunOptions options;
  oneapi::tbb::task_arena threads; ///< none of them works outside of it
  std::unique_ptr<const mechanics::HelpersLeaveSignals> helpers;
  std::unique_ptr<process::Process> process;
  std::vector<std::string> columns;
  Units units;
  OneIncrement observer;
  Status status = Status::running;
  std::weak_ptr<std::vector<double>> kept; ///< who keeps the positions; theirs once we go on

  Inside(Case source_case, RunOptions run_options)
      : source(std::move(source_case)), options(std::move(run_options)),
        threads(threads_of(options)),
        helpers(threads.execute([] { return std::make_unique<mechanics::HelpersLeaveSignals>(); })),
        process(prepared()) {
    const io::UnitSystem& labels = content().units;
    columns = io::history_columns(process->view().scene);
    units = {labels.length, labels.force, labels.time, labels.stress, labels.temperature};
  }
  ~Inside() { leave_positions(); }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  [[nodiscard]] const io::Case& content() const { return source.inside_->content; }

  /// Of a run that was saved with a status: one that was done may have more time now.
  [[nodiscard]] Status status_after(Status saved) const {
    const process::Run& run = process->view();
    const bool at_end = process::has_ended(run) || run.state.time >= run.scene.stages.back().end ||
                        run.state.ended_by == process::EndedBy::energy_used_up;
    return saved == Status::done && !at_end ? Status::running : saved;
  }

  /// Does what takes time, within the threads of this run.
  template <class Function> auto work(Function&& function) {
    const mechanics::KernelSettings settings;
    return translated([&] { return threads.execute(function); });
  }

  [[nodiscard]] std::unique_ptr<process::Process> prepared() {
    return work([&] {
      return std::make_unique<process::Process>(io::build_scene(content(), source.name()).scene);
    });
  }

  /// Positions that somebody keeps are theirs: we go on with a copy.
  void leave_positions() {
    if (const std::shared_ptr<std::vector<double>> holder = kept.lock(); holder && process)
      *holder = process->take_positions();
    kept.reset();
  }

  [[nodiscard]] std::vector<io::Field> fields() {
    return work([&] {
      const std::vector<Vec3> points =
          io::points_of(process->view().positions(), process->view().mesh().dimension());
      return io::workpiece_frame(process->view(), points, {content().units, "", content().title})
          .point_fields;
    });
  }

  [[nodiscard]] contact::ToolLoad load(std::size_t tool) const {
    if (tool >= process->view().tools().size())
      throw RunError("there is no tool " + std::to_string(tool));
    return process->view().contact()->loads()[tool];
  }
};

Run::Run(const std::filesystem::path& case_file, const RunOptions& options)
    : inside_(
          std::make_unique<Inside>(Case::load(case_file, options.overrides, options.allow_outside),
                                   options)) {}
Run::Run(Case content, const RunOptions& options)
    : inside_(std::make_unique<Inside>(with_overrides(std::move(content), options.overrides),
                                       options)) {}
Run::~Run() = default;
Run::Run(Run&& other) noexcept = default;
Run& Run::operator=(Run&& other) noexcept = default;

Status Run::advance() {
  if (inside_->status != Status::running)
    return inside_->status;
  inside_->leave_positions();
  inside_->observer.begin();
  const process::RunStatus ended =
      inside_->work([&] { return inside_->process->run({&inside_->observer}); });
  inside_->status = ended == process::RunStatus::stopped ? Status::running
                    : ended == process::RunStatus::done  ? Status::done
                                                         : Status::not_converged;
  return inside_->status;
}

Status Run::finish() {
  while (advance() == Status::running) {
  }
  return inside_->status;
}

Status Run::status() const { return inside_->status; }
const std::string& Run::reason() const { return inside_->observer.reason; }
std::string Run::ended_by() const {
  return inside_->status == Status::done
             ? std::string(io::words_of(inside_->process->view().state.ended_by))
             : std::string();
}
double Run::time() const { return inside_->process->view().state.time; }
int Run::increment() const { return inside_->process->view().state.increment; }
const Increment& Run::last_increment() const { return inside_->observer.told.last; }

std::vector<std::string> Run::failed_checks() const {
  std::vector<std::string> lines;
  for (const process::FailedCheck& check : process::failed_checks(inside_->process->view()))
    lines.push_back(check.name + ": " + check.what);
  return lines;
}

const std::vector<std::string>& Run::history_columns() const { return inside_->columns; }
std::span<const double> Run::history() const { return inside_->observer.told.history; }

const Units& Run::units() const { return inside_->units; }
int Run::dimension() const { return inside_->process->view().mesh().dimension(); }
std::span<const double> Run::positions() const { return inside_->process->view().positions(); }
Kept<double> Run::keep_positions() {
  std::shared_ptr<std::vector<double>> holder = inside_->kept.lock();
  if (!holder)
    holder = std::make_shared<std::vector<double>>();
  inside_->kept = holder;
  return {holder, positions()};
}

std::span<const std::int32_t> Run::elements() const {
  return inside_->process->view().mesh().cells;
}
Kept<std::int32_t> Run::keep_elements() const {
  return {inside_->process->view().state.part, elements()};
}
int Run::nodes_per_element() const {
  return mechanics::nodes_per_element(inside_->process->view().mesh().kind);
}

std::vector<std::string> Run::field_names() const {
  std::vector<std::string> names;
  for (const io::Field& field : inside_->fields())
    names.push_back(field.name);
  return names;
}

std::vector<double> Run::field(std::string_view name) const { return nodal_field(name).values; }

NodalField Run::nodal_field(std::string_view name) const {
  std::vector<std::string> known;
  for (NodalField& field : nodal_fields()) {
    if (field.name == name)
      return std::move(field);
    known.push_back(field.name);
  }
  throw RunError(
      fmt::format("there is no field '{}' at the nodes; {}", name, io::suggestion(name, known)));
}

std::vector<NodalField> Run::nodal_fields() const {
  std::vector<NodalField> fields;
  for (io::Field& field : inside_->fields())
    fields.push_back(
        {std::move(field.name), std::move(field.unit), field.components, std::move(field.values)});
  return fields;
}

std::vector<std::string> Run::tools() const {
  std::vector<std::string> names;
  for (const contact::Tool& tool : inside_->process->view().tools())
    names.push_back(tool.name);
  return names;
}

std::array<double, 3> Run::tool_force(std::size_t tool) const {
  return as_array(inside_->load(tool).force);
}

std::array<double, 3> Run::tool_torque(std::size_t tool) const {
  return as_array(inside_->load(tool).torque);
}

std::string Run::save() {
  return inside_->work([&] {
    const process::Run& run = inside_->process->view();
    return bytes_of({io::resolved_toml(inside_->content()), io::scene_fingerprint(run.scene),
                     run.state.progress.stage, inside_->observer.told,
                     static_cast<std::int32_t>(inside_->status), inside_->observer.reason,
                     inside_->process->store()});
  });
}

void Run::load(std::string_view saved) {
  std::unique_ptr<process::Process> process = inside_->prepared();
  const Saved from = inside_->work([&] {
    Saved read = saved_of(saved);
    go_on_from(read, inside_->content(), *process);
    return read;
  });
  inside_->leave_positions();
  inside_->process = std::move(process);
  inside_->status = inside_->status_after(static_cast<Status>(from.status));
  inside_->observer = {};
  inside_->observer.told = from.told;
  inside_->observer.reason = from.reason;
}

Run Run::copy() {
  Run other(inside_->source, {{}, inside_->options.threads, inside_->options.allow_outside});
  other.load(save());
  return other;
}

} // namespace billet
