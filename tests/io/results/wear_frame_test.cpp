// A tool's frame shows all of its wear, however far from the workpiece that lies by then.

#include "geometry/surfaces/analytic_surfaces.h"
#include "io/results/wear_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::io::wear_frame_test {
namespace {

using contact::WornPatch;
using geometry::RigidSurface;
using mechanics::Analysis;
using mechanics::Index;

/// A piece 0.5 wide of a workpiece at x, on the foot of x, after a way along the tool.
WornPatch piece_at(const RigidSurface& surface, Analysis analysis, const Vec3& x, const Vec3& way) {
  std::array<geometry::Projection, 1> at;
  surface.project(std::array{x}, 1e6, at);
  const bool solid = analysis == Analysis::solid;
  const Vec3 along =
      solid ? at[0].normal.unitOrthogonal() : Vec3(Vec3::UnitZ().cross(at[0].normal));
  const Vec3 across = at[0].normal.cross(along);
  WornPatch patch;
  const auto add = [&](double a, double b) {
    patch.footprint.corners[patch.footprint.n_corners++] =
        at[0].foot + 0.25 * (a * along + b * across);
  };
  if (solid)
    for (const auto& [a, b] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}})
      add(a, b);
  else
    for (const double a : {1.0, -1.0})
      add(a, 0.0);
  patch.foot = at[0].foot;
  patch.normal = at[0].normal;
  patch.way = way;
  patch.volume = 1e-3;
  return patch;
}

/// Area of a cell as it is drawn: of a line, per thickness or about the axis.
double area(const SurfaceFrame& frame, const std::vector<Index>& cell, Analysis analysis) {
  std::vector<Vec3> corners;
  for (const Index i : cell)
    corners.push_back(frame.points[idx(i)]);
  if (corners.size() > 2)
    return geometry::ConvexPolygon(corners).area_vector().norm();
  const double length = (corners[1] - corners[0]).norm();
  return analysis == Analysis::axisymmetric
             ? std::numbers::pi * (corners[0].x() + corners[1].x()) * length
             : length;
}

/// Depth times area, over the cells of a frame.
double volume(const SurfaceFrame& frame, Analysis analysis) {
  const Field& depth = frame.cell_fields.at(0);
  EXPECT_EQ(depth.name, "wear_depth");
  EXPECT_EQ(depth.values.size(), frame.lines.size() + frame.polygons.size());
  double sum = 0.0;
  std::size_t i = 0;
  for (const auto* cells : {&frame.lines, &frame.polygons})
    for (const std::vector<Index>& cell : *cells)
      sum += depth.values[i++] * area(frame, cell, analysis);
  return sum;
}

struct Slide {
  const char* name;
  geometry::SurfacePtr surface;
  Analysis analysis;
  Vec3 way; ///< from the start to the end [mm]
};

std::vector<Slide> slides() {
  std::vector<Slide> list;
  const Vec3 up = Vec3::UnitY();
  list.push_back({"plane in the plane",
                  geometry::make_plane({0, 0, 0}, up),
                  Analysis::plane_strain,
                  {100, 0, 0}});
  list.push_back({"plane about the axis",
                  geometry::make_plane({0, 0, 0}, up),
                  Analysis::axisymmetric,
                  {100, 0, 0}});
  list.push_back({"plane in space",
                  geometry::make_plane({0, 0, 0}, {0.1, 1, 0.2}),
                  Analysis::solid,
                  {100, -10, 0}});
  list.push_back({"cylinder",
                  geometry::make_cylinder({0, -5, 0}, {1, 0, 0}, 5.0, false),
                  Analysis::solid,
                  {100, 0, 0}});
  list.push_back({"bore",
                  geometry::make_cylinder({0, 5, 0}, {1, 0.1, 0}, 5.0, true),
                  Analysis::solid,
                  {100, 10, 0}});
  list.push_back({"cone",
                  geometry::make_cone({-20, -20, 0}, {1, 0, 0}, 0.7, false),
                  Analysis::solid,
                  {80, 67, 0}});
  return list;
}

TEST(WearFrame, shows_the_whole_volume_after_a_long_way) {
  Box body;
  body.add({0, 0, 0});
  body.add({4, 2, 3});
  std::vector<Slide> all = slides();
  for (Slide& slide : all) {
    contact::WearMap map(*slide.surface, slide.analysis, body);
    constexpr int n_increments = 200;
    for (int i = 1; i <= n_increments; ++i)
      for (const double x : {0.5, 1.5, 2.5}) // pieces of the workpiece
        map.add(piece_at(*slide.surface, slide.analysis,
                         Vec3(x, 0, 0) + i * slide.way / n_increments, slide.way / n_increments));
    contact::Tool tool;
    tool.surface = std::move(slide.surface);
    tool.wear = contact::PairWear{{1e-4, 8000.0}, {}};
    Box window; // the workpiece at the end
    window.add(body.low + slide.way);
    window.add(body.high + slide.way);
    SurfaceFrame frame;
    add_wear(map, tool, window, "mm", frame);
    constexpr double rounding = 1e-9;
    EXPECT_NEAR(volume(frame, slide.analysis), map.volume(), rounding * map.volume()) << slide.name;
    // And no more of an endless shape than that and what is near the workpiece.
    const Box drawn = box_of(frame.points);
    EXPECT_LT(drawn.size(), 2.5 * slide.way.norm()) << slide.name;
  }
}

} // namespace
} // namespace billet::io::wear_frame_test
