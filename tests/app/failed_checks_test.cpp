// A run that comes to its end with a result of no use says so by its status.

#include "tests/app/case_run.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace billet::test::failed_checks_test {

namespace {

/// A block that stands on an edge between two planes, and nothing holds it.
const std::string tilted_block = R"(analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "m"
mesh = { box = [[0, 0], [10, 10]], cells = [4, 4] }
place = { rotate = { axis = [0, 0, 1], degrees = 20 } }
[material.m]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[tool]]
name = "table"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[[tool]]
name = "punch"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = { velocity = [0, -0.5] }
touch = true
[time]
end = 1
)";

class FailedCheck : public CaseRun {};

TEST_F(FailedCheck, AGoodRunHasNone) {
  const Outcome outcome = run(upsetting);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary()["status"], "done");
  EXPECT_TRUE(summary()["failed_checks"].empty());
}

// It ended with "done", a force of 0.0003 N and all of the work in the stabilization.
TEST_F(FailedCheck, AForgottenSupportIsNamed) {
  const std::string text = R"(analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "m"
mesh = { box = [[0, 0], [10, 10]], cells = [4, 4] }
[material.m]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[tool]]
name = "punch"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = { velocity = [0, -0.5] }
[time]
end = 1
)";
  const Outcome outcome = run(text);
  EXPECT_EQ(outcome.status, 8) << outcome.err;
  EXPECT_TRUE(outcome.says("failed check 'stabilization'")) << outcome.err;
  EXPECT_TRUE(outcome.says("[[support]]")) << outcome.err;
  const nlohmann::json result = summary();
  EXPECT_EQ(result["status"], "failed-checks");
  EXPECT_EQ(result["exit_status"], 8);
  EXPECT_EQ(result["failed_checks"][0]["check"], "stabilization");
  EXPECT_TRUE(outcome.prints("failed-checks at time 1")) << outcome.out;
}

TEST_F(FailedCheck, ABlockThatStandsTiltedIsNoForging) {
  const Outcome outcome = run(tilted_block);
  EXPECT_EQ(outcome.status, 8) << outcome.out;
  EXPECT_TRUE(outcome.says("failed check 'stabilization'")) << outcome.err;
}

} // namespace

} // namespace billet::test::failed_checks_test
