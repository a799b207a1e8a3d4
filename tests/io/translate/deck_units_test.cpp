// Decks in other units than those of a case.

#include "tests/io/translate/pulled_deck.h"

#include <cmath>
#include <variant>

namespace billet::io::deck_units_test {

namespace {

using test::TemporaryFolder;

TEST(DeckUnits, inches_and_pounds_are_converted) {
  const TemporaryFolder folder;
  const Pulled pulled{.material = "*PLASTIC\n40000,0\n*DENSITY\n7.4e-4\n",
                      .model = "*SURFACE,NAME=S\nE,S2\n",
                      .parameters = ",VALUE=ABSOLUTE",
                      .first = "*BOUNDARY,AMPLITUDE=A\nTOP,2,2\n*DSLOAD\nS,P,1000.\n"
                               "*DLOAD\nE,BY,-0.283\nE,GRAV,386.1,0.,-1.\n"};
  const auto units = std::find_if(deck_units().begin(), deck_units().end(),
                                  [](const auto& one) { return one.name == "in-lbf-s-psi"; });
  ASSERT_NE(units, deck_units().end());
  const DeckCase made = case_of(deck_of(pulled.text(), folder), *units, "job.inp");
  const Case content = read_back(made, folder);
  constexpr double psi = 6.894757293168361e-3; // [MPa]
  const auto near = [](double found, double wanted) {
    EXPECT_NEAR(found, wanted, 1e-9 * std::abs(wanted)); // ten digits are written
  };
  EXPECT_EQ(content.units.name, "mm-N-s-MPa-degC");
  near(content.materials.at("workpiece").elastic.young, 2e5 * psi);
  EXPECT_NE(made.files[1].content.find("2, 25.39"), std::string::npos) << made.files[1].content;
  const auto moved = std::find_if(content.supports.begin(), content.supports.end(),
                                  [](const Support& one) { return one.move[1].has_value(); });
  ASSERT_NE(moved, content.supports.end());
  near((*moved->move[1])(1.0), 25.4);
  ASSERT_EQ(content.loads.size(), 3U);
  near(std::get<PressureLoad>(content.loads[0].kind).pressure(1.0), 1000.0 * psi);
  const double weight = 4.4482216152605 / (25.4 * 25.4 * 25.4); // of a pound in a cubic inch
  near(std::get<BodyForce>(content.loads[1].kind).force.y(), -7.4e-4 * 386.1 * weight);
  near(std::get<BodyForce>(content.loads[2].kind).force.y(), -0.283 * weight);
}

TEST(DeckUnits, angles_of_a_node_that_turns_a_tool_stay) {
  const TemporaryFolder folder;
  Deck deck = deck_of("*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n98,0,2\n99,0,2\n"
                      "*ELEMENT,TYPE=CPE4,ELSET=E\n1,1,2,3,4\n*SURFACE,TYPE=SEGMENTS,NAME=DIE\n"
                      "START,5.,1.\nLINE,-5.,1.\n"
                      "*RIGID BODY,ANALYTICAL SURFACE=DIE,REF NODE=98,ROT NODE=99\n"
                      "*STEP\n*STATIC\n0.1,1\n*BOUNDARY\n98,2,2,-0.5\n99,3,3,0.25\n*END STEP\n",
                      folder);
  to_units_of_case(deck, deck_units().back());
  const auto& boundary = deck.steps.front().boundary;
  ASSERT_EQ(boundary.size(), 2U);
  EXPECT_DOUBLE_EQ(boundary[0].unit, 25.4);
  EXPECT_DOUBLE_EQ(boundary[1].unit, 1.0);
}

} // namespace

} // namespace billet::io::deck_units_test
