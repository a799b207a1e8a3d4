#include "contact/wear/wear_map.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace billet::contact::wear_map_test {
namespace {

using mechanics::Analysis;

constexpr double pi = std::numbers::pi;

Box body() {
  Box box;
  box.add({0, 0, 0});
  box.add({4, 1, 2});
  return box;
}

/// A piece of a face from `low` to `high` along x on the plane y = 0.
WornPatch on_floor(double low, double high, const Vec3& way, double volume) {
  WornPatch patch;
  patch.footprint.corners = {Vec3(low, 0, 0), Vec3(high, 0, 0)};
  patch.footprint.n_corners = 2;
  patch.foot = Vec3(0.5 * (low + high), 0, 0);
  patch.normal = Vec3::UnitY();
  patch.way = way;
  patch.volume = volume;
  return patch;
}

/// A square of that side about a place on a surface.
WornPatch square(const geometry::Projection& at, double side, double volume) {
  WornPatch patch;
  const Vec3 u = at.normal.unitOrthogonal(), v = at.normal.cross(u);
  for (const auto& [a, b] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) // as faces turn: inwards
    patch.footprint.corners[patch.footprint.n_corners++] = at.foot + 0.5 * side * (a * u + b * v);
  patch.foot = at.foot;
  patch.normal = at.normal;
  patch.volume = volume;
  return patch;
}

double length(const WearCell& cell) {
  return (cell.shape.corners()[1] - cell.shape.corners()[0]).norm();
}

TEST(WearMap, lays_a_volume_along_the_arc_of_a_roll_that_turns) {
  // A piece of 0.08 on the top of a roll of radius 10 that turns by 24 degrees an increment, 15 of
  // them in a round: laid along the chord it was three times too deep in places.
  constexpr double radius = 10.0, volume = 1e-3;
  constexpr int of_a_round = 15;
  const auto roll = geometry::make_circle({0, 0, 0}, radius, false);
  WearMap map(*roll, Analysis::plane_strain, body());
  const double angle = 2.0 * pi / of_a_round;
  for (int i = 0; i < of_a_round; ++i) {
    const auto at = [&](double by) {
      return Vec3(radius * std::sin(i * angle + by), radius * std::cos(i * angle + by), 0);
    };
    WornPatch patch;
    patch.footprint.corners = {at(-0.004), at(0.004)};
    patch.footprint.n_corners = 2;
    patch.foot = at(0.0);
    patch.normal = at(0.0).normalized();
    patch.way = at(0.0) - at(-angle);
    patch.turn = -angle * Vec3::UnitZ(); // clockwise, as sin and cos go
    patch.volume = volume;
    map.add(patch);
  }
  const double mean = of_a_round * volume / (2.0 * pi * radius);
  EXPECT_NEAR(map.volume(), of_a_round * volume, 1e-12);
  EXPECT_LT(map.deepest()->depth, 1.25 * mean);
  for (const WearCell& cell : map.cells())
    EXPECT_GT(cell.depth, 0.75 * mean);
}

TEST(WearMap, spreads_a_volume_evenly_over_the_footprint) {
  const auto floor = geometry::make_plane(Vec3::Zero(), Vec3::UnitY());
  WearMap map(*floor, Analysis::plane_strain, body());
  for (int i = 0; i < 8; ++i) // pieces that meet without gaps
    map.add(on_floor(0.5 * i, 0.5 * (i + 1), Vec3::Zero(), 0.5 * 1e-3));
  EXPECT_NEAR(map.volume(), 4e-3, 1e-17);
  double inside = 0.0;
  for (const WearCell& cell : map.cells()) {
    const double x = cell.shape.middle()[0];
    if (x > 0.25 && x < 3.75) {
      EXPECT_NEAR(cell.depth, 1e-3, 1e-12); // cells at the ends are covered in part
      EXPECT_LE(length(cell), 0.25);
      inside += length(cell);
    }
  }
  EXPECT_GT(inside, 3.0);
  ASSERT_TRUE(map.deepest());
  EXPECT_NEAR(map.deepest()->depth, 1e-3, 1e-12);
}

TEST(WearMap, draws_a_piece_along_its_way) {
  // A piece of 0.5 that slides by 10: worn alike from its start to its end.
  const auto floor = geometry::make_plane(Vec3::Zero(), Vec3::UnitY());
  WearMap map(*floor, Analysis::plane_strain, body());
  map.add(on_floor(10.0, 10.5, Vec3(10, 0, 0), 1e-3));
  EXPECT_NEAR(map.volume(), 1e-3, 1e-17);
  for (const WearCell& cell : map.cells()) {
    const double x = cell.shape.middle()[0];
    if (x > 0.75 && x < 9.75) {
      EXPECT_NEAR(cell.depth, 1e-4, 0.35e-4) << x; // placed in steps of 0.25
    } else if (x < -0.5 || x > 11.0) {
      EXPECT_EQ(cell.depth, 0.0) << x;
    }
  }
}

TEST(WearMap, goes_on_for_thousands_of_sizes_of_the_workpiece) {
  // A pin on a disc whose track is rolled off: the last metre is worn like the first.
  const auto floor = geometry::make_plane(Vec3::Zero(), Vec3::UnitY());
  WearMap map(*floor, Analysis::plane_strain, body());
  constexpr double way = 10'000.0, volume = 1.0; // a body of size 4.6
  constexpr int n_increments = 20;
  for (int i = 1; i <= n_increments; ++i) {
    const double x = i * way / n_increments;
    map.add(on_floor(x, x + 0.5, Vec3(way / n_increments, 0, 0), volume / n_increments));
  }
  EXPECT_NEAR(map.volume(), volume, 1e-9 * volume);
  double length_worn = 0.0;
  for (const WearCell& cell : map.cells()) {
    const double x = cell.shape.middle()[0];
    length_worn += cell.depth > 0.0 ? length(cell) : 0.0;
    if (x > 1.0 && x < way - 1.0) {
      EXPECT_NEAR(cell.depth, volume / way, 0.35 * volume / way) << x;
    }
  }
  EXPECT_NEAR(length_worn, way, 2.0);
}

TEST(WearMap, keeps_the_volume_on_every_kind_of_tool) {
  const std::vector<std::pair<const char*, geometry::SurfacePtr>> surfaces = [] {
    std::vector<std::pair<const char*, geometry::SurfacePtr>> list;
    list.emplace_back("plane", geometry::make_plane({0, 0, 0}, {0.3, 1, 0.2}));
    list.emplace_back("cylinder", geometry::make_cylinder({0, -5, 0}, {0, 0.2, 1}, 5.0, false));
    list.emplace_back("bore", geometry::make_cylinder({0, 5, 0}, {0, 0, 1}, 5.0, true));
    list.emplace_back("sphere", geometry::make_sphere({1, -6, 1}, 6.0, false));
    list.emplace_back("cone", geometry::make_cone({0, 3, 0}, {0, -1, 0}, 0.7, false));
    list.emplace_back("torus", geometry::make_torus({0, 0, 0}, {0, 1, 0}, 6.0, 2.0, false));
    return list;
  }();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const auto& [name, surface] : surfaces) {
    WearMap map(*surface, Analysis::solid, body());
    double total = 0.0, most = 0.0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 x(4.0 * uniform(generator), uniform(generator), 2.0 * uniform(generator));
      std::array<geometry::Projection, 1> at;
      surface->project(std::array{x}, 1e3, at);
      const double volume = 1e-3 * uniform(generator);
      WornPatch patch = square(at[0], 0.3, volume);
      patch.way = 0.4 * uniform(generator) * at[0].normal.unitOrthogonal();
      map.add(patch);
      total += volume;
    }
    double far = 0.0;
    for (const WearCell& cell : map.cells()) {
      most = std::max(most, cell.depth);
      const Vec3 middle = cell.shape.middle();
      if (cell.depth > 0.0) {
        std::array<geometry::Projection, 1> at;
        surface->project(std::array{middle}, 1e3, at);
        far = std::max(far, std::abs(at[0].gap));
      }
    }
    std::printf("%-8s volume %.12e of %.12e, %zu cells, deepest %.3e, at most %.4f off the shape\n",
                name, map.volume(), total, map.cells().size(), most, far);
    EXPECT_NEAR(map.volume(), total, 1e-12 * total) << name;
    EXPECT_LT(far, 0.02) << name; // the chords that a shape is drawn with
  }
}

TEST(WearMap, takes_the_full_turn_in_axisymmetry) {
  const auto floor = geometry::make_plane(Vec3::Zero(), Vec3::UnitY());
  WearMap map(*floor, Analysis::axisymmetric, body());
  constexpr double depth = 1e-3;
  for (int i = 0; i < 8; ++i) {
    const double a = 0.5 * i, b = 0.5 * (i + 1);
    map.add(on_floor(a, b, Vec3::Zero(), depth * pi * (b * b - a * a)));
  }
  EXPECT_NEAR(map.volume(), depth * pi * 16.0, 1e-14);
  for (const WearCell& cell : map.cells()) {
    EXPECT_GE(std::min(cell.shape.corners()[0][0], cell.shape.corners()[1][0]), 0.0);
    if (cell.shape.middle()[0] < 3.75) {
      EXPECT_NEAR(cell.depth, depth, 1e-12) << cell.shape.middle()[0];
    }
  }
}

TEST(WearMap, begins_with_the_triangles_of_a_mesh_and_knows_its_sides) {
  // A thin plate: what slides on top does not wear the bottom.
  geometry::TriangleMesh plate;
  for (const double y : {0.0, -0.05})
    for (const auto& [x, z] : {std::pair{0, 0}, {4, 0}, {4, 4}, {0, 4}})
      plate.points.emplace_back(x, y, z);
  plate.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                     {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const auto surface = geometry::make_triangle_surface(plate);
  WearMap map(*surface, Analysis::solid, body());
  EXPECT_EQ(map.cells().size(), 12U);
  std::array<geometry::Projection, 1> at;
  surface->project(std::array{Vec3(2, 0.01, 2)}, 1.0, at);
  ASSERT_EQ(at[0].normal, Vec3::UnitY());
  map.add(square(at[0], 0.5, 1e-3));
  double area = 0.0;
  for (const WearCell& cell : map.cells())
    if (cell.depth > 0.0) {
      EXPECT_EQ(cell.shape.middle()[1], 0.0);
      area += cell.shape.area_vector().norm();
    }
  EXPECT_GE(area, 0.25 - 1e-12);
  EXPECT_LT(area, 0.8); // the square and cells at its rim
  EXPECT_NEAR(map.volume(), 1e-3, 1e-17);
}

TEST(WearMap, gives_what_lies_beyond_a_rim_to_the_nearest_cell) {
  const std::vector<Vec2> points{{3, 0}, {0, 0}}; // the tool below
  const auto edge = geometry::make_profile(geometry::polygon(points, false));
  WearMap map(*edge, Analysis::plane_strain, body());
  map.add(on_floor(3.5, 4.0, Vec3::Zero(), 1e-3));
  EXPECT_EQ(map.volume(), 1e-3);
}

} // namespace
} // namespace billet::contact::wear_map_test
