// Tools that are narrower than faces: no run passes them over.

#include "tests/app/case_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace billet::test::narrow_tools_test {

namespace {

/// A tool goes half of a length unit down into a block of 3 x 3 x 2 hex8 of about 1.4.
std::string in_space(const std::string& surface, const std::string& more = "") {
  return R"(analysis = "3d"
[workpiece]
element = "hex8"
material = "m"
mesh = { box = [[-2, -2, 0], [2, 2, 3]], cells = [3, 3, 2] }
[material.m]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "z = 0"
fix = ["x", "y", "z"]
[[tool]]
name = "needle"
surface = )" +
         surface + R"(
motion = { velocity = [0, 0, -0.5] }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
)" + more;
}

/// A wire of that radius goes 0.5 into a block of 20 x 8 quad8 of 0.5.
std::string in_plane(double radius, const std::string& more = "") {
  const std::string r = std::to_string(radius);
  const std::string height = std::to_string(4.0 + radius);
  return R"(analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "m"
mesh = { box = [[-5, 0], [5, 4]], cells = [20, 8] }
[material.m]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "y = 0"
fix = ["x", "y"]
[[tool]]
name = "needle"
surface = { circle = { centre = [0.1, )" +
         height + "], radius = " + r + R"( } }
motion = { velocity = [0, -0.5] }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
)" + more;
}

class NarrowTool : public CaseRun {};

// They went in by up to a third of an element, or through it, with force 0 and status 0.
TEST_F(NarrowTool, InSpaceEndsTheRunWhereItLiesInThePartUnfelt) {
  for (const std::string surface : {
           "{ sphere = { centre = [0.13, 0.21, 3.001], radius = 0.001 } }",
           "{ sphere = { centre = [0.13, 0.21, 3.1], radius = 0.1 } }",
           "{ sphere = { centre = [0.13, 0.21, 3.3], radius = 0.3 } }",
           "{ cone = { apex = [0.13, 0.21, 3], axis = [0, 0, 1], half_angle = 2 } }",
           "{ cylinder = { point = [0, 0, 3.01], axis = [0, 1, 0], radius = 0.01 } }",
           "{ torus = { centre = [0.1, 0, 3.01], axis = [0, 0, 1], major = 0.6, minor = 0.01 } }",
       }) {
    const Outcome outcome = run(in_space(surface));
    EXPECT_EQ(outcome.status, 5) << surface;
    const nlohmann::json result = summary();
    const std::string reason = result["failure"]["reason"];
    for (const char* part : {"tool 'needle' lies ", " deep in the workpiece near (",
                             "% of the element there", "no contact point meets it"})
      EXPECT_NE(reason.find(part), std::string::npos) << reason;
    const double share = result["penetration"]["largest_share_of_element"];
    EXPECT_LE(share, 0.102) << surface << ": no accepted increment has it deeper, but for what a "
                            << "bound exceeds it by";
    EXPECT_GT(share, 0.05) << surface;
  }
}

/// An open sheet has nothing behind it that says how wide it is.
TEST_F(NarrowTool, AnOpenSheetSmallerThanAFaceIsNotPassedOver) {
  write_text(folder_.path() / "sheet.stl", R"(solid sheet
facet normal 0 0 -1
outer loop
vertex -0.1 -0.1 3.2
vertex 0.1 0.1 3.2
vertex 0.1 -0.1 3.2
endloop
endfacet
facet normal 0 0 -1
outer loop
vertex -0.1 -0.1 3.2
vertex -0.1 0.1 3.2
vertex 0.1 0.1 3.2
endloop
endfacet
endsolid sheet
)");
  const Outcome outcome = run(in_space(R"({ stl = "sheet.stl", unit = "mm" })"));
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  EXPECT_TRUE(outcome.says("lies")) << outcome.err;
}

TEST_F(NarrowTool, IsMetInFixedIncrementsThatWouldCarryItThrough) {
  const Outcome outcome =
      run(in_space("{ sphere = { centre = [0.13, 0.21, 3.01], radius = 0.01 } }",
                   "increments = { first = 1, max = 1 }\n"));
  EXPECT_EQ(outcome.status, 5);
  const double share = summary()["penetration"]["largest_share_of_element"];
  EXPECT_LE(share, 0.1);
}

TEST_F(NarrowTool, WithALimitOfPenetrationKeepsIt) {
  const Outcome outcome = run(in_plane(0.1501, "[contact]\nmax_penetration = 0.001\n"));
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  const double largest = summary()["penetration"]["largest"];
  EXPECT_LE(largest, 0.001);
}

// In the plane a thin wire presses between the contact points, as the rounding of a profile does.
TEST_F(NarrowTool, InThePlaneAWireHasAForce) {
  for (const double radius : {0.0005, 0.05}) {
    const Outcome outcome = run(in_plane(radius));
    const std::vector<double> force = history().values("needle.force_y");
    ASSERT_FALSE(force.empty());
    const double largest = *std::max_element(force.begin(), force.end());
    EXPECT_GT(largest, 100.0) << radius;
    EXPECT_EQ(outcome.status, 8) << "its force is that of elements of this size";
    EXPECT_TRUE(outcome.says("failed check 'contact-resolution'")) << outcome.err;
    const double share = summary()["penetration"]["largest_share_of_element"];
    EXPECT_LE(share, 0.1) << radius;
  }
}

// Its end is in the wall before a contact point is: small increments came to that, large ones went
// past it.
TEST_F(NarrowTool, AFaceMayMeetABroadToolEndFirst) {
  const auto case_text = [](const std::string& normal, double penalty) {
    return R"(analysis = "plane-strain"
[workpiece]
element = "quad4"
material = "m"
mesh = { box = [[-4, 0], [0, 1]], cells = [8, 2] }
[material.m]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "set:x-min"
move = { x = [[0, 0], [1, 0.3]] }
[[tool]]
name = "wall"
surface = { plane = { point = [0.05, 1], normal = )" +
           normal + R"( } }
[contact]
surface = "set:y-max"
penalty = )" +
           std::to_string(penalty) +
           R"(
[time]
end = 1
increments = { first = 0.005, max = 0.005 }
)";
  };
  // 0.096 of an element at 27 degrees, and a little of a soft penalty: more than a tenth in all.
  const Outcome slight = run(case_text("[-0.454, -0.891]", 0.5));
  EXPECT_EQ(slight.status, 0) << slight.err;
  EXPECT_TRUE(slight.says("10.2 % of the parent element"));
  const Outcome outcome = run(case_text("[-0.643, -0.766]", 100.0));
  EXPECT_EQ(outcome.status, 8) << outcome.err;
  EXPECT_TRUE(outcome.says("failed check 'tool-in-part'")) << "the mesh is too coarse for it";
  EXPECT_EQ(summary()["cutbacks"], 0);
  EXPECT_GT(history().values("wall.force_x").back(), 100.0);
}

TEST_F(NarrowTool, LargeToolsAndSharpPunchesRunAsBefore) {
  const Outcome outcome = run(in_space("{ sphere = { centre = [0.13, 0.21, 8], radius = 5 } }"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const double balance = summary()["energy"]["relative_error"];
  EXPECT_LT(balance, 0.01);
}

} // namespace

} // namespace billet::test::narrow_tools_test
