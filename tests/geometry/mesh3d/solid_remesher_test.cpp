// Bodies meshed anew: volume, lines and corners that stay, curved surfaces, quality, refusals.

#include "geometry/base/error.h"
#include "geometry/mesh3d/solid_quality.h"
#include "geometry/mesh3d/solid_remesher.h"
#include "geometry/repair/mesh_health.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/sound_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace billet::geometry::solid_remesher_test {
namespace {

constexpr double rounding = 1e-12;

/// Each triangle in four, new points in the middles.
TriangleMesh divided(const TriangleMesh& mesh, int times) {
  TriangleMesh result = mesh;
  for (int i = 0; i < times; ++i) {
    const TriangleMesh old = result;
    result.triangles.clear();
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [place, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(result.points.size()));
      if (added)
        result.points.emplace_back(0.5 * (old.points[static_cast<std::size_t>(a)] +
                                          old.points[static_cast<std::size_t>(b)]));
      return place->second;
    };
    for (const auto& [a, b, c] : old.triangles) {
      const std::int32_t d = middle(a, b), e = middle(b, c), f = middle(c, a);
      for (const auto& t : {std::array{a, d, f}, {d, b, e}, {f, e, c}, {d, e, f}})
        result.triangles.push_back(t);
    }
  }
  return result;
}

double chords_off(const RemeshedSolid& solid, const std::function<double(const Vec3&)>& distance) {
  double most = 0.0;
  for (const RemeshedSolid::Edge& edge : solid.edges) {
    most = std::max(most, std::abs(distance(edge.middle)));
    for (const std::int32_t a : edge.corners)
      most = std::max(most, std::abs(distance(solid.mesh.points[static_cast<std::size_t>(a)])));
  }
  return most;
}

/// Of the quadratic tetrahedra.
double worst_bent_quality(const RemeshedSolid& solid) {
  constexpr std::array<std::array<std::size_t, 2>, 6> ends{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  std::map<std::array<std::int32_t, 2>, Vec3> bent;
  for (const RemeshedSolid::Edge& edge : solid.edges)
    bent[edge.corners] = edge.middle;
  double worst = 1.0;
  for (const auto& corners : solid.mesh.tetrahedra) {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      x[i] = solid.mesh.points[static_cast<std::size_t>(corners[i])];
    std::array<Vec3, 6> middles;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& [a, b] = ends[i];
      const auto [low, high] = std::minmax(corners[a], corners[b]);
      const auto found = bent.find({low, high});
      middles[i] = found != bent.end() ? found->second : Vec3(0.5 * (x[a] + x[b]));
    }
    worst = std::min(worst, bent_quality(x, middles));
  }
  return worst;
}

TEST(SolidRemesher, KeepsEdgesAndVolumeOfABox) {
  const SolidBoundary boundary = whole(divided(prism({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, 1.5), 2));
  const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.5), 9.0);
  expect_sound(solid);
  std::printf("box: %zu tetrahedra, smallest angle %.1f deg\n", solid.mesh.tetrahedra.size(),
              solid.smallest_angle);
  EXPECT_NEAR(solid.volume, 9.0, 9.0 * rounding);
  EXPECT_GE(solid.smallest_angle, 10.0);
  EXPECT_EQ(solid.kept.size(), 8u);
  // Every node of the boundary lies on one of the six planes, to the bit.
  for (const RemeshedSolid::Edge& edge : solid.edges) {
    const Vec3& x = edge.middle;
    EXPECT_TRUE(x.x() == 0.0 || x.x() == 3.0 || x.y() == 0.0 || x.y() == 2.0 || x.z() == 0.0 ||
                x.z() == 1.5)
        << x.transpose();
  }
  // Edges of about the size that was asked for.
  double sum = 0.0;
  for (const RemeshedSolid::Edge& edge : solid.edges)
    sum += (solid.mesh.points[static_cast<std::size_t>(edge.corners[0])] -
            solid.mesh.points[static_cast<std::size_t>(edge.corners[1])])
               .norm();
  std::printf("box: mean edge on the boundary %.3f\n",
              sum / static_cast<double>(solid.edges.size()));
  EXPECT_NEAR(sum / static_cast<double>(solid.edges.size()), 0.5, 0.1);
}

TEST(SolidRemesher, FollowsASphereToFourthOrder) {
  double last = 0.0;
  for (const int level : {2, 3}) {
    const TriangleMesh ball = icosphere(level);
    const double sphere = 4.0 / 3.0 * std::numbers::pi;
    SolidBoundary boundary = whole(ball);
    boundary.hold.assign(ball.triangles.size(), 1); // nothing is shifted for the volume
    const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.35), sphere);
    expect_sound(solid);
    EXPECT_GE(solid.smallest_angle, 10.0);
    EXPECT_NEAR(solid.volume, sphere, 1e-3 * sphere) << "the parabolas'";
    const double off = chords_off(solid, [](const Vec3& x) { return x.norm() - 1.0; });
    std::printf("sphere of %zu triangles (facets off by %.1e): nodes off by %.1e\n",
                ball.triangles.size(), 1.0 - std::cos(1.107 / (2 << level)), off);
    if (last > 0.0) {
      EXPECT_LT(off, last / 8.0);
    }
    last = off;
  }
  EXPECT_LT(last, 2e-4);
}

TEST(SolidRemesher, KeepsTheRimsOfACylinder) {
  const TriangleMesh bar = round_bar({.n = 24, .radius = 2.0, .length = 3.0, .layers = 6});
  const double cylinder = 12.0 * std::numbers::pi;
  SolidBoundary boundary = whole(bar);
  for (std::size_t t = 0; t < bar.triangles.size(); ++t) {
    const auto z = [&](std::size_t i) {
      return bar.points[static_cast<std::size_t>(bar.triangles[t][i])].z();
    };
    boundary.hold[t] = static_cast<char>(z(0) == z(1) && z(1) == z(2)); // the ends
  }
  const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.8), cylinder);
  expect_sound(solid);
  EXPECT_GE(solid.smallest_angle, 10.0);
  EXPECT_NEAR(solid.volume, cylinder, cylinder * rounding);
  // Nodes on the rims lie on circles, middles too.
  EXPECT_GT(solid.on_lines.size(), 20u);
  for (const RemeshedSolid::LineEdge& line : solid.on_lines) {
    const RemeshedSolid::Edge& edge = solid.edges[line.edge];
    for (const Vec3& x :
         {edge.middle, solid.mesh.points[static_cast<std::size_t>(edge.corners[0])]}) {
      EXPECT_NEAR(std::hypot(x.x(), x.y()), 2.0, 1e-3);
      EXPECT_NEAR(std::abs(x.z() - 1.5), 1.5, rounding);
    }
  }
}

TEST(SolidRemesher, MakesGoodTetrahedraWhereABulgeMeetsAFlatEnd) {
  // A barrel that rolls onto its ends: side and end meet at 154 degrees. A tetrahedron with a face
  // on either has that angle between the tangents of its bent edges.
  TriangleMesh barrel = round_bar({.n = 24, .radius = 1.0, .length = 3.0, .layers = 12});
  for (Vec3& x : barrel.points)
    x.head<2>() *= 1.0 + 2.0 * std::sin(std::numbers::pi * x.z() / 3.0);
  SolidBoundary boundary = whole(barrel);
  for (std::size_t t = 0; t < barrel.triangles.size(); ++t) {
    const auto& [a, b, c] = barrel.triangles[t];
    const auto z = [&](std::int32_t i) { return barrel.points[static_cast<std::size_t>(i)].z(); };
    boundary.hold[t] = static_cast<char>(z(a) == z(b) && z(b) == z(c)); // the ends
  }
  const double volume = health(barrel).volume;
  const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.6), volume);
  expect_sound(solid);
  const double worst = worst_bent_quality(solid);
  std::printf("barrel: %zu tetrahedra, worst quality %.2f\n", solid.mesh.tetrahedra.size(), worst);
  EXPECT_NEAR(solid.volume, volume, volume * rounding);
  EXPECT_GT(worst, 0.25);
}

TEST(SolidRemesher, KeepsLinesBetweenPartsPointsAndEdgesOfTheCaller) {
  // The top of a box in two parts, an edge across its front, a point on the right.
  SolidBoundary boundary = whole(divided(prism({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 2.0), 2));
  const auto& points = boundary.mesh.points;
  for (std::size_t t = 0; t < boundary.mesh.triangles.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t a : boundary.mesh.triangles[t])
      middle += points[static_cast<std::size_t>(a)] / 3.0;
    if (middle.z() > 2.0 - rounding && middle.x() > 1.0)
      boundary.part[t] = 1;
  }
  std::int32_t kept = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] == Vec3(2.0, 1.0, 0.5))
      kept = static_cast<std::int32_t>(i);
  }
  ASSERT_GE(kept, 0);
  boundary.keep[static_cast<std::size_t>(kept)] = 1;
  for (std::size_t t = 0; t < boundary.mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = boundary.mesh.triangles[t][i],
                         b = boundary.mesh.triangles[t][(i + 1) % 3];
      const Vec3 &x = points[static_cast<std::size_t>(a)], &y = points[static_cast<std::size_t>(b)];
      if (x.y() == 0.0 && y.y() == 0.0 && x.z() == 1.0 && y.z() == 1.0 && a < b)
        boundary.lines.push_back({a, b});
    }
  ASSERT_EQ(boundary.lines.size(), 4u);
  const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.6), 8.0);
  expect_sound(solid);
  double area = 0.0;
  for (const RemeshedSolid::Facet& facet : solid.facets) {
    const auto x = [&](std::size_t i) {
      return solid.mesh.points[static_cast<std::size_t>(facet.corners[i])];
    };
    if (facet.part == 1)
      area += 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
  }
  EXPECT_NEAR(area, 2.0, 2.0 * rounding);
  double length = 0.0;
  for (const RemeshedSolid::LineEdge& line : solid.on_lines) {
    const auto& [a, b] = solid.edges[line.edge].corners;
    if (std::find(boundary.lines.begin(), boundary.lines.end(), line.old) != boundary.lines.end())
      length += (solid.mesh.points[static_cast<std::size_t>(a)] -
                 solid.mesh.points[static_cast<std::size_t>(b)])
                    .norm();
  }
  EXPECT_NEAR(length, 2.0, 2.0 * rounding);
  EXPECT_TRUE(std::any_of(solid.kept.begin(), solid.kept.end(),
                          [&](const RemeshedSolid::Kept& k) { return k.point == kept; }));
}

TEST(SolidRemesher, PutsNodesWhereTheCallerWantsThem) {
  SolidBoundary boundary = whole(icosphere(3));
  for (std::size_t t = 0; t < boundary.mesh.triangles.size(); ++t) {
    bool above = true;
    for (const std::int32_t a : boundary.mesh.triangles[t])
      above = above && boundary.mesh.points[static_cast<std::size_t>(a)].z() > 0.55;
    boundary.hold[t] = static_cast<char>(above);
  }
  // A plane that the cap is to lie below.
  const SnapSolid snap = [](std::span<const std::int32_t>, const SurfacePlace&, const Vec3& x) {
    return Vec3(x.x(), x.y(), std::min(x.z(), 0.9));
  };
  const double sphere = 4.0 / 3.0 * std::numbers::pi;
  const RemeshedSolid solid = remesh_solid(boundary, edges_of(0.35), sphere, snap);
  expect_sound(solid);
  EXPECT_NEAR(solid.volume, sphere, sphere * rounding) << "the rest gives way";
  int on_plane = 0;
  for (const RemeshedSolid::Edge& edge : solid.edges) {
    EXPECT_LE(edge.middle.z(), 0.9);
    on_plane += edge.middle.z() == 0.9 ? 1 : 0;
  }
  EXPECT_GT(on_plane, 5);
}

TEST(SolidRemesher, GradesSizesAndResolvesThinWalls) {
  // A plate of thickness 0.2 with edges of 1 asked for: one through the wall.
  const SolidBoundary plate = whole(divided(prism({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0.2), 3));
  SolidSizes sizes = edges_of(1.0);
  sizes.min = 0.05;
  const RemeshedSolid thin = remesh_solid(plate, sizes, 3.2);
  expect_sound(thin);
  std::printf("plate: %zu tetrahedra, smallest angle %.1f deg\n", thin.mesh.tetrahedra.size(),
              thin.smallest_angle);
  EXPECT_GE(thin.smallest_angle, 10.0);
  EXPECT_NEAR(thin.volume, 3.2, 3.2 * rounding);

  // Small at one corner.
  SolidSizes graded = edges_of(0.6);
  graded.min = 0.1;
  graded.wanted = [](const Vec3& x) { return x.norm() < 0.3 ? 0.1 : 0.6; };
  const RemeshedSolid solid = remesh_solid(whole(divided(cube(), 3)), graded, 1.0);
  expect_sound(solid);
  double near = 0.0, far = 0.0;
  int n_near = 0, n_far = 0;
  for (const RemeshedSolid::Edge& edge : solid.edges) {
    const double length = (solid.mesh.points[static_cast<std::size_t>(edge.corners[0])] -
                           solid.mesh.points[static_cast<std::size_t>(edge.corners[1])])
                              .norm();
    if (edge.middle.norm() < 0.25) {
      near += length;
      ++n_near;
    } else if (edge.middle.norm() > 1.2) {
      far += length;
      ++n_far;
    }
  }
  EXPECT_LT(near / n_near, 0.15);
  EXPECT_GT(far / n_far, 0.25);
}

TEST(SolidRemesher, RefusesWhatIsNoBodyAndSaysWhere) {
  TriangleMesh open = cube();
  open.triangles.pop_back();
  SolidBoundary boundary = whole(open);
  try {
    static_cast<void>(remesh_solid(boundary, edges_of(0.5), 1.0));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_NE(error.complaints().front().message.find("near ("), std::string::npos);
  }
  // A corner pushed through the opposite face.
  TriangleMesh crossed = divided(cube(), 1);
  for (Vec3& x : crossed.points)
    if (x == Vec3(0.5, 0.5, 1.0))
      x = Vec3(0.5, 0.5, -0.5);
  try {
    static_cast<void>(remesh_solid(whole(crossed), edges_of(0.5), 1.0));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.complaints().front().message.find("cuts itself near ("), std::string::npos);
  }
}

TEST(SolidRemesher, GivesTheSameMeshEveryTime) {
  const SolidBoundary boundary =
      whole(round_bar({.n = 16, .radius = 1.0, .length = 2.0, .layers = 4}));
  const RemeshedSolid first = remesh_solid(boundary, edges_of(0.4), 6.2);
  const RemeshedSolid second = remesh_solid(boundary, edges_of(0.4), 6.2);
  ASSERT_EQ(first.mesh.points.size(), second.mesh.points.size());
  EXPECT_EQ(first.mesh.tetrahedra, second.mesh.tetrahedra);
  for (std::size_t i = 0; i < first.mesh.points.size(); ++i)
    EXPECT_EQ(first.mesh.points[i], second.mesh.points[i]);
  for (std::size_t i = 0; i < first.edges.size(); ++i)
    EXPECT_EQ(first.edges[i].middle, second.edges[i].middle);
}

} // namespace
} // namespace billet::geometry::solid_remesher_test
