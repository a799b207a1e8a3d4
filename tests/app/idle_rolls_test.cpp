// Rolls that nothing drives: contact may turn them by friction alone.

#include "tests/app/case_run.h"
#include "tests/support/case_texts.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace billet::test::idle_rolls_test {
namespace {

/// A roll pressed into a block, off its middle, and then drawn along it.
const std::string roll = R"(title = "Idle roll"
analysis = "plane-strain"

[workpiece]
element = "quad8"
material = "metal"
mesh = { box = [[0, 0], [5, 6]], cells = [4, 4] }

[material.metal]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 500 }

[[support]]
where = "y = 0"
fix = ["y"]

[[support]]
where = "set:x-min"
fix = ["x"]

[[tool]]
name = "roll"
surface = { circle = { centre = [2.2, 9], radius = 3 } }
motion = { displacement = [[0, 0, 0], [0.4, 0, -1], [1, 1.5, -1]], torque = { point = [2.2, 9], value = 0 } }
friction = { law = "frictionless" }

[time]
end = 1
)";

class IdleRoll : public CaseRun {
protected:
  [[nodiscard]] double turned() const { return summary().at("tools").at("roll").at("turned"); }
};

TEST_F(IdleRoll, WithoutFrictionIsNotTurned) {
  for (const std::string element : {"quad8", "tri6", "quad4"}) {
    const Outcome outcome = run(edited(roll, {{"quad8", element}}));
    ASSERT_EQ(outcome.status, 0) << element << ": " << outcome.err;
    EXPECT_LT(std::abs(turned()), 1e-5) << element;
  }
}

TEST_F(IdleRoll, WithAFilmTurnsAsTheMetalGoesPast) {
  const std::string film = R"({ law = "thick-film", viscosity = 1e-6, film = 1e-3 })";
  const std::string with_film = edited(roll, {{R"({ law = "frictionless" })", film}});
  ASSERT_EQ(run(with_film).status, 0);
  const double mixed = turned();
  ASSERT_EQ(run(with_film + "\n[contact]\nform = \"compatible\"\n").status, 0);
  EXPECT_LT(mixed, -0.2);
  EXPECT_NEAR(mixed, turned(), 0.05 * std::abs(turned()));
}

TEST_F(IdleRoll, ThatIsHeldFeelsNoTorqueAboutItsAxis) {
  const Outcome outcome = run(edited(roll, {{"torque = { point = [2.2, 9], value = 0 }",
                                             "rotation = { point = [2.2, 9], speed = 0 }"}}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  double largest = 0.0;
  for (const double force : history().values("roll.force_y"))
    largest = std::max(largest, std::abs(force));
  ASSERT_GT(largest, 0.0);
  for (const double torque : history().values("roll.torque_z"))
    EXPECT_LT(std::abs(torque), 1e-9 * 3.0 * largest);
}

} // namespace
} // namespace billet::test::idle_rolls_test
