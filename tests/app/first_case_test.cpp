// docs/tutorials/first-case.md prints what the program prints.

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

namespace billet::test::first_case_test {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

const std::regex& number() {
  static const std::regex number(R"(-?\d+(\.\d+)?(e[-+]\d+)?)");
  return number;
}

/// A line with a mark in place of each number.
std::string words_of(const std::string& line) { return std::regex_replace(line, number(), "#"); }

std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  for (auto at = std::sregex_iterator(line.begin(), line.end(), number());
       at != std::sregex_iterator(); ++at)
    numbers.push_back(std::strtod(at->str().c_str(), nullptr));
  return numbers;
}

class FirstCase : public testing::Test {
protected:
  FirstCase() {
    std::filesystem::create_directory(folder_.path() / "disc");
    write_text(folder_.path() / "disc" / "case.toml", block_after("## 1.", "```toml\n"));
  }
  /// The first block of the guide below a heading.
  [[nodiscard]] std::string block_after(const std::string& heading,
                                        const std::string& fence = "```\n") const {
    const std::size_t section = guide_.find("\n" + heading);
    const std::size_t begin = guide_.find("\n" + fence, section) + 1 + fence.size();
    return guide_.substr(begin, guide_.find("\n```", begin) + 1 - begin);
  }
  [[nodiscard]] Outcome run(const std::vector<std::string>& words) const {
    return billet(words, folder_.path());
  }

  std::string guide_ =
      whole_file(std::filesystem::path(BILLET_SOURCE_DIR) / "docs" / "tutorials" / "first-case.md");
  TemporaryFolder folder_;
};

/// The same lines, figures to a hundredth; the machine's memory is its own.
void expect_same(const std::string& printed, const std::string& guide) {
  const std::vector<std::string> a = lines_of(printed), b = lines_of(guide);
  ASSERT_EQ(a.size(), b.size()) << printed;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(words_of(a[i]), words_of(b[i]));
    if (a[i].starts_with("memory: "))
      continue;
    const std::vector<double> x = numbers_of(a[i]), y = numbers_of(b[i]);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_NEAR(x[k], y[k], 0.01 * std::abs(y[k])) << a[i];
  }
}

TEST_F(FirstCase, is_checked_and_run_as_the_guide_says) {
  const Outcome check = run({"check", "disc/case.toml"});
  EXPECT_EQ(check.status, 0) << check.err;
  expect_same(check.out, block_after("## 2."));
  const Outcome done = run({"run", "disc/case.toml", "--quiet"});
  EXPECT_EQ(done.status, 0) << done.err;
  expect_same(done.out, block_after("## 3."));
}

TEST_F(FirstCase, fails_as_the_guide_says) {
  const Outcome outcome =
      run({"run", "disc/case.toml", "--quiet", "--set", "time.increments.min=1"});
  EXPECT_EQ(outcome.status, 5);
  // Contact that chatters does so as rounding goes: words only, and not every iteration.
  std::vector<std::string> printed;
  for (const std::string& line :
       lines_of(whole_file(folder_.path() / "results/disc/failure/post_mortem.txt")))
    printed.push_back(words_of(line));
  std::size_t at = 0;
  for (const std::string& line : lines_of(block_after("## 7."))) {
    if (line == "...")
      continue;
    while (at < printed.size() && printed[at] != words_of(line))
      ++at;
    EXPECT_LT(at, printed.size()) << line << " is not in it, or not at its place";
  }
  EXPECT_EQ(words_of(lines_of(block_after("## 7.")).back()), printed.back());
}

} // namespace

} // namespace billet::test::first_case_test
