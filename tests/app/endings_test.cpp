// What a run tells of its forces: at its end, in its summary, and on a terminal while it goes on.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>

namespace billet::test::endings_test {

namespace {

/// Pressed, and let go: at the end there is no force.
const std::string released = edited(upsetting, {{"end = 0.1\n", ""}}) + R"(
[[stage]]
name = "press"
end = 0.1

[[stage]]
name = "unload"
end = 0.2
unload = true
)";

class Endings : public testing::Test {
protected:
  Endings() { write_text(folder_.path() / "released.toml", released); }
  TemporaryFolder folder_;
};

TEST_F(Endings, name_the_largest_force_and_when_it_was) {
  const Outcome outcome = billet({"run", "released.toml", "--output", "out"}, folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable history = read_table(folder_.path() / "out" / "history.csv");
  double largest = 0.0, time = 0.0;
  for (std::size_t row = 0; row < history.rows.size(); ++row) {
    const double force =
        std::hypot(history.value(row, "punch.force_x"), history.value(row, "punch.force_y"));
    if (force > largest) {
      largest = force;
      time = history.value(row, "time");
    }
  }
  ASSERT_GT(largest, 10.0 * std::abs(history.values("punch.force_y").back()));
  EXPECT_TRUE(outcome.prints(fmt::format("at most {:.6g} N at time {:.6g} s", largest, time)))
      << outcome.out;
  const nlohmann::json tool =
      nlohmann::json::parse(whole_file(folder_.path() / "out" / "summary.json"))
          .at("tools")
          .at("punch");
  EXPECT_NEAR(tool.at("largest_force").at("value"), largest, 1e-12 * largest);
  EXPECT_NEAR(tool.at("largest_force").at("vector").at(1), largest, 1e-6 * largest);
  EXPECT_EQ(tool.at("largest_force").at("time"), time);
}

TEST_F(Endings, show_stroke_force_and_the_time_left_on_a_terminal) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(::grantpt(master), 0);
  ASSERT_EQ(::unlockpt(master), 0);
  const std::string terminal = ::ptsname(master);
  const int end = ::open(terminal.c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(end, 0);
  const Outcome outcome =
      billet(Start{{"run", "released.toml", "-o", "out"}, folder_.path(), [end] {
                     ::dup2(end, STDERR_FILENO);
                   }});
  ::close(end);
  EXPECT_EQ(outcome.status, 0);
  std::string shown; // less than the terminal holds back
  char part[4096];
  for (ssize_t n = 0; (n = ::read(master, part, sizeof(part))) > 0;)
    shown.append(part, static_cast<std::size_t>(n));
  ::close(master);
  EXPECT_NE(shown.find("  punch 0.1 mm "), std::string::npos) << shown;
  EXPECT_NE(shown.find(" kN  "), std::string::npos) << shown;
  EXPECT_NE(shown.find(" s left"), std::string::npos) << shown;
  EXPECT_NE(shown.find("100 %"), std::string::npos) << shown;
}

TEST_F(Endings, results_go_to_the_home_folder_for_a_tilde_no_shell_replaced) {
  const std::string home = folder_.path().string();
  const auto run = [&](const std::vector<std::string>& words) {
    return billet(Start{words, folder_.path(), [&] { ::setenv("HOME", home.c_str(), 1); }});
  };
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "released.toml", "-o", "~/at-home"},
        {"run", "released.toml", "--output=~/at-home-as-well"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  for (const char* results : {"at-home", "at-home-as-well"})
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / results / "summary.json")) << results;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "~"));
  const Outcome other = run({"run", "released.toml", "-o", "~bob/x"});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(other.says("'./~bob/x'")) << other.err;
}

} // namespace

} // namespace billet::test::endings_test
