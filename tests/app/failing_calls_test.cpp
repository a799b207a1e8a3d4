// Runs whose calls to the system fail: each write, rename, close and fsync in turn, and memory from
// some allocation on (tests/support/failing_calls.cpp).

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>

namespace billet::test::failing_calls_test {

namespace {

class FailingCalls : public testing::Test {
protected:
  FailingCalls() {
    // Three increments, frames at their start and end.
    write_text(folder_.path() / "tiny.toml",
               edited(upsetting, {{"end = 0.1", "end = 0.04"}}) + "[output]\nevery = 0.04\n");
  }

  /// Starts the program with a variable for the calls (tests/support/failing_calls.cpp).
  [[nodiscard]] Outcome run(const std::string& variable, const std::string& value) const {
    return billet(
        Start{{"run", "tiny.toml", "--quiet", "--threads", "1", "-o", "out"}, folder_.path(), [=] {
                const auto library =
                    std::filesystem::path(BILLET_PROGRAM).parent_path() / "failing_calls.so";
                ::setenv("LD_PRELOAD", library.c_str(), 1);
                ::setenv(variable.c_str(), value.c_str(), 1);
              }});
  }
  [[nodiscard]] Outcome run_failing(const std::string& plan) const {
    return run("BILLET_FAIL", plan);
  }

  /// A call: what it was, and of which file, relative to the results.
  struct Call {
    std::string function;
    std::string file;
  };
  [[nodiscard]] std::vector<Call> calls_of_a_run() const {
    const auto list = folder_.path() / "calls";
    EXPECT_EQ(run("BILLET_CALLS", list.string()).status, 0);
    const std::string above = std::filesystem::canonical(folder_.path()).string() + "/";
    std::vector<Call> calls;
    std::ifstream stream(list);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t space = line.find(' ');
      std::string file = line.substr(space + 1);
      if (file.starts_with(above))
        file.erase(0, above.size());
      calls.push_back({line.substr(0, space), file});
    }
    return calls;
  }
  [[nodiscard]] std::filesystem::path out() const { return folder_.path() / "out"; }

  TemporaryFolder folder_;
};

/// What a run leaves when one of its calls has failed: whole tables, and a list of frames that are
/// there.
void expect_nothing_half_done(const std::filesystem::path& folder, const std::string& what) {
  SCOPED_TRACE(what);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
  EXPECT_FALSE(std::filesystem::exists(folder / ".billet.lock"));
  if (std::filesystem::exists(folder / "tiny.pvd")) {
    for (const ListedFile& entry : read_list(folder / "tiny.pvd"))
      EXPECT_NE(whole_file(folder / entry.file).find("</VTKFile>"), std::string::npos)
          << entry.file << " is listed";
  }
  for (const char* table : {"history.csv", "iterations.csv"})
    if (std::filesystem::exists(folder / table) && std::filesystem::file_size(folder / table) > 0)
      read_table(folder / table);
}

TEST_F(FailingCalls, each_that_fails_ends_the_run_with_status_6_and_whole_files) {
  std::map<std::string, int> number;
  for (const Call& call : calls_of_a_run())
    ++number[call.function];
  for (const char* function : {"write", "rename", "close", "fsync"}) {
    EXPECT_GT(number[function], 5) << function;
    for (int i = 1; i <= number[function]; ++i) {
      const std::string plan = std::string(function) + ":" + std::to_string(i);
      std::filesystem::remove_all(out());
      const Outcome outcome = run_failing(plan);
      // What is closed after it has been synchronized has nothing to lose.
      if (std::string(function) != "close" || outcome.status != 0) {
        EXPECT_EQ(outcome.status, 6) << plan << ": " << outcome.err;
        EXPECT_TRUE(outcome.says("cannot be written: Input/output error")) << outcome.err;
      }
      if (std::filesystem::exists(out()))
        expect_nothing_half_done(out(), plan);
      if (std::string(function) != "fsync" && outcome.status != 0) {
        EXPECT_FALSE(std::filesystem::exists(out() / "summary.json")) << plan;
      }
    }
  }
}

TEST_F(FailingCalls, what_the_summary_speaks_for_is_on_the_disk_before_it) {
  const std::vector<Call> calls = calls_of_a_run();
  // Place of the last call of that kind; none: -1.
  const auto last = [&](const std::string& function, const auto& matches) {
    long place = -1;
    for (std::size_t i = 0; i < calls.size(); ++i)
      if (calls[i].function == function && matches(calls[i].file))
        place = static_cast<long>(i);
    return place;
  };
  const auto is = [](const std::string& name) {
    return [name](const std::string& file) { return file == name; };
  };
  const long summary = last("rename", is("out/summary.json"));
  ASSERT_GT(summary, 0);
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out())) {
    const std::string name = "out/" + entry.path().lexically_relative(out()).string();
    if (!entry.is_regular_file() || name == "out/summary.json" ||
        name == "out/starts.json") // of which the summary says nothing
      continue;
    ++files;
    if (entry.path().extension() == ".checkpoint") { // before it has its name
      const auto is_its_beginning = [&](const std::string& file) {
        return file.starts_with("out/checkpoints/." + entry.path().filename().string());
      };
      EXPECT_GT(last("fsync", is_its_beginning), last("write", is_its_beginning)) << name;
      EXPECT_GT(last("rename", is(name)), last("fsync", is_its_beginning)) << name;
      EXPECT_LT(last("rename", is(name)), summary) << name;
      continue;
    }
    const long synchronized = last("fsync", is(name));
    EXPECT_GT(synchronized, last("write", is(name))) << name;
    EXPECT_GT(synchronized, last("rename", is(name))) << name;
    EXPECT_LT(synchronized, summary) << name;
    EXPECT_EQ(std::count_if(
                  calls.begin(), calls.end(),
                  [&](const Call& call) { return call.function == "fsync" && call.file == name; }),
              1)
        << name << " is synchronized more than once";
  }
  EXPECT_GT(files, 9);
  // Names, after the last that is new; and the summary itself.
  const long frames = last("fsync", is("out/frames"));
  EXPECT_GT(frames, last("rename",
                         [](const std::string& file) { return file.starts_with("out/frames/"); }));
  EXPECT_LT(frames, summary);
  const auto is_new_summary = [](const std::string& file) {
    return file.find(".summary.json.") != std::string::npos;
  };
  const long content = last("fsync", is_new_summary);
  EXPECT_GT(content, last("write", is_new_summary));
  EXPECT_LT(content, summary);
  EXPECT_GT(last("fsync", is("out")), summary);
}

TEST_F(FailingCalls, memory_that_ends_anywhere_ends_the_run_with_status_7) {
  int failed = 0;
  int status = 7;
  for (double from = 1.0; status != 0 && from < 1e6; from = 1.3 * from + 1.0) {
    const std::string plan = "malloc:" + std::to_string(static_cast<long>(from)) + "+";
    const Outcome outcome = run_failing(plan);
    status = outcome.status;
    if (status == 0)
      break;
    ++failed;
    EXPECT_EQ(outcome.status, 7) << plan << ": " << outcome.err;
    EXPECT_FALSE(outcome.crashed) << plan;
    EXPECT_TRUE(outcome.says("billet: not enough memory")) << plan << ": " << outcome.err;
  }
  EXPECT_EQ(status, 0);
  EXPECT_GT(failed, 20);
}

TEST_F(FailingCalls, an_order_of_the_unknowns_without_memory_is_no_tangent_without_solution) {
  bool of_metis = false;
  int went_on = 0;
  for (int i = 400; !of_metis && i < 6000; i += 30) { // METIS takes some ninety blocks
    const Outcome outcome = run_failing("malloc:" + std::to_string(i));
    went_on += outcome.status == 0 ? 1 : 0;
    EXPECT_TRUE(outcome.status == 7 || outcome.status == 0) << i << ": " << outcome.err;
    of_metis = outcome.says("Memory allocation failed");
  }
  EXPECT_TRUE(of_metis);
  EXPECT_LE(went_on, 1); // where a line of /proc/cpuinfo is read, which streams forgive
}

TEST_F(FailingCalls, a_folder_on_a_file_system_without_locks_is_kept_by_what_its_lock_says) {
  ASSERT_EQ(run_failing("flock:1+").status, 0);
  EXPECT_FALSE(std::filesystem::exists(out() / ".billet.lock"));
  const auto lock_of = [&](const std::string& machine, const std::string& boot) {
    write_text(out() / ".billet.lock", "process 1\nmachine " + machine + "\nboot " + boot +
                                           "\nbegun 0\nsince 2026-01-02 03:04:05 +0000\n");
  };
  std::array<char, 256> machine{};
  ::gethostname(machine.data(), machine.size() - 1);
  lock_of(machine.data(), "earlier");
  EXPECT_EQ(run_failing("flock:1+").status, 0);
  lock_of("elsewhere", "earlier");
  const Outcome refused = run_failing("flock:1+");
  EXPECT_EQ(refused.status, 6);
  EXPECT_TRUE(refused.says("process 1 on elsewhere, since 2026-01-02 03:04:05")) << refused.err;
  EXPECT_TRUE(refused.says("if it has ended, remove out/.billet.lock")) << refused.err;
  EXPECT_EQ(run_failing("write:0").status, 0); // with locks that file is nobody's
}

} // namespace

} // namespace billet::test::failing_calls_test
