// Every file of the zoo gets the verdict it should, whatever its random numbers.

#include "geometry/base/error.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "tests/io/stl_zoo.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>

namespace billet::io::stl_zoo_test {
namespace {

constexpr unsigned seeds = 5;

std::vector<ZooKind> zoo() {
  std::vector<ZooKind> all = zoo_of_files();
  const std::vector<ZooKind> surfaces = zoo_of_surfaces();
  all.insert(all.end(), surfaces.begin(), surfaces.end());
  return all;
}

class StlZoo : public testing::TestWithParam<ZooKind> {};

void expect_taken(const ZooKind& kind, const FacetFile& file) {
  const StlTool tool = tool_mesh(file, {});
  const std::string text = report(file, tool);
  EXPECT_NE(kind.verdict, Verdict::refused) << text;
  const bool sound = tool.repairs.notes().empty() && remarks(file, tool).empty();
  EXPECT_EQ(sound, kind.verdict == Verdict::sound) << text;
  EXPECT_NE(text.find(kind.says), std::string::npos) << text;
  EXPECT_EQ(tool.health.closed(), kind.closed.value_or(tool.health.closed())) << text;
  EXPECT_LE(tool.repairs.stitching.largest_move, tool.repairs.tolerance);
  EXPECT_TRUE(tool.intersections.complete);
  const auto surface = geometry::make_triangle_surface(tool.mesh);
  std::vector<geometry::Projection> out(1);
  const std::vector<Vec3> point{tool.mesh.points[0]};
  surface->project(point, tool.health.bounds.size(), out);
  EXPECT_TRUE(out[0].found());
}

TEST_P(StlZoo, GetsItsVerdict) {
  const ZooKind& kind = GetParam();
  const test::TemporaryFolder folder;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::filesystem::path path = folder.file("die.stl", kind.bytes(random));
    try {
      expect_taken(kind, read_stl(path));
    } catch (const Error& error) {
      EXPECT_EQ(kind.verdict, Verdict::refused) << error.what();
      EXPECT_EQ(error.fault(), Fault::geometry);
      ASSERT_FALSE(error.complaints().empty());
      EXPECT_TRUE(error.complaints()[0].place.starts_with(path.string()));
      EXPECT_NE(std::string(error.what()).find(kind.says), std::string::npos) << error.what();
    }
  }
}

std::string name_of(const testing::TestParamInfo<ZooKind>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(files, StlZoo, testing::ValuesIn(zoo_of_files()), name_of);
INSTANTIATE_TEST_SUITE_P(surfaces, StlZoo, testing::ValuesIn(zoo_of_surfaces()), name_of);

// Replaces a few coordinates by others of the same binary file.
void spoil(std::string& bytes, Random& random) {
  constexpr std::size_t first = 84, facet = 50;
  const auto place = [&] {
    const std::size_t count = (bytes.size() - first) / facet;
    return static_cast<std::ptrdiff_t>(first + facet * (random() % count) + 12 +
                                       4 * (random() % 9));
  };
  for (int i = 0; i < 4; ++i) {
    const std::ptrdiff_t from = place(), to = place();
    std::copy_n(bytes.begin() + from, 4, bytes.begin() + to);
  }
}

TEST(StlZooItself, FurtherDamageEndsInAnErrorOrASurface) {
  const test::TemporaryFolder folder;
  Random random(7);
  int taken = 0, refused = 0;
  for (const ZooKind& kind : zoo_of_surfaces())
    for (int trial = 0; trial < 6; ++trial) {
      SCOPED_TRACE(kind.name + ", trial " + std::to_string(trial));
      std::string bytes = kind.bytes(random);
      if (bytes.starts_with("solid"))
        continue;
      spoil(bytes, random);
      try {
        const StlTool tool = tool_mesh(read_stl(folder.file("die.stl", bytes)), {});
        EXPECT_NO_THROW((void)geometry::make_triangle_surface(tool.mesh));
        EXPECT_LE(tool.repairs.stitching.largest_move, tool.repairs.tolerance);
        ++taken;
      } catch (const Error& error) {
        EXPECT_FALSE(error.complaints().empty());
        ++refused;
      }
    }
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0);
}

TEST(StlZooItself, HasManyKindsEachWithItsName) {
  std::set<std::string> names;
  for (const ZooKind& kind : zoo())
    names.insert(kind.name);
  EXPECT_EQ(names.size(), zoo().size());
  EXPECT_GE(names.size(), 60U);
}

} // namespace
} // namespace billet::io::stl_zoo_test
