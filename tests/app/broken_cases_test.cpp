// Case files with one thing (or several) wrong, end to end: exit status, place and message.

#include "tests/app/broken_inputs.h"

namespace billet::test::broken_cases_test {

namespace {

const std::string swift = "flow    = { law = \"swift\", K = 740, eps0 = 0.01, n = 0.2 }";
const std::string punch_motion = "motion   = { velocity = [0, -1] }";
const std::string punch_surface = "surface  = { plane = { point = [0, 7.5], normal = [0, -1] } }";
const std::string punch_friction = "friction = { law = \"tresca\", m = 0.08 }";
const std::string box = "{ box = [[0, 0], [5, 7.5]], cells = [2, 3] }";

/// The upsetting with one edit; the message stands at the line of the new text.
Broken one(std::string name,
           const std::string& from,
           const std::string& to,
           std::vector<std::string> says,
           const std::string& at = "") {
  return {
      std::move(name), edited(upsetting, {{from, to}}), 3, std::move(says), {at.empty() ? to : at}};
}

/// The upsetting with something missing: no line of its own.
Broken lacking(std::string name, const Edits& edits, std::vector<std::string> says) {
  return {std::move(name), edited(upsetting, edits), 3, std::move(says), {}};
}

std::vector<Broken> missing_keys() {
  return {
      lacking("no_analysis", {{"analysis = \"axisymmetric\"", ""}},
              {"analysis: missing, it must be given"}),
      one("no_material_of_the_workpiece", "material = \"steel\"\n", "",
          {"workpiece.material: missing"}, "[workpiece]"),
      one("no_mesh", "mesh     = " + box, "", {"workpiece.mesh: missing"}, "[workpiece]"),
      lacking("no_end", {{"end = 0.1", ""}}, {"time.end: missing"}),
      one("no_young", "young = \"210 GPa\", ", "", {"material.steel.elastic.young: missing"},
          "elastic"),
      one("no_cells", ", cells = [2, 3]", "", {"workpiece.mesh.cells: missing"}, "mesh "),
      one("no_surface", punch_surface, "", {"tool.punch.surface: missing"}, "[[tool]]"),
      one("no_law", "law = \"tresca\", ", "", {"tool.punch.friction.law: missing"}, "friction"),
      one("no_name_of_a_tool", "name     = \"punch\"", "", {"name: missing"}, "[[tool]]"),
      one("no_fix", "fix   = [\"y\"]", "", {"support.1", "fix"}, "[[support]]\nwhere = \"y"),
      {"nothing_at_all", "", 3, {"analysis: missing", "workpiece: missing", "time.end"}, {}},
  };
}

std::vector<Broken> wrong_values() {
  return {
      one("text_for_a_number", "K = 740", "K = \"strong\"",
          {"material.steel.flow.K: found \"strong\""}),
      one("number_for_a_text", "element  = \"quad8\"", "element  = 8",
          {"workpiece.element: found 8"}),
      one("table_for_a_list", "fix   = [\"x\"]", "fix   = { x = true }", {"support.0.fix"}),
      one("list_for_a_table", "friction = { law = \"tresca\", m = 0.08 }", "friction = [0.08]",
          {"tool.punch.friction: found a list"}),
      one("three_entries_in_the_plane", "velocity = [0, -1]", "velocity = [0, -1, 0]",
          {"tool.punch.motion.velocity", "2"}),
      one("fraction_of_a_cell", "cells = [2, 3]", "cells = [2.5, 3]",
          {"cells", "2.5", "whole number"}),
      one("no_cells_along_y", "cells = [2, 3]", "cells = [2, 0]", {"cells", "found 0"}),
      one("box_upside_down", "[5, 7.5]]", "[5, -7.5]]", {"workpiece.mesh.box"}),
      one("box_beyond_the_axis", "[[0, 0]", "[[-1, 0]", {"workpiece.mesh.box"}),
      one("negative_young", "\"210 GPa\"", "\"-210 GPa\"", {"young", "-210 GPa"}),
      one("poisson_of_a_half", "poisson = 0.3", "poisson = 0.5", {"poisson: found 0.5", "< 0.5"}),
      one("negative_yield", swift, "flow = { law = \"perfect\", yield = -3 }", {"yield: found -3"}),
      one("negative_friction", "m = 0.08", "m = -0.08",
          {"friction.m: found -0.08", "0 <= value <= 1"}),
      one("end_before_the_start", "end = 0.1", "end = -0.1", {"time.end: found -0.1"}),
      one("not_a_number", "K = 740", "K = nan", {"material.steel.flow.K: found nan", "finite"}),
      one("infinite", "end = 0.1", "end = inf", {"time.end: found inf", "finite"}),
      one("first_above_end", "first = 0.02", "first = 2.0", {"time.increments.first"}),
      one("frame_after_the_end", "[time]", "[output]\nat = [0.05, 5]\n[time]",
          {"output.at.1: found 5", "no more than the end 0.1"}, "at ="),
      one("normal_of_length_zero", "normal = [0, -1]", "normal = [0, 0]", {"normal"}),
      one("table_that_goes_back", swift,
          "flow = { law = \"table\", points = [[0, 300], [0.5, 400], [0.2, 500]] }",
          {"points", "0.2", "more than"}),
  };
}

std::vector<Broken> wrong_units() {
  return {
      one("length_for_a_stress", "\"210 GPa\"", "\"210 mm\"",
          {"elastic.young: found \"210 mm\"", "does not measure a stress", "MPa"}),
      one("unit_that_is_none", "\"210 GPa\"", "\"210 GPascal\"", {"there is no unit 'GPascal'"}),
      one("unit_where_there_is_none", "poisson = 0.3", "poisson = \"0.3 mm\"",
          {"poisson: found \"0.3 mm\"", "without a unit"}),
      one("unknown_system", "analysis =", "units = \"inch-lbf\"\nanalysis =",
          {"units: found \"inch-lbf\"", "m-N-s-Pa-degC"}, "units ="),
      {"stl_without_unit",
       edited(upsetting_3d, {{", unit = \"mm\"", ""}}),
       3,
       {"tool.punch.surface.unit: missing"},
       {"stl ="},
       {{"punch.stl", square_stl(20, 15, false)}, {"die.stl", square_stl(20, 0, true)}}},
  };
}

std::vector<Broken> wrong_words() {
  return {
      one("misspelt_key", "poisson", "poison", {"unknown key", "did you mean 'poisson'?"}),
      one("misspelt_section", "[[support]]", "[[suport]]",
          {"unknown key", "did you mean 'support'?"}),
      one("misspelt_element", "quad8", "quad9", {"workpiece.element: found \"quad9\"", "quad8"}),
      one("misspelt_law", "\"swift\"", "\"swiff\"", {"found \"swiff\"", "did you mean 'swift'?"}),
      one("misspelt_analysis", "\"axisymmetric\"", "\"axisymetric\"",
          {"found \"axisymetric\"", "did you mean 'axisymmetric'?"}),
      one("material_that_is_not_there", "material = \"steel\"", "material = \"steal\"",
          {"no [material.steal]", "did you mean 'steel'?"}),
      one("field_that_is_none", "[time]", "[output]\nfields = [\"von_misses\"]\n[time]",
          {"output.fields", "von_misses", "did you mean 'von_mises'?"}, "fields ="),
      one("two_kinds_of_surface", "plane = {",
          "circle = { centre = [0, 0], radius = 1 }, plane = {",
          {"tool.punch.surface.circle", "there is 'plane' already"}),
      one("law_without_its_temperature", swift,
          "flow = { law = \"johnson-cook\", A = 1, B = 1, n = 1, C = 0, rate0 = 1, m = 1, T_room = "
          "20, T_melt = 100 }",
          {"needs the temperature of the workpiece", "give temperature = ... (degC) at the top"}),
      one("element_of_another_dimension", "quad8", "hex20", {"workpiece.element"}),
      {"same_tool_twice",
       upsetting + "[[tool]]\nname = \"punch\" # again\n" + punch_surface + "\n",
       3,
       {"there is a tool \"punch\" already"},
       {"# again"}},
      {"stage_with_a_tool_that_is_none",
       edited(upsetting, {{"end = 0.1\n", ""}}) +
           "[[stage]]\nname = \"press\"\nend = 0.1\ntools = [\"punhc\"]\n",
       3,
       {"no such tool", "did you mean 'punch'?"},
       {"tools ="}},
  };
}

std::vector<Broken> later_versions() {
  return {
      lacking("remeshing_with_quadrilaterals",
              {{"[time]", "[remesh]\nelement = \"quad8\"\n[time]"}},
              {"case.toml: remesh: element = \"quad8\" is not available in this version",
               "element = \"tri6\""}),
      lacking("remeshing_that_keeps_an_unknown_set",
              {{"[time]", "[remesh]\nkeep = [\"set:rim\"]\n[time]"}},
              {"case.toml: remesh.keep: the mesh has no set named 'rim'"}),
      lacking("remeshing_in_space_with_triangles",
              {{"axisymmetric", "3d"},
               {"\"quad8\"", "\"hex8\""},
               {"[[0, 0], [5, 7.5]], cells = [2, 3]", "[[0, 0, 0], [5, 5, 5]], cells = [2, 2, 2]"},
               {"plane = { point = [0, 7.5], normal = [0, -1]",
                "plane = { point = [0, 0, 5], normal = [0, 0, -1]"},
               {"velocity = [0, -1]", "velocity = [0, 0, -1]"},
               {"[time]", "[[support]]\nwhere = \"z = 0\"\nfix = [\"z\"]\n"
                          "[remesh]\nelement = \"tri6\"\n[time]"}},
              {"remesh.element: found \"tri6\", allowed is", "\"tet10\""}),
      one("remeshing_when_who_knows", "[time]", "[remesh]\nwhen = { qualty = 0.2 }\n[time]",
          {"remesh.when.qualty: unknown key (did you mean 'quality'?)"}, "when ="),
      one("wear_of_less_than_a_stroke", punch_friction,
          punch_friction + "\nwear = { law = \"archard\", K = 1e-6, hardness = 800, strokes = 0 }",
          {"tool.punch.wear.strokes: found 0, allowed is a value >= 1"}, "wear ="),
  };
}

std::vector<Broken> damaged_text() {
  std::string binary = "\x7f"
                       "ELF";
  for (int i = 0; i < 2000; ++i)
    binary += static_cast<char>((i * 7919) % 251);
  return {
      {"garbage", binary, 3, {"case.toml:"}, {}},
      {"zeros", std::string(100, '\0'), 3, {"case.toml:1", "not valid TOML"}, {}},
      one("bracket_left_open", "[time]", "[time", {"not valid TOML"}),
      one("string_left_open", "\"Tiny upsetting\"", "\"Tiny upsetting", {"not valid TOML"}),
      one("key_twice", "end = 0.1", "end = 0.1\nend = 0.2", {"end"}, "end = 0.2"),
      {"brackets_without_end", "a = " + std::string(100000, '['), 3, {"nested more than"}, {}},
      {"several_at_once",
       edited(upsetting, {{"quad8", "quad9"},
                          {"poisson = 0.3", "poisson = 0.7"},
                          {"m = 0.08", "mm = 0.08"},
                          {"end = 0.1", "end = \"0.1 mm\""}}),
       3,
       {"quad9", "poisson: found 0.7", "friction.mm: unknown key (did you mean 'm'?)",
        "time.end: found \"0.1 mm\""},
       {"quad9", "poisson = 0.7", "mm = 0.08", "end = \"0.1 mm\""}},
  };
}

std::vector<Broken> wrong_scenes() {
  Broken overlap = lacking("billet_overlaps_a_die", {{"point = [0, 7.5]", "point = [0, 7]"}},
                           {"case.toml", "the workpiece overlaps tool 'punch'", "0.5 deep", "7.5"});
  overlap.status = 4;
  Broken turned = lacking("turned_tool", {{"normal = [0, -1]", "normal = [0, 1]"}},
                          {"the workpiece overlaps tool 'punch'", "7.5 deep",
                           "the whole workpiece lies inside of the tool, which may be turned",
                           "a plane's normal points out of its tool"});
  turned.status = 4;
  Broken never = lacking("touch_that_never_meets",
                         {{"point = [0, 7.5]", "point = [0, 9]"},
                          {punch_motion, "motion = { velocity = [0, 1] }\ntouch = true"}},
                         {"case.toml", "tool 'punch' cannot be brought to touch"});
  never.status = 4;
  return {
      std::move(overlap),
      std::move(turned),
      std::move(never),
      {"body_without_support",
       edited(upsetting,
              {{upsetting.substr(upsetting.find("[[support]]"),
                                 upsetting.find("[time]") - upsetting.find("[[support]]")),
                ""}}),
       3,
       {"case.toml", "the workpiece can move freely", "[[support]]"},
       {}},
      one("touch_without_motion", punch_motion, "touch = true", {"tool.punch.touch", "velocity"}),
      lacking("shear_yield_of_an_elastic_body", {{swift, ""}},
              {"case.toml", "tool 'punch'", "the workpiece is elastic"}),
      lacking("supports_that_contradict_each_other",
              {{"fix   = [\"y\"]", "fix   = [\"x\", \"y\"]"},
               {"fix   = [\"x\"]", "fix   = [\"x\"]\nmove  = { y = [[0, 0], [1, 0.1]] }"}},
              {"case.toml",
               "support.0 and support.1 prescribe different displacements in y at (0, 0, 0)"}),
      lacking("plane_without_nodes", {{"where = \"y = 0\"", "where = \"y = 0.3\""}},
              {"case.toml:18:9", "support.1.where: no node of the mesh lies on y = 0.3"}),
      lacking("set_of_a_box", {{"where = \"y = 0\"", "where = \"set:bottom\""}},
              {"case.toml", "no set named 'bottom'"}),
      lacking("two_places_that_are_not_there",
              {{"where = \"y = 0\"", "where = \"y = 0.3\""},
               {"[time]", "[contact]\nsurface = \"set:skin\"\n[time]"}},
              {"case.toml:18:9", "support.1.where:", "contact.surface: the mesh has no set named"}),
      lacking("surface_on_the_axis", {{"[time]", "[contact]\nsurface = \"x = 0\"\n[time]"}},
              {"contact.surface:", "the axis of an axisymmetric part is none"}),
      lacking("load_on_no_face",
              {{"[time]", "[[load]]\nwhere = \"x = 2.5\"\npressure = 1\n[time]"}},
              {"case.toml:28:9", "load.0.where:", "no whole free face"}),
      one("file_outside_of_the_folder", "mesh     = " + box, "mesh = { file = \"../part.msh\" }",
          {"outside the folder of the case", "--allow-outside"}),
      one("absolute_file", "mesh     = " + box, "mesh = { file = \"/etc/passwd\" }",
          {"outside the folder of the case"}),
      one("file_that_is_not_there", "mesh     = " + box, "mesh = { file = \"part.msh\" }",
          {"\"part.msh\"", "no such file"}),
  };
}

class BrokenCase : public testing::TestWithParam<Broken> {};

TEST_P(BrokenCase, is_refused_with_its_place) { expect_refused(GetParam()); }

INSTANTIATE_TEST_SUITE_P(missing, BrokenCase, testing::ValuesIn(missing_keys()), name_of);
INSTANTIATE_TEST_SUITE_P(values, BrokenCase, testing::ValuesIn(wrong_values()), name_of);
INSTANTIATE_TEST_SUITE_P(units, BrokenCase, testing::ValuesIn(wrong_units()), name_of);
INSTANTIATE_TEST_SUITE_P(words, BrokenCase, testing::ValuesIn(wrong_words()), name_of);
INSTANTIATE_TEST_SUITE_P(later, BrokenCase, testing::ValuesIn(later_versions()), name_of);
INSTANTIATE_TEST_SUITE_P(text, BrokenCase, testing::ValuesIn(damaged_text()), name_of);
INSTANTIATE_TEST_SUITE_P(scenes, BrokenCase, testing::ValuesIn(wrong_scenes()), name_of);

} // namespace

} // namespace billet::test::broken_cases_test
