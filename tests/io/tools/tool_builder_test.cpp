#include "geometry/base/error.h"
#include "geometry/triangles/triangle_mesh.h"
#include "io/tools/stl.h"
#include "io/tools/tool_builder.h"
#include "tests/geometry/round_meshes.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace billet::io::tool_builder_test {
namespace {

/// A roll of radius 10 with 36 facets, as the tool of a case.
class ToolBuilder : public testing::Test {
protected:
  ToolBuilder() {
    const std::filesystem::path path = folder_.path() / "roll.stl";
    write_stl(path, geometry::round_bar({}));
    StlSurface stl;
    stl.file.path = path;
    stl.unit = "mm";
    tool_.name = "roll";
    tool_.surface = stl;
  }

  /// Gap of a point on the true cylinder, in the middle of a facet. [mm]
  double gap() {
    const Vec3 x(10.0 * std::cos(std::numbers::pi / 36), 10.0 * std::sin(std::numbers::pi / 36),
                 20.0);
    const contact::Tool built = build_tool(tool_, Analysis::solid, 10.0, notes_);
    geometry::Projection p;
    built.surface->project({&x, 1}, 1.0, {&p, 1});
    return p.gap;
  }

  StlSurface& stl() { return std::get<StlSurface>(tool_.surface); }

  test::TemporaryFolder folder_;
  Tool tool_;
  std::vector<std::string> notes_;
};

TEST_F(ToolBuilder, AnStlKeepsItsFacetsUnlessTheCaseSaysSmooth) {
  EXPECT_NEAR(gap(), 0.038, 1e-3);
  ASSERT_EQ(notes_.size(), 2U);
  EXPECT_EQ(notes_[1].find("tool 'roll': its facets are off the curved shape"), 0U) << notes_[1];
  EXPECT_NE(notes_[1].find("by up to 0.038"), std::string::npos) << notes_[1];
}

TEST_F(ToolBuilder, ARollOfFacetsThatTurnsIsAWarning) {
  tool_.motion.rotation = RotationMotion{Vec3::Zero(), Vec3::UnitZ(), TimeFunction(1.0)};
  (void)gap();
  ASSERT_EQ(notes_.size(), 2U);
  EXPECT_EQ(notes_[1].find("warning: [faceted-roll] tool 'roll': its facets are off"), 0U)
      << notes_[1];
  stl().smooth = true;
  notes_.clear();
  (void)gap();
  for (const std::string& note : notes_)
    EXPECT_NE(note.find("warning"), 0U) << note;
}

TEST_F(ToolBuilder, ASmoothStlIsRoundAndTheLogSaysWhatWasGained) {
  stl().smooth = true;
  EXPECT_NEAR(gap(), 0.0, 1e-4);
  ASSERT_EQ(notes_.size(), 2U);
  EXPECT_NE(notes_[1].find("tool 'roll': smoothed below 30 degrees: 72 triangles curved, 68 flat"),
            std::string::npos)
      << notes_[1];
  EXPECT_NE(notes_[1].find("chord error 0.0381 before"), std::string::npos) << notes_[1];
}

TEST_F(ToolBuilder, FacetsThatTurnMoreThanTheFeatureAngleStay) {
  stl().smooth = true;
  stl().feature_angle = 5.0;
  EXPECT_NEAR(gap(), 0.038, 1e-3);
  ASSERT_EQ(notes_.size(), 2U);
  EXPECT_NE(notes_[1].find("nothing to smooth"), std::string::npos) << notes_[1];
}

TEST_F(ToolBuilder, APointsChainAndAProfileFileAreTurned) {
  const std::filesystem::path path = folder_.path() / "roll.toml";
  RevolutionSurface turned;
  turned.points = {{30, 10}, {-30, 10}};
  tool_.surface = turned;
  EXPECT_NEAR(gap(), 0.0, 1e-12);
  std::ofstream(path) << "start = [30, 9]\n[[segment]]\nto = [-30, 9]\n";
  turned.points.clear();
  turned.profile = InputFile{"roll.toml", path};
  tool_.surface = turned;
  EXPECT_NEAR(gap(), 1.0, 1e-12);
}

TEST_F(ToolBuilder, AFlippedProfileHasItsToolOnTheOtherSide) {
  const std::filesystem::path path = folder_.path() / "roll.toml";
  std::ofstream(path) << "start = [20, 30]\n[[segment]]\nto = [9, 19]\nradius = 11\n"
                         "[[segment]]\nto = [9, -30]\n";
  const auto gap_of = [&](const ToolSurface& surface) {
    tool_.surface = surface;
    const Vec3 x(10.0, 2.0, 0.0);
    const contact::Tool built = build_tool(tool_, Analysis::plane_strain, 10.0, notes_);
    geometry::Projection p;
    built.surface->project({&x, 1}, 5.0, {&p, 1});
    EXPECT_NE(built.facing.find("on the left of the direction"), std::string::npos);
    return p.gap;
  };
  EXPECT_NEAR(gap_of(ProfileSurface{{"roll.toml", path}}), -1.0, 1e-12);
  EXPECT_NEAR(gap_of(ProfileSurface{{"roll.toml", path}, true}), 1.0, 1e-12);
  const std::vector<Vec3> points{{9, 30, 0}, {9, -30, 0}};
  EXPECT_NEAR(gap_of(PointsSurface{points}), -1.0, 1e-12);
  EXPECT_NEAR(gap_of(PointsSurface{points, false, true}), 1.0, 1e-12);
  RevolutionSurface turned;
  turned.points = {{30, 9}, {-30, 9}};
  tool_.surface = turned;
  EXPECT_NEAR(gap(), 1.0, 1e-12);
  turned.flip = true;
  tool_.surface = turned;
  EXPECT_NEAR(gap(), -1.0, 1e-12);
}

TEST_F(ToolBuilder, AProfileBeyondTheAxisIsRefusedWithTheNameOfTheTool) {
  const std::filesystem::path path = folder_.path() / "roll.toml";
  std::ofstream(path) << "points = [[30, 9], [-30, -9]]\n";
  RevolutionSurface turned;
  turned.profile = InputFile{"roll.toml", path};
  tool_.surface = turned;
  try {
    (void)gap();
    ADD_FAILURE() << "nothing was wrong";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("tool 'roll': segment 1 of the profile is beyond the axis, at radius -9"),
              std::string::npos)
        << text;
  }
}

/// What a press that strikes is built to.
geometry::Blow blow_of(const PressMotion& motion) {
  Tool tool;
  tool.surface = PlaneSurface{};
  tool.motion.translation = motion;
  std::vector<std::string> notes;
  const contact::Tool built = build_tool(tool, Analysis::solid, 10.0, notes);
  EXPECT_EQ(built.motion.force->axis, Vec3(0, 0, -1));
  return built.motion.force->blow.value_or(geometry::Blow{});
}

TEST(PressBuilder, AHammerHasTheShareOfItsEnergyAtItsSpeed) {
  const geometry::Blow blow = blow_of(HammerMotion{{{0, 0, -2}, 0.8, {}}, 1.3, 5000.0});
  EXPECT_EQ(blow.speed, 5000.0);
  EXPECT_NEAR(blow.energy(), 0.8 * 0.5 * 1.3 * 25e6, 1e-12 * 13e6);
}

TEST(PressBuilder, AScrewPressHasTheEnergyOfItsFlywheelAndRam) {
  constexpr double inertia = 8e5, pitch = 300.0, spin = 20.0, mass = 4.0;
  const geometry::Blow blow =
      blow_of(ScrewMotion{{{0, 0, -2}, 0.7, {}}, inertia, pitch, spin, mass});
  EXPECT_NEAR(blow.speed, spin * pitch / (2.0 * std::numbers::pi), 1e-9);
  const double energy = 0.5 * inertia * spin * spin + 0.5 * mass * blow.speed * blow.speed;
  EXPECT_NEAR(blow.energy(), 0.7 * energy, 1e-9 * energy);
}

TEST(PressBuilder, ACrankIsInRadians) {
  Tool tool;
  tool.surface = PlaneSurface{};
  tool.motion.translation = PressMotion{CrankMotion{{0, 0, -2}, 80.0, 480.0, 2.0, 90.0}};
  std::vector<std::string> notes;
  const contact::Tool built = build_tool(tool, Analysis::solid, 10.0, notes);
  const double bottom = 0.25 * std::numbers::pi; // a quarter turn on
  EXPECT_NEAR(built.motion.crank->slide_speed(bottom), 0.0, 1e-9);
  // From a pin that stands aside to one at the bottom.
  const double way = 80.0 + 480.0 - std::sqrt(480.0 * 480.0 - 80.0 * 80.0);
  EXPECT_NEAR(built.motion.translation(bottom).z(), -way, 1e-9);
}

TEST_F(ToolBuilder, RefusesADirectionOfFrictionThatIsNormalToThePlane) {
  tool_.surface = PlaneSurface{Vec3::Zero(), Vec3(0, 0, 2)};
  tool_.friction.direction = Vec3(0, 0, -1);
  EXPECT_THROW((void)build_tool(tool_, Analysis::solid, 10.0, notes_), Error);
  tool_.friction.direction = Vec3(0, 1, -1);
  EXPECT_NO_THROW((void)build_tool(tool_, Analysis::solid, 10.0, notes_));
}

} // namespace
} // namespace billet::io::tool_builder_test
