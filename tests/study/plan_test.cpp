// Study files, and the rows that they give.

#include "geometry/base/error.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "study/plan.h"
#include "study/sampling.h"

namespace billet::study::plan_test {
namespace {

class StudyFile : public testing::Test {
protected:
  StudyFile() { (void)folder_.file("case.toml", "\n"); }
  [[nodiscard]] Study read(const std::string& text) const {
    return read_study(folder_.file("study.toml", "case = \"case.toml\"\n" + text));
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(StudyFile, GivesAllCombinationsTheLastAxisFastest) {
  const std::vector<Row> rows = rows_of(read(R"(
[[vary]]
key = "tool.punch.friction.m"
values = [0, 0.5]
[[vary]]
name = "mesh"
key = "workpiece.mesh.cells"
values = [[2, 3], [4, 6]]
sizes = [1, 0.5]
)"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1].labels, (std::vector<std::string>{"0", "[4, 6]"}));
  EXPECT_EQ(rows[1].overrides(),
            (std::vector<std::string>{"tool.punch.friction.m=0", "workpiece.mesh.cells=[4, 6]"}));
  EXPECT_EQ(rows[2].labels[0], "0.5");
}

TEST_F(StudyFile, HasRangesAndLevelsOfSeveralKeys) {
  const std::vector<Row> rows = rows_of(read(R"(
[[vary]]
key = "contact.penalty"
from = 1
to = 1e4
count = 3
scale = "log"
[[vary]]
name = "element"
levels = [ { label = "linear", set = { "workpiece.element" = "quad4", "workpiece.mesh.cells" = [8, 8] } },
           { label = "quadratic", set = { "workpiece.element" = "quad8" } } ]
)"));
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[2].overrides(),
            (std::vector<std::string>{"contact.penalty=100", "workpiece.element=\"quad4\"",
                                      "workpiece.mesh.cells=[8, 8]"}));
  EXPECT_EQ(rows[5].labels, (std::vector<std::string>{"10000", "quadratic"}));
}

TEST_F(StudyFile, DrawsSamplesOfValuesAlone) {
  const std::vector<Row> rows = rows_of(read(R"(
[sample]
method = "sobol"
count = 8
[[vary]]
key = "a"
values = [1, 2]
)"));
  ASSERT_EQ(rows.size(), 8U);
  for (const char* const label : {"1", "2"})
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                            [&](const Row& row) { return row.labels[0] == label; }),
              4)
        << label;
  EXPECT_NE(refusal("[sample]\nmethod = \"sobol\"\ncount = 8\n").find("nothing to draw from"),
            std::string::npos);
}

TEST_F(StudyFile, DrawsSamplesThatFillRanges) {
  for (const std::string method : {"latin-hypercube", "sobol"}) {
    const std::vector<Row> rows = rows_of(read(R"(
[sample]
method = ")" + method + R"("
count = 16
[[vary]]
key = "a"
from = 0
to = 16
[[vary]]
key = "b"
values = ["x", "y"]
)"));
    ASSERT_EQ(rows.size(), 16U);
    std::set<int> intervals;
    for (const Row& row : rows)
      intervals.insert(static_cast<int>(std::floor(std::stod(row.labels[0]))));
    EXPECT_GE(intervals.size(), method == "sobol" ? 15U : 16U) << method;
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                            [](const Row& row) { return row.labels[1] == "x"; }),
              8)
        << method;
  }
}

TEST_F(StudyFile, IsRefusedWithAllThatIsWrong) {
  const std::string text = refusal(R"(
[[vary]]
key = "m"
valuse = [1]
[[quantity]]
name = "f"
of = "time"
take = "median"
[run]
engine = "cloud"
)");
  EXPECT_NE(text.find("study.toml:3"), std::string::npos) << text;
  EXPECT_NE(text.find("valuse"), std::string::npos) << text;
  EXPECT_NE(text.find("median"), std::string::npos) << text;
  EXPECT_NE(text.find("cloud"), std::string::npos) << text;
}

TEST_F(StudyFile, NeedsAReferenceThatIsThere) {
  const std::string axis = "[[vary]]\nkey = \"m\"\nvalues = [1, 2, 3]\n";
  EXPECT_NE(refusal(axis + "[trade]\nreference = \"finest\"\n").find("sizes"), std::string::npos);
  EXPECT_NE(refusal(axis + "[trade]\nreference = { m = 4 }\n").find("level of m '4'"),
            std::string::npos);
  EXPECT_NE(refusal(axis + "[trade]\nreference = { n = 1 }\n").find("axis 'n'"), std::string::npos);
  EXPECT_NE(refusal(axis + "[convergence]\n").find("sizes"), std::string::npos);
  EXPECT_EQ(refusal(axis + "sizes = [4, 2, 1]\n[convergence]\n[trade]\nreference = \"finest\"\n"),
            "");
}

TEST_F(StudyFile, MayBeOverridden) {
  const Study study = read_study(folder_.file("study.toml", "case = \"case.toml\"\n"),
                                 {"run.engine=slurm", "run.processes=3"});
  EXPECT_EQ(study.engine.kind, Engine::Kind::slurm);
  EXPECT_EQ(study.engine.processes, 3);
  EXPECT_EQ(rows_of(study).size(), 1U); // the case as it is
}

TEST(Sampling, LatinHypercubeHasOnePointInEveryInterval) {
  const auto points = latin_hypercube(50, 3, 4);
  for (std::size_t d = 0; d < 3; ++d) {
    std::set<int> intervals;
    for (const std::vector<double>& point : points)
      intervals.insert(static_cast<int>(point[d] * 50.0));
    EXPECT_EQ(intervals.size(), 50U);
  }
}

TEST(Sampling, SobolsPointsAreThoseOfTheLiterature) {
  // Bratley and Fox, ACM Trans. Math. Softw. 14 (1988) 88: 1/2; 3/4, 1/4; ... along both axes.
  const auto points = sobol(3, 2, 1);
  EXPECT_EQ(points[0], (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(points[1], (std::vector<double>{0.75, 0.25}));
  EXPECT_EQ(points[2], (std::vector<double>{0.25, 0.75}));
}

} // namespace
} // namespace billet::study::plan_test
