#include "io/scene/scene_builder.h"
#include "io/slips/slips.h"
#include "tests/io/case/case_text.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>

namespace billet::io::scene_slips_test {
namespace {

using test::edited;
using test::Edits;
using test::upsetting;

const std::string punch_plane = "{ plane = { point = [0, 7.5], normal = [0, -1] } }";
const std::string down = "velocity = [0, -1]";

std::vector<std::string> told_of(const std::string& text) {
  const Case content = read(text);
  const process::Process process(build_scene(content, "case.toml").scene);
  return scene_slips(content, process);
}

/// Expects one slip that has all the pieces.
void expect_told(const std::string& text, const std::vector<std::string>& pieces) {
  const std::vector<std::string> told = told_of(text);
  std::string all;
  for (const std::string& line : told)
    all += line + "\n";
  EXPECT_EQ(told.size(), 1U) << all << text;
  for (const std::string& piece : pieces)
    EXPECT_NE(all.find(piece), std::string::npos) << piece << " is not in: " << all;
}

/// A brick of bricks between two planes, held by nothing else.
const std::string brick = R"(analysis = "3d"
[workpiece]
element  = "hex8"
material = "steel"
mesh     = { box = [[0, 0, 0], [10, 10, 10]], cells = [3, 3, 3] }
[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "perfect", yield = 300 }
[[tool]]
name     = "punch"
surface  = { plane = { point = [0, 0, 10], normal = [0, 0, -1] } }
motion   = { velocity = [0, 0, -1] }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name     = "table"
surface  = { plane = { point = [0, 0, 0], normal = [0, 0, 1] } }
[time]
end = 1
)";

TEST(SceneSlips, good_cases_have_none) {
  for (const std::string& text : {upsetting, brick})
    EXPECT_EQ(told_of(text), std::vector<std::string>()) << text;
}

TEST(SceneSlips, a_part_that_is_too_small_or_too_large_for_its_unit) {
  const Edits small{{"[5, 7.5]", "[5e-4, 7.5e-4]"}, {"[0, 7.5], normal", "[0, 7.5e-4], normal"}};
  expect_told(edited(upsetting, small), {"the workpiece is 0.000901 mm long, which is 9.01e-07 m"});
  const Edits large{{"[5, 7.5]", "[5, 750000]"},
                    {"[0, 7.5], normal", "[0, 750000], normal"},
                    {"end = 0.1", "end = 10000"}};
  const std::vector<std::string> told = told_of(edited(upsetting, large));
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told.front().find("which is 750 m"), std::string::npos) << told.front();
}

TEST(SceneSlips, a_tool_that_does_not_reach_the_workpiece_in_its_time) {
  expect_told(edited(upsetting, {{"point = [0, 7.5]", "point = [0, 9]"}}),
              {"warning: [tool-misses] tool 'punch' does not reach the workpiece: it is 1.5 mm off "
               "at t = 0 s, "
               "moves 0.1 mm and comes as near as 1.4 mm",
               "touch = true"});
}

TEST(SceneSlips, a_tool_that_moves_away) {
  expect_told(
      edited(upsetting, {{down, "velocity = [0, 1]"}}),
      {"tool 'punch' moves away from the workpiece: it is 0 mm off at t = 0 s and 0.1 mm at "
       "t = 0.1 s"});
  expect_told(edited(upsetting, {{down, "velocity = [0, 1]"}, {"[0, 7.5], n", "[0, 8], n"}}),
              {"moves away from the workpiece: it is 0.5 mm off at t = 0 s and 0.6 mm"});
}

TEST(SceneSlips, a_needle_that_goes_in_between_nodes_does_not_move_away) {
  expect_told(
      edited(upsetting, {{punch_plane, "{ circle = { centre = [1.875, 7.6], radius = 0.1 } }"},
                         {"end = 0.1", "end = 0.5"}}),
      {"tool 'punch' is rounded with a radius of 0.1 mm"});
}

TEST(SceneSlips, a_tool_that_starts_far_off) {
  expect_told(
      edited(upsetting, {{"[0, 7.5], n", "[0, 107.5], n"}, {down, "velocity = [0, -1001]"}}),
      {"tool 'punch' is 100 mm off the workpiece when it begins to act, ", "touch = true"});
}

TEST(SceneSlips, a_tool_that_another_one_brings_the_part_to_is_none) {
  // Pushed along by 2 mm, the brick comes to a stop that draws back by 1 mm.
  const std::string pushed =
      edited(brick, {{"{ plane = { point = [0, 0, 10], normal = [0, 0, -1] } }",
                      "{ plane = { point = [0, 0, 0], normal = [1, 0, 0] } }"},
                     {"velocity = [0, 0, -1]", "velocity = [2, 0, 0]"}}) +
      "[[tool]]\nname = \"stop\"\nsurface = { plane = { point = [10.5, 0, 0], normal = [-1, 0, 0] "
      "} "
      "}\nmotion = { velocity = [1, 0, 0] }\n";
  EXPECT_EQ(told_of(pushed), std::vector<std::string>());
}

TEST(SceneSlips, a_tool_far_behind_its_own_surface) {
  const std::string turned =
      edited(upsetting, {{punch_plane, "{ points = [[50, 60], [-50, 60]] }"}});
  expect_told(turned,
              {"tool 'punch': the whole workpiece lies behind its surface, up to 60 mm deep",
               "on the left of the direction in which its profile runs; flip = true"});
  const std::string flipped = edited(
      turned, {{"[-50, 60]] }", "[-50, 60]], flip = true }"}, {down, "velocity = [0, -530]"}});
  expect_told(flipped, {"tool 'punch' is 52.5 mm off the workpiece when it begins to act"});
}

TEST(SceneSlips, an_end_before_anything_yields) {
  expect_told(edited(upsetting, {{"end = 0.1", "end = 0.001"}, {"first = 0.02", "first = 0.001"}}),
              {"until the end, t = 0.001 s, the workpiece is strained by about 0.00013",
               "metal yields at 0.0014: nothing will flow"});
  expect_told(edited(upsetting, {{"motion   = { " + down + " }\n", ""}}),
              {"nothing moves or loads the workpiece"});
}

TEST(SceneSlips, a_part_that_is_pushed_where_nothing_holds_it) {
  expect_told(edited(upsetting, {{"fix   = [\"y\"]", "fix   = [\"x\"]"}}),
              {"tool 'punch' pushes the workpiece along -y, and neither a support nor another tool "
               "holds it",
               "where = \"y = 0\" and fix = [\"y\"]"});
  const std::string without_table = brick.substr(0, brick.find("[[tool]]\nname     = \"table\""));
  expect_told(without_table + "[time]\nend = 1\n", {"along -z", "where = \"z = 0\""});
}

TEST(SceneSlips, an_axis_of_revolution_and_a_cut_that_nothing_holds) {
  expect_told(edited(upsetting, {{"where = \"x = 0\"", "where = \"y = 0\""}}),
              {"axis of revolution, which nothing holds in x", "where = \"x = 0\""});
  const std::string sector =
      edited(brick, {{"{ box = [[0, 0, 0], [10, 10, 10]], cells = [3, 3, 3] }",
                      "{ cylinder = { radius = 5, height = 10 }, cells = [8, 4], sector = 90 }"}});
  const std::string half_held = sector + "[[support]]\nwhere = \"x = 0\"\nfix = [\"x\"]\n";
  expect_told(half_held, {"a sector of 90 degrees", "where = \"set:y-min\" and fix = [\"y\"]"});
  EXPECT_TRUE(told_of(half_held + "[[support]]\nwhere = \"y = 0\"\nfix = [\"y\"]\n").empty());
}

TEST(SceneSlips, a_cylinder_of_linear_elements_that_is_a_prism) {
  const auto disk = [](const std::string& element, const std::string& cells) {
    return edited(brick, {{"hex8", element},
                          {"{ box = [[0, 0, 0], [10, 10, 10]], cells = [3, 3, 3] }",
                           "{ cylinder = { radius = 5, height = 10 }, cells = " + cells + " }"}});
  };
  expect_told(disk("hex8", "[2, 4]"), {"a prism with 90.0 % of its volume"});
  EXPECT_TRUE(told_of(disk("hex20", "[2, 4]")).empty());
  EXPECT_TRUE(told_of(disk("hex8", "[8, 4]")).empty());
}

TEST(SceneSlips, one_element_over_the_height) {
  const std::string flat = edited(upsetting, {{"cells = [2, 3]", "cells = [4, 1]"}});
  EXPECT_TRUE(told_of(flat).empty()) << "one of quad8 shows both";
  expect_told(
      edited(flat, {{"quad8", "quad4"}}),
      {"4 of 4 elements are the only one between two faces of the workpiece, the first with "
       "its centre at (0.625, 3.75): a single quad4 does not bulge, and in bending it is too soft "
       "where it is short, too stiff where it is long"});
  // A slice in plane strain is one element wide and means it.
  const std::string slice = edited(brick, {{"cells = [3, 3, 3]", "cells = [3, 1, 3]"}});
  expect_told(slice, {"9 of 9 elements", "four or more"});
  EXPECT_TRUE(told_of(slice +
                      "[[support]]\nwhere = \"set:y-min\"\nfix = [\"y\"]\n[[support]]\nwhere "
                      "= \"set:y-max\"\nfix = [\"y\"]\n")
                  .empty());
}

TEST(SceneSlips, elements_far_longer_than_the_radius_of_a_tool) {
  const std::string needle =
      edited(upsetting, {{punch_plane, "{ circle = { centre = [0, 8.5], radius = 1 } }"}});
  expect_told(needle, {"tool 'punch' is rounded with a radius of 1 mm",
                       "no element that may touch it is shorter than 2.5 mm"});
  EXPECT_TRUE(told_of(edited(needle, {{"cells = [2, 3]", "cells = [5, 5]"}})).empty());
  EXPECT_TRUE(told_of(needle + "[remesh]\n").empty());
}

TEST(SceneSlips, elements_far_longer_than_the_flash) {
  const std::string die = "\n[[tool]]\nname = \"die\"\nsurface = { points = [[9, 6.5], [8, 6.5], "
                          "[7, -0.001], [0, -0.001]] }\n";
  const std::string dies =
      edited(upsetting, {{punch_plane, "{ points = [[0, 7.6], [8, 7.6], [9, 8]] }"},
                         {"end = 0.1", "end = 1"}}) +
      die;
  expect_told(dies,
              {"tools 'punch' and 'die' come together to a gap of 0.1 mm, and no element that "
               "may touch them is shorter than 2.5 mm"});
  EXPECT_TRUE(told_of(dies + "[remesh]\n").empty());
}

} // namespace
} // namespace billet::io::scene_slips_test
