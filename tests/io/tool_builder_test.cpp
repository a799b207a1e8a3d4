#include "geometry/triangle_mesh.h"
#include "io/stl.h"
#include "io/tool_builder.h"
#include "tests/geometry/round_meshes.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {
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
  EXPECT_EQ(notes_.size(), 1U);
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

} // namespace
} // namespace billet::io
