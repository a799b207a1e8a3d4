#include "geometry/base/error.h"
#include "io/tools/profile.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace billet::io::profile_test {
namespace {

class ProfileFile : public testing::Test {
protected:
  [[nodiscard]] geometry::Profile read(const std::string& text) const {
    std::ofstream(folder_ / "die.toml") << text;
    return read_profile(folder_ / "die.toml");
  }

  // Every complaint, without the name of the folder.
  [[nodiscard]] std::vector<std::string> complaints(const std::string& text) const {
    std::vector<std::string> all;
    try {
      (void)read(text);
      ADD_FAILURE() << "nothing was wrong";
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::geometry);
      for (const Complaint& c : error.complaints())
        all.push_back(c.text().substr(folder_.string().size() + 1));
    }
    return all;
  }

  test::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ProfileFile, LinesAndArcsAreRead) {
  const geometry::Profile p = read(R"(
closed = true
start = [0, 0.5]
[[segment]]
to = [10, 0]
[[segment]]
to = [12, 2]
radius = 2
[[segment]]
to = [12, 6.5]
radius = 3
large = true
[[segment]]
to = [0, 6.5]
)");
  EXPECT_TRUE(p.closed);
  EXPECT_EQ(p.start, Vec2(0, 0.5));
  ASSERT_EQ(p.segments.size(), 4U);
  EXPECT_EQ(p.segments[0].radius, 0.0);
  EXPECT_EQ(p.segments[1].to, Vec2(12, 2));
  EXPECT_EQ(p.segments[1].radius, 2.0);
  EXPECT_EQ(p.segments[2].radius, 3.0);
  EXPECT_TRUE(p.segments[2].large);
}

TEST_F(ProfileFile, PointsAreStraightLines) {
  const geometry::Profile p = read("points = [[0, 0], [1, 0], [1, 2.5]]");
  EXPECT_FALSE(p.closed);
  ASSERT_EQ(p.segments.size(), 2U);
  EXPECT_EQ(p.start, Vec2(0, 0));
  EXPECT_EQ(p.segments[1].to, Vec2(1, 2.5));
  EXPECT_EQ(p.segments[1].radius, 0.0);
}

TEST_F(ProfileFile, EveryErrorIsReportedInOneGoWithItsPlace) {
  const std::vector<std::string> all = complaints(R"(start = [0, 0]
colsed = true
[[segment]]
to = [10, 0]
[[segment]]
to = [14, 0]
radius = 1.5
[[segment]]
to = [14, 0]
[[segment]]
to = [nan, 2]
[[segment]]
radius = 2
[[segment]]
to = [1, 2, 3]
[[segment]]
to = ["a", 2]
large = 1
)");
  ASSERT_EQ(all.size(), 8U);
  EXPECT_TRUE(contains(all[0], "die.toml:2:1: unknown key 'colsed'")) << all[0];
  EXPECT_TRUE(contains(all[1], "die.toml:5:1: radius 1.5 is too small")) << all[1];
  EXPECT_TRUE(contains(all[2], "die.toml:8:1: ")) << all[2];
  EXPECT_TRUE(contains(all[2], "no length")) << all[2];
  EXPECT_TRUE(contains(all[3], "die.toml:11:7: 'to' must be a finite number")) << all[3];
  EXPECT_TRUE(contains(all[4], "'to' is missing")) << all[4];
  EXPECT_TRUE(contains(all[5], "'to' must be [x, y]")) << all[5];
  EXPECT_TRUE(contains(all[6], "'to' must be a finite number")) << all[6];
  EXPECT_TRUE(contains(all[7], "'large' must be true or false")) << all[7];
}

TEST_F(ProfileFile, BadTomlAndMissingFilesAreRefused) {
  EXPECT_THROW((void)read_profile(folder_ / "none.toml"), Error);
  EXPECT_TRUE(contains(complaints("start = [0,\n").at(0), "die.toml:"));
  EXPECT_TRUE(contains(complaints("").at(0), "missing"));
  EXPECT_TRUE(contains(complaints("start = [0, 0]").at(0), "'segment' is missing"));
  EXPECT_TRUE(contains(complaints("points = [[0, 0]]").at(0), "at least two"));
  EXPECT_TRUE(contains(complaints("points = [[0, 0], [1, 1]]\nstart = [0, 0]").at(0), "next to"));
  EXPECT_TRUE(contains(complaints("start = [0, 0]\nsegment = 3").at(0), "[[segment]]"));
  EXPECT_TRUE(contains(complaints("start = [0, 0]\nsegment = [3]").at(0), "table"));
  EXPECT_TRUE(
      contains(complaints("start = [0, 0]\n[[segment]]\nto = [1, 0]\nradius = 0").at(0), "line"));
}

/// It asserts, runs into code that it holds to be out of reach, or overflows its stack.
TEST_F(ProfileFile, TextsThatTheTomlLibraryIsNotPreparedForAreRefused) {
  for (const std::string& text : {std::string("[=]\n"), std::string("\"\u00e9\" = 1\n"),
                                  "points = " + std::string(100'000, '[')})
    EXPECT_FALSE(complaints(text).empty()) << text.substr(0, 20);
}

TEST_F(ProfileFile, AChainThatCrossesItselfIsRefused) {
  const std::vector<std::string> all =
      complaints("closed = true\npoints = [[0, 0], [1, 1], [1, 0], [0, 1]]");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(contains(all[0], "meet at (0.5, 0.5)")) << all[0];
}

} // namespace
} // namespace billet::io::profile_test
