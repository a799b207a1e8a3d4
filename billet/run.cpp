#include "billet/run.h"

#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/results/frames.h"
#include "io/scene/scene_builder.h"
#include "process/loop/process.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <new>
#include <utility>

namespace billet {

namespace {

/// Calls a function; what is wrong with a case or with the machine becomes a RunError.
template <class Function> auto translated(Function&& function) {
  try {
    return function();
  } catch (const Error& error) {
    throw RunError(error.what());
  } catch (const std::bad_alloc&) {
    throw RunError("too little memory");
  }
}

/// Ends a run after each increment, and keeps why one could not be solved.
class OneIncrement final : public process::Observer {
public:
  std::string reason;

  void begin() { solved_ = false; }
  void incremented(const process::Run&, const process::IncrementReport&) override {
    solved_ = true;
  }
  void failed(const process::Run&, const process::PostMortem& post) override {
    reason = post.reason;
  }
  [[nodiscard]] bool stop_requested() const override { return solved_; }

private:
  bool solved_ = false;
};

std::array<double, 3> as_array(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace

struct Run::Inside {
  std::filesystem::path file;
  RunOptions options;
  io::Case content;
  oneapi::tbb::task_arena threads; ///< none of them works outside of it
  std::unique_ptr<process::Process> process;
  OneIncrement observer;
  Status status = Status::running;

  Inside(std::filesystem::path case_file, RunOptions run_options)
      : file(std::move(case_file)), options(std::move(run_options)),
        content(io::read_case(file, options.overrides, {options.allow_outside})),
        threads(std::max(options.threads, 1)) {
    prepare();
  }

  void prepare() {
    threads.execute([&] {
      process = std::make_unique<process::Process>(io::build_scene(content, file.string()).scene);
    });
  }

  [[nodiscard]] io::WorkpieceFrame frame() {
    const std::vector<Vec3> points =
        io::points_of(process->view().positions(), process->view().mesh().dimension());
    return threads.execute([&] {
      return io::workpiece_frame(process->view(), points, {content.units, "", content.title});
    });
  }

  [[nodiscard]] contact::ToolLoad load(std::size_t tool) const {
    if (tool >= process->view().tools().size())
      throw RunError("there is no tool " + std::to_string(tool));
    return process->view().contact()->loads()[tool];
  }
};

Run::Run(const std::filesystem::path& case_file, const RunOptions& options)
    : inside_(translated([&] { return std::make_unique<Inside>(case_file, options); })) {}
Run::~Run() = default;
Run::Run(Run&& other) noexcept = default;
Run& Run::operator=(Run&& other) noexcept = default;

Status Run::advance() {
  if (inside_->status != Status::running)
    return inside_->status;
  inside_->observer.begin();
  const process::RunStatus ended = translated([&] {
    return inside_->threads.execute([&] { return inside_->process->run({&inside_->observer}); });
  });
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
double Run::time() const { return inside_->process->view().state.time; }
int Run::increment() const { return inside_->process->view().state.increment; }
int Run::dimension() const { return inside_->process->view().mesh().dimension(); }
std::span<const double> Run::positions() const { return inside_->process->view().positions(); }
std::span<const std::int32_t> Run::elements() const {
  return inside_->process->view().mesh().cells;
}
int Run::nodes_per_element() const {
  return mechanics::nodes_per_element(inside_->process->view().mesh().kind);
}

std::vector<std::string> Run::field_names() const {
  std::vector<std::string> names;
  for (const io::Field& field : inside_->frame().point_fields)
    names.push_back(field.name);
  return names;
}

std::vector<double> Run::field(std::string_view name) const {
  std::string known;
  for (io::Field& field : inside_->frame().point_fields) {
    if (field.name == name)
      return std::move(field.values);
    known += (known.empty() ? "" : ", ") + field.name;
  }
  throw RunError("there is no field '" + std::string(name) + "' at the nodes; known are " + known);
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

std::string Run::save() { return inside_->process->store(); }

void Run::load(std::string_view saved) {
  translated([&] {
    inside_->prepare();
    inside_->threads.execute([&] { inside_->process->resume(saved); });
  });
  inside_->status = Status::running;
  inside_->observer = {};
}

Run Run::copy() {
  const std::string saved = save();
  Run other(inside_->file, inside_->options);
  other.load(saved);
  other.inside_->status = inside_->status;
  return other;
}

} // namespace billet
