// How far two results are apart.

#include "geometry/base/error.h"
#include "io/compare/difference.h"
#include "io/results/pvd.h"
#include "io/results/vtk_writer.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace billet::io::compare_test {

namespace {

using test::TemporaryFolder;

class Compared : public testing::Test {
protected:
  void write(const std::string& run, const std::string& file, const std::string& text) {
    std::filesystem::create_directories(folder_.path() / run);
    std::ofstream(folder_.path() / run / file) << text;
  }
  [[nodiscard]] Comparison compare() const {
    return compare_results(folder_.path() / "a", folder_.path() / "b");
  }
  static const Difference* find(const Comparison& comparison, const std::string& quantity) {
    const auto found =
        std::find_if(comparison.quantities.begin(), comparison.quantities.end(),
                     [&](const Difference& one) { return one.quantity == quantity; });
    return found == comparison.quantities.end() ? nullptr : &*found;
  }

  TemporaryFolder folder_;
};

TEST_F(Compared, columns_are_compared_at_all_common_times) {
  write("a", "history.csv", "increment,time,punch.force_y\n1,0,0\n2,1,-100\n");
  write("b", "history.csv", "increment,time,punch.force_y\n1,0,0\n2,0.5,-60\n3,1,-100\n");
  const Comparison comparison = compare();
  const Difference* const force = find(comparison, "history punch.force_y");
  ASSERT_NE(force, nullptr);
  EXPECT_DOUBLE_EQ(force->absolute, 10.0); // at 0.5: -50 and -60
  EXPECT_EQ(force->where, "t = 0.5");
  EXPECT_DOUBLE_EQ(force->relative(), 0.1);
  EXPECT_EQ(find(comparison, "history increment"), nullptr);
  ASSERT_FALSE(comparison.notes.empty());
  EXPECT_NE(comparison.notes.front().find("2 and 3 increments"), std::string::npos);
}

TEST_F(Compared, noise_of_one_component_counts_by_the_vector) {
  const std::string head = "time,die.force_x,die.force_y\n";
  write("a", "history.csv", head + "0,1e-9,0\n1,2e-9,500\n");
  write("b", "history.csv", head + "0,3e-9,0\n1,1e-9,500\n");
  const Comparison comparison = compare();
  EXPECT_LT(find(comparison, "history die.force_x")->relative(), 1e-11);
  EXPECT_TRUE(Tolerance{}.admits(*find(comparison, "history die.force_x")));
}

TEST_F(Compared, what_one_of_them_lacks_is_a_difference_that_no_tolerance_admits) {
  write("a", "history.csv", "time,wear\n0,1\n");
  write("b", "history.csv", "time\n0\n");
  const Difference* const wear = find(compare(), "history wear");
  ASSERT_NE(wear, nullptr);
  EXPECT_TRUE(std::isinf(wear->relative()));
  EXPECT_FALSE((Tolerance{1.0, 1e9}.admits(*wear)));
}

TEST_F(Compared, frames_of_one_alone_are_such_a_difference) {
  for (const char* run : {"a", "b"})
    write(run, "history.csv", "time,wear\n0,1\n");
  EXPECT_EQ(find(compare(), "frames"), nullptr);
  WorkpieceFrame frame;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<mechanics::Index> cells{0, 1, 2, 3};
  frame.points = points;
  frame.cells = cells;
  std::filesystem::create_directories(folder_.path() / "a" / "frames");
  write_vtu(folder_.path() / "a" / "frames" / "workpiece_0000.vtu", frame);
  write_pvd(folder_.path() / "a" / "case.pvd", {{0.0, "workpiece", "frames/workpiece_0000.vtu"}});
  const Comparison comparison = compare();
  const Difference* const frames = find(comparison, "frames");
  ASSERT_NE(frames, nullptr);
  EXPECT_EQ(frames->second, "absent");
}

TEST_F(Compared, not_a_number_is_the_same_as_itself_only) {
  write("a", "history.csv", "time,u,v\n0,nan,nan\n");
  write("b", "history.csv", "time,u,v\n0,nan,1\n");
  const Comparison comparison = compare();
  EXPECT_EQ(find(comparison, "history u")->relative(), 0.0);
  EXPECT_TRUE(std::isinf(find(comparison, "history v")->relative()));
}

TEST_F(Compared, summaries_are_compared_without_what_tells_of_the_machine) {
  for (const char* run : {"a", "b"})
    write(run, "history.csv", "time\n0\n");
  write("a", "summary.json",
        R"({"status": "done", "threads": 1, "energy": {"plastic": 10.0}, "seconds": {"total": 1},
            "tools": [{"name": "die", "force": [0.0, 5.0]}]})");
  write("b", "summary.json",
        R"({"status": "stopped", "threads": 2, "energy": {"plastic": 11.0}, "seconds": {"total": 9},
            "tools": [{"name": "die", "force": [1e-8, 5.0]}]})");
  const Comparison comparison = compare();
  EXPECT_EQ(find(comparison, "summary threads"), nullptr);
  EXPECT_EQ(find(comparison, "summary seconds.total"), nullptr);
  EXPECT_EQ(find(comparison, "summary status")->second, "stopped");
  EXPECT_NEAR(find(comparison, "summary energy.plastic")->relative(), 1.0 / 11.0, 1e-12);
  EXPECT_LT(find(comparison, "summary tools.die.force.0")->relative(), 1e-8);
}

TEST_F(Compared, refuses_a_folder_that_holds_no_results) {
  write("a", "history.csv", "time\n0\n");
  std::filesystem::create_directories(folder_.path() / "b");
  EXPECT_THROW((void)compare(), Error);
}

TEST_F(Compared, the_files_that_cases_name_are_compared) {
  const std::string text = R"(
analysis = "axisymmetric"
[workpiece]
element = "quad4"
material = "m"
mesh = { file = "part.inp" }
[material.m]
elastic = { young = 7e4, poisson = 0.3 }
[[tool]]
name = "die"
surface = { profile = "die.toml" }
[time]
end = 1
)";
  for (const char* run : {"a", "b"}) {
    write(run, "case.toml", text);
    write(run, "die.toml", "points = [[5, 5], [0, 5]]\n");
    write(run, "part.inp", "*NODE\n1, 0, 0\n2, 1, 0\n");
  }
  const auto compared = [&] {
    return compare_cases(folder_.path() / "a" / "case.toml", folder_.path() / "b" / "case.toml");
  };
  EXPECT_EQ(find(compared(), "content of workpiece.mesh")->relative(), 0.0);
  EXPECT_EQ(find(compared(), "content of tool.die.surface")->relative(), 0.0);
  write("b", "part.inp", "*NODE\n1, 0, 0\n2, 2, 0\n");
  const Comparison comparison = compared();
  const Difference* const mesh = find(comparison, "content of workpiece.mesh");
  ASSERT_NE(mesh, nullptr);
  EXPECT_TRUE(std::isinf(mesh->relative()));
  EXPECT_EQ(mesh->where, "part.inp, from line 3");
  EXPECT_EQ(find(comparison, "content of tool.die.surface")->relative(), 0.0);
  for (const std::string run : {"a", "b"}) { // the same file, which includes others
    write(run, "part.inp", "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=CAX4\n1, 1, 2, 3, 4\n");
    write(run, "nodes.inp", "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n");
  }
  EXPECT_EQ(find(compared(), "content of workpiece.mesh")->relative(), 0.0);
  write("b", "nodes.inp", "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 2\n4, 0, 2\n");
  EXPECT_EQ(find(compared(), "content of workpiece.mesh")->where, "what part.inp includes");
}

} // namespace

} // namespace billet::io::compare_test
