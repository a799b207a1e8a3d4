#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/io/stl_zoo.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace billet::io::stl_report_test {
namespace {

class StlReport : public testing::Test {
protected:
  [[nodiscard]] FacetFile file(const geometry::TriangleMesh& mesh) const {
    return read_stl(temporary_.file("die.stl", binary_stl(mesh)));
  }

  // The value of a row of the table.
  static std::string row(const std::vector<ReportRow>& rows, const std::string& name) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const ReportRow& r) { return r.name == name; });
    return found == rows.end() ? "no such row" : found->value;
  }

  test::TemporaryFolder temporary_;
};

TEST_F(StlReport, TheTableSaysWhatASoundSurfaceIsLike) {
  const FacetFile cube = file(geometry::cube());
  const std::vector<ReportRow> rows = table(cube, examine(cube, {}));
  EXPECT_EQ(row(rows, "facets in the file"), "12");
  EXPECT_EQ(row(rows, "box"), "(0, 0, 0) to (1, 1, 1)");
  EXPECT_EQ(row(rows, "surface"), "closed, volume 1");
  EXPECT_EQ(row(rows, "feature edges"), "12");
  EXPECT_EQ(row(rows, "repairs"), "none");
  EXPECT_EQ(row(rows, "needles"), "0, worst aspect ratio 2");
}

TEST_F(StlReport, TheTableIsThereForASurfaceThatIsRefused) {
  geometry::TriangleMesh mesh = geometry::cube();
  mesh.points.emplace_back(0.5, -1.0, -1.0);
  mesh.triangles.push_back({0, 1, 8});
  const FacetFile fin = file(mesh);
  const StlTool tool = examine(fin, {});
  EXPECT_EQ(tool.complaints.size(), 1U);
  EXPECT_EQ(row(table(fin, tool), "edges of three and more"), "1, the first at (0.5, 0, 0)");
}

TEST_F(StlReport, EachPartOfSeveralHasItsRow) {
  const FacetFile two = file(together(geometry::cube(), moved(geometry::cube(), {3, 0, 0})));
  const std::vector<ReportRow> rows = table(two, examine(two, {}));
  EXPECT_EQ(row(rows, "part 2"), "12 triangles at (3, 0, 0), volume 1");
}

TEST_F(StlReport, TheFeatureAngleDecidesWhatIsAFeature) {
  const FacetFile ball = file(geometry::sphere_mesh(12));
  EXPECT_EQ(examine(ball, {}).health.feature_edges, 0);
  EXPECT_GT(examine(ball, {1.0, false, 5.0}).health.feature_edges, 100);
}

TEST(SizeWarning, NamesTheUnitTheFileIsLikelyToBeIn) {
  EXPECT_FALSE(size_warning(100.0, 10.0, "mm").has_value());
  EXPECT_FALSE(size_warning(100.0, 5.1, "mm").has_value());
  EXPECT_FALSE(size_warning(1.0, 19.0, "mm").has_value());
  EXPECT_FALSE(size_warning(900.0, 1.0, "mm").has_value())
      << "a roll, and no larger unit is likely";
  EXPECT_NE(size_warning(0.016, 5.0, "mm").value_or("").find("is the file in m instead of mm?"),
            std::string::npos)
      << "a die as large as the workpiece, and a little more";
  const std::string metres = size_warning(0.09, 100.0, "mm").value_or("");
  EXPECT_NE(metres.find("1.11e+03 times smaller"), std::string::npos) << metres;
  EXPECT_NE(metres.find("is the file in m instead of mm?"), std::string::npos) << metres;
  const std::string inches = size_warning(20.0 / 25.4, 20.0, "mm").value_or("");
  EXPECT_NE(inches.find("25.4 times smaller"), std::string::npos) << inches;
  EXPECT_NE(inches.find("is the file in in instead of mm?"), std::string::npos) << inches;
  const std::string no_inches = size_warning(20.0 * 25.4, 20.0, "in").value_or("");
  EXPECT_NE(no_inches.find("is the file in mm instead of in?"), std::string::npos) << no_inches;
  const std::string millimetres = size_warning(2e5, 100.0, "m").value_or("");
  EXPECT_NE(millimetres.find("is the file in mm instead of m?"), std::string::npos) << millimetres;
}

} // namespace
} // namespace billet::io::stl_report_test
