// Loads of a deck: pressures, tractions, forces per volume, and when they end.

#include "geometry/base/time_function.h"
#include "tests/io/translate/pulled_deck.h"

#include <variant>

namespace billet::io::deck_forces_test {

namespace {

using test::TemporaryFolder;

TEST(DeckForces, pressures_and_velocities_go_along_amplitudes_that_do_not_end_with_the_step) {
  const TemporaryFolder folder;
  Deck deck = deck_of(Pulled{.amplitude = "0,0,2,1",
                             .first = "*DLOAD,AMPLITUDE=A\nE,P3,40.\n"
                                      "*BOUNDARY,TYPE=VELOCITY,AMPLITUDE=A\nTOP,2,2,-0.5\n"}
                          .text(),
                      folder);
  const auto pressures = pressure_histories(deck);
  ASSERT_EQ(pressures.size(), 1U);
  expect_history(pressures.front().history, {{0.0, 0.0}, {1.0, 20.0}});
  const DeckHistory pull = prescribed_motions(deck).at("TOP").components.at(2);
  EXPECT_DOUBLE_EQ(TimeFunction(pull)(0.5), -0.03125); // integral of -t / 4
  EXPECT_DOUBLE_EQ(TimeFunction(pull)(1.0), -0.125);
}

TEST(DeckForces, that_a_step_takes_back_end_at_zero) {
  const TemporaryFolder folder;
  Deck deck = deck_of(Pulled{.first = "*DLOAD\nE,P3,40.\n*CLOAD\nTOP,2,7.\n",
                             .second = "*DLOAD,OP=NEW\nE,P2,10.\n*CLOAD,OP=NEW\nBOT,1,3.\n"}
                          .text(),
                      folder);
  const auto pressures = pressure_histories(deck);
  ASSERT_EQ(pressures.size(), 2U);
  expect_history(pressures[0].history, {{0.0, 0.0}, {1.0, 40.0}, {2.0, 0.0}});
  expect_history(pressures[1].history, {{0.0, 0.0}, {1.0, 0.0}, {2.0, 10.0}});
  expect_history(concentrated_forces(deck).at("TOP").components.at(2),
                 {{0.0, 0.0}, {1.0, 7.0}, {2.0, 0.0}});
}

TEST(DeckForces, of_a_traction_keep_their_direction_and_go_along_its_amplitude) {
  const std::string surface = "*SURFACE,NAME=S\nE,S3\n";
  const Pulled along{.model = surface,
                     .first = "*DSLOAD,AMPLITUDE=A,FOLLOWER=NO,CONSTANT RESULTANT=YES\n"
                              "S,TRVEC,5.,0.,2.\n"};
  EXPECT_EQ(remarks_on(along), "");
  const Case straight = read_pulled(along);
  ASSERT_EQ(straight.loads.size(), 1U);
  const auto& traction = std::get<TractionLoad>(straight.loads.front().kind);
  EXPECT_EQ(traction.traction, Vec3::UnitY());
  EXPECT_DOUBLE_EQ(traction.amplitude(0.5), 2.5);
  const Pulled oblique{
      .model = surface, .first = "*DLOAD\nE,TRVEC3,5.,3.,4.\n", .second = "*DLOAD,OP=NEW\n"};
  expect_remark(remarks_on(oblique), "job.inp:31: *DLOAD: TRVEC: the traction keeps its direction");
  const Case two = read_pulled(oblique);
  ASSERT_EQ(two.loads.size(), 2U);
  EXPECT_DOUBLE_EQ(std::get<TractionLoad>(two.loads[0].kind).amplitude(1.0), 3.0);
  EXPECT_DOUBLE_EQ(std::get<TractionLoad>(two.loads[1].kind).amplitude(1.0), 4.0);
  EXPECT_DOUBLE_EQ(std::get<TractionLoad>(two.loads[1].kind).amplitude(2.0), 0.0);
  expect_remark(remarks_on({.model = surface, .first = "*DSLOAD\nS,TRVEC,5.,0.,1.,1.\n"}),
                "job.inp:32: TRVEC: its component along z is left out\n");
  expect_remark(remarks_on({.model = surface, .first = "*DSLOAD\nS,TRVEC,5.\n"}),
                "job.inp:32: *DSLOAD: TRVEC without a direction, left out\n");
}

TEST(DeckForces, forces_per_volume_are_body_forces) {
  const Pulled heavy{.first = "*DLOAD\nE,BY,-5.\nE,BX,2.\n"};
  EXPECT_EQ(remarks_on(heavy), "");
  const Case content = read_pulled(heavy);
  ASSERT_EQ(content.loads.size(), 1U);
  EXPECT_EQ(std::get<BodyForce>(content.loads.front().kind).force, Vec3(2.0, -5.0, 0.0));
  expect_remark(remarks_on({.first = "*DLOAD\nE,BZ,-5.\n"}),
                "job.inp:30: BZ: no axis of the case, left out\n");
  expect_remark(remarks_on({.first = "*DLOAD,AMPLITUDE=A\nE,BX,-5.\n"}),
                "job.inp:30: BX: it acts in full from the begin of the run to its end\n");
  expect_remark(remarks_on({.first = "*DLOAD\nE,BX,1.\n", .second = "*DLOAD\nE,BX,2.\n"}),
                "*DLOAD: BX is another than at ");
}

} // namespace

} // namespace billet::io::deck_forces_test
