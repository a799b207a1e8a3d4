// Decks of CalculiX and Abaqus as cases.

#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/translate/deck_case.h"
#include "io/translate/deck_history.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace billet::io::deck_case_test {

namespace {

using test::TemporaryFolder;

/// A block of one element between an analytical die and a plane of symmetry.
const std::string upsetting = R"(*HEADING
A disk
*NODE, NSET=ALL
1, 0., 0.
2, 5., 0.
3, 5., 5.
4, 0., 5.
99, 0., 6.
*ELEMENT, TYPE=CAX4, ELSET=PART
1, 1, 2, 3, 4
*NSET, NSET=AXIS
1, 4
*NSET, NSET=FOOT, GENERATE
1, 2
*SURFACE, NAME=TOP
PART, S3
*SURFACE, TYPE=SEGMENTS, NAME=DIE
START, 10., 5.
LINE, 2., 5.
CIRCL, 0., 7., 0., 5.
*RIGID BODY, ANALYTICAL SURFACE=DIE, REF NODE=99
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3, 20.
190000., 0.3, 400.
*PLASTIC
300., 0., 20.
400., 0.2, 20.
250., 0., 400.
*CREEP, LAW=NORTON
1e-10, 5., 0.
*SOLID SECTION, ELSET=PART, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=OILY
*FRICTION, TAUMAX=120.
0.1,
*CONTACT PAIR, INTERACTION=OILY
TOP, DIE
*BOUNDARY
AXIS, XSYMM
FOOT, 2
*AMPLITUDE, NAME=FAST
0., 0., 0.5, 1., 1., 1.
*STEP, NLGEOM
*STATIC
0.01, 1., 1e-8, 0.05
*BOUNDARY, AMPLITUDE=FAST
99, 2, 2, -1.5
99, 1
99, 6
*END STEP
*STEP
*STATIC
0.1, 2.
*BOUNDARY
99, 2, 2, 0.
*END STEP
)";

Deck deck_of(const std::string& text, const TemporaryFolder& folder) {
  const auto file = folder.path() / "job.inp";
  std::ofstream(file) << text;
  return read_deck(file, {folder.path(), false});
}

DeckCase case_of_text(const std::string& text, const TemporaryFolder& folder) {
  return case_of(deck_of(text, folder), deck_units().front(), "job.inp");
}

/// Writes the files of a case and reads it as the program does.
Case read_back(const DeckCase& made, const TemporaryFolder& folder) {
  for (const DeckFile& file : made.files)
    std::ofstream(folder.path() / file.name) << file.content;
  return read_case(folder.path() / "case.toml");
}

bool remarks_say(const DeckCase& made, const std::string& text) {
  return std::any_of(made.remarks.begin(), made.remarks.end(), [&](const DeckRemark& one) {
    return (one.place + ": " + one.text).find(text) != std::string::npos;
  });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(Deck, becomes_a_case_that_can_be_read) {
  const TemporaryFolder folder;
  const DeckCase made = case_of_text(upsetting, folder);
  const Case content = read_back(made, folder);
  EXPECT_EQ(content.title, "A disk");
  EXPECT_EQ(content.analysis, Analysis::axisymmetric);
  EXPECT_EQ(content.workpiece.element, "quad4");
  EXPECT_EQ(content.materials.at("workpiece").elastic.young, 210000.0);
  const auto& table = std::get<mechanics::FlowTable>(*content.materials.at("workpiece").flow);
  EXPECT_EQ(table.points, (std::vector<std::pair<double, double>>{{0.0, 300.0}, {0.2, 400.0}}));
  ASSERT_EQ(content.supports.size(), 2U);
  ASSERT_EQ(content.tools.size(), 1U);
  const Tool& die = content.tools.front();
  EXPECT_EQ(die.name, "DIE");
  EXPECT_TRUE(std::get<ProfileSurface>(die.surface).flip);
  EXPECT_EQ(std::get<contact::Coulomb>(die.friction.law).mu, 0.1);
  EXPECT_EQ(content.time.end, 3.0);
  EXPECT_EQ(content.time.increments.max, 0.05);
}

TEST(Deck, moves_a_tool_along_its_amplitude_and_back_over_two_steps) {
  const TemporaryFolder folder;
  const Case content = read_back(case_of_text(upsetting, folder), folder);
  const auto& motion =
      std::get<DisplacementMotion>(*content.tools.front().motion.translation).displacement[1];
  EXPECT_DOUBLE_EQ(motion(0.25), -0.75);
  EXPECT_DOUBLE_EQ(motion(0.5), -1.5);
  EXPECT_DOUBLE_EQ(motion(1.0), -1.5);
  EXPECT_DOUBLE_EQ(motion(2.0), -0.75);
  EXPECT_DOUBLE_EQ(motion(3.0), 0.0);
}

TEST(Deck, says_by_line_what_it_leaves_out) {
  const TemporaryFolder folder;
  const DeckCase made = case_of_text(upsetting, folder);
  EXPECT_TRUE(remarks_say(made, "job.inp:23: *ELASTIC: the values of the first temperature"));
  EXPECT_TRUE(remarks_say(made, "*PLASTIC: the curve of temperature 20."));
  EXPECT_TRUE(remarks_say(made, "job.inp:30: *CREEP: not understood"));
  EXPECT_NE(made.files.front().content.find("job.inp:30: *CREEP"), std::string::npos);
}

TEST(Deck, takes_a_stiff_body_as_a_tool_with_the_body_on_the_left_of_its_profile) {
  const std::string block = replaced(
      replaced(upsetting, "*ELEMENT, TYPE=CAX4, ELSET=PART\n1, 1, 2, 3, 4\n",
               "11, 0., 5.\n12, 6., 5.\n13, 6., 8.\n14, 0., 8.\n"
               "*ELEMENT, TYPE=CAX4, ELSET=PART\n1, 1, 2, 3, 4\n"
               "*ELEMENT, TYPE=CAX4, ELSET=PUNCH\n2, 11, 12, 13, 14\n"
               "*NSET, NSET=PUNCHTOP\n13, 14\n"),
      "*SURFACE, TYPE=SEGMENTS, NAME=DIE\nSTART, 10., 5.\nLINE, 2., 5.\nCIRCL, 0., 7., 0., 5.\n"
      "*RIGID BODY, ANALYTICAL SURFACE=DIE, REF NODE=99\n",
      "*SURFACE, NAME=DIE\nPUNCH, S1\n");
  const std::string moved = replaced(
      replaced(block, "99, 2, 2, -1.5\n99, 1\n99, 6\n", "PUNCHTOP, 2, 2, -1.5\nPUNCHTOP, 1\n"),
      "99, 2, 2, 0.", "PUNCHTOP, 2, 2, 0.");
  const TemporaryFolder folder;
  const DeckCase made =
      case_of_text(replaced(moved, "*SOLID SECTION",
                            "*MATERIAL, NAME=HARD\n*ELASTIC\n600000., 0.3\n"
                            "*SOLID SECTION, ELSET=PUNCH, MATERIAL=HARD\n*SOLID SECTION"),
                   folder);
  const Case content = read_back(made, folder);
  ASSERT_EQ(content.tools.size(), 1U);
  EXPECT_EQ(content.tools.front().name, "PUNCH");
  EXPECT_TRUE(remarks_say(made, "PUNCH becomes a rigid tool"));
  // Counter-clockwise: the area to the left of the chain is positive.
  const auto profile = std::find_if(made.files.begin(), made.files.end(),
                                    [](const DeckFile& file) { return file.name == "PUNCH.toml"; });
  ASSERT_NE(profile, made.files.end());
  EXPECT_NE(profile->content.find("closed = true"), std::string::npos);
  const std::size_t low = profile->content.find("[0, 5]"), next = profile->content.find("[6, 5]");
  ASSERT_NE(low, std::string::npos);
  EXPECT_LT(low, next);
}

TEST(Deck, a_body_in_space_becomes_an_stl_whose_facets_look_outward) {
  const TemporaryFolder folder;
  std::string text = "*NODE\n";
  int node = 0;
  for (const double z : {0.0, 1.0, 1.0, 2.0})
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
      text += std::to_string(++node) + ", " + std::to_string(x) + ", " + std::to_string(y) + ", " +
              std::to_string(z) + "\n";
  text += "*ELEMENT, TYPE=C3D8, ELSET=SOFT\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
          "*ELEMENT, TYPE=C3D8, ELSET=STIFF\n2, 9, 10, 11, 12, 13, 14, 15, 16\n"
          "*MATERIAL, NAME=A\n*ELASTIC\n7e4, .3\n*PLASTIC\n100., 0.\n"
          "*MATERIAL, NAME=B\n*ELASTIC\n2e5, .3\n"
          "*SOLID SECTION, ELSET=SOFT, MATERIAL=A\n*SOLID SECTION, ELSET=STIFF, MATERIAL=B\n"
          "*SURFACE, NAME=S\nSOFT, S2\n*SURFACE, NAME=M\nSTIFF, S1\n"
          "*SURFACE INTERACTION, NAME=I\n*FRICTION, ROUGH\n*CONTACT PAIR, INTERACTION=I\nS, M\n"
          "*STEP\n*STATIC\n*DSLOAD\nS, P, 5.\n*END STEP\n";
  const DeckCase made = case_of_text(text, folder);
  const Case content = read_back(made, folder);
  EXPECT_EQ(content.analysis, Analysis::solid);
  ASSERT_EQ(content.tools.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<contact::Sticking>(content.tools.front().friction.law));
  ASSERT_EQ(content.loads.size(), 1U);
  const auto stl = std::find_if(made.files.begin(), made.files.end(),
                                [](const DeckFile& file) { return file.name == "STIFF.stl"; });
  ASSERT_NE(stl, made.files.end());
  // Two facets look down, two up, as many to each side.
  const auto count = [&](const std::string& normal) {
    int n = 0;
    for (std::size_t at = 0; (at = stl->content.find(normal, at)) != std::string::npos; ++at)
      ++n;
    return n;
  };
  const std::size_t down = stl->content.find("normal 0 0 -1");
  ASSERT_NE(down, std::string::npos) << stl->content;
  EXPECT_NE(stl->content.substr(down, 120).find("vertex"), std::string::npos);
  EXPECT_EQ(count("facet normal"), 12);
  const std::string lowest = stl->content.substr(down, stl->content.find("endloop", down) - down);
  EXPECT_EQ(lowest.find(" 2\n"), std::string::npos) << lowest; // z = 1 looks down, not z = 2
}

TEST(Deck, refuses_what_it_cannot_take) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& text, const std::string& what) {
    try {
      (void)case_of_text(text, folder);
      ADD_FAILURE() << "read: " << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  says("*PART, NAME=A\n", "decks with parts and instances are not read");
  says("1, 2\n", "a keyword such as *NODE is expected");
  says("*NODE\n1, x\n", "\"x\" is not a number");
  says(replaced(upsetting, "TYPE=CAX4", "TYPE=CAX3"),
       "element 1 has more than the 3 nodes of CAX3");
  says(replaced(replaced(upsetting, "TYPE=CAX4", "TYPE=CAX3"), "1, 1, 2, 3, 4", "1, 1, 2, 3"),
       "elements of type CAX3, which are not available");
  says("*NODE\n1, 0.\n", "no nodes or no elements");
  says(replaced(upsetting, "*NSET, NSET=AXIS\n1, 4", "*NSET, NSET=AXIS\nNOWHERE"), "NOWHERE");
}

TEST(Deck, names_and_numbers_stand_for_sets_and_includes_are_followed) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "held.inp") << "FOOT, 2\n";
  const Deck deck = deck_of(replaced(upsetting, "AXIS, XSYMM\nFOOT, 2\n",
                                     "axis, 1, , 0.\n*INCLUDE, INPUT=held.inp\n3, 1\n"),
                            folder);
  ASSERT_EQ(deck.initial.boundary.size(), 3U);
  EXPECT_EQ(deck.nodes_of("Axis"), (std::vector<DeckNumber>{1, 4}));
  EXPECT_EQ(deck.nodes_of("3"), std::vector<DeckNumber>{3});
  EXPECT_EQ(deck.initial.boundary[1].target, "FOOT");
}

} // namespace

} // namespace billet::io::deck_case_test
