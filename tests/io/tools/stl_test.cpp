#include "geometry/base/error.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "io/tools/stl_tool.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace billet::io::stl_test {
namespace {

using geometry::TriangleMesh;

class Stl : public testing::Test {
protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    std::filesystem::path path = folder_ / "die.stl";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  // The complaint of the reader, and its place after the folder's name.
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      (void)tool_mesh(read_stl(write(text)), {});
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::geometry);
      EXPECT_TRUE(error.complaints().at(0).place.starts_with((folder_ / "die.stl").string()));
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    ADD_FAILURE() << "nothing was wrong";
    return "";
  }

  test::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

std::string ascii(const TriangleMesh& mesh, const std::string& name, const std::string& eol) {
  std::string text = "solid " + name + eol;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "  facet normal 0 0 0" + eol + "    outer loop" + eol;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = geometry::corner(mesh, t, i);
      text += "      vertex " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " " +
              std::to_string(x.z()) + eol;
    }
    text += "    endloop" + eol + "  endfacet" + eol;
  }
  return text + "endsolid " + name + eol;
}

std::string binary(const TriangleMesh& mesh, const std::string& header) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "die.stl";
  write_stl(path, mesh, header);
  return test::content_of(path);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

void expect_cube(const StlTool& stl, double edge = 1.0) {
  EXPECT_EQ(stl.mesh.points.size(), 8U);
  EXPECT_EQ(stl.mesh.triangles.size(), 12U);
  EXPECT_TRUE(stl.health.closed());
  EXPECT_NEAR(stl.health.volume, edge * edge * edge, 1e-12 * edge * edge * edge);
}

TEST_F(Stl, ABinaryFileComesBackAsItWasWritten) {
  const std::filesystem::path path = folder_ / "cube.stl";
  write_stl(path, geometry::cube(), "a cube");
  const FacetFile file = read_stl(path);
  EXPECT_EQ(file.format, FacetFormat::binary_stl);
  EXPECT_EQ(file.solids, std::vector<std::string>{"a cube"});
  EXPECT_EQ(file.opposed_normals, 0);
  const StlTool stl = tool_mesh(file, {});
  expect_cube(stl);
  EXPECT_EQ(stl.repairs.clean_up.welded_points, 28);
  EXPECT_NO_THROW((void)geometry::make_triangle_surface(stl.mesh));
}

TEST_F(Stl, ABinaryFileMayStartWithTheWordSolid) {
  const FacetFile file = read_stl(write(binary(geometry::cube(), "solid made by a scanner")));
  EXPECT_EQ(file.format, FacetFormat::binary_stl);
  expect_cube(tool_mesh(file, {}));
}

TEST_F(Stl, AsciiMayBeUpperCaseAndHaveAnyLineEnding) {
  for (const std::string eol : {"\n", "\r\n"}) {
    const std::string text = ascii(geometry::cube(), "Cube No 1", eol);
    for (const std::string& variant : {text, upper(text), "\xEF\xBB\xBF" + text, "\n  " + text}) {
      const FacetFile file = read_stl(write(variant));
      EXPECT_EQ(file.format, FacetFormat::ascii_stl);
      EXPECT_EQ(upper(file.solids.at(0)), "CUBE NO 1");
      expect_cube(tool_mesh(file, {}));
    }
  }
}

TEST_F(Stl, SeveralSolidsMakeOneSurface) {
  TriangleMesh other = geometry::cube();
  for (Vec3& x : other.points)
    x += Vec3(3, 0, 0);
  const std::string text = ascii(geometry::cube(), "", "\n") + ascii(other, "second", "\n");
  const FacetFile file = read_stl(write(text));
  EXPECT_EQ(file.solids, (std::vector<std::string>{"", "second"}));
  const StlTool stl = tool_mesh(file, {});
  EXPECT_EQ(stl.health.components, 2);
  EXPECT_TRUE(contains(report(file, stl), "2 parts"));
}

TEST_F(Stl, UnitsAreScaledAndFlipTurnsTheSurfaceInsideOut) {
  const FacetFile file = read_stl(write(binary(geometry::cube(), "")));
  expect_cube(tool_mesh(file, {25.4}), 25.4);
  const StlTool flipped = tool_mesh(file, {1.0, true});
  EXPECT_TRUE(flipped.health.inside_out());
  EXPECT_TRUE(contains(report(file, flipped), "inside out"));
}

TEST_F(Stl, DegenerateFacetsAreDroppedAndReported) {
  TriangleMesh mesh = geometry::cube();
  mesh.triangles.push_back({0, 0, 1});
  const FacetFile file = read_stl(write(binary(mesh, "")));
  const StlTool stl = tool_mesh(file, {});
  expect_cube(stl);
  EXPECT_EQ(stl.repairs.clean_up.degenerate_triangles, 1);
  EXPECT_TRUE(contains(report(file, stl), "repaired: 1 degenerate"));
}

TEST_F(Stl, AnOpenSurfaceIsLegalAndSaidSo) {
  const auto flat = [](double, double) { return 0.0; };
  const FacetFile file = read_stl(write(binary(geometry::sheet(3, flat), "")));
  const StlTool stl = tool_mesh(file, {});
  EXPECT_TRUE(contains(report(file, stl), "open, 12 border edges in 1 loop"));
}

TEST_F(Stl, StatedNormalsAgainstTheCornersAreCounted) {
  std::string text = ascii(geometry::cube(), "", "\n");
  text.replace(text.find("normal 0 0 0"), 12, "normal 0 0 9"); // the first facet faces down
  EXPECT_EQ(read_stl(write(text)).opposed_normals, 1);
  text.replace(text.find("normal 0 0 9"), 12, "normal nan x");
  EXPECT_EQ(read_stl(write(text)).opposed_normals, 0);
}

TEST_F(Stl, MissingAndEmptyFilesAreRefused) {
  EXPECT_THROW((void)read_stl(folder_ / "none.stl"), Error);
  EXPECT_THROW((void)read_stl(folder_), Error);
  EXPECT_TRUE(contains(complaint(""), "empty"));
  EXPECT_TRUE(contains(complaint("solid nothing\nendsolid nothing\n"), "no facets"));
  EXPECT_TRUE(contains(complaint("hello"), "neither"));
}

TEST_F(Stl, TruncatedBinaryFilesAreRefusedWithTheCounts) {
  const std::string whole = binary(geometry::cube(), "");
  const std::string what = complaint(whole.substr(0, whole.size() - 60));
  EXPECT_TRUE(contains(what, "12 facets")) << what;
  EXPECT_TRUE(contains(what, "truncated")) << what;
  EXPECT_TRUE(contains(complaint(whole + "xx"), "12 facets"));
  const std::string short_by_one = whole.substr(0, whole.size() - 50);
  EXPECT_TRUE(contains(complaint(short_by_one), "12 facets"));
  const std::string solid = binary(geometry::cube(), "solid but binary");
  EXPECT_TRUE(contains(complaint(solid.substr(0, 500)), "12 facets"));
}

TEST_F(Stl, AWrongCountOrAMissingEndIsForgivenIfTheSurfaceIsClosed) {
  std::string wrong = binary(geometry::cube(), "");
  std::string endless = ascii(geometry::cube(), "c", "\n");
  wrong[80] = 13;
  endless.resize(endless.find("endsolid"));
  for (const std::string& text : {wrong, endless}) {
    const FacetFile file = read_stl(write(text));
    EXPECT_EQ(file.doubts.size(), 1U);
    const StlTool stl = tool_mesh(file, {});
    expect_cube(stl);
    EXPECT_TRUE(contains(report(file, stl), "nothing is missing"));
  }
}

TEST_F(Stl, NumbersThatAreNotFiniteAreRefusedWithTheirPlace) {
  std::string bytes = binary(geometry::cube(), "");
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 84 + 2 * 50 + 12 + 4, &infinite, sizeof infinite);
  EXPECT_TRUE(contains(complaint(bytes), "corner 1 of facet 3"));
  for (const std::string bad : {"nan", "inf", "1e999", "1.0x", "one"}) {
    std::string text = ascii(geometry::cube(), "c", "\n");
    text.replace(text.find("vertex ") + 7, 8, bad);
    const std::string what = complaint(text);
    EXPECT_TRUE(contains(what, "die.stl:4: found '" + bad)) << what;
  }
}

TEST_F(Stl, BrokenAsciiIsRefusedWithItsLine) {
  const std::string text = ascii(geometry::cube(), "c", "\n");
  EXPECT_TRUE(contains(complaint(text.substr(0, text.rfind("  facet"))),
                       "ends within solid 'c', after facet 11"));
  EXPECT_TRUE(contains(complaint(text.substr(0, 150)), "expected"));
  std::string four = text;
  four.insert(four.find("    endloop"), "vertex 0 0 0\n");
  EXPECT_TRUE(contains(complaint(four), "die.stl:7: found 'vertex' where 'endloop'"));
  std::string tail = text + "rubbish\n";
  EXPECT_TRUE(contains(complaint(tail), "found 'rubbish' where 'solid'"));
}

TEST_F(Stl, DamagedSurfacesAreRefusedWithCoordinates) {
  TriangleMesh torn = geometry::sheet(1, [](double, double) { return 0.0; });
  std::swap(torn.triangles[1][0], torn.triangles[1][1]);
  EXPECT_TRUE(contains(complaint(binary(torn, "")), "face opposite ways, the first at ("));
  TriangleMesh fin = geometry::cube();
  fin.points.emplace_back(0.5, -1.0, -1.0);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_TRUE(contains(complaint(binary(fin, "")), "more than two triangles"));
}

TEST_F(Stl, AnyDamageEndsInAnErrorOrASoundSurface) {
  const std::string text = ascii(geometry::cube(), "c", "\n"), bytes = binary(geometry::cube(), "");
  std::mt19937 generator(11);
  for (int trial = 0; trial < 600; ++trial) {
    std::string damaged = trial % 2 == 0 ? text : bytes;
    for (int i = 0; i < 3; ++i)
      damaged[generator() % damaged.size()] = static_cast<char>(generator() % 256);
    damaged.resize(damaged.size() - (trial % 3 == 0 ? generator() % damaged.size() : 0));
    try {
      const StlTool stl = tool_mesh(read_stl(write(damaged)), {});
      EXPECT_TRUE(stl.health.bounds.low.allFinite());
      EXPECT_NO_THROW((void)geometry::make_triangle_surface(stl.mesh));
    } catch (const Error& error) {
      EXPECT_FALSE(error.complaints().empty());
    }
  }
}

TEST_F(Stl, AFileThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_stl(folder_ / "no" / "die.stl", geometry::cube()), Error);
}

} // namespace
} // namespace billet::io::stl_test
