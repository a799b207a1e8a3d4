// Triangles and tetrahedra from case file to results: cut from boxes and cylinders, and meshed by
// the program from an outline and from an STL.

#include "tests/app/tables.h"
#include "tests/geometry/studded_block.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

namespace billet::test::meshed_domains_test {

namespace {

const std::string box_mesh = "mesh     = { box = [[0, 0], [5, 7.5]], cells = [2, 3] }";

/// Half a specimen with a rounded edge.
const std::string rounded = R"(closed = true
start = [0, 0]
[[segment]]
to = [5, 0]
[[segment]]
to = [5, 6.5]
[[segment]]
to = [4, 7.5]
radius = 1
[[segment]]
to = [0, 7.5]
)";

std::string outlined() {
  return edited(upsetting, {{"\"quad8\"", "\"tri6\""},
                            {box_mesh, "mesh     = { outline = \"part.toml\", size = 1.5 }"},
                            {"where = \"y = 0\"", "where = \"set:segment-1\""}});
}

/// A strip that no triangles of that size fit into.
const std::string sliver = R"(closed = true
start = [0, 0]
[[segment]]
to = [5, 0]
[[segment]]
to = [5, 1e-6]
[[segment]]
to = [0, 1e-6]
)";

/// A cube from 0 to 5 by 5 by 15 as ASCII STL.
std::string block_stl() {
  const std::array<std::array<int, 3>, 12> triangles{{{0, 2, 1},
                                                      {1, 2, 3},
                                                      {4, 5, 6},
                                                      {5, 7, 6},
                                                      {0, 1, 4},
                                                      {1, 5, 4},
                                                      {2, 6, 3},
                                                      {3, 6, 7},
                                                      {0, 4, 2},
                                                      {2, 4, 6},
                                                      {1, 3, 5},
                                                      {3, 7, 5}}};
  std::string text = "solid block\n";
  for (const auto& triangle : triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int corner : triangle)
      text += "   vertex " + std::to_string(corner % 2 * 5) + " " +
              std::to_string(corner / 2 % 2 * 5) + " " + std::to_string(corner / 4 * 15) + "\n";
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid block\n";
}

/// A surface as ASCII STL, moved.
std::string stl_text(const geometry::TriangleMesh& mesh, const Vec3& by = Vec3::Zero()) {
  std::string text = "solid part\n";
  for (const auto& triangle : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const std::int32_t corner : triangle) {
      const Vec3 x = mesh.points[static_cast<std::size_t>(corner)] + by;
      text += "   vertex " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " +
              std::to_string(x[2]) + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid part\n";
}

/// Upsetting of an STL body.
std::string with_body(const std::string& keys) {
  return edited(
      upsetting_3d,
      {{"\"hex8\"", "\"tet10\""},
       {"mesh     = { cylinder = { radius = 5, height = 15 }, cells = [2, 3], sector = 90 }",
        "mesh     = { stl = \"body.stl\", unit = \"mm\", " + keys + " }"}});
}

class MeshedDomains : public testing::Test {
protected:
  void SetUp() override {
    write_text(folder_.path() / "part.toml", rounded);
    write_text(folder_.path() / "block.stl", block_stl());
    write_text(folder_.path() / "punch.stl", square_stl(20, 15, false));
    write_text(folder_.path() / "die.stl", square_stl(20, 0, true));
  }
  [[nodiscard]] Outcome run(const std::string& text, const std::vector<std::string>& more) const {
    write_text(folder_.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml"};
    words.insert(words.end(), more.begin(), more.end());
    return billet(words, folder_.path());
  }
  [[nodiscard]] Outcome check(const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    return billet({"check", "case.toml"}, folder_.path());
  }
  /// The first frame of the workpiece.
  [[nodiscard]] std::string first_frame(const std::string& results) const {
    std::vector<std::filesystem::path> frames;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_.path() / results))
      if (entry.path().extension() == ".vtu")
        frames.push_back(entry.path());
    EXPECT_FALSE(frames.empty());
    return whole_file(*std::min_element(frames.begin(), frames.end()));
  }

  TemporaryFolder folder_;
};

TEST_F(MeshedDomains, ACaseRunsOnTrianglesAndTetrahedra) {
  for (const auto& [text, element] : {std::pair{upsetting, "tri6"}, {upsetting_3d, "tet10"}}) {
    const std::string set = std::string("workpiece.element=\"") + element + "\"";
    const Outcome outcome = run(text, {"--quiet", "-o", element, "--set", set});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(first_frame(element).empty());
  }
}

TEST_F(MeshedDomains, AnOutlineIsMeshedAndItsSegmentsHoldIt) {
  const Outcome outcome = run(outlined(), {"-o", "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("part.toml: meshed with") || outcome.says("part.toml: meshed with"));
  const Outcome looked = check(outlined());
  EXPECT_EQ(looked.status, 0) << looked.err;
  EXPECT_TRUE(looked.prints("tri6 elements"));
}

TEST_F(MeshedDomains, AnOutlineGivesTheSameMeshInEveryRun) {
  EXPECT_EQ(run(outlined(), {"--quiet", "-o", "first"}).status, 0);
  EXPECT_EQ(run(outlined(), {"--quiet", "-o", "second"}).status, 0);
  EXPECT_EQ(first_frame("first"), first_frame("second"));
}

TEST_F(MeshedDomains, ABodyIsMeshedTheSameInEveryRun) {
  const std::string text =
      edited(upsetting_3d,
             {{"\"hex8\"", "\"tet10\""},
              {"mesh     = { cylinder = { radius = 5, height = 15 }, cells = [2, 3], sector = 90 }",
               "mesh     = { stl = \"block.stl\", size = 4, unit = \"mm\" }"}});
  const Outcome looked = check(text);
  EXPECT_EQ(looked.status, 0) << looked.err;
  EXPECT_TRUE(looked.prints("block.stl: meshed with") || looked.says("block.stl: meshed with"));
  EXPECT_EQ(run(text, {"--quiet", "-o", "first"}).status, 0);
  EXPECT_EQ(run(text, {"--quiet", "-o", "second"}).status, 0);
  EXPECT_EQ(first_frame("first"), first_frame("second"));
}

TEST_F(MeshedDomains, MeshingInSpaceIsEstimatedWithTheReason) {
  write_text(folder_.path() / "body.stl", stl_text(geometry::studded_block(1, 0.3)));
  const Outcome looked = check(with_body("size = 5"));
  EXPECT_EQ(looked.status, 0) << looked.err;
  EXPECT_TRUE(looked.prints("body.stl: meshing in space, about ")) << looked.out;
  EXPECT_TRUE(looked.prints("for the volume alone; ")) << looked.out;
  EXPECT_TRUE(looked.prints("sharp edges that are only 0.3 apart, the closest at (")) << looked.out;
  const Outcome coarse = check(with_body("size = 5, details = 0.5"));
  EXPECT_EQ(coarse.status, 0) << coarse.err;
  EXPECT_TRUE(coarse.prints("details below 0.5 passed over")) << coarse.out;
  const Outcome ran =
      run(with_body("size = 5, details = 0.5"), {"-o", "out", "--set", "time.end=0.05"});
  EXPECT_TRUE(ran.says("body.stl: meshing in space, about ")) << ran.err;
  EXPECT_NE(whole_file(folder_.path() / "out" / "case.resolved.toml").find("details = 0.5"),
            std::string::npos);
}

TEST_F(MeshedDomains, BodiesThatCannotBeMeshedInTimeAreRefusedAtOnce) {
  write_text(folder_.path() / "body.stl", stl_text(geometry::studded_block(32, 0.2)));
  const Outcome fine = check(with_body("size = 5"));
  EXPECT_EQ(fine.status, 7); // a limit
  EXPECT_TRUE(fine.prints("body.stl: meshing in space, about ")) << fine.out;
  EXPECT_TRUE(fine.says("body.stl: tetrahedra of size 5 would be about ")) << fine.err;
  EXPECT_TRUE(fine.says("pass over small shapes with details")) << fine.err;

  const Outcome wrong = check(with_body("size = 5, details = 6"));
  EXPECT_EQ(wrong.status, 3); // the case file
  EXPECT_TRUE(wrong.says("details = 6 is more than size = 5")) << wrong.err;
}

TEST_F(MeshedDomains, SeveralBodiesInOneFileAreRefusedWithTheirBoxes) {
  write_text(folder_.path() / "body.stl",
             stl_text(geometry::studded_block(1, 0.3)) +
                 stl_text(geometry::studded_block(1, 0.3), Vec3(30, 0, 0)));
  const Outcome looked = check(with_body("size = 5"));
  EXPECT_EQ(looked.status, 4); // geometry
  EXPECT_TRUE(looked.says("body.stl: the file holds 2 bodies, in the boxes (0, 0, 0) to "
                          "(20, 20, 6.3); (30, 0, 0) to (50, 20, 6.3)"))
      << looked.err;
}

TEST_F(MeshedDomains, WhatCannotBeMeshedIsSaidWithFileAndRemedy) {
  const Outcome element = check(edited(outlined(), {{"\"tri6\"", "\"quad8\""}}));
  EXPECT_EQ(element.status, 3); // the case file
  EXPECT_TRUE(element.says("case.toml:")) << element.err;
  EXPECT_TRUE(element.says("set element = \"tri6\"")) << element.err;

  write_text(folder_.path() / "part.toml", edited(rounded, {{"closed = true\n", ""}}));
  const Outcome open = check(outlined());
  EXPECT_EQ(open.status, 4); // geometry
  EXPECT_TRUE(open.says("part.toml")) << open.err;
  EXPECT_TRUE(open.says("closed = true")) << open.err;

  write_text(folder_.path() / "part.toml", rounded);
  const Outcome size = check(edited(outlined(), {{"size = 1.5", "size = 1e-4"}}));
  EXPECT_NE(size.status, 0);
  EXPECT_TRUE(size.says("part.toml") && size.says("larger size")) << size.err;

  write_text(folder_.path() / "part.toml", sliver);
  const Outcome thin = check(outlined());
  EXPECT_EQ(thin.status, 7); // a limit
  EXPECT_TRUE(thin.says("part.toml") && thin.says("far thinner than they are")) << thin.err;

  const Outcome missing = check(edited(outlined(), {{", size = 1.5", ""}}));
  EXPECT_TRUE(missing.says("workpiece.mesh.size: missing")) << missing.err;
}

} // namespace

} // namespace billet::test::meshed_domains_test
