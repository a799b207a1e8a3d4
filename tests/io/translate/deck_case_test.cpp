// Decks of CalculiX and Abaqus as cases.

#include "geometry/base/error.h"
#include "geometry/base/time_function.h"
#include "io/case/read_case.h"
#include "io/translate/deck_case.h"
#include "io/translate/deck_history.h"
#include "tests/io/translate/pulled_deck.h"
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

void expect_refusal(const Pulled& pulled, const std::string& wanted) {
  try {
    (void)case_of_pulled(pulled);
    ADD_FAILURE() << "read, but wanted: " << wanted;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
  }
}

TEST(Deck, an_element_without_its_node_is_an_error_with_line_and_numbers) {
  const TemporaryFolder folder;
  const std::string text = replaced(Pulled{}.text(), "1,1,2,3,4", "1,1,2,3,5");
  try {
    (void)case_of_text(text, folder);
    ADD_FAILURE();
  } catch (const Error& error) {
    ASSERT_EQ(error.complaints().size(), 1U);
    const Complaint& complaint = error.complaints().front();
    EXPECT_TRUE(complaint.place.ends_with("job.inp:7")) << complaint.place;
    EXPECT_EQ(complaint.message, "element 1 names node 5, which is not there");
  }
}

TEST(Deck, nodes_may_follow_the_elements_that_name_them) {
  const TemporaryFolder folder;
  const std::string nodes = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n";
  const std::string text = nodes + replaced(Pulled{}.text(), nodes, "");
  const std::string late =
      replaced(Pulled{}.text(), nodes, "") + "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n";
  EXPECT_EQ(case_of_text(late, folder).files[1].content,
            case_of_text(text, folder).files[1].content);
}

TEST(Deck, refuses_what_would_be_no_element_support_or_amplitude) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& what) {
    try {
      (void)case_of_text(replaced(Pulled{}.text(), from, to), folder);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused("TYPE=CPE4,ELSET=E\n1,1,2,3,4", "TYPE=CPE,ELSET=E\n1,1,2",
          "element 1 of type CPE has 2 nodes, its corners are 4");
  refused("BOT,1,1", "BOT,2,1", "*BOUNDARY: degrees of freedom from 2 to 1");
  refused("BOT,1,1", "BOT,-1,1", "*BOUNDARY: degrees of freedom from -1 to 1");
  refused("*NSET,NSET=BOT", "*NSET", "*NSET: the set has no name");
  expect_refusal({.amplitude = "0,0,1,1,1,2"},
                 "*AMPLITUDE: the time 1 is not after the one before, 1");
  expect_refusal({.parameters = ",SHIFTX=x"}, "SHIFTX=\"x\" is not a number");
  expect_refusal({.material = "*PLASTIC\n,0\n"}, "the row has no stress");
  expect_refusal({.model = "*RIGID BODY,NSET=TOP,REF NODE=98\n"},
                 "*RIGID BODY: REF NODE=98 is not there");
  expect_refusal({.model = "*NSET,NSET=X,ELSET=NOPE\n"},
                 "*NSET: ELSET=NOPE is no set given before");
}

TEST(Deck, an_amplitude_that_goes_on_after_its_step_is_cut_where_the_step_ends) {
  expect_history(pull_of({.amplitude = "0,0,2,1"}), {{0.0, 0.0}, {1.0, -0.25}});
  expect_history(pull_of({.amplitude = "0,0,0.5,0.4,2,1"}), {{0.0, 0.0}, {0.5, -0.2}, {1.0, -0.3}});
  expect_history(pull_of({.amplitude = "-1,0,1,1"}), {{0.0, -0.25}, {1.0, -0.5}});
}

TEST(Deck, an_amplitude_has_its_first_value_before_its_points_and_its_last_after_them) {
  expect_history(pull_of({.amplitude = "0.5,0,0.75,1"}),
                 {{0.0, 0.0}, {0.5, 0.0}, {0.75, -0.5}, {1.0, -0.5}});
  expect_history(pull_of({.amplitude = "3,0.5,4,1"}), {{0.0, -0.25}, {1.0, -0.25}});
}

TEST(Deck, a_velocity_goes_on_in_later_steps_until_something_else_is_prescribed) {
  const std::string velocity = "*BOUNDARY,TYPE=VELOCITY\nTOP,2,2,-0.5\n";
  expect_history(pull_of({.first = velocity, .second = "*BOUNDARY\nBOT,1\n"}),
                 {{0.0, 0.0}, {2.0, -1.0}});
  expect_history(pull_of({.first = velocity, .second = "*BOUNDARY\nTOP,2,2,-0.7\n"}),
                 {{0.0, 0.0}, {1.0, -0.5}, {2.0, -0.7}});
}

TEST(Deck, an_amplitude_over_the_time_of_the_run_goes_on_over_the_steps) {
  const Pulled once{.amplitude = "0,0,2,1", .parameters = ",TIME=TOTAL TIME", .second = "*CLOAD\n"};
  expect_history(pull_of(once), {{0.0, 0.0}, {2.0, -0.5}});
  Pulled twice = once;
  twice.second = twice.first;
  expect_history(pull_of(twice), {{0.0, 0.0}, {1.0, -0.25}, {2.0, -0.5}});
  EXPECT_EQ(remarks_on(twice).find("jumps"), std::string::npos);
  const TemporaryFolder folder;
  Deck deck = deck_of(
      replaced(
          Pulled{.amplitude = "0,0,3,1", .parameters = ",TIME=TOTAL TIME", .second = once.first}
              .text(),
          "0.1,1\n*BOUNDARY,AMPLITUDE=A\nTOP,2,2,-0.5\n*END STEP\n*STEP\n*STATIC\n0.1,1",
          "0.1,1\n*BOUNDARY,AMPLITUDE=A\nTOP,2,2,-0.5\n*END STEP\n*STEP\n*STATIC\n0.1,2"),
      folder);
  expect_history(prescribed_motions(deck).at("TOP").components.at(2),
                 {{0.0, 0.0}, {1.0, -0.5 / 3.0}, {3.0, -0.5}});
}

TEST(Deck, where_an_amplitude_begins_elsewhere_the_value_jumps_and_a_remark_says_so) {
  const Pulled twice{.second = "*BOUNDARY,AMPLITUDE=A\nTOP,2,2,-1.0\n"};
  expect_history(pull_of(twice), {{0.0, 0.0}, {1.0, -0.5}, {1.001, -0.001}, {2.0, -1.0}});
  expect_remark(
      remarks_on(twice),
      "job.inp:36: *BOUNDARY: component 2 of TOP jumps at time 1 from -0.5 to 0, where its "
      "amplitude begins: it gets there in a thousandth of the step\n");
  EXPECT_EQ(remarks_on({}).find("jumps"), std::string::npos);
  const Pulled held{.second = "*BOUNDARY\nTOP,2,2,-1.0\n"};
  expect_history(pull_of(held), {{0.0, 0.0}, {1.0, -0.5}, {2.0, -1.0}});
}

TEST(Deck, an_amplitude_of_absolute_values_or_with_a_shift_is_what_it_says) {
  expect_history(pull_of({.amplitude = "0,0,1,-0.2", .parameters = ",VALUE=ABSOLUTE"}),
                 {{0.0, 0.0}, {1.0, -0.2}});
  expect_history(pull_of({.amplitude = "0,0,2,1", .parameters = ",SHIFTX=0.5,SHIFTY=0.1"}),
                 {{0.0, -0.05}, {0.5, -0.05}, {1.0, -0.175}}); // as CalculiX 2.20 has it
}

TEST(Deck, names_that_are_not_there_are_remarks_with_line_and_name) {
  const std::string remarks = remarks_on(
      {.model =
           "*SURFACE,NAME=S\nEE,S3\n*CONTACT PAIR,INTERACTION=nope\nS,MISSING\n"
           "*NSET,NSET=PART\n3,77,78\n*RIGID BODY,ELSET=GONE\n*SHELL SECTION,ELSET=Q,MATERIAL=MM\n",
       .first = "*BOUNDARY,AMPLITUDE=NOPE\nTOPP,2,2,-0.5\n*BOUNDARY\n12,1\n*CLOAD\nX,2,1.\n"
                "*DLOAD\nYY,P3,4.\n*DSLOAD\nZ,P,4.\n"});
  expect_remark(remarks, "job.inp:27: *SURFACE: there is no set of elements EE: left out; did you "
                         "mean 'E'?\n");
  expect_remark(remarks, "job.inp:28: *CONTACT PAIR: there is no surface interaction nope: without "
                         "friction\n");
  expect_remark(remarks, "job.inp:29: *CONTACT PAIR: there is no surface MISSING: left out");
  expect_remark(remarks, "job.inp:30: the set of nodes PART: 2 of its 3 numbers are not there, the "
                         "first is 77\n");
  expect_remark(remarks, "job.inp:32: *RIGID BODY: there is no set of elements GONE");
  expect_remark(remarks, "job.inp:33: *SHELL SECTION: there is no set of elements Q");
  expect_remark(remarks, "job.inp:33: *SHELL SECTION: there is no material MM");
  expect_remark(remarks, "job.inp:37: *BOUNDARY: there is no amplitude NOPE: the value is taken as "
                         "without one; the deck has A\n");
  expect_remark(remarks, "job.inp:38: *BOUNDARY: there is no set of nodes TOPP: left out; did you "
                         "mean 'TOP'?\n");
  expect_remark(remarks, "job.inp:40: *BOUNDARY: there is no node 12: left out\n");
  expect_remark(remarks, "job.inp:42: *CLOAD: there is no set of nodes X: left out");
  expect_remark(remarks, "job.inp:44: *DLOAD: there is no set of elements YY: left out");
  expect_remark(remarks, "job.inp:46: *DSLOAD: there is no surface Z: left out");
  // Nothing of it for a deck that is whole, and sets may follow the lines that name them.
  EXPECT_EQ(remarks_on({}), "");
  EXPECT_EQ(remarks_on({.first = "*BOUNDARY\nLATE,2,2,-0.5\n*NSET,NSET=LATE\n3,4\n"}), "");
}

TEST(Deck, a_set_of_nodes_takes_those_of_a_set_of_elements) {
  const TemporaryFolder folder;
  const Deck deck = deck_of(
      replaced(Pulled{}.text(), "*NSET,NSET=TOP\n3,4\n", "*NSET,NSET=TOP,ELSET=PIECE\n"), folder);
  EXPECT_EQ(deck.nodes_of("TOP"), (std::vector<DeckNumber>{1, 2, 3, 4}));
}

TEST(Deck, antisymmetry_holds_the_two_displacements_in_its_plane) {
  const TemporaryFolder folder;
  const auto held_by = [&](const std::string& name) {
    Deck deck =
        deck_of(replaced(Pulled{}.text(), "BOT,2,2\nBOT,1,1\n", "BOT," + name + "\n"), folder);
    std::vector<int> components;
    const auto motions = prescribed_motions(deck);
    for (const auto& [component, history] : motions.at("BOT").components)
      components.push_back(component);
    return components;
  };
  EXPECT_EQ(held_by("XSYMM"), std::vector<int>{1});
  EXPECT_EQ(held_by("XASYMM"), (std::vector<int>{2, 3}));
  EXPECT_EQ(held_by("YASYMM"), (std::vector<int>{1, 3}));
  EXPECT_EQ(held_by("ZASYMM"), (std::vector<int>{1, 2}));
  EXPECT_EQ(held_by("ENCASTRE"), (std::vector<int>{1, 2, 3}));
}

TEST(Deck, the_law_of_johnson_and_cook_is_translated) {
  const Case content = read_pulled({.material = "*PLASTIC,HARDENING=JOHNSON COOK\n"
                                                "300.,400.,0.2,1.1,1500.,25.\n"
                                                "*RATE DEPENDENT,TYPE=JOHNSON COOK\n0.01,2.\n"});
  EXPECT_EQ(std::get<mechanics::JohnsonCook>(*content.materials.at("workpiece").flow),
            (mechanics::JohnsonCook{300.0, 400.0, 0.2, 0.01, 2.0, 1.1, 25.0, 1500.0}));
  EXPECT_EQ(content.temperature, 25.0);
  const Case slow =
      read_pulled({.material = "*PLASTIC,HARDENING=JOHNSON COOK\n300.,400.,0.2,1.1,1500.,25.\n"});
  EXPECT_EQ(std::get<mechanics::JohnsonCook>(*slow.materials.at("workpiece").flow).C, 0.0);
  const Case cold =
      read_pulled({.material = "*PLASTIC,HARDENING=JOHNSON COOK\n300.,400.,0.2,1.1\n"});
  EXPECT_EQ(std::get<mechanics::Ludwik>(*cold.materials.at("workpiece").flow),
            (mechanics::Ludwik{300.0, 400.0, 0.2}));
}

TEST(Deck, says_which_hardening_and_which_rows_of_it_are_left_out) {
  const Pulled user{.material = "*PLASTIC,HARDENING=USER\n300.,0.\n"};
  expect_remark(remarks_on(user), "job.inp:19: *PLASTIC: HARDENING=USER is not available: the "
                                  "plasticity is left out\n");
  EXPECT_FALSE(read_pulled(user).materials.at("workpiece").flow);
  expect_remark(remarks_on({.material = "*PLASTIC,HARDENING=KINEMATIC\n300.,0.\n"}),
                "job.inp:19: *PLASTIC: HARDENING=KINEMATIC is taken as isotropic\n");
  expect_remark(
      remarks_on({.material = "*PLASTIC,HARDENING=COMBINED,DATA TYPE=PARAMETERS\n300.,1e4,9.\n"}),
      "HARDENING=COMBINED with DATA TYPE=PARAMETERS is not available");
  const Pulled rates{.material =
                         "*PLASTIC\n300.,0.\n400.,0.1\n*PLASTIC,RATE=10.\n350.,0.\n500.,0.3\n"};
  expect_remark(remarks_on(rates), "job.inp:22: *PLASTIC: the first curve is taken for all rates, "
                                   "the one of RATE=10. is left out\n");
  EXPECT_EQ(
      std::get<mechanics::FlowTable>(*read_pulled(rates).materials.at("workpiece").flow).points,
      (std::vector<std::pair<double, double>>{{0.0, 300.0}, {0.1, 400.0}}));
  expect_remark(
      remarks_on({.material = "*PLASTIC\n300.,0.\n400.,0.2\n380.,0.1\n"}),
      "job.inp:22: *PLASTIC: the strain 0.1 is not above the one before, 0.2: rows of strains "
      "that do not rise are left out\n");
}

TEST(Deck, says_which_friction_and_gravity_are_left_out) {
  expect_remark(
      remarks_on(
          {.model = "*SURFACE INTERACTION,NAME=I\n*FRICTION,EXPONENTIAL DECAY\n0.3,0.1,2.\n"}),
      "job.inp:27: *FRICTION: EXPONENTIAL DECAY is not available: the static coefficient 0.3 "
      "is taken for all speeds of sliding\n");
  expect_remark(remarks_on({.first = "*DLOAD\nE,GRAV,9810.,0.,-1.,0.\n"}),
                "job.inp:30: GRAV: the workpiece has no *DENSITY, left out\n");
  const Pulled heavy{.material = "*DENSITY\n8e-9\n", .first = "*DLOAD\nE,GRAV,9810.,0.,-1.,0.\n"};
  EXPECT_EQ(remarks_on(heavy), "");
  EXPECT_EQ(read_pulled(heavy).loads.size(), 1U);
}

TEST(Deck, one_without_a_step_says_how_long_its_case_is) {
  const TemporaryFolder folder;
  std::string text = Pulled{}.text();
  text.erase(text.find("*STEP"));
  const DeckCase made = case_of_text(text, folder);
  EXPECT_TRUE(remarks_say(made, ": the deck has no *STEP: the case ends at time 1"));
}

TEST(Deck, keywords_are_shown_as_they_are_written) {
  expect_remark(remarks_on({.model = "*INITIAL CONDITIONS,TYPE=TEMPERATURE\nTOP,20.\n"}),
                "job.inp:26: *INITIAL CONDITIONS: not understood, and left out\n");
}

TEST(Deck, degrees_of_freedom_that_are_no_displacement_are_left_out) {
  const TemporaryFolder folder;
  Deck deck =
      deck_of(replaced(Pulled{}.text(), "BOT,2,2\nBOT,1,1\n", "BOT,0\nBOT,2,11\nBOT,11\n"), folder);
  EXPECT_EQ(std::count_if(deck.remarks.begin(), deck.remarks.end(),
                          [](const DeckRemark& one) {
                            return one.text ==
                                   "*BOUNDARY: no displacement or rotation (a degree of "
                                   "freedom other than 1 to 6), left out";
                          }),
            3);
  ASSERT_EQ(deck.initial.boundary.size(), 1U);
  EXPECT_EQ(deck.initial.boundary.front().first, 2);
  EXPECT_EQ(deck.initial.boundary.front().last, 6);
}

TEST(Deck, elements_that_are_part_of_no_body_are_a_remark) {
  expect_remark(remarks_on({.model = "*ELEMENT,TYPE=SPRINGA\n7,1,3\n8,2,4\n"}),
                ": *ELEMENT, TYPE=SPRINGA: left out, 2 elements from number 7\n");
}

} // namespace

} // namespace billet::io::deck_case_test
