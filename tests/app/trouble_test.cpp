// Runs that cannot go on: full and forbidden disks, signals, increments without a solution.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/mount.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

namespace billet::test::trouble_test {

namespace {

/// A run of ten thousand increments; tests end it.
const std::string long_run =
    edited(upsetting,
           {{"end = 0.1", "end = 1"},
            {"{ first = 0.02, max = 0.02 }", "{ first = 1e-4, max = 1e-4 }"}}) +
    "[output]\nevery = 0.002\n";

class Trouble : public testing::Test {
protected:
  Trouble() {
    write_text(folder_.path() / "tiny.toml", upsetting);
    write_text(folder_.path() / "long.toml", long_run);
  }
  [[nodiscard]] std::filesystem::path at(const std::string& name) const {
    return folder_.path() / name;
  }
  /// All files below a folder with what they hold.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>>
  contents(const std::string& name) const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(at(name)))
      if (entry.is_regular_file())
        all.emplace_back(entry.path().string(), whole_file(entry.path()));
    std::sort(all.begin(), all.end());
    return all;
  }

  TemporaryFolder folder_;
};

/// As if the disk were full: no file may grow beyond a size.
std::function<void()> files_up_to(::rlim_t bytes) {
  return [bytes] {
    const ::rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_DFL); // the signal is no end of the program
  };
}

TEST_F(Trouble, a_disk_that_is_full_from_the_start_leaves_earlier_results_alone) {
  ASSERT_EQ(billet({"run", "tiny.toml", "--quiet", "-o", "out"}, folder_.path()).status, 0);
  const auto before = contents("out");
  const Outcome outcome =
      billet(Start{{"run", "tiny.toml", "--quiet", "-o", "out"}, folder_.path(), files_up_to(500)});
  EXPECT_EQ(outcome.status, 6) << outcome.err;
  EXPECT_TRUE(outcome.says("case.resolved.toml: cannot be written: File too large")) << outcome.err;
  EXPECT_TRUE(outcome.says("free some space")) << outcome.err;
  EXPECT_EQ(contents("out"), before);
}

TEST_F(Trouble, a_disk_that_fills_during_the_run_leaves_whole_files) {
  const Outcome outcome = billet(
      Start{{"run", "long.toml", "--quiet", "-o", "out"}, folder_.path(), files_up_to(30000)});
  EXPECT_EQ(outcome.status, 6) << outcome.err;
  EXPECT_TRUE(outcome.says("cannot be written: File too large")) << outcome.err;
  expect_whole_results(at("out"), "long");
  EXPECT_GT(read_table(at("out") / "history.csv").rows.size(), 20U);
  EXPECT_GT(frame_times(at("out") / "long.pvd").size(), 1U);
}

/// Runs the program into a file system of its own of `size`, then copies what is there to `copy`.
/// Returns the exit status; -1 if no file system can be had.
int run_on_small_disk(const std::filesystem::path& folder,
                      const std::string& size,
                      const std::filesystem::path& copy) {
  std::filesystem::create_directory(folder / "disk");
  const ::pid_t child = ::fork();
  if (child == 0) {
    constexpr int no_disk = 125;
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("none", (folder / "disk").c_str(), "tmpfs", 0, ("size=" + size).c_str()) != 0)
      ::_exit(no_disk);
    const Outcome outcome = billet({"run", "long.toml", "--quiet", "-o", "disk/out"}, folder);
    std::error_code error;
    std::filesystem::copy(folder / "disk/out", copy, std::filesystem::copy_options::recursive,
                          error);
    write_text(folder / "message.txt", outcome.err);
    ::_exit(outcome.status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  constexpr int no_disk = 125;
  return WIFEXITED(status) && WEXITSTATUS(status) != no_disk ? WEXITSTATUS(status) : -1;
}

TEST_F(Trouble, a_small_disk_that_fills_ends_the_run_with_whole_files) {
  const int status = run_on_small_disk(folder_.path(), "300k", at("copy"));
  if (status == -1)
    GTEST_SKIP() << "a file system of one's own needs to be root, with unshare and mount allowed";
  EXPECT_EQ(status, 6);
  const std::string message = whole_file(at("message.txt"));
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_NE(message.find("free some space"), std::string::npos) << message;
  expect_whole_results(at("copy"), "long");
  EXPECT_GT(read_table(at("copy") / "history.csv").rows.size(), 20U);
}

TEST_F(Trouble, a_results_folder_that_cannot_be_is_refused) {
  write_text(at("file"), "mine");
  std::filesystem::create_directories(at("taken/history.csv"));
  std::filesystem::create_symlink("nowhere/at/all", at("dangling"));
  for (const std::string& output :
       {std::string("file"), std::string("file/out"), std::string("/proc/out"),
        std::string("/dev/null/out"), std::string("taken"), std::string("dangling/out"),
        std::string(300, 'a')}) {
    const Outcome outcome = billet({"run", "tiny.toml", "--quiet", "-o", output}, folder_.path());
    EXPECT_EQ(outcome.status, 6) << output << ": " << outcome.err;
    EXPECT_TRUE(outcome.says("cannot be written") || outcome.says("folder")) << outcome.err;
    EXPECT_TRUE(outcome.says(output)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(whole_file(at("file")), "mine");
}

TEST_F(Trouble, a_folder_that_may_not_be_written_is_refused) {
  namespace fs = std::filesystem;
  fs::create_directory(at("locked"));
  fs::permissions(at("locked"), static_cast<fs::perms>(0555));
  const auto as_nobody = [] { // root may write everywhere
    constexpr ::uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setuid(nobody) != 0)
      ::_exit(126);
  };
  if (billet(Start{{"--version"}, folder_.path(), as_nobody}).status != 0)
    GTEST_SKIP() << "the program cannot be started by a user other than root here";
  const Outcome outcome =
      billet(Start{{"run", "tiny.toml", "--quiet", "-o", "locked/out"}, folder_.path(), as_nobody});
  EXPECT_EQ(outcome.status, 6) << outcome.err;
  EXPECT_TRUE(outcome.says("Permission denied")) << outcome.err;
  EXPECT_TRUE(outcome.says("choose a folder you may write to with -o")) << outcome.err;
}

TEST_F(Trouble, signals_end_the_run_after_a_whole_increment) {
  for (const auto& [number, status] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const std::string name = "out" + std::to_string(number);
    Program program(Start{{"run", "long.toml", "--quiet", "-o", name}, folder_.path()});
    const auto started = [&] {
      return std::filesystem::exists(at(name) / "frames/workpiece_0002.vtu");
    };
    ASSERT_TRUE(program.wait_until(started));
    program.signal(number);
    program.signal(number); // as timeout(1) does: to the process, and to its group
    const Outcome outcome = program.end();
    EXPECT_FALSE(outcome.crashed);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_TRUE(outcome.prints("stopped at time")) << outcome.out;
    expect_whole_results(at(name), "long");
    const auto summary = nlohmann::json::parse(whole_file(at(name) / "summary.json"));
    EXPECT_EQ(summary.at("status"), "stopped");
    EXPECT_EQ(summary.at("exit_status"), status);
    const ResultTable history = read_table(at(name) / "history.csv");
    ASSERT_FALSE(history.rows.empty());
    const double last = history.value(history.rows.size() - 1, "time");
    EXPECT_EQ(summary.at("time"), last);
    EXPECT_LT(last, 1.0);
    EXPECT_EQ(frame_times(at(name) / "long.pvd").back(), last);
  }
}

/// Standard error is a pipe that nobody reads: the program waits once it is full.
void into_a_pipe() {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0 || ::fcntl(ends[1], F_SETPIPE_SZ, 4096) < 0 ||
      ::dup2(ends[1], STDERR_FILENO) < 0)
    ::_exit(126);
}

TEST_F(Trouble, a_second_signal_ends_the_program_at_once) {
  for (const auto& [number, status] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const std::string name = "out" + std::to_string(number);
    Program program(Start{{"run", "long.toml", "-o", name}, folder_.path(), into_a_pipe});
    std::string rows;
    const auto waits = [&] { // for its words to be read
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
      const std::string before = std::exchange(rows, whole_file(at(name) / "history.csv"));
      return rows.size() > 2000 && rows == before;
    };
    ASSERT_TRUE(program.wait_until(waits));
    for (int i = 0; i < 2; ++i) {
      program.signal(SIGHUP); // which never ends it at once
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
    EXPECT_TRUE(program.wait_until([] { return true; }));
    program.signal(number);
    const Outcome outcome = program.end();
    EXPECT_EQ(outcome.status, status);
    EXPECT_FALSE(std::filesystem::exists(at(name) / "summary.json"));
  }
}

TEST_F(Trouble, a_closed_terminal_does_not_end_a_run_under_nohup) {
  const auto nohup = [] { std::signal(SIGHUP, SIG_IGN); };
  Program program(Start{{"run", "long.toml", "--quiet", "-o", "out"}, folder_.path(), nohup});
  const auto frame = [&](const std::string& number) {
    return [this, number] {
      return std::filesystem::exists(at("out") / ("frames/workpiece_" + number + ".vtu"));
    };
  };
  ASSERT_TRUE(program.wait_until(frame("0001")));
  program.signal(SIGHUP);
  EXPECT_TRUE(program.wait_until(frame("0004")));
}

TEST_F(Trouble, a_folder_that_a_run_writes_to_is_not_for_another) {
  Program first(Start{{"run", "long.toml", "--quiet", "-o", "out"}, folder_.path()});
  const auto frame = [&](const std::string& number) {
    return [this, number] {
      return std::filesystem::exists(at("out") / ("frames/workpiece_" + number + ".vtu"));
    };
  };
  ASSERT_TRUE(first.wait_until(frame("0001")));
  const std::string lock = whole_file(at("out") / ".billet.lock");
  const std::string process = lock.substr(0, lock.find('\n')); // "process 4711"
  for (const char* folder : {"out", "./out/", "link"}) {
    if (std::string(folder) == "link")
      std::filesystem::create_symlink("out", at("link"));
    const Outcome second = billet({"run", "tiny.toml", "--quiet", "-o", folder}, folder_.path());
    EXPECT_EQ(second.status, 6) << folder;
    EXPECT_TRUE(second.says("another run writes its results here: " + process + " on "))
        << second.err;
    EXPECT_TRUE(second.says(lock.substr(lock.find("since "), 25))) << second.err;
    EXPECT_TRUE(second.says("choose another folder with -o")) << second.err;
    EXPECT_FALSE(std::filesystem::exists(at("out") / "tiny.pvd"));
  }
  EXPECT_TRUE(first.wait_until(frame("0003"))); // the first goes on
  first.signal(SIGKILL);
  EXPECT_EQ(first.end().status, 128 + SIGKILL);
  EXPECT_TRUE(std::filesystem::exists(at("out") / ".billet.lock")); // nobody's now
  EXPECT_EQ(billet({"run", "tiny.toml", "--quiet", "-o", "out"}, folder_.path()).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out") / ".billet.lock"));
}

TEST_F(Trouble, of_many_runs_into_one_folder_one_at_a_time_writes) {
  std::vector<std::unique_ptr<Program>> runs;
  for (int i = 0; i < 8; ++i)
    runs.push_back(std::make_unique<Program>(
        Start{{"run", "tiny.toml", "--quiet", "--threads", "1", "-o", "out", "--set",
               "time.increments={ first = 0.002, max = 0.002 }"},
              folder_.path()}));
  int done = 0;
  for (auto& run : runs) {
    const Outcome outcome = run->end();
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 6) << outcome.err;
    done += outcome.status == 0 ? 1 : 0;
  }
  EXPECT_GE(done, 1);
  expect_whole_results(at("out"), "tiny");
  const auto summary = nlohmann::json::parse(whole_file(at("out") / "summary.json"));
  EXPECT_EQ(read_table(at("out") / "history.csv").rows.size(), summary.at("increments"));
}

TEST_F(Trouble, a_killed_run_leaves_whole_files) {
  Program program(Start{{"run", "long.toml", "--quiet", "-o", "out"}, folder_.path()});
  ASSERT_TRUE(program.wait_until(
      [&] { return std::filesystem::exists(at("out") / "frames/workpiece_0003.vtu"); }));
  program.signal(SIGKILL);
  EXPECT_EQ(program.end().status, 128 + SIGKILL);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(at("out")))
    if (entry.path().filename().string()[0] == '.')
      std::filesystem::remove(entry.path()); // the file being written: hidden, never in its place
  expect_whole_results(at("out"), "long");
  EXPECT_FALSE(std::filesystem::exists(at("out") / "summary.json"));
}

TEST_F(Trouble, an_increment_without_solution_ends_with_status_5_and_a_post_mortem) {
  // 99.5 % of the height in increments too long for the mesh.
  const Outcome outcome =
      billet({"run", "tiny.toml", "--quiet", "-o", "out", "--set", "time.end=7.4625", "--set",
              "time.increments={ first = 0.2, min = 0.1, max = 0.2 }"},
             folder_.path());
  EXPECT_EQ(outcome.status, 5) << outcome.err << outcome.out;
  EXPECT_TRUE(outcome.says("billet: time 7")) << outcome.err; // quiet or not
  EXPECT_TRUE(outcome.says("could not be reached")) << outcome.err;
  EXPECT_TRUE(outcome.prints("not-converged at time")) << outcome.out;
  EXPECT_TRUE(outcome.prints("what went wrong: out/failure/post_mortem.txt")) << outcome.out;
  const std::string post = whole_file(at("out") / "failure/post_mortem.txt");
  for (const char* piece : {"could not be reached", "largest residual at node", "near (",
                            "tried:", "dt = ", "what may help"})
    EXPECT_NE(post.find(piece), std::string::npos) << piece << " is not in: " << post;
  EXPECT_NE(whole_file(at("out") / "failure/last_good.vtu").find("</VTKFile>"), std::string::npos);
  expect_whole_results(at("out"), "tiny");
  const auto summary = nlohmann::json::parse(whole_file(at("out") / "summary.json"));
  EXPECT_EQ(summary.at("status"), "not-converged");
  EXPECT_EQ(summary.at("exit_status"), 5);
  EXPECT_FALSE(summary.at("failure").at("reason").get<std::string>().empty());
  const ResultTable history = read_table(at("out") / "history.csv");
  ASSERT_GT(history.rows.size(), 5U);
  const double last = history.value(history.rows.size() - 1, "time");
  EXPECT_EQ(frame_times(at("out") / "tiny.pvd").back(), last);
  EXPECT_EQ(summary.at("time"), last);
  EXPECT_GT(summary.at("failure").at("time"), last);
  // A good run into the same folder leaves no trace of the failure.
  EXPECT_EQ(billet({"run", "tiny.toml", "--quiet", "-o", "out"}, folder_.path()).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out") / "failure"));
}

TEST_F(Trouble, a_tool_too_fast_for_the_increments_does_not_pass_unseen) {
  const Outcome outcome =
      billet({"run", "tiny.toml", "--quiet", "-o", "out", "--set",
              "tool.punch.motion.velocity=[0, -1e6]", "--set", "time.increments.min=0.001"},
             folder_.path());
  EXPECT_EQ(outcome.status, 5) << outcome.out;
  const std::string post = whole_file(at("out") / "failure/post_mortem.txt");
  EXPECT_NE(post.find("tool 'punch' moves by"), std::string::npos) << post;
}

TEST_F(Trouble, too_little_memory_ends_with_status_7) {
  const auto little = [] {
    const ::rlimit limit{::rlim_t{300} << 20U, ::rlim_t{300} << 20U};
    ::setrlimit(RLIMIT_AS, &limit);
  };
  if (billet(Start{{"--version"}, {}, little}).status != 0)
    GTEST_SKIP() << "this build of the program does not start within 300 MB";
  for (const char* cells : {"[400, 400]", "[1000, 1000]", "[40000, 40000]"}) {
    const std::string set = std::string("workpiece.mesh.cells=") + cells;
    const Outcome outcome =
        billet(Start{{"check", "tiny.toml", "--set", set}, folder_.path(), little});
    EXPECT_EQ(outcome.status, 7) << cells << ": " << outcome.err;
    EXPECT_TRUE(outcome.says("not enough memory") || outcome.says("too large")) << outcome.err;
  }
}

/// A run in space: a matrix that takes OpenBLAS's buffer, with threads of TBB.
const std::string ball_on_block = R"(analysis = "3d"
[workpiece]
element = "hex20"
material = "m"
mesh = { box = [[0, 0, 0], [4, 4, 3]], cells = [6, 6, 4] }
[material.m]
elastic = { young = "200 GPa", poisson = 0.3 }
flow = { law = "voce", yield = 300, saturation = 500, rate = 5 }
[[support]]
where = "z = 0"
fix = ["x", "y", "z"]
[[tool]]
name = "ball"
surface = { sphere = { centre = [2, 2, 8], radius = 5 } }
motion = { velocity = [0, 0, -1] }
friction = { law = "tresca", m = 0.3 }
[time]
end = 0.004
)";

TEST_F(Trouble, address_space_of_any_size_is_enough_or_ends_the_run_with_status_7) {
  write_text(at("ball.toml"), ball_on_block);
  int too_small = 0;
  for (::rlim_t kilobytes = 75000; kilobytes <= 250000; kilobytes += 25000) {
    const auto little = [kilobytes] {
      const ::rlimit limit{kilobytes << 10U, kilobytes << 10U};
      ::setrlimit(RLIMIT_AS, &limit);
    };
    if (billet(Start{{"--version"}, {}, little}).status != 0)
      continue; // the system cannot load the program
    const Outcome outcome = billet(Start{
        {"run", "ball.toml", "--quiet", "--threads", "2", "-o", "out"}, folder_.path(), little});
    EXPECT_FALSE(outcome.crashed) << kilobytes << ": " << outcome.err;
    constexpr int failed_check = 8; // a touch in two increments misses energy
    if (outcome.status == 0 || outcome.status == failed_check)
      continue;
    ++too_small;
    EXPECT_EQ(outcome.status, 7) << kilobytes << ": " << outcome.err;
    EXPECT_TRUE(outcome.says("billet: not enough memory")) << kilobytes << ": " << outcome.err;
  }
  if (too_small == 0)
    GTEST_SKIP() << "this build of the program does not start within so little";
}

} // namespace

} // namespace billet::test::trouble_test
