#include "io/case/accuracy_preset.h"
#include "tests/io/case/case_text.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::io::resolved_case_test {
namespace {

void expect_round_trip(const Case& content) {
  const std::string text = resolved_toml(content);
  try {
    const Case again = read(text);
    EXPECT_EQ(again, content) << text;
    EXPECT_EQ(resolved_toml(again), text);
  } catch (const Error& error) {
    ADD_FAILURE() << error.what() << "\n" << text;
  }
}

TEST(ResolvedCase, reads_back_equal) {
  expect_round_trip(read(plane_case));
  expect_round_trip(read(space_case));
  expect_round_trip(read("units = \"m-N-s-Pa-degC\"\n" + space_case));
}

TEST(ResolvedCase, keeps_presses) {
  Case content = read(space_case);
  content.tools[0].motion.translation = PressMotion{
      CrankMotion{{0, 0, -1}, 80.0, 480.0, TimeFunction({{0.0, 1.0}, {1.0, 3.0}}), 150}};
  content.tools[1].motion.translation =
      PressMotion{HammerMotion{{{0, 1, -1}, 0.8, 20.0}, 1.0 / 3.0, 5000.0}};
  content.tools[2].motion.translation =
      PressMotion{ScrewMotion{{{0, 0, -2}, 1.0, {}}, 8e5, 300.0, 0.1 + 0.2, 4.0}};
  expect_round_trip(content);
}

TEST(ResolvedCase, keeps_on_which_side_of_a_profile_the_tool_lies) {
  for (const bool flip : {false, true}) {
    Case content = read(plane_case);
    content.tools[2].surface = PointsSurface{{{0, 0, 0}, {4, 0, 0}}, false, flip};
    expect_round_trip(content);
    const test::TemporaryFolder folder; // the file must be in the folder of the case
    content.tools[2].surface =
        ProfileSurface{{"die.toml", folder.file("die.toml", "points = [[0, 0], [4, 0]]")}, flip};
    const Case again = read_case(folder.file("case.toml", resolved_toml(content)));
    EXPECT_EQ(again.tools[2].surface, content.tools[2].surface) << resolved_toml(content);
    content = read(space_case);
    std::get<RevolutionSurface>(content.tools[4].surface).flip = flip;
    expect_round_trip(content);
  }
}

TEST(ResolvedCase, keeps_step_files) {
  const test::TemporaryFolder folder; // files must be in the folder of the case
  StepSurface plain;
  plain.file = {"die.step", folder.file("die.step", "")};
  StepSurface full = plain;
  full.chord_error = 0.1 + 0.2;
  full.smooth = false;
  full.feature_angle = 12.5;
  full.flip = true;
  for (const std::string units : {"", "units = \"m-N-s-Pa-degC\"\n"})
    for (StepSurface surface : {plain, full}) {
      Case content = read(units + space_case);
      surface.unit_factor = units.empty() ? 1.0 : 1e-3;
      content.tools[1].surface = surface;
      const Case again = read_case(folder.file("case.toml", resolved_toml(content)));
      EXPECT_EQ(resolved_toml(again), resolved_toml(content));
      EXPECT_EQ(again.tools[1].surface, content.tools[1].surface) << resolved_toml(content);
    }
  StepMesh body;
  body.file = plain.file;
  body.size = 1.0 / 3.0;
  Case content = read(space_case);
  content.workpiece.element = "tet10";
  for (const std::optional<double> chord_error : {std::optional<double>(), {0.1 + 0.2}}) {
    body.chord_error = chord_error;
    content.workpiece.mesh = body;
    const Case again = read_case(folder.file("case.toml", resolved_toml(content)));
    EXPECT_EQ(again.workpiece.mesh, content.workpiece.mesh) << resolved_toml(content);
  }
}

TEST(ResolvedCase, keeps_every_bit_of_a_number) {
  Case content = read(space_case);
  content.time.end = 0.1 + 0.2;
  content.temperature = 1.0 / 3.0;
  content.solver.tolerance = 4.9406564584124654e-324;
  content.contact.penalty = 1.7976931348623157e308;
  content.contact.penalty_tangent = 1234567890123456789.0;
  expect_round_trip(content);
}

TEST(ResolvedCase, escapes_text_and_names) {
  Case content = read(space_case);
  content.title = "a \"quoted\" \\ title\n\twith \x01 \u00e4";
  content.materials["spring steel"] = content.materials.at("lead");
  expect_round_trip(content);
}

/// A case with everything that this version knows and cannot do yet, in space or in the plane.
Case full_case() {
  Case content = read(space_case);
  content.workpiece.element = "tet10";
  content.tools[0].motion = {ForceMotion{{0, 0, 1}, 3.0}, TorqueMotion{{0, 0, 0}, {0, 0, 1}, 4.0}};
  content.tools[3].wear = Wear{1e-4, 700, 2e-4, 1e5};
  content.contact.method = ContactMethod::augmented;
  content.contact.max_penetration = 1e-3;
  content.solver.accuracy = Accuracy::draft;
  content.remesh = Remesh{0.1, 1, 2, 0.5, 5, 4, 6, 4.5, "tet10", {"top"}, true};
  content.output.checkpoint_every = {1.5, false};
  return content;
}

TEST(ResolvedCase, keeps_rate_laws_temperature_and_heating) {
  Case content = read(space_case);
  content.temperature = 1150.5;
  Material& lead = content.materials.at("lead");
  lead.density = 1.1e-8;
  lead.heat_capacity = 1.3e8;
  lead.heating = 0.9;
  for (const FlowLaw& flow :
       {FlowLaw(mechanics::NortonHoff{1, 0.1, 0.2, 0.3, 4}),
        FlowLaw(mechanics::Perzyna{mechanics::Swift{1, 0.1, 0.2}, 3, 4}),
        FlowLaw(mechanics::JohnsonCook{1, 2, 3, 4, 5, 6, 20, 6000}),
        FlowLaw(mechanics::HanselSpittel{1, 2, 3, 4, 5, 6, 7, 8, 9, 0.02}),
        FlowLaw(mechanics::HanselSpittel{1, 2, 3, 4, 5, 6, 7, 8, 9, 0.02, 1.5})}) {
    lead.flow = flow;
    expect_round_trip(content);
  }
}

TEST(ResolvedCase, keeps_every_friction) {
  Case content = read(space_case);
  content.tools[0].friction.law = contact::Shaw{3.0, 0.5, contact::Flattening::wanheim_bay};
  content.tools[0].friction.tensor = {{{1, 0}, {0, 2}}};
  content.tools[0].friction.direction = Vec3(1, 0, 0);
  content.tools[1].friction.law = contact::Asperity{0.1, contact::FollowedStress::von_mises, 0.0,
                                                    contact::Flattening::bowden_tabor};
  content.tools[1].friction.evolution = {{0, 1}, {1, 2}};
  content.tools[2].friction.law = contact::ThickFilm{1, 2};
  content.tools[3].friction.law = contact::Viscoplastic{1, 2, 0.5};
  content.contact.integrator = ContactIntegrator::midpoint;
  content.contact.substeps = 5;
  expect_round_trip(content);
  content.tools[2].friction.law = contact::Coulomb{1.0};
  content.tools[2].friction.table = {{0, 100}, {1, 2, 3}, {}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
  content.tools[3].friction.law = contact::Tresca{1.0, {}};
  content.tools[3].friction.table = {{}, {}, {0, 5}, {0.1, 0.2}};
  content.contact.integrator = ContactIntegrator::exact;
  content.contact.substeps.reset();
  expect_round_trip(content);
}

TEST(ResolvedCase, keeps_remeshing) {
  Case content = read(plane_case);
  content.remesh = Remesh{};
  expect_round_trip(content);
  content.remesh =
      Remesh{0.1 + 0.2, 1.0 / 3.0, 2, 0.25, 4, 3, 6, 5, "tri6", {"top", "a rim"}, false};
  expect_round_trip(content);
}

TEST(ResolvedCase, keeps_what_ends_a_run) {
  Case content = read(plane_case);
  content.stop = {.on_full_cavity = false,
                  .on_tools_overloaded = false,
                  .on_tools_together = false,
                  .on_lap = 0.1};
  expect_round_trip(content);
}

TEST(ResolvedCase, keeps_intervals_of_checkpoints) {
  Case content = read(plane_case);
  for (const CheckpointInterval& interval :
       {CheckpointInterval{}, CheckpointInterval{90.0, true}, CheckpointInterval{100.0 / 3.0, true},
        CheckpointInterval{7200.0, true}, CheckpointInterval{HUGE_VAL, true},
        CheckpointInterval{0.1, false}}) {
    content.output.checkpoint_every = interval;
    expect_round_trip(content);
  }
}

TEST(ResolvedCase, keeps_what_few_cases_have) { expect_round_trip(full_case()); }

TEST(ResolvedCase, keeps_measures) {
  Case content = read(space_case);
  const std::string tool = content.tools[0].name;
  content.measures = {
      {.name = "barrel",
       .kind = MeasureKind::barrelling,
       .point = {1, 2, 3},
       .axis = {0, 0, 2},
       .tool = tool,
       .touching = 0.01},
      {.name = "bore",
       .kind = MeasureKind::bore,
       .axis = {0, 0, 1},
       .within = Box{{-1, -2, -3}, {1, 2, 3}}},
      {.name = "tip", .kind = MeasureKind::reach, .direction = {1, 0, 1}},
      {.name = "filled", .kind = MeasureKind::filling, .within = Box{{0, 0, 0}, {1, 2, 3}}}};
  expect_round_trip(content);
}

TEST(ResolvedCase, says_what_an_accuracy_stands_for) {
  const Case content = read(space_case, {"solver.accuracy=draft"});
  EXPECT_EQ(content.solver.tolerance, preset_of(Accuracy::draft).tolerance);
  EXPECT_EQ(read(space_case, {"solver.accuracy=fine", "solver.tolerance=1e-3"}).solver.tolerance,
            1e-3);
  EXPECT_NE(resolved_toml(content).find("accuracy = \"draft\""), std::string::npos);
}

TEST(ResolvedCase, states_the_defaults) {
  const std::string text = resolved_toml(read(space_case));
  EXPECT_NE(text.find("penalty = 100\n"), std::string::npos);
  EXPECT_NE(text.find("element = \"hex20\"\n"), std::string::npos);
  EXPECT_NE(text.find("friction = { law = \"frictionless\" }\n"), std::string::npos);
  EXPECT_NE(text.find("hardness = 30\n"), std::string::npos);
}

} // namespace
} // namespace billet::io::resolved_case_test
