// Runs made side by side, and the script that Slurm is given.

#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "study/local_engine.h"
#include "study/runs.h"
#include "study/slurm_engine.h"

namespace billet::study::engines_test {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Job shell(const std::string& words, const std::filesystem::path& output) {
  return {{"/bin/sh", "-c", words}, output};
}

TEST(LocalEngine, TellsHowEveryJobEnded) {
  const test::TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  std::map<std::size_t, int> statuses;
  run_jobs(
      {shell("echo said", out),
       shell("exit 5", "/dev/null"),
       shell("kill -9 $$", "/dev/null"),
       {{"/no/such/program"}, "/dev/null"}},
      2, [] { return false; }, [&](std::size_t job, int status) { statuses[job] = status; });
  EXPECT_EQ(statuses, (std::map<std::size_t, int>{{0, 0}, {1, 5}, {2, 137}, {3, 127}}));
  EXPECT_EQ(text_of(out), "said\n");
}

TEST(LocalEngine, RunsSeveralAtOnce) {
  const test::TemporaryFolder folder;
  // Each waits for the other's file.
  const auto waiting = [&](const std::string& own, const std::string& other) {
    return shell("cd '" + folder.path().string() + "'; touch " + own +
                     "; for i in $(seq 200); do [ -e " + other +
                     " ] && exit 0; sleep 0.05; done; exit 1",
                 "/dev/null");
  };
  int sum = 0;
  run_jobs(
      {waiting("a", "b"), waiting("b", "a")}, 2, [] { return false; },
      [&](std::size_t, int status) { sum += status; });
  EXPECT_EQ(sum, 0);
}

TEST(LocalEngine, StopsWhatRunsAndStartsNoMore) {
  std::map<std::size_t, int> statuses;
  int asked = 0;
  run_jobs(
      {shell("sleep 60", "/dev/null"), shell("sleep 60", "/dev/null")}, 1,
      [&] { return ++asked > 10; }, [&](std::size_t job, int status) { statuses[job] = status; });
  EXPECT_EQ(statuses, (std::map<std::size_t, int>{{0, 143}}));
}

TEST(SlurmEngine, GivesEveryLineToOneTask) {
  const test::TemporaryFolder folder;
  // Names of folders may hold what a shell reads otherwise.
  const std::filesystem::path runs = folder.path() / "the smith's $runs";
  std::filesystem::create_directory(runs);
  std::string lines;
  for (int i = 1; i <= 7; ++i)
    lines += "echo " + std::to_string(i) + " >> " + quoted((runs / "seen").string()) + "\n";
  std::ofstream(runs / "commands.txt") << lines;
  const std::filesystem::path script =
      folder.file("slurm.sh", slurm_script(runs / "commands.txt", 3));
  for (int task = 1; task <= 3; ++task)
    ASSERT_EQ(std::system(("SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " bash " +
                           quoted(script.string()))
                              .c_str()),
              0);
  EXPECT_EQ(text_of(runs / "seen"), "1\n4\n7\n2\n5\n3\n6\n");
}

} // namespace
} // namespace billet::study::engines_test
