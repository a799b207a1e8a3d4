// The share of an increment in which a point that comes down on a tool rubs. (C.42)

#include "contact/term/contact_term.h"
#include "contact/wear/wear.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace billet::contact::first_touch_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double height = 0.3; ///< of the body above the floor [mm]

/// A body 2 x 1 above y = 0, over tools that may move.
ContactBench above(Tool floor) {
  mechanics::Mesh mesh = bench_mesh(body_kinds()[1]);
  for (Vec3& p : mesh.points)
    p[1] += height;
  const auto faces = faces_at(mesh, 1, height);
  return ContactBench(std::move(mesh), mechanics::Analysis::plane_strain, bench_material(),
                      one_tool(std::move(floor)), {Form::mixed, 1.0, 1.0}, faces);
}

Tool floor(const Friction& friction = Coulomb{0.3}) {
  Tool tool = still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), friction);
  tool.wear = PairWear{{1e-4, 8000.0}, Archard{1e-3, 2000.0}};
  return tool;
}

std::vector<double> moved(const ContactBench& bench, const Vec2& by) {
  std::vector<double> x = bench.x;
  for (mechanics::Index i = 0; i < bench.pattern.n_dofs(); ++i)
    x[as_size(i)] += by[i % 2];
  return x;
}

/// Bits of forces and tangent.
std::vector<double> all_of(const mechanics::System& system) {
  std::vector<double> all = system.residual;
  all.insert(all.end(), system.tangent.values.begin(), system.tangent.values.end());
  return all;
}

double shear_of(const ContactBench& bench) {
  double sum = 0.0;
  for (std::size_t k = 0; k < bench.surface.n_points(); ++k)
    sum += trial_traction(bench.term, 0, k).shear.norm();
  return sum;
}

TEST(FirstTouch, IsForetoldByTheWayOfATurningToolThatWasMovedToTouch) {
  constexpr double turn = 0.05, rise = 0.4;
  const Vec3 axis(2, -1, 0), offset(0.02, 0.1, 0);
  Tool table = floor();
  table.motion.rotation = geometry::Rotation{axis, Vec3::UnitZ(), TimeFunction(turn)};
  table.motion.velocity = Vec3(0.1, rise, 0);
  table.motion.offset = offset;
  ContactBench bench = above(std::move(table));
  bench.commit(bench.x, 1e-9); // it has stood still
  bench.commit(moved(bench, {0, -0.01}), 1.0);
  std::vector<Vec3> places(bench.surface.n_points());
  bench.surface.positions(moved(bench, {0, -0.01 * 1.0 / (1.0 - 1e-9)}), places);
  // By hand: the plane through the axis' foot, turned and shifted.
  const auto gap = [&](const Vec3& p, double time) {
    const Vec3 at = axis + offset + time * Vec3(0.1, rise, 0);
    const Vec3 n(-std::sin(turn * time), std::cos(turn * time), 0.0);
    return n.dot(p - at) - 1.0;
  };
  std::vector<Vec3> before(bench.surface.n_points());
  bench.surface.positions(bench.x, before);
  bench.term.predict(moved(bench, {0, -0.01 * 1.0 / (1.0 - 1e-9)}));
  const mechanics::Trial trial{1.0, 2.0, bench.x, bench.x};
  ASSERT_TRUE(bench.bulk.assemble(trial, bench.bulk_system).has_value());
  ASSERT_TRUE(bench.term.assemble(trial, bench.system).has_value());
  bench.term.commit(trial);
  ASSERT_EQ(bench.term.closed()[0].size(), bench.surface.n_points());
  for (const ClosedPoint& point : bench.term.closed()[0]) {
    const double first = gap(before[point.point], 1.0), last = gap(places[point.point], 2.0);
    ASSERT_LT(last, 0.0);
    if (first <= 0.0)
      EXPECT_EQ(point.touching, 1.0);
    else
      EXPECT_NEAR(point.touching, last / (last - first), rounding);
  }
}

TEST(FirstTouch, IsForetoldByTheWayOfADrivenToolUnlessItIsHeld) {
  constexpr double way = 0.4; // up, in the increment
  for (const bool held : {false, true}) {
    Tool ram = floor();
    ram.motion.force = geometry::Drive{Vec3::Zero(), Vec3::UnitY(), TimeFunction(1.0)};
    ContactBench bench = above(std::move(ram));
    bench.term.activity().hold(0, held);
    std::vector<double> x = bench.x;
    x.back() += way;
    bench.term.predict(x);
    bench.assemble(x, 1.0);
    bench.term.commit({0.0, 1.0, bench.x, x});
    ASSERT_EQ(bench.term.closed()[0].size(), bench.surface.n_points());
    for (const ClosedPoint& point : bench.term.closed()[0])
      EXPECT_NEAR(point.touching, held ? 0.0 : (way - height) / way, rounding);
  }
}

TEST(FirstTouch, IsThatOfTheTryWhateverWasTriedBefore) {
  const auto bits = [](const std::vector<double>& lengths) {
    ContactBench bench = above(floor(Sticking{}));
    bench.commit(moved(bench, {0, 0.05}), 1.0);
    std::vector<double> all;
    for (const double length : lengths) {
      bench.term.restart();
      bench.term.predict(moved(bench, {0.1 * length, -0.5 * length}));
      for (const double depth : {0.36, 0.9, 0.2, 0.352})
        all = all_of(bench.assemble(moved(bench, {0.01, -depth}), 1.0 + length));
      EXPECT_GT(shear_of(bench), 0.0);
    }
    return all;
  };
  EXPECT_EQ(bits({2.0, 1.0}), bits({1.0}));
  EXPECT_EQ(bits({1.0, 2.0}), bits({2.0}));
  EXPECT_NE(bits({1.0}), bits({2.0}));
}

TEST(FirstTouch, IsNoneWhereNothingIsForetold) {
  ContactBench bench = above(floor());
  const std::vector<double> pressed = moved(bench, {0.1, -height - 1e-3});
  bench.assemble(pressed, 1.0);
  EXPECT_EQ(shear_of(bench), 0.0) << "not told";
  bench.term.predict(pressed);
  bench.assemble(pressed, 1.0);
  EXPECT_GT(shear_of(bench), 0.0);
  bench.term.restart();
  bench.assemble(pressed, 1.0);
  EXPECT_EQ(shear_of(bench), 0.0) << "forgotten with the try";
  bench.term.predict(moved(bench, {0.1, -height + 1e-3}));
  bench.assemble(pressed, 1.0);
  EXPECT_EQ(shear_of(bench), 0.0) << "told to stay above";
}

TEST(FirstTouch, CountsFromWhereANewMeshHasLeftThePoint) {
  // Points that were open before it and lie in the tool on the new mesh touch without pressure.
  constexpr double deep = 5e-5, down = 1e-4;
  ContactBench old = above(floor()), anew = above(floor());
  old.commit(old.x, 1.0);
  for (const double sinks : {0.0, down}) {
    anew.x = moved(old, {0, -height - deep});
    anew.term.start(anew.x, 1.0);
    std::vector<PointSource> sources;
    for (std::size_t k = 0; k < anew.surface.n_points(); ++k)
      sources.push_back(PointSource::between(k, k, 0.0));
    anew.term.go_on_from(snapshot(old.term.state()), {sources, anew.x, 1.0});
    anew.term.predict(moved(anew, {0.01, -sinks}));
    const std::vector<double> pressed = moved(anew, {0.01, -1e-3});
    anew.assemble(pressed, 2.0);
    for (std::size_t k = 0; k < anew.surface.n_points(); ++k) {
      EXPECT_GT(trial_traction(anew.term, 0, k).pressure, 0.0);
      EXPECT_EQ(trial_traction(anew.term, 0, k).shear.norm() > 0.0, sinks > 0.0);
    }
  }
}

TEST(FirstTouch, WearsNothingTwice) {
  // A predicted touch that sticks has had its say: what slides in the next increment adds nothing
  // to it, as (W.10) does where the touch came by surprise.
  for (const bool predicted : {true, false}) {
    ContactBench bench = above(floor(Coulomb{0.9}));
    Wear wear(bench.surface, bench.tools, box_of(bench.mesh.points));
    const auto go = [&](const Vec2& by) {
      bench.commit(moved(bench, by), bench.time_old + 1.0);
      wear.add(bench.term, bench.x, bench.time_old);
    };
    if (predicted)
      go({0, 0.5 * height});
    go({0, predicted ? -height : -0.5 * height});
    if (!predicted)
      bench.velocity.assign(bench.velocity.size(), 0.0);
    go({1e-6, -0.5 * height - 1e-3});
    ASSERT_EQ(bench.term.closed()[0].front().touching > 0.0, predicted);
    ASSERT_EQ(wear.map(0)->volume(), 0.0) << "sticks";
    const double pressure = point_results(bench.term)[0].pressure;
    go({0.5, 0});
    ASSERT_GT(bench.term.closed()[0].front().slip, 0.0);
    const double full = bench.tools[0].wear->tool.depth(pressure) * bench.term.state().area;
    const double slid = full * bench.term.closed()[0].front().slip;
    EXPECT_NEAR(wear.map(0)->volume(), slid + (predicted ? 0.0 : 0.25 * full * 1e-6), 1e-9 * slid);
  }
}

} // namespace
} // namespace billet::contact::first_touch_test
