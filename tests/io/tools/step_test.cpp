// STEP files of known volume, written by OpenCASCADE 7.6; a build without its reader refuses them.

#include "geometry/rigid_surface.h"
#include "io/tools/step.h"
#include "io/tools/stl_tool.h"
#include "io/tools/tool_builder.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>

namespace billet::io::step_test {
namespace {

std::filesystem::path step(const std::string& name) {
  return std::filesystem::path(BILLET_SOURCE_DIR) / "tests/io/step" / name;
}

std::string complaint(const std::filesystem::path& path) {
  try {
    (void)read_step(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

class StepReader : public testing::Test {
protected:
  void SetUp() override {
    if (!reads_step())
      GTEST_SKIP() << "built without BILLET_STEP";
  }
};

TEST(StepFile, IsRefusedWithARemedyWhereItCannotBeRead) {
  if (reads_step())
    GTEST_SKIP() << "built with BILLET_STEP";
  const std::string text = complaint(step("grooved-die-mm.step"));
  EXPECT_NE(text.find("this build does not read STEP files"), std::string::npos) << text;
  EXPECT_NE(text.find("./dev build --step"), std::string::npos) << text;
}

/// What a file holds, by integrals over its exact surfaces.
struct Exact {
  std::string file;
  double volume; ///< [mm^3]
  double area;   ///< [mm^2]
  std::size_t parts;
  Vec3 size; ///< of its box [mm]
};

TEST_F(StepReader, CutsEveryFaceIntoTrianglesWhateverTheUnit) {
  // A die with a groove and rounded edges, a ball in inches, a cylinder and a torus in metres.
  const double pi = std::numbers::pi;
  for (const Exact& exact :
       {Exact{"grooved-die-mm.step", 22147.0586359, 5174.20112883, 1, {40, 20, 30}},
        Exact{"ball-inch.step", 4.0 / 3.0 * pi * std::pow(25.4, 3), 4.0 * pi * 25.4 * 25.4, 1,
              Vec3::Constant(50.8)},
        Exact{"two-bodies-m.step",
              5e5 * pi + 2.0 * pi * pi * 100.0 * 400.0,
              2e4 * pi + 1e4 * pi + 4.0 * pi * pi * 100.0 * 20.0,
              2,
              {240, 70, 720}}}) {
    SCOPED_TRACE(exact.file);
    const FacetFile file = read_step(step(exact.file));
    const StlTool tool = tool_mesh(file, {});
    EXPECT_EQ(file.format, FacetFormat::step);
    EXPECT_TRUE(tool.health.closed());
    ASSERT_EQ(tool.parts.list.size(), exact.parts);
    double volume = 0.0;
    for (const geometry::MeshPart& part : tool.parts.list)
      volume += part.volume;
    std::printf("%-20s %6zu facets, volume %+.3f %%, area %+.3f %%\n", exact.file.c_str(),
                file.facets.size(), 100.0 * (volume / exact.volume - 1.0),
                100.0 * (tool.health.area / exact.area - 1.0));
    EXPECT_NEAR(volume, exact.volume, 5e-3 * exact.volume);
    EXPECT_NEAR(tool.health.area, exact.area, 3e-3 * exact.area);
    const Vec3 size = tool.health.bounds.high - tool.health.bounds.low;
    EXPECT_LT((size - exact.size).norm(), 1e-3 * exact.size.norm()) << size.transpose();
  }
}

TEST_F(StepReader, KeepsTheChordErrorAskedFor) {
  double before = 1.0;
  for (const double asked : {0.02, 0.006}) {
    double most = 0.0;
    for (const auto& facet : read_step(step("ball-inch.step"), asked).facets) {
      const Vec3 middle = (facet[0] + facet[1] + facet[2]) / 3.0;
      most = std::max({most, 25.4 - middle.norm(), std::abs(facet[0].norm() - 25.4)});
    }
    std::printf("ball of 25.4 mm: %.5f mm off, %.5f asked\n", most, asked);
    EXPECT_LT(most, asked);
    EXPECT_LT(most, before);
    before = most;
  }
}

TEST_F(StepReader, TakesASheetThatIsOpenAndKnowsItsFront) {
  const StlTool tool = tool_mesh(read_step(step("sheet-mm.step")), {});
  EXPECT_FALSE(tool.health.closed());
  EXPECT_NEAR(tool.health.area, 600.0 * std::numbers::pi, 1.0);
}

TEST_F(StepReader, ServesAsATool) {
  Tool tool;
  tool.name = "ball";
  StepSurface surface;
  surface.file.path = step("ball-inch.step");
  std::vector<std::string> notes;
  const auto gap_at = [&](const Vec3& x) {
    tool.surface = surface;
    const contact::Tool built = build_tool(tool, Analysis::solid, 10.0, notes);
    geometry::Projection p;
    built.surface->project({&x, 1}, 100.0, {&p, 1});
    return p.gap;
  };
  const Vec3 outside = 26.4 * Vec3(0.6, 0.48, 0.64);
  const double smooth = gap_at(outside);
  surface.smooth = false;
  surface.chord_error = 0.05;
  const double raw = gap_at(outside);
  std::printf("gap of 1 mm: smooth %.6f, facets %.6f\n", smooth, raw);
  EXPECT_NEAR(smooth, 1.0, 1e-3);
  EXPECT_GT(raw, 1.0);
  EXPECT_LT(raw, 1.08);
  surface.unit_factor = 1e-3; // a case in metres
  surface.chord_error = 5e-5;
  EXPECT_NEAR(gap_at(1e-3 * outside), 1e-3 * raw, 1e-9);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("(STEP)"), std::string::npos) << notes[0];
}

TEST_F(StepReader, KeepsTheFacetsOfARoundPartManyButNotTooMany) {
  // A slip of the unit must not make a ball of 26 facets, nor one that fills the memory.
  const std::size_t coarse = read_step(step("ball-inch.step"), 1e9).facets.size();
  std::printf("chord error 1e9 mm: %zu facets\n", coarse);
  EXPECT_GT(coarse, 4000U);
  try {
    (void)read_step(step("ball-inch.step"), 1e-4);
    FAIL() << "a ball of 50 mm";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("too many facets"), std::string::npos) << what;
    EXPECT_NE(what.find("ask for 0.0009 mm or more"), std::string::npos) << what;
  }
}

TEST_F(StepReader, RefusesWhatIsNoSurfaceAndSaysWhy) {
  const test::TemporaryFolder folder;
  EXPECT_NE(complaint(folder.path() / "none.step").find("cannot be read"), std::string::npos);
  EXPECT_NE(complaint(folder.file("a.step", "")).find("is not a STEP file"), std::string::npos);
  EXPECT_NE(complaint(folder.file("b.step", "solid die\n")).find("is not a STEP file"),
            std::string::npos);
  EXPECT_NE(complaint(step("edge-mm.step")).find("holds no face"), std::string::npos)
      << complaint(step("edge-mm.step"));
  const std::string whole = test::content_of(step("ball-inch.step"));
  for (const std::size_t percent : {20U, 50U, 90U, 99U})
    EXPECT_NE(complaint(folder.file("c.step", whole.substr(0, percent * whole.size() / 100)))
                  .find("has been cut short"),
              std::string::npos);
}

TEST_F(StepReader, LooksForMissingEntitiesOutsideOfCommentsAndTexts) {
  const test::TemporaryFolder folder;
  const std::string whole = test::content_of(step("ball-inch.step"));
  const std::size_t data = whole.find("DATA;") + 5, name = whole.find("Open CASCADE Model");
  const auto with = [&](std::size_t at, const std::string& text) {
    std::string changed = whole;
    return complaint(folder.file("e.step", changed.insert(at, text)));
  };
  EXPECT_EQ(with(data, "\n/* the part's #98765, (c) */\n"), "none");
  EXPECT_EQ(with(name, "#98765; "), "none");
  EXPECT_NE(with(data, "\n#900=PRODUCT_CONTEXT('',#98765,'');\n").find("refers to #98765"),
            std::string::npos);
}

TEST_F(StepReader, SurvivesLinesThatAreMissing) {
  // Refused or read, but never a crash: every line of a file left out in turn.
  const test::TemporaryFolder folder;
  const std::string whole = test::content_of(step("ball-inch.step"));
  int refused = 0, lines = 0;
  for (std::size_t at = 0; at < whole.size(); ++lines) {
    const std::size_t end = std::min(whole.find('\n', at), whole.size() - 1) + 1;
    refused += complaint(folder.file("d.step", whole.substr(0, at) + whole.substr(end))) != "none";
    at = end;
  }
  std::printf("%d lines, %d of them needed\n", lines, refused);
  EXPECT_GT(refused, 5);
  EXPECT_LT(refused, lines);
}

} // namespace
} // namespace billet::io::step_test
