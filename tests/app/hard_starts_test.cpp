// Jobs that used to diverge at once: a sheet that bends off the tool it lay on, a strip that a roll
// takes faster than it is pushed; and what a run says when a load or the energy is at fault.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>

namespace billet::test::hard_starts_test {

namespace {

/// A disc on a ring of radius 33, pressed in the middle by a flat punch of radius 20: it touches
/// all over both at the start, and then on two circles.
const std::string disc = R"(title = "Disc"
analysis = "axisymmetric"

[workpiece]
element = "quad8"
material = "steel"
mesh = { box = [[0, 0], [34, 1]], cells = [68, 2] }

[material.steel]
elastic = { young = 210000, poisson = 0.3 }

[[support]]
where = "x = 0"
fix = ["x"]

[[tool]]
name = "punch"
surface = { profile = "punch.toml" }
motion = { velocity = [0, -1] }

[[tool]]
name = "die"
surface = { profile = "die.toml" }

[time]
end = 0.01
)";
const std::string punch = R"(start = [-5, 1]
[[segment]]
to = [20, 1]
[[segment]]
to = [25, 6]
radius = 5
[[segment]]
to = [25, 80]
)";
const std::string die = R"(start = [80, 0]
[[segment]]
to = [33, 0]
[[segment]]
to = [27, -6]
radius = 6
[[segment]]
to = [27, -60]
)";

/// Half of a strip before a roll whose surface is faster than the pusher behind it.
const std::string strip = R"(title = "Strip"
analysis = "plane-strain"

[workpiece]
element = "quad4"
material = "steel"
mesh = { box = [[0, 0], [80, 10]], cells = [40, 5] }

[material.steel]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "swift", K = 600, eps0 = 0.01, n = 0.2 }

[[support]]
where = "y = 0"
fix = ["y"]

[[tool]]
name = "roll"
surface = { circle = { centre = [106, 107], radius = 100 } }
motion = { rotation = { point = [106, 107], speed = 3 } }
friction = { law = "coulomb", mu = 0.3 }

[[tool]]
name = "pusher"
surface = { plane = { point = [0, 0], normal = [1, 0] } }
motion = { velocity = [250, 0] }

[time]
end = 0.02
)";

/// Deflection of a plate of thickness 1 supported at radius a under a ring of load 1 at radius b,
/// at that ring (Timoshenko and Woinowsky-Krieger, Theory of plates and shells, section 18).
double deflection_at_ring(double a, double b, double young, double poisson) {
  const double D = young / (12.0 * (1.0 - poisson * poisson));
  return (2.0 * b * b * std::log(b / a) + (a * a - b * b) *
                                              ((3.0 + poisson) * a * a - (1.0 - poisson) * b * b) /
                                              (2.0 * (1.0 + poisson) * a * a)) /
         (8.0 * std::numbers::pi * D);
}

class HardStarts : public testing::Test {
protected:
  Outcome run(const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    return billet({"run", "case.toml", "-o", "out"}, folder_.path());
  }
  [[nodiscard]] ResultTable history() const {
    return read_table(folder_.path() / "out" / "history.csv");
  }
  TemporaryFolder folder_;
};

TEST_F(HardStarts, ASheetBendsOffAPunchWithTheForceOfAPlate) {
  write_text(folder_.path() / "punch.toml", punch);
  write_text(folder_.path() / "die.toml", die);
  const double exact = 0.01 / deflection_at_ring(33.0, 20.0, 210e3, 0.3);
  // Shear, the rim beyond the support and, in two linear elements over the height, their stiffness
  // in bending.
  for (const auto& [element, most] : {std::pair{"quad8", 0.03}, std::pair{"quad4", 0.1}}) {
    const Outcome outcome = run(edited(disc, {{"quad8", element}}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const ResultTable table = history();
    const double force = table.value(table.rows.size() - 1, "punch.force_y");
    std::printf("%s: %zu increments, force %.2f N (plate %.2f)\n", element, table.rows.size(),
                force, exact);
    EXPECT_NEAR(force, exact, most * exact);
    EXPECT_LT(table.rows.size(), 100u);
  }
}

TEST_F(HardStarts, ARollTakesAStripThatIsPushedMoreSlowly) {
  const Outcome outcome = run(strip);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  std::printf("%zu increments, roll %.1f N/mm up, pusher %.2g N/mm\n", table.rows.size(),
              table.value(last, "roll.force_y"), table.value(last, "pusher.force_x"));
  EXPECT_GT(table.value(last, "roll.force_y"), 100.0) << "it has bitten";
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    EXPECT_LE(table.value(row, "pusher.force_x"), 0.0) << "it pushes or stays behind";
}

TEST_F(HardStarts, AStripIsRolledThatSticksToItsRoll) {
  // Sticking, behind the roll's lowest point surfaces that part snap: it stopped there.
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[-13, 0], [-6.4, 1]], cells = [30, 1] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "perfect", yield = 346 }
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "roll"
surface = { circle = { centre = [0, 100.8], radius = 100 } }
motion = { rotation = { point = [0, 100.8], speed = 0.1 } }
friction = { law = "sticking" }
[[tool]]
name = "pusher"
surface = { plane = { point = [-13, 0], normal = [1, 0] } }
motion = { displacement = [[0, 0, 0], [0.2, 2, 0]] }
[time]
end = 1.1
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  double force = 0.0;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    force = std::max(force, table.value(row, "roll.force_y"));
  std::printf("%zu increments, %.0f N/mm at most\n", table.rows.size(), force);
  EXPECT_GT(force, 3000.0);
  EXPECT_LT(force, 7000.0);
}

TEST_F(HardStarts, ATurningPlateRubsAlongItsSpeedWhateverTheIncrements) {
  // A bar of 10 x 2 x 3 under 100 MPa on a plate that turns about the bar's end by 0.6 rad an
  // increment. Coulomb: the mean direction of the speed beneath the bar.
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex8", material = "steel", mesh = { box = [[0, 0, 0], [10, 2, 3]], cells = [5, 1, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "all"
fix = ["x", "z"]
[[load]]
where = "y = 2"
pressure = 100
[[tool]]
name = "plate"
surface = { plane = { point = [0, 0, 0], normal = [0, 1, 0] } }
motion = { rotation = { point = [0, 0, 0], axis = [0, 1, 0], speed = 6 } }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
increments = { first = 0.1, max = 0.1 }
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  // The mean of (-z, x)/r over the bar's face by Gauss' rule of 400 x 400 points: 10 N per unit.
  double x = 0.0, z = 0.0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double at_x = 10.0 * (i + 0.5) / n, at_z = 3.0 * (j + 0.5) / n;
      x += at_z / std::hypot(at_x, at_z) / (n * n);
      z -= at_x / std::hypot(at_x, at_z) / (n * n);
    }
  const double normal = 3000.0;
  EXPECT_NEAR(table.value(last, "plate.force_x"), -0.1 * normal * x, 0.02 * 0.1 * normal);
  EXPECT_NEAR(table.value(last, "plate.force_z"), -0.1 * normal * z, 0.02 * 0.1 * normal);
  const double torque = table.value(last, "plate.torque_y");
  const double turned = 6.0 - 0.3; // the pressure grows over the first tenth
  EXPECT_NEAR(table.value(last, "friction_work"), std::abs(torque) * turned,
              5e-3 * std::abs(torque) * turned);
}

TEST_F(HardStarts, APartThatTurnsWithItsToolsHasNoTorqueFromThat) {
  // It sticks to the lower plate; both turn alike, and the upper one presses it.
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex8", material = "steel", mesh = { cylinder = { radius = 5, height = 4 }, cells = [2, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 500 }
[[tool]]
name = "bottom"
surface = { plane = { point = [0, 0, 0], normal = [0, 0, 1] } }
motion = { rotation = { point = [0, 0, 0], axis = [0, 0, 1], speed = 6 } }
friction = { law = "sticking" }
[[tool]]
name = "top"
surface = { plane = { point = [0, 0, 4], normal = [0, 0, -1] } }
motion = { displacement = [[0, 0, 0, 0], [0.2, 0, 0, -0.4]], rotation = { point = [0, 0, 0], axis = [0, 0, 1], speed = 6 } }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 0.2
increments = { first = 0.01, max = 0.01 }
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  const double force = std::abs(table.value(last, "top.force_z"));
  EXPECT_GT(force, 20e3);
  EXPECT_LT(std::abs(table.value(last, "top.torque_z")), 1e-4 * 0.1 * force * 5.0);
}

TEST_F(HardStarts, AToolThatNeverTouchesIsTold) {
  const Outcome outcome = run(edited(upsetting, {{"velocity = [0, -1]", "velocity = [0, 1]"}}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("tool punch has not touched the workpiece"), std::string::npos);
  EXPECT_NE(outcome.out.find("balance 0.00e+00"), std::string::npos) << outcome.out;
  EXPECT_LT(history().rows.size(), 60u);
}

TEST_F(HardStarts, AToolWithinTheWorkpieceIsRefused) {
  const Outcome outcome =
      run(edited(upsetting, {{"plane = { point = [0, 7.5], normal = [0, -1] }",
                              "circle = { centre = [2.5, 3.75], radius = 1 }"}}));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find("the tool lies wholly within it"), std::string::npos) << outcome.err;
}

TEST_F(HardStarts, IncrementsAreAsLongAsAskedForAtLeast) {
  const Outcome outcome = run(edited(upsetting, {{"first = 0.02, max = 0.02", "min = 0.05"}}));
  ASSERT_EQ(outcome.status, 8) << outcome.err; // too long for the balance of energy
  EXPECT_EQ(history().rows.size(), 2u);
  // Half of the height at once, on six elements.
  const Outcome failed =
      run(edited(upsetting, {{"end = 0.1\nincrements = { first = 0.02, max = 0.02 }",
                              "end = 6\nincrements = { min = 6 }"}}));
  EXPECT_EQ(failed.status, 5);
  EXPECT_NE(whole_file(folder_.path() / "out" / "failure" / "post_mortem.txt")
                .find("time.increments.min = 6 allows none shorter"),
            std::string::npos);
  const Outcome refused = run(edited(upsetting, {{"first = 0.02, max = 0.02", "min = 0.2"}}));
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("no more than the end 0.1"), std::string::npos) << refused.err;
}

TEST_F(HardStarts, ALooseStripIsTippedByATiltedDieAndPressedFlat) {
  // It lies on the lower die; the upper one, turned by 0.3 degrees, meets one end.
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[-10, 0], [10, 1]], cells = [40, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 550, eps0 = 0.005, n = 0.2 }
[[tool]]
name = "upper"
surface = { plane = { point = [0, 1.05336], normal = [0.005236, -0.9999863] } }
motion = { velocity = [0, -0.1] }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name = "lower"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  std::printf("%zu increments, %.0f N/mm\n", table.rows.size(), table.value(last, "upper.force_y"));
  EXPECT_NEAR(table.value(last, "upper.force_y"), -table.value(last, "lower.force_y"),
              1e-3 * table.value(last, "upper.force_y"));
  EXPECT_GT(table.value(last, "max_plastic_strain"), 0.05) << "both ends have been pressed";
}

TEST_F(HardStarts, AStripIsPushedThroughTheAirToARoll) {
  // Nothing but its stabilization holds it on the way: forces of 1e-7 N, which say nothing.
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[-10.831347195933173, 0], [-2.831347195933173, 1]], cells = [30, 4] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "perfect", yield = 200 }
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "roll"
surface = { circle = { centre = [0, 20.8], radius = 20 } }
motion = { rotation = { point = [0, 20.8], speed = 1 } }
friction = { law = "coulomb", mu = 0.2 }
[[tool]]
name = "pusher"
surface = { plane = { point = [-10.831347195933173, 0], normal = [1, 0] } }
motion = { velocity = [15, 0] }
[time]
end = 0.02
increments = { first = 0.006, max = 0.012 }
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  EXPECT_GT(table.value(table.rows.size() - 1, "roll.force_y"), 1.0);
}

TEST_F(HardStarts, ARunThatMissesEnergySaysWhere) {
  // The pusher leaves while the roll presses the strip back, far too fast for increments that the
  // case says itself.
  const Outcome outcome = run(edited(
      strip, {{"velocity = [250, 0]", "displacement = [[0, 0, 0], [0.02, 7, 0], [0.0201, -9, 0]]"},
              {"speed = 3", "speed = 0"},
              {"end = 0.02", "end = 0.0202\nincrements = { first = 1e-4, max = 4e-4 }"}}));
  ASSERT_EQ(outcome.status, 8) << outcome.err;
  EXPECT_TRUE(outcome.says("failed check 'energy-balance'")) << outcome.err;
  EXPECT_TRUE(outcome.prints("warning: [energy-missing] the balance of energy misses") ||
              outcome.says("warning: [energy-missing] the balance of energy misses"))
      << outcome.out << outcome.err;
  EXPECT_TRUE(outcome.prints("the increment that ends at t = 0.020") ||
              outcome.says("the increment that ends at t = 0.020"))
      << outcome.out << outcome.err;
}

TEST_F(HardStarts, ALoadBeyondWhatThePartBearsIsNamed) {
  // A thin ring under a pressure that rises beyond its yield: it bursts.
  const Outcome outcome = run(
      edited(upsetting,
             {{"[[0, 0], [5, 7.5]]", "[[20, 0], [22, 7.5]]"},
              {"\"x = 0\"\nfix   = [\"x\"]", "\"y = 7.5\"\nfix = [\"y\"]"},
              {"[time]", "[[load]]\nwhere = \"x = 20\"\npressure = [[0, 0], [0.1, 100]]\n\n[time]"},
              {"motion   = { velocity = [0, -1] }\n", ""}}));
  ASSERT_EQ(outcome.status, 5) << outcome.err;
  const std::string post = whole_file(folder_.path() / "out" / "failure" / "post_mortem.txt");
  EXPECT_NE(post.find("the most that the part bears"), std::string::npos) << post;
}

TEST_F(HardStarts, AForceThatIsThereAtOnceSqueezesThePart) {
  // Twice what makes the billet yield: increments grow into it, and it ends as if the case had let
  // the force grow.
  const auto pressed = [&](const std::string& force) {
    const Outcome outcome = run(edited(
        upsetting, {{"motion   = { velocity = [0, -1] }",
                     "motion = { force = { direction = [0, -1], value = " + force + " } }"}}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const ResultTable table = history();
    const std::size_t last = table.rows.size() - 1;
    EXPECT_NEAR(table.value(last, "punch.force_y"), 80e3, 1.0);
    return table.value(last, "punch.displacement_y");
  };
  const double at_once = pressed("80e3");
  EXPECT_LT(at_once, -1.0);
  EXPECT_NEAR(at_once, pressed("[[0, 0], [0.01, 80e3]]"), 2e-3 * std::abs(at_once));
}

TEST_F(HardStarts, APressureThatIsThereAtOnceWidensARing) {
  const auto widened = [&](const std::string& pressure) {
    const Outcome outcome = run(
        edited(upsetting,
               {{"[[0, 0], [5, 7.5]]", "[[20, 0], [22, 7.5]]"},
                {"\"x = 0\"\nfix   = [\"x\"]", "\"y = 7.5\"\nfix = [\"y\"]"},
                {"[time]", "[[load]]\nwhere = \"x = 20\"\npressure = " + pressure + "\n\n[time]"},
                {"motion   = { velocity = [0, -1] }\n", ""}}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return history().value(history().rows.size() - 1, "plastic_work");
  };
  const double at_once = widened("\"36 MPa\"");
  EXPECT_GT(at_once, 0.0);
  EXPECT_NEAR(at_once, widened("[[0, 0], [0.01, 36]]"), 5e-3 * at_once);
}

/// The gap that touch leaves is rounding of coordinates, of large ones in the tool's frame too.
TEST_F(HardStarts, a_tool_far_from_its_origin_is_brought_to_touch) {
  const Outcome outcome = run(R"(title = "Far away"
analysis = "3d"

[workpiece]
element = "hex8"
material = "metal"
mesh = { box = [[-5, -4, 0], [5, 4, 6]], cells = [5, 4, 3] }
place = { translate = [0, 0, 7000] }

[material.metal]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 500 }

[[support]]
where = "set:z-min"
fix = ["x", "y", "z"]

[[tool]]
name = "punch"
surface = { sphere = { centre = [0.3, 0.2, 7014], radius = 3 } }
motion = { force = { direction = [0, 0, -1], value = [[0, 0], [1, 10000]] } }
touch = true

[time]
end = 1
)");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(history().value(history().rows.size() - 1, "punch.force_z"), 10000.0, 1.0);
}

} // namespace
} // namespace billet::test::hard_starts_test
