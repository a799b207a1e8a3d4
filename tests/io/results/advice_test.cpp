// The advice for a run that stopped: a line for each cause, with its remedy.

#include "io/case/read_case.h"
#include "io/results/advice.h"
#include "io/scene/scene_builder.h"
#include "tests/support/case_texts.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace billet::io::advice_test {
namespace {

using test::edited;
using test::Edits;

/// An ASCII STL of a dome of radius 20 whose lowest point is (0, 0, z), in flat facets.
std::string dome_stl(double z) {
  constexpr int rings = 4, sectors = 16;
  constexpr double radius = 20.0, width = 3.0;
  const auto vertex = [&](int ring, int sector) {
    const double r = width * ring, turn = 2.0 * std::numbers::pi * sector / sectors;
    return std::array{r * std::cos(turn), r * std::sin(turn),
                      z + radius - std::sqrt(radius * radius - r * r)};
  };
  std::string text = "solid dome\n";
  const auto facet = [&](const auto&... corners) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto& [x, y, height] : {corners...})
      text += "   vertex " + std::to_string(x) + " " + std::to_string(y) + " " +
              std::to_string(height) + "\n";
    text += "  endloop\n endfacet\n";
  };
  for (int i = 0; i < sectors; ++i)
    for (int ring = 0; ring < rings; ++ring) {
      facet(vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i));
      if (ring > 0)
        facet(vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1));
    }
  return text + "endsolid dome\n";
}

/// A quarter of a cylinder under a dome.
class Advice : public testing::Test {
protected:
  [[nodiscard]] std::string all(const process::PostMortem& post, const Edits& edits = {}) const {
    static_cast<void>(folder_.file("punch.stl", dome_stl(15.0)));
    static_cast<void>(folder_.file("die.stl", test::square_stl(20.0, 0.0, true)));
    const Case content =
        read_case(folder_.file("case.toml", edited(test::upsetting_3d, edits)), {}, {});
    const process::Process process(build_scene(content, "case.toml").scene);
    std::string text;
    for (const std::string& line : advice(content, process, post))
      text += line + "\n";
    return text;
  }
  static bool has(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Advice, FacetsBetweenWhichPointsGoToAndFroAreToBeSmoothed) {
  process::PostMortem post;
  post.chattering = {{0, Vec3::Zero(), 12}};
  const std::string flat = all(post);
  EXPECT_TRUE(has(flat, "between the facets of tool punch")) << flat;
  EXPECT_TRUE(has(flat, "smooth = true")) << flat;
  EXPECT_TRUE(has(flat, "less friction")) << flat;
  const std::string smooth =
      all(post, {{R"(stl = "punch.stl",)", R"(stl = "punch.stl", smooth = true,)"}});
  EXPECT_FALSE(has(smooth, "smooth = true")) << smooth;
  post.chattering = {{1, Vec3::Zero(), 12}}; // a flat one
  EXPECT_FALSE(has(all(post), "smooth = true"));
}

TEST_F(Advice, ElementsInsideOutWantANewMesh) {
  process::PostMortem post;
  post.inside_out = true;
  EXPECT_TRUE(has(all(post), "a [remesh] section replaces the mesh in time"));
  post.inside_out = false;
  post.too_deep = true;
  EXPECT_TRUE(has(all(post), "smaller elements there follow the tool"));
}

TEST_F(Advice, LoadsThatNothingAnswersAreNamed) {
  process::PostMortem post;
  post.drives = {{0, false, 500.0, 0.0, process::DriveState::Contact::pulls_off}};
  EXPECT_TRUE(has(all(post), "takes tool punch away from the part"));
  post.drives = {{0, true, 500.0, 0.0, process::DriveState::Contact::presses}};
  EXPECT_TRUE(has(all(post), "a prescribed rotation in its place goes on beyond"));
  post.drives = {{0, false, 500.0, 500.0, process::DriveState::Contact::presses}};
  EXPECT_TRUE(has(all(post), "tool punch is under a force of 500 there"));
  EXPECT_TRUE(has(all(post), "the most that the part bears"));
}

TEST_F(Advice, APressureBeyondAllStrengthIsNamed) {
  process::PostMortem post;
  post.time = 0.05;
  const auto pressed_by = [&](const std::string& pressure) {
    return all(post, {{"[time]", "[[load]]\nwhere = \"set:side\"\npressure = [[0, 0], [0.1, " +
                                     pressure + "]]\n\n[time]"}});
  };
  EXPECT_TRUE(has(pressed_by("1e9"), "a pressure of 5e+08 acts there")) << pressed_by("1e9");
  EXPECT_TRUE(has(pressed_by("1e9"), "check its unit"));
  EXPECT_FALSE(has(pressed_by("100"), "check its unit"));
}

TEST_F(Advice, SomethingIsAlwaysSaid) {
  const std::string text = all({});
  EXPECT_TRUE(has(text, "a finer mesh there, a [remesh] section")) << text;
  EXPECT_FALSE(has(text, "smooth"));
  process::PostMortem post;
  post.dt = 0.06;
  EXPECT_TRUE(has(all(post, {{"first = 0.05, max = 0.05", "min = 0.05"}}),
                  "time.increments.min = 0.05 allows none shorter"));
}

} // namespace
} // namespace billet::io::advice_test
