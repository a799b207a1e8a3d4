// Damaged meshes, STLs and profiles with a good case, end to end.

#include "tests/app/broken_inputs.h"

#include <cmath>

namespace billet::test::broken_files_test {

namespace {

/// Two quad4 elements with the sets "bottom" and "body", Gmsh 2.2.
const std::string good_msh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "bottom"
2 2 "body"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 5 0 0
3 5 7.5 0
4 0 7.5 0
5 2 0 0
6 2 7.5 0
$EndNodes
$Elements
3
1 1 2 1 1 1 5
2 3 2 2 1 1 5 6 4
3 3 2 2 1 5 2 3 6
$EndElements
)";

const Edits on_msh{{"{ box = [[0, 0], [5, 7.5]], cells = [2, 3] }", "{ file = \"part.msh\" }"},
                   {"quad8", "quad4"}};

Broken mesh(std::string name, const std::string& text, std::vector<std::string> says) {
  return {std::move(name), edited(upsetting, on_msh), 4, std::move(says), {}, {{"part.msh", text}}};
}

std::vector<Broken> meshes() {
  Broken set =
      mesh("set_that_is_not_there", good_msh, {"case.toml", "no set named 'botom'", "bottom"});
  set.text = edited(set.text, {{"\"y = 0\"", "\"set:botom\""}});
  set.status = 3;
  Broken kind = mesh("elements_of_another_kind", good_msh,
                     {"part.msh", "quad4 elements, the case says quad8", "element = \"quad4\""});
  kind.text = edited(kind.text, {{"quad4", "quad8"}});
  Broken suffix = mesh("suffix_unknown", good_msh, {"part.dat", "suffix \".dat\"", ".msh"});
  suffix.text = edited(suffix.text, {{"part.msh", "part.dat"}});
  suffix.files = {{"part.dat", "1 2 3\n"}}; // nor does it begin as a mesh does
  Broken inp = mesh("inp_with_a_letter_in_a_number", "", {"part.inp:3", "1.x"});
  inp.text = edited(inp.text, {{"part.msh", "part.inp"}});
  inp.files = {{"part.inp", "*NODE\n1, 0, 0\n2, 1.x, 0\n*ELEMENT, TYPE=CAX4\n1, 1, 2, 3, 4\n"}};
  Broken vtu = mesh("vtu_cut_short", "", {"part.vtu"});
  vtu.text = edited(vtu.text, {{"part.msh", "part.vtu"}});
  vtu.files = {
      {"part.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<Unstr"}};
  return {
      mesh("empty_mesh", "", {"part.msh:1", "$MeshFormat"}),
      mesh("mesh_cut_short", good_msh.substr(0, good_msh.find("3 3 2 2 1")),
           {"part.msh:22", "the file ends"}),
      mesh("mesh_cut_in_the_nodes", good_msh.substr(0, good_msh.find("4 0 7.5 0")),
           {"part.msh:10", "6 nodes are announced", "cut short"}),
      mesh("element_inside_out", edited(good_msh, {{"1 5 6 4", "1 4 6 5"}}),
           {"part.msh", "1 of 2 elements turn the wrong way round", "(1, 3.75, 0)"}),
      mesh("element_folded", edited(good_msh, {{"1 5 6 4", "1 6 5 4"}}), {"element 2 (quad4"}),
      mesh("node_out_of_range", edited(good_msh, {{"5 2 3 6", "5 2 99 6"}}),
           {"part.msh:22", "node 99, which is not given"}),
      mesh("node_twice", edited(good_msh, {{"6 2 7.5 0", "5 2 7.5 0"}}), {"part.msh:", "5"}),
      mesh("node_at_nan", edited(good_msh, {{"6 2 7.5 0", "6 nan 7.5 0"}}), {"part.msh:16", "nan"}),
      mesh("more_nodes_than_a_computer_holds",
           edited(good_msh, {{"$Nodes\n6", "$Nodes\n99999999999999"}}), {"part.msh:"}),
      mesh("node_beyond_the_axis", edited(good_msh, {{"4 0 7.5 0", "4 -1 7.5 0"}}), {"radius"}),
      mesh("mesh_of_another_program", "solid\nfacet\n", {"part.msh:1", "$MeshFormat"}),
      std::move(set),
      std::move(kind),
      std::move(suffix),
      std::move(inp),
      std::move(vtu),
  };
}

Broken stl(std::string name, const std::string& punch, std::vector<std::string> says) {
  return {
      std::move(name), upsetting_3d, 4,
      std::move(says), {},           {{"punch.stl", punch}, {"die.stl", square_stl(20, 0, true)}}};
}

std::vector<Broken> stls() {
  const std::string good = square_stl(20, 15, false);
  const std::string second = good.substr(good.find("endfacet") + 9);
  // A third triangle on the diagonal of the square.
  const std::string fin = " facet normal 0 1 0\n  outer loop\n   vertex -20 -20 15\n"
                          "   vertex 20 20 15\n   vertex 0 0 30\n  endloop\n endfacet\n";
  std::string twisted = good;
  const std::size_t loop = twisted.rfind("outer loop\n") + 11;
  const std::size_t end_of_first = twisted.find('\n', loop) + 1;
  const std::size_t end_of_second = twisted.find('\n', end_of_first) + 1;
  const std::string first_corner = twisted.substr(loop, end_of_first - loop);
  twisted = twisted.substr(0, loop) + twisted.substr(end_of_first, end_of_second - end_of_first) +
            first_corner + twisted.substr(end_of_second);
  Broken missing = stl("stl_that_is_not_there", good, {"\"punch.stl\"", "no such file"});
  missing.files = {{"die.stl", square_stl(20, 0, true)}};
  missing.at = {"punch.stl"};
  missing.status = 3;
  Broken unit = stl("stl_in_metres", good, {"case.toml:", "unit", "\"acre\""});
  unit.text = edited(unit.text, {{"unit = \"mm\"", "unit = \"acre\""}});
  unit.status = 3;
  Broken metres = stl("stl_taken_for_metres", good,
                      {"cannot be brought to touch", "times larger than the workpiece",
                       "is the file in mm instead of m?"});
  metres.text = edited(metres.text, {{"unit = \"mm\"", "unit = \"m\""}});
  Broken plane = {"stl_in_the_plane",
                  edited(upsetting, {{"plane = { point = [0, 7.5], normal = [0, -1] }",
                                      "stl = \"punch.stl\", unit = \"mm\""}}),
                  3,
                  {"tool.punch.surface.stl", "only for 3d scenes"},
                  {"stl ="},
                  {{"punch.stl", good}}};
  return {
      stl("empty_stl", "", {"tool 'punch'", "punch.stl", "empty"}),
      stl("binary_stl_cut_short", binary_stl(3, 5, 0.0F), {"punch.stl", "promises 5 facets"}),
      stl("binary_stl_of_many_facets", binary_stl(1, 4000000000U, 0.0F),
          {"punch.stl", "promises 4000000000 facets"}),
      stl("binary_stl_of_none", binary_stl(0, 0, 0.0F), {"punch.stl"}),
      stl("binary_stl_at_nan", binary_stl(1, 1, std::nanf("")), {"punch.stl", "facet 1", "finite"}),
      stl("ascii_stl_without_endsolid", edited(good, {{"endsolid square\n", ""}}),
          {"punch.stl", "endsolid", "truncated"}),
      stl("ascii_stl_at_nan", edited(good, {{"vertex 20.000000", "vertex nan"}}),
          {"punch.stl:5", "'nan'", "finite number"}),
      stl("ascii_stl_misspelt", edited(good, {{"vertex", "vertx"}}), {"punch.stl:4", "'vertx'"}),
      stl("stl_with_three_facets_on_an_edge", edited(good, {{"endsolid", fin + "endsolid"}}),
          {"tool 'punch'", "edge"}),
      stl("stl_turned_both_ways", twisted, {"tool 'punch'", "orient"}),
      stl("stl_facing_away", square_stl(20, 15, true),
          {"case.toml", "tool 'punch' cannot be brought to touch", "flip = true"}),
      std::move(missing),
      std::move(unit),
      std::move(metres),
      std::move(plane),
  };
}

Broken
profile(std::string name, const std::string& text, std::vector<std::string> says, int status = 4) {
  return {std::move(name),
          edited(upsetting, {{"{ plane = { point = [0, 7.5], normal = [0, -1] } }",
                              "{ profile = \"die.toml\" }"}}),
          status,
          std::move(says),
          {},
          {{"die.toml", text}}};
}

std::vector<Broken> profiles() {
  return {
      profile("empty_profile", "", {"die.toml"}),
      profile(
          "profile_with_a_bad_arc",
          "start = [10, 7.5]\n[[segment]]\nto = [5, 7.5]\n[[segment]]\nto = [0, 7.5]\nradius = 2\n",
          {"die.toml", "radius", "2"}),
      profile("profile_that_is_no_toml", "start = [", {"die.toml:1"}),
      profile("profile_with_an_unknown_key", "start = [10, 7.5]\nsegmant = [{ line = [0, 7.5] }]\n",
              {"die.toml:2", "unknown key 'segmant'"}),
  };
}

class BrokenFile : public testing::TestWithParam<Broken> {};

TEST_P(BrokenFile, is_refused_with_its_place) { expect_refused(GetParam()); }

INSTANTIATE_TEST_SUITE_P(mesh, BrokenFile, testing::ValuesIn(meshes()), name_of);
INSTANTIATE_TEST_SUITE_P(stl, BrokenFile, testing::ValuesIn(stls()), name_of);
INSTANTIATE_TEST_SUITE_P(profile, BrokenFile, testing::ValuesIn(profiles()), name_of);

TEST(GoodFile, the_mesh_that_the_others_spoil_is_taken) {
  const TemporaryFolder folder;
  write_text(folder.path() / "case.toml",
             edited(edited(upsetting, on_msh), {{"\"y = 0\"", "\"set:bottom\""}}));
  write_text(folder.path() / "part.msh", good_msh);
  const Outcome outcome = billet({"check", "case.toml"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(GoodFile, the_dies_that_the_others_spoil_are_taken) {
  const TemporaryFolder folder;
  write_text(folder.path() / "case.toml", upsetting_3d);
  write_text(folder.path() / "punch.stl", square_stl(20, 15, false));
  write_text(folder.path() / "die.stl", square_stl(20, 0, true));
  const Outcome outcome = billet({"check", "case.toml"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(GoodFile, what_is_outside_of_the_folder_is_read_if_allowed) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  write_text(folder.path() / "inner/case.toml",
             edited(edited(upsetting, on_msh), {{"part.msh", "../part.msh"}}));
  write_text(folder.path() / "part.msh", good_msh);
  EXPECT_EQ(billet({"check", "inner/case.toml"}, folder.path()).status, 3);
  EXPECT_EQ(billet({"check", "inner/case.toml", "--allow-outside"}, folder.path()).status, 0);
}

} // namespace

} // namespace billet::test::broken_files_test
