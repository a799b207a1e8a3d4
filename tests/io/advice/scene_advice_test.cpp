#include "io/advice/scene_advice.h"
#include "io/scene/scene_builder.h"
#include "process/loop/process.h"
#include "tests/io/case/case_text.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace billet::io::scene_advice_test {
namespace {

using test::edited;
using test::Edits;
using Kinds = std::vector<Advice::Kind>;
using enum Advice::Kind;

std::vector<Advice> advice_of(const std::string& text) {
  const Case content = read(text);
  const process::Process process(build_scene(content, "case.toml").scene);
  return scene_advice(content, process.view().scene);
}

Kinds kinds_of(const std::vector<Advice>& all) {
  Kinds kinds;
  for (const Advice& advice : all)
    kinds.push_back(advice.kind);
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::string texts_of(const std::vector<Advice>& all) {
  std::string texts;
  for (const Advice& advice : all)
    texts += "  " + advice.text + "\n";
  return texts;
}

/// A scene and what is to be said of it, sorted.
struct LabelledScene {
  std::string name;
  std::string text;
  Kinds kinds;
};

void expect_labels(const std::vector<LabelledScene>& scenes) {
  for (const LabelledScene& scene : scenes) {
    const std::vector<Advice> all = advice_of(scene.text);
    EXPECT_EQ(kinds_of(all), scene.kinds) << scene.name << "\n" << texts_of(all);
  }
}

/// The upper half of a disk, pressed to the half of its height.
const std::string disk = R"(analysis = "axisymmetric"
[workpiece]
element  = "quad8"
material = "steel"
mesh     = { box = [[0, 0], [10, 5]], cells = [4, 2] }
[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }
[[support]]
where = "x = 0"
fix   = ["x"]
[[support]]
where = "y = 0"
fix   = ["y"]
[[tool]]
name     = "die"
surface  = { plane = { point = [0, 5], normal = [0, -1] } }
motion   = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 2.5
)";
const std::string middle_support = "[[support]]\nwhere = \"y = 0\"\nfix   = [\"y\"]\n";
const std::string lower_die = R"([[tool]]
name     = "lower"
surface  = { plane = { point = [0, 0], normal = [0, 1] } }
friction = { law = "coulomb", mu = 0.1 }
)";

/// The whole disk between two dies, one of which moves.
std::string whole_disk() { return edited(disk, {{middle_support, lower_die}}); }

/// A block of the plane between a punch and a table, whole.
const std::string block = R"(analysis = "plane-strain"
[workpiece]
element  = "quad4"
material = "steel"
mesh     = { box = [[0, 0], [10, 10]], cells = [4, 4] }
[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "perfect", yield = 300 }
[[support]]
where = "y = 0"
fix   = ["y"]
[[tool]]
name     = "punch"
surface  = { circle = { centre = [5, 20], radius = 10 } }
motion   = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 2
)";

/// A brick of space under a punch, an eighth of the whole.
const std::string brick = R"(analysis = "3d"
[workpiece]
element  = "hex8"
material = "steel"
mesh     = { box = [[0, 0, 0], [10, 12, 8]], cells = [3, 3, 3] }
[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "perfect", yield = 300 }
[[support]]
where = "x = 0"
fix   = ["x"]
[[support]]
where = "y = 0"
fix   = ["y"]
[[support]]
where = "z = 0"
fix   = ["z"]
[[tool]]
name     = "punch"
surface  = { plane = { point = [0, 0, 8], normal = [0, 0, -1] } }
motion   = { velocity = [0, 0, -1] }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
)";
const std::string brick_mesh = "{ box = [[0, 0, 0], [10, 12, 8]], cells = [3, 3, 3] }";
const std::string quarter_mesh =
    "{ cylinder = { radius = 5, height = 8 }, cells = [2, 3], sector = 90 }";
const std::string x_support = "[[support]]\nwhere = \"x = 0\"\nfix   = [\"x\"]\n";
const std::string y_support = "[[support]]\nwhere = \"y = 0\"\nfix   = [\"y\"]\n";

const std::string swift = R"({ law = "swift", K = 740, eps0 = 0.01, n = 0.2 })";
const std::string slow = "velocity = [0, -1]", slow_end = "end = 2.5";
const std::string johnson_cook =
    R"({ law = "johnson-cook", A = 550, B = 600, n = 0.23, C = 0.013, rate0 = 1, m = 1, T_room = 20, T_melt = 1460 })";

TEST(SceneAdvice, savings) {
  const std::string both_move =
      edited(whole_disk(), {{"[0, 0], normal = [0, 1] } }", "[0, 0], normal = [0, 1] } }\nmotion = "
                                                            "{ velocity = [0, 1] }"},
                            {slow_end, "end = 1.25"}});
  const std::string plate = edited(block, {{"{ circle = { centre = [5, 20], radius = 10 } }",
                                            "{ plane = { point = [0, 10], normal = [0, -1] } }"}});
  const std::string slice = edited(
      brick,
      {{"where = \"y = 0\"\nfix   = [\"y\"]\n",
        "where = \"y = 0\"\nfix   = [\"y\"]\n[[support]]\nwhere = \"y = 12\"\nfix = [\"y\"]\n"},
       {"{ plane = { point = [0, 0, 8], normal = [0, 0, -1] } }",
        "{ cylinder = { point = [0, 0, 28], axis = [0, 1, 0], radius = 20 } }"}});
  const std::string quarter = edited(brick, {{brick_mesh, quarter_mesh}});
  const std::string round =
      edited(quarter, {{", sector = 90", ""}, {x_support, ""}, {y_support, ""}});
  const std::string ball =
      edited(quarter, {{"{ plane = { point = [0, 0, 8], normal = [0, 0, -1] } }",
                        "{ sphere = { centre = [0, 0, 18], radius = 10 } }"}});
  expect_labels({
      {"a disk between a die that moves and one that rests", whole_disk(), {symmetry}},
      {"a disk between two dies that move", both_move, {symmetry}},
      {"a block under a roller that does not turn", block, {symmetry}},
      {"a block under a plate", plate, {symmetry}},
      {"a quarter of a cylinder under a plate", quarter, {axisymmetric}},
      {"a cylinder under a plate", round, {axisymmetric}},
      {"a quarter of a cylinder under a ball", ball, {axisymmetric}},
      {"a slice under a roller along it", slice, {plane_strain}},
      {"a slice of tetrahedra", edited(slice, {{"hex8", "tet10"}}), {plane_strain}},
  });
}

TEST(SceneAdvice, tools_that_do_nothing) {
  const std::string guard = "[[tool]]\nname = \"guard\"\nsurface = { plane = { point = [900, 0], "
                            "normal = [-1, 0] } }\n";
  const std::string stages = "[[stage]]\nname = \"press\"\nend = 2.5\ntools = [\"die\"]\n";
  const std::string near = edited(guard, {{"[900, 0]", "[15, 0]"}});
  const auto with = [](const std::string& more) {
    return edited(disk, {{"[time]", more + "[time]"}});
  };
  expect_labels({
      {"far off", with(guard), {idle_tool}},
      {"in no stage", edited(with(near + stages), {{"[time]\nend = 2.5\n", ""}}), {idle_tool}},
      {"active when all is over", with(near + "active = [5, 6]\n"), {idle_tool}},
      {"a collar that the metal comes to", with(near), {}},
  });
}

TEST(SceneAdvice, physics_that_is_left_out) {
  const std::string hard = edited(disk, {{"K = 740", "K = 1800"}});
  const std::string hard_in_metres =
      edited("units = \"m-N-s-Pa-degC\"\n" + hard, {{"[10, 5]]", "[0.01, 0.005]]"},
                                                    {"K = 1800", "K = 1.8e9"},
                                                    {"[0, 5], n", "[0, 0.005], n"},
                                                    {slow, "velocity = [0, -0.001]"}});
  const Edits fast{{slow, "velocity = [0, -100]"}, {slow_end, "end = 0.025"}};
  const std::string hot =
      edited("temperature = 1100\n" + disk,
             {{swift, R"({ law = "perfect", yield = 80 })"}, {"210 GPa", "120 GPa"}});
  const std::string hot_slow =
      edited(hot, {{slow, "velocity = [0, -0.1]"}, {slow_end, "end = 25"}});
  const std::string bar = edited(disk, {{"[10, 5]]", "[5, 40]]"},
                                        {"[4, 2]", "[2, 12]"},
                                        {"[0, 5], n", "[0, 40], n"},
                                        {slow_end, "end = 10"}});
  const std::string tube = edited(whole_disk(), {{"[[0, 0], [10, 5]]", "[[20, 0], [22, 40]]"},
                                                 {"[4, 2]", "[2, 20]"},
                                                 {x_support, ""},
                                                 {"[0, 5], n", "[0, 40], n"},
                                                 {slow_end, "end = 10"}});
  expect_labels({
      {"a hard steel", hard, {die_pressure}},
      {"the same in metres", hard_in_metres, {die_pressure}},
      {"a press of 0.1 m/s", edited(disk, fast), {heating}},
      {"the same with a law that follows the temperature",
       edited("temperature = 20\n" + disk, {{swift, johnson_cook}, fast[0], fast[1]}),
       {heating}},
      {"hot metal on dies for seconds", hot_slow, {chill}},
      {"hot metal, quickly, by a law without rate", edited(hot, fast), {rate}},
      {"an explosion",
       edited(disk, {{slow, "velocity = [0, -100000]"}, {slow_end, "end = 2.5e-5"}}),
       {heating, inertia, rate}},
      {"a long bar", bar, {buckling}},
      {"a thin tube between two dies", tube, {symmetry, buckling}},
  });
}

TEST(SceneAdvice, nothing_where_nothing_is_to_be_said) {
  const std::string heated = edited(
      "temperature = 20\n" + disk,
      {{swift, johnson_cook +
                   "\ndensity = \"7850 kg/m^3\"\nheat_capacity = \"460 J/kg/K\"\nheating = 0.9"},
       {slow, "velocity = [0, -100]"},
       {slow_end, "end = 0.025"}});
  const std::string stretched =
      edited(disk, {{"[10, 5]]", "[5, 40]]"},
                    {"[4, 2]", "[2, 12]"},
                    {"[0, 5], n", "[0, 90], n"},
                    {slow, "velocity = [0, 0]"}}) +
      "[[support]]\nwhere = \"y = 40\"\nfix = [\"x\"]\nmove = { y = [[0, 0], [2.5, 10]] }\n";
  const std::string in_container = edited(
      disk, {{"[10, 5]]", "[5, 40]]"},
             {"[4, 2]", "[2, 12]"},
             {"[0, 5], n", "[0, 40], n"},
             {"[time]", "[[tool]]\nname = \"container\"\nsurface = { plane = { point = [5, 0], "
                        "normal = [-1, 0] } }\n[time]"}});
  const std::string hot_press = edited("temperature = 1150\n" + disk,
                                       {{"flow    = " + swift, "library = \"c45-hot\""},
                                        {"elastic = { young = \"210 GPa\", poisson = 0.3 }\n", ""},
                                        {slow, "velocity = [0, -50]"},
                                        {slow_end, "end = 0.05"}});
  const std::string turning = edited(block, {{"motion   = { velocity = [0, -1] }",
                                              "motion = { velocity = [0, -1], rotation = { point = "
                                              "[5, 20], speed = 1 } }"}});
  const std::string lifted =
      edited(disk, {{"[time]\nend = 2.5\n", "[[stage]]\nname = \"press\"\nend = 0.4\n"
                                            "[[stage]]\nname = \"lift\"\nend = 0.5\n"
                                            "unload = true\n"}});
  expect_labels({
      {"a half of a disk", disk, {}},
      {"a die that is lifted off at a time that 48 looks do not divide", lifted, {}},
      {"an eighth of a brick", brick, {}},
      {"two dies that rub differently", edited(whole_disk(), {{"mu = 0.1", "mu = 0.2"}}), {}},
      {"a punch beside the middle", edited(block, {{"[5, 20]", "[6, 20]"}}), {}},
      {"a punch across",
       edited(block,
              {{slow, "velocity = [0.3, -1]"}, {"fix   = [\"y\"]", "fix   = [\"x\", \"y\"]"}}),
       {}},
      {"a roller that turns", turning, {}},
      {"a block held at one side",
       edited(block, {{"[[tool]]", "[[support]]\nwhere = \"x = 0\"\nfix = [\"x\"]\n[[tool]]"}}),
       {}},
      {"a quarter of a cylinder under a roller",
       edited(brick, {{brick_mesh, quarter_mesh},
                      {"{ plane = { point = [0, 0, 8], normal = [0, 0, -1] } }",
                       "{ cylinder = { point = [0, 0, 28], axis = [0, 1, 0], radius = 20 } }"}}),
       {}},
      {"a square bar", edited(brick, {{"[10, 12, 8]", "[10, 10, 8]"}}), {}},
      {"a press whose heat is followed", heated, {}},
      {"a bar that is drawn", stretched, {}},
      {"a long billet in a container", in_container, {}},
      {"a hot press", hot_press, {}},
  });
}

TEST(SceneAdvice, what_bends_or_turns_is_not_taken_for_pressed) {
  // All of these are fast enough to heat a part that is pressed by so much.
  const std::string roller = "{ circle = { centre = [5, 20], radius = 10 } }";
  const Edits sheet{{"[[0, 0], [10, 10]], cells = [4, 4]", "[[-50, 0], [50, 10]], cells = [20, 2]"},
                    {roller, "{ circle = { centre = [3, 20], radius = 10 } }"},
                    {slow, "velocity = [0, -50]"},
                    {"end = 2", "end = 0.1"}};
  const auto support = [](double x) {
    return "[[tool]]\nname = \"at " + std::to_string(static_cast<int>(x)) +
           "\"\nsurface = { circle = { centre = [" + std::to_string(x) +
           ", -5], radius = 5 } }\n[time]";
  };
  const std::string bent =
      edited(edited(edited(block, sheet), {{y_support, ""}, {"[time]", support(-30.0)}}),
             {{"[time]", support(30.0)}});
  const std::string cantilever =
      edited(edited(block, sheet),
             {{"where = \"y = 0\"\nfix   = [\"y\"]", "where = \"x = -50\"\nfix = [\"x\", \"y\"]"},
              {"[3, 20]", "[45, 20]"}});
  const std::string twisted = edited(
      brick, {{brick_mesh, "{ cylinder = { radius = 5, height = 8 }, cells = [2, 3] }"},
              {x_support, ""},
              {y_support, ""},
              {"motion   = { velocity = [0, 0, -1] }",
               "motion = { velocity = [0, 0, -1], rotation = { point = [0, 0, 0], axis = [0, 0, "
               "1], speed = 0.1 } }"}});
  expect_labels({
      {"a sheet that is bent", bent, {}},
      {"a cantilever", cantilever, {}},
      {"a cylinder that is twisted", twisted, {}},
  });
}

TEST(SceneAdvice, says_its_numbers) {
  const std::string whole = texts_of(advice_of(whole_disk()));
  EXPECT_NE(whole.find("symmetric about y = 2.5 mm"), std::string::npos) << whole;
  EXPECT_NE(whole.find("where = \"y = 2.5\", fix = [\"y\"]"), std::string::npos) << whole;
  EXPECT_NE(whole.find("46 unknowns in place of 74"), std::string::npos) << whole;
  const std::string hard = texts_of(advice_of(edited(disk, {{"K = 740", "K = 1800"}})));
  // K (0.01 + ln 2)^0.2 = 1676; 2 (1 - 0.3^2) 1676 10 / 210000 = 0.145
  EXPECT_NE(hard.find("about 1678 MPa"), std::string::npos) << hard;
  EXPECT_NE(hard.find("about 0.15 mm under a part 20 mm wide"), std::string::npos) << hard;
}

} // namespace
} // namespace billet::io::scene_advice_test
