#include "geometry/collision/facet_body.h"
#include "geometry/collision/first_contact.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace billet::geometry::first_contact_test {
namespace {

constexpr double precision = 1e-9; // gap 1e-12 of a size of 10, over a slope of 0.01

double least_gap(const RigidSurface& surface, const Pose& pose, const std::vector<Vec3>& points) {
  double least = far;
  for (const Vec3& x : points)
    if (const Projection p = projection(surface, pose.to_tool(x)); p.found())
      least = std::min(least, p.gap);
  return least;
}

Pose moved(const Pose& start, const Vec3& by) { return {start.rotation, start.translation + by}; }

TEST(FirstContact, APlaneTravelsItsGapOverTheCosine) {
  const SurfacePtr plane = make_plane({0, 5, 0}, {0, -1, 0});
  const std::vector<Vec3> points{{0, 1, 0}, {1, 2, 0}, {2, 0, 0}};
  EXPECT_NEAR(*distance_to_contact(*plane, {}, {0, -1, 0}, points, far), 3.0, precision);
  const Vec3 slanted = Vec3(3, -4, 0) / 5;
  EXPECT_NEAR(*distance_to_contact(*plane, {}, slanted, points, far), 3.0 / 0.8, precision);
}

TEST(FirstContact, ASphereMeetsAPointWhereTheFormulaSays) {
  const SurfacePtr ball = make_sphere({0, 0, 0}, 1.0, false);
  for (const double offset : {0.0, 0.3, 0.9, 0.999}) {
    const std::vector<Vec3> points{{5.0, offset, 0.0}};
    const double expected = 5.0 - std::sqrt(1.0 - offset * offset);
    const Outcome<double> s = distance_to_contact(*ball, {}, {1, 0, 0}, points, far);
    ASSERT_TRUE(s) << s.error().reason;
    EXPECT_NEAR(*s, expected, precision);
  }
}

TEST(FirstContact, AToolThatMovesPastOrStopsShortMeetsNothing) {
  const SurfacePtr ball = make_sphere({0, 0, 0}, 1.0, false);
  const std::vector<Vec3> beside{{5.0, 1.001, 0.0}}, ahead{{5.0, 0.0, 0.0}}, none;
  EXPECT_FALSE(distance_to_contact(*ball, {}, {1, 0, 0}, beside, 50.0));
  EXPECT_FALSE(distance_to_contact(*ball, {}, {-1, 0, 0}, ahead, 50.0));
  EXPECT_FALSE(distance_to_contact(*ball, {}, {1, 0, 0}, ahead, 3.9));
  EXPECT_TRUE(distance_to_contact(*ball, {}, {1, 0, 0}, ahead, 4.1));
  EXPECT_FALSE(distance_to_contact(*ball, {}, {1, 0, 0}, none, 50.0));
}

TEST(FirstContact, AnOverlappingToolBacksOffUntilItIsClear) {
  const SurfacePtr ball = make_sphere({0, 0, 0}, 1.0, false);
  const std::vector<Vec3> points{{0.5, 0.3, 0.0}, {0.1, -0.2, 0.4}};
  const Outcome<double> s = distance_to_contact(*ball, {}, {1, 0, 0}, points, far);
  ASSERT_TRUE(s);
  EXPECT_LT(*s, 0.0);
  EXPECT_NEAR(least_gap(*ball, moved({}, Vec3(*s, 0, 0)), points), 0.0, precision);
  EXPECT_NEAR(*s, 0.1 - std::sqrt(1.0 - 0.2), precision);
}

TEST(FirstContact, ContactAtTheStartIsZero) {
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, 1, 0});
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 0}};
  EXPECT_EQ(*distance_to_contact(*plane, {}, {0, 1, 0}, points, far), 0.0);
}

TEST(FirstContact, TheFirstContactOfASpikyToolIsFoundAndNothingTouchedBefore) {
  const TriangleMesh mesh = spiky(6);
  const SurfacePtr tool = make_triangle_surface(mesh);
  const std::vector<Vec3> points = [] {
    std::vector<Vec3> block = random_points(200, 1.0);
    for (Vec3& x : block)
      x += Vec3(4.0, 0.2, -0.1);
    return block;
  }();
  Pose start;
  start.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  start.translation = Vec3(-0.5, 0.1, 0.2);
  for (const Vec3& towards : {Vec3(1, 0, 0), Vec3(1, 0.2, 0.1), Vec3(1, -0.3, 0.0)}) {
    const Vec3 direction = towards.normalized();
    const Outcome<double> s = distance_to_contact(*tool, start, direction, points, far);
    ASSERT_TRUE(s) << s.error().reason;
    EXPECT_NEAR(least_gap(*tool, moved(start, *s * direction), points), 0.0, precision);
    for (int i = 0; i < 200; ++i) // on the way the tool is clear
      EXPECT_GT(least_gap(*tool, moved(start, *s * direction * i / 200.0), points), 0.0);
  }
}

TEST(FirstContact, AProfileComesToRestOnTheFirstPoint) {
  const std::vector<Vec2> nose{{-5, 5}, {0, 0}, {5, 5}}; // the tool is above
  const SurfacePtr tool = make_profile(polygon(nose, false));
  const std::vector<Vec3> points{{-0.5, -3, 0}, {0.4, -3, 0}, {2, -1.5, 0}};
  const Outcome<double> s = distance_to_contact(*tool, {}, {0, -1, 0}, points, far);
  ASSERT_TRUE(s) << s.error().reason;
  EXPECT_NEAR(*s, 3.4, precision);
}

TEST(FirstContact, TheOffsetScalesWithTheUnitOfLength) {
  for (const double unit : {1e-3, 1.0, 1e6}) {
    const SurfacePtr ball = make_sphere(Vec3::Zero(), unit, false);
    const std::vector<Vec3> points{{5.0 * unit, 0.6 * unit, 0.0}};
    EXPECT_NEAR(*distance_to_contact(*ball, {}, {1, 0, 0}, points, far * unit) / unit, 4.2,
                precision);
  }
}

TEST(FirstContact, AFineMeshNearGrazingContactConverges) {
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, -1, 0});
  const double angle = 1e-2;
  const Vec3 direction(std::cos(angle), -std::sin(angle), 0.0);
  const std::vector<Vec3> points{{0, -0.5, 0}};
  const Outcome<double> s = distance_to_contact(*plane, {}, direction, points, far);
  ASSERT_TRUE(s) << s.error().reason;
  EXPECT_NEAR(*s, 0.5 / std::sin(angle), precision);
}

TEST(FirstContact, FacetsMeetWhereFclSeesThemTouchAndNotLater) {
  // Two bodies of spikes. Their points alone meet later or at the same time; just before the
  // facets' contact they are apart, just after it they cut.
  const TriangleMesh mesh = spiky(5);
  const SurfacePtr tool = make_triangle_surface(mesh);
  const FacetBody body({mesh.points, {}, mesh.triangles}, 10.0);
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int sooner = 0;
  for (int k = 0; k < 20; ++k) {
    const Pose start = rotation_about(Vec3(1, 2, 3), Vec3(any(generator), 1, 0).normalized(), 2.0);
    Pose there;
    there.translation = start.translation + Vec3(5, 0.5 * any(generator), 0.5 * any(generator));
    const Vec3 direction = (there.translation - start.translation).normalized();
    std::vector<Vec3> points;
    for (const Vec3& p : mesh.points)
      points.push_back(there.to_space(p));
    const Outcome<double> latest = distance_to_contact(*tool, start, direction, points, far);
    constexpr double tolerance = 1e-6, step = 1e-5;
    const double s =
        facet_contact({body, start}, direction, {body, there}, latest ? *latest : 10.0, tolerance);
    EXPECT_LE(s, latest ? *latest : 10.0);
    const auto at = [&](double offset) {
      return PlacedBody{body, moved(start, offset * direction)};
    };
    EXPECT_GT(clearance(at(s - step), {body, there}), 0.0) << k;
    if (latest && *latest - s < step)
      continue;
    ++sooner;
    ASSERT_LT(s, 10.0);
    EXPECT_TRUE(deepest_cut(at(s + step), {body, there})) << k;
  }
  EXPECT_GT(sooner, 10);
}

} // namespace
} // namespace billet::geometry::first_contact_test
