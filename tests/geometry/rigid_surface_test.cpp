#include "geometry/rigid_surface.h"
#include "geometry/surfaces/analytic_surfaces.h"

#include <gtest/gtest.h>

#include <vector>

namespace billet::geometry::rigid_surface_test {
namespace {

TEST(RigidSurface, ABatchGivesWhatItsPointsGiveAloneAndOverwritesOldResults) {
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, 1, 0});
  const std::vector<Vec3> points{{0, 1, 0}, {0, 50, 0}, {0, -2, 0}};
  std::vector<Projection> out(3);
  out[1].gap = 7.0; // left from an earlier query
  plane->project(points, 10.0, out);
  EXPECT_EQ(out[0].gap, 1.0);
  EXPECT_FALSE(out[1].found());
  EXPECT_EQ(out[2].gap, -2.0);
  EXPECT_FALSE(Projection{}.found());
}

} // namespace
} // namespace billet::geometry::rigid_surface_test
