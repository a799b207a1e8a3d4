// Metal that comes to a plane of symmetry, from case file to force: compared with a rigid tool
// there.

#include "tests/app/case_run.h"

#include <string>

namespace billet::test::symmetry_wall_test {

namespace {

class SymmetryWallRun : public CaseRun {
protected:
  /// The force on the punch when half of a C, 20 x 5.1 mm with a slit of 0.1 mm, is being closed.
  [[nodiscard]] double force(const std::string& results, const std::string& at_the_plane) const {
    write_text(folder_.path() / "half.toml", R"(closed = true
start = [0, 0]
[[segment]]
to = [3, 0]
[[segment]]
to = [3, 0.1]
[[segment]]
to = [20, 0.1]
[[segment]]
to = [20, 5.1]
[[segment]]
to = [0, 5.1]
)");
    write_text(folder_.path() / "case.toml", R"(analysis = "plane-strain"
[workpiece]
element = "tri6"
material = "m"
mesh = { outline = "half.toml", size = 1 }
[material.m]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 500 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "punch"
surface = { plane = { point = [0, 5.1], normal = [0, -1] } }
motion = { velocity = [0, -0.5] }
[time]
end = 0.18
)" + at_the_plane);
    const Outcome outcome = billet({"run", "case.toml", "--quiet", "-o", results}, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_table(folder_.path() / results / "history.csv").values("punch.force_y").back();
  }
};

TEST_F(SymmetryWallRun, BearsASlitThatClosesAsARigidPlaneDoes) {
  const double meets_its_image = force("image", "");
  const double meets_a_tool = force("tool", R"([[tool]]
name = "wall"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[contact]
self = false
)");
  EXPECT_GT(meets_a_tool, 1000.0);
  // Node by node; where nodes were held early a fifth was missing.
  EXPECT_NEAR(meets_its_image, meets_a_tool, 0.03 * meets_a_tool);
}

} // namespace

} // namespace billet::test::symmetry_wall_test
