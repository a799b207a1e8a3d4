#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/retreating_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace billet::geometry::retreating_surface_test {
namespace {

TEST(RetreatingSurface, IsAsFarOffAsItHasDrawnBack) {
  const SurfacePtr ball = make_sphere({1, 2, 3}, 5.0, false);
  RetreatingSurface surface(make_sphere({1, 2, 3}, 5.0, false));
  const SurfacePtr smaller = make_sphere({1, 2, 3}, 4.5, false);
  const std::array<Vec3, 3> points{Vec3(7, 2, 3), Vec3(1, 6.5, 3), Vec3(3, 4, 5.5)};
  std::array<Projection, 3> before, plain, found, wanted;
  ball->project(points, 10.0, plain);
  surface.project(points, 10.0, before);
  surface.set_distance(0.5);
  surface.project(points, 10.0, found);
  smaller->project(points, 10.0, wanted);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(before[i].gap, plain[i].gap);
    EXPECT_NEAR(found[i].gap, wanted[i].gap, 1e-14);
    EXPECT_LT((found[i].foot - wanted[i].foot).norm(), 1e-14);
    EXPECT_LT((found[i].normal - wanted[i].normal).norm(), 1e-15);
    EXPECT_LT((found[i].dnormal_dx - wanted[i].dnormal_dx).norm(), 1e-14);
  }
  const std::array<Vec3, 1> far{Vec3(100, 0, 0)};
  std::array<Projection, 1> none;
  surface.project(far, 10.0, none);
  EXPECT_FALSE(none[0].found());
}

} // namespace
} // namespace billet::geometry::retreating_surface_test
