// WEA-01: the wear integral of Archard, Hansen and Bay against closed forms (VALIDATION,
// wea01_archard.csv), and what it may not depend on.

#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::process::contact_wear_test {
namespace {

using support::show;

constexpr double K = 1e-4, H = 8000.0;
constexpr double one_percent = 0.01; // VALIDATION's tolerance

contact::Tool worn(contact::Tool tool) {
  tool.wear = contact::PairWear{{K, H}, contact::Archard{K, H}, 1.0};
  return tool;
}

/// Mean depth of the cells whose middle lies between two places along x.
double mean_depth(const contact::WearMap& map, double low, double high) {
  double sum = 0.0, length = 0.0;
  for (const contact::WearCell& cell : map.cells()) {
    const double x = cell.shape.middle()[0];
    const double part = (cell.shape.corners()[1] - cell.shape.corners()[0]).norm();
    if (x > low && x < high) {
      sum += part * cell.depth;
      length += part;
    }
  }
  return sum / length;
}

/// An elastic block, its top kept straight and moved along x over a floor under a force per depth.
struct Sliding {
  double length = 4.0;
  int faces = 8;
  double radius = 0.0; ///< of the underside; 0: flat [mm]
  double force = 0.0;  ///< [N/mm]
  TimeFunction way{0.0};
  double end = 1.0;
};

Scene sliding_block(const Sliding& s) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh({ElementKind::quad4,
                                         Vec3(-0.5 * s.length, 0, 0),
                                         Vec3(0.5 * s.length, 0.5 * s.length, 0),
                                         {s.faces, s.faces / 2, 1},
                                         {1, 1, 1}});
  for (Vec3& p : scene.part.mesh.points)
    if (s.radius > 0.0)
      p[1] += p[0] * p[0] / (2.0 * s.radius) * (1.0 - 2.0 * p[1] / s.length);
  scene.material = elastic_body(200e3, 0.0);
  scene.part.supports.push_back({nodes_at(scene.part.mesh, 1, 0.5 * s.length), 0, s.way});
  scene.part.loads.emplace_back(PressureOn{faces_on(scene.part.mesh, 1, 0.5 * s.length),
                                           TimeFunction({{0.0, 0.0}, {1.0, s.force / s.length}})});
  scene.tools.push_back(
      worn(moving_tool("floor", geometry::make_plane({0, 0, 0}, {0, 1, 0}), Vec3::Zero())));
  scene.touch = {0};
  scene.part.contact_faces = faces_on(scene.part.mesh, 1, 0.5 * s.length, true);
  scene.stages.push_back({"slide", s.end, {1}, false});
  for (const auto& [t, v] : s.way.points())
    scene.landing_times.push_back(t);
  return scene;
}

TEST(ArchardWear, IsThatOfUniformSliding) {
  // p = 500 MPa over a way of 100 mm, to and fro: 6.25e-4 mm wherever contact never ends.
  std::vector<std::pair<double, double>> way{{0.0, 0.0}};
  for (int i = 0; i <= 100; ++i)
    way.emplace_back(1.0 + i, i % 2);
  const double end = way.back().first;
  Scene scene = sliding_block({.force = 500.0 * 4.0, .way = TimeFunction(way), .end = end});
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const contact::WearMap& map = *done.process->view().model.wear->map(0);
  constexpr double expected = 6.25e-4;
  const double tool = mean_depth(map, -0.5, 1.5);
  show("WEA-01", "uniform, tool [mm]", tool, expected);
  EXPECT_NEAR(tool, expected, one_percent * expected);
  for (const contact::WearCell& cell : map.cells())
    if (const double x = cell.shape.middle()[0]; x > -0.5 && x < 1.5) {
      EXPECT_NEAR(cell.depth, expected, one_percent * expected) << x;
    }
  std::size_t worn_points = 0; // two a face of the underside
  for (const double depth : done.process->view().model.wear->workpiece(0)->depth) {
    worn_points += depth > 0.0 ? 1 : 0;
    EXPECT_NEAR(depth, depth > 0.0 ? expected : 0.0, one_percent * expected);
  }
  EXPECT_EQ(worn_points, 16U);
}

TEST(ArchardWear, OfAPassDoesNotDependOnTheWidthOfContact) {
  // A round underside with 1000 N/mm: every place it passes wears by (K / H) F' = 1.25e-5 mm.
  constexpr double expected = 1.25e-5;
  for (const double radius : {100.0, 400.0}) {
    Sliding s{.length = 8.0, .faces = 40, .radius = radius, .force = 1000.0};
    s.way = TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {2.0, 8.0}});
    s.end = 2.0;
    const FinishedRun done = run(sliding_block(s));
    ASSERT_EQ(done.status, RunStatus::done);
    const contact::WearMap& map = *done.process->view().model.wear->map(0);
    const double half_width = 0.5 * done.last().report.contact_area;
    const double depth = mean_depth(map, half_width + 0.3, 8.0 - half_width - 0.3);
    show("WEA-01", fmt::format("Hertz pass, a = {:.2f} mm, tool [mm]", half_width), depth,
         expected);
    show("WEA-01", "  volume [mm^2]", map.volume(), 8.0 * expected);
    EXPECT_NEAR(depth, expected, one_percent * expected);
    EXPECT_NEAR(map.volume(), 8.0 * expected, one_percent * 8.0 * expected);
  }
}

TEST(ArchardWear, FollowsTheFlowOfAnUpsetBillet) {
  // Without friction the surface slides by r / 2 per unit of L = ln(h0 / h) past a place at r of
  // the die, pressed by the yield stress: w = (K / H) (r / 2) (s_y L + H' L^2 / 2), rigid-plastic.
  Scene scene = billet_scene(ElementKind::quad8, 20, 4, contact::Frictionless{}, 0.3);
  scene.tools[0] = worn(std::move(scene.tools[0]));
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const double L = -std::log(0.7);
  const double slope = K / H * 0.5 * (700.0 * L + 0.5 * 300.0 * L * L);
  for (const double r : {2.0, 4.0, 6.0, 8.0}) {
    const double depth = mean_depth(*done.process->view().model.wear->map(0), r - 0.5, r + 0.5);
    show("WEA-01", fmt::format("upsetting, die at r = {} mm [mm]", r), depth, slope * r);
    // A point's wear is spread evenly over its piece of the face, though it lies off the middle.
    EXPECT_NEAR(depth, slope * r, 2.0 * one_percent * slope * r);
  }
}

/// The billet between dies with Coulomb friction.
FinishedRun upset(double largest_increment, double unit = 1.0) {
  Upsetting u;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(10 * unit, 15 * unit, 0), {6, 8, 1}, {1, 1, 1}});
  u.height = 15.0 * unit;
  u.friction = contact::Coulomb{0.1};
  const double stress = 1.0 / (unit * unit); // newtons stay
  u.material = {{200e3 * stress, 0.3}, mechanics::Linear{700.0 * stress, 300.0 * stress}};
  u.reduction = 0.2;
  Scene scene = upsetting_scene(std::move(u));
  scene.tools[0].motion.velocity = Vec3(0, -unit, 0);
  scene.stages[0].end = 3.0;
  scene.increments = {largest_increment, {}, largest_increment};
  scene.tools[0].wear = contact::PairWear{{K, H * stress}, contact::Archard{K, H * stress}, 1.0};
  return run(std::move(scene));
}

TEST(ArchardWear, OfCoulombFrictionIsItsWork) {
  // Up to a hundredth of the way the stick stiffness stores what the last slide has paid (C.17).
  const FinishedRun done = upset(0.03);
  ASSERT_EQ(done.status, RunStatus::done);
  const double expected = K / H * done.process->view().state.energy.friction / 0.1;
  const double volume = done.process->view().model.wear->map(0)->volume();
  show("WEA-01", "volume, (K/H) friction work / mu [mm^3]", volume, expected);
  EXPECT_NEAR(volume, expected, one_percent * expected);
}

TEST(ArchardWear, DoesNotDependOnIncrements) {
  // What is left is the first increment: the trapezoidal rule is coarse where the pressure rises.
  const FinishedRun fine = upset(0.015);
  ASSERT_EQ(fine.status, RunStatus::done);
  const contact::WearMap& reference = *fine.process->view().model.wear->map(0);
  for (const double increment : {0.03, 0.06, 0.1}) {
    const FinishedRun coarse = upset(increment);
    ASSERT_EQ(coarse.status, RunStatus::done);
    const contact::WearMap& map = *coarse.process->view().model.wear->map(0);
    const auto what =
        fmt::format("{} increments, {} cut-backs", coarse.process->view().state.increment,
                    coarse.process->view().state.counters.cutbacks);
    show("WEA-01", what + ": volume [mm^3]", map.volume(), reference.volume());
    show("WEA-01", what + ": at r = 6 [mm]", mean_depth(map, 5, 7), mean_depth(reference, 5, 7));
    EXPECT_NEAR(map.volume(), reference.volume(), one_percent * reference.volume());
    EXPECT_NEAR(mean_depth(map, 5, 7), mean_depth(reference, 5, 7),
                one_percent * mean_depth(reference, 5, 7));
  }
}

TEST(ArchardWear, DoesNotDependOnUnits) {
  constexpr double rounding = 1e-9; // VALIDATION NUM-04
  const FinishedRun mm = upset(0.06);
  for (const double unit : {1e-3, 1e3}) {
    const FinishedRun other = upset(0.06, unit);
    const contact::WearMap& a = *mm.process->view().model.wear->map(0);
    const contact::WearMap& b = *other.process->view().model.wear->map(0);
    const double cube = unit * unit * unit;
    support::show_error("WEA-01", fmt::format("units times {}", unit),
                        std::abs(b.volume() / cube / a.volume() - 1.0), rounding);
    EXPECT_NEAR(b.volume() / cube, a.volume(), rounding * a.volume());
    EXPECT_EQ(a.cells().size(), b.cells().size());
    EXPECT_NEAR(b.deepest()->depth / unit, a.deepest()->depth, 1e-6 * a.deepest()->depth);
  }
}

} // namespace
} // namespace billet::process::contact_wear_test
