// How many tetrahedra a body takes, estimated: the right number, the right reason, the limit.

#include "geometry/base/error.h"
#include "geometry/mesh3d/mesher_3d.h"
#include "geometry/mesh3d/solid_estimate.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/studded_block.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace billet::geometry::solid_estimate_test {
namespace {

/// What an estimate is worth: right to this factor.
constexpr double factor = 2.5;

TriangleMesh plate(double side, double thickness) {
  return prism({{0, 0}, {side, 0}, {side, side}, {0, side}}, thickness);
}

struct Body {
  std::string name;
  TriangleMesh surface;
  SolidRefinement wanted;
};

TEST(SolidEstimate, IsNearWhatIsMade) {
  const std::vector<Body> bodies{
      {"cube", cube(), {0.2}},
      {"bar", round_bar({.n = 36, .radius = 5.0, .length = 20.0}), {4.0}},
      {"plate", plate(10.0, 0.8), {4.0}},
      {"studs", studded_block(1, 0.4), {4.0}},
      {"studs passed over", studded_block(1, 0.4), {.size = 4.0, .details = 0.6}}};
  for (const Body& body : bodies) {
    const double estimated = solid_estimate(body.surface, body.wanted).tetrahedra();
    const auto made = static_cast<double>(mesh_solid(body.surface, body.wanted).tetrahedra.size());
    std::printf("%-18s estimated %6.0f, made %6.0f\n", body.name.c_str(), estimated, made);
    EXPECT_LT(estimated, factor * made) << body.name;
    EXPECT_GT(estimated, made / factor) << body.name;
  }
}

TEST(SolidEstimate, SaysWhichShapesAskForMost) {
  EXPECT_EQ(reason(solid_estimate(cube(), {0.2})), "");
  const std::string studs = reason(solid_estimate(studded_block(4, 0.2), {4.0}));
  EXPECT_NE(studs.find("sharp edges that are only 0.2 apart"), std::string::npos) << studs;
  const std::string thin = reason(solid_estimate(plate(60.0, 0.4), {4.0}));
  EXPECT_NE(thin.find("walls that are only 0.4 thick"), std::string::npos) << thin;
}

TEST(SolidEstimate, RefusesABodyWhoseDetailsTakeFarMoreThanItsVolume) {
  const TriangleMesh block = studded_block(32, 0.2);
  try {
    (void)mesh_solid(block, {4.0});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
    const std::string text = error.what();
    EXPECT_NE(text.find("sharp edges that are only 0.2 apart"), std::string::npos) << text;
    EXPECT_NE(text.find("details"), std::string::npos) << text;
  }
  const SolidRefinement coarse{.size = 4.0, .details = 0.3};
  EXPECT_NO_THROW(require_meshable(solid_estimate(block, coarse), coarse));
}

TEST(SolidEstimate, DoesNotDependOnTheUnit) {
  TriangleMesh large = studded_block(2, 0.3);
  for (Vec3& x : large.points)
    x *= 1000.0;
  const double in_mm = solid_estimate(studded_block(2, 0.3), {4.0}).tetrahedra();
  EXPECT_NEAR(solid_estimate(large, {4000.0}).tetrahedra(), in_mm, 1e-6 * in_mm);
}

} // namespace
} // namespace billet::geometry::solid_estimate_test
