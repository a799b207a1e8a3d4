// Tools that turn fast on the part: no increment takes a circle for a chord.

#include "tests/app/case_run.h"
#include "tests/app/tables.h"
#include "tests/support/case_texts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace billet::test::turning_tools_test {
namespace {

/// A plane tool that spins by a turn a second on a disc; the longest increments by default, a
/// fiftieth, would be a fifth of a turn.
const std::string spinning = R"(title = "Spin"
analysis = "3d"

[workpiece]
element = "hex8"
material = "metal"
mesh = { cylinder = { radius = 5, height = 1 }, cells = [4, 1] }

[material.metal]
elastic = { young = 210e3, poisson = 0 }
flow = { law = "perfect", yield = 1000 }

[[support]]
where = "set:bottom"
fix = ["x", "y", "z"]

[[tool]]
name = "die"
surface = { plane = { point = [0, 0, 1], normal = [0, 0, -1] } }
motion = { displacement = [[0, 0, 0, 0], [1, 0, 0, -0.0001], [10, 0, 0, -0.0001]], rotation = { point = [0, 0, 0], axis = [0, 0, 1], speed = 25 } }
friction = { law = "coulomb", mu = 0.1 }

[time]
end = 10
)";

class TurningTool : public CaseRun {};

TEST_F(TurningTool, RubsAllTheWayRound) {
  const Outcome outcome = run(spinning);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::vector<double> time = table.values("time"), torque = table.values("die.torque_z"),
                            work = table.values("friction_work");
  double expected = 0.0; // of the torque over the turn
  for (std::size_t i = 1; i < time.size(); ++i) {
    expected += 0.5 * std::abs(torque[i] + torque[i - 1]) * 25.0 * (time[i] - time[i - 1]);
    if (time[i] > 1.0) {
      EXPECT_LT(25.0 * (time[i] - time[i - 1]), 0.5001) << time[i];
      EXPECT_NEAR(torque[i], torque.back(), 0.02 * std::abs(torque.back())) << time[i];
    }
  }
  EXPECT_NEAR(work.back(), expected, 0.01 * expected);
}

TEST_F(TurningTool, TakesNoMoreIncrementsThanOthersWithoutFriction) {
  ASSERT_EQ(
      run(edited(spinning, {{R"({ law = "coulomb", mu = 0.1 })", R"({ law = "frictionless" })"}}))
          .status,
      0);
  EXPECT_LT(history().values("time").size(), 120U);
}

} // namespace
} // namespace billet::test::turning_tools_test
