// What contact takes over to the surface of a new mesh. (C.41)

#include "contact/term/contact_term.h"
#include "contact/wear/wear.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace billet::contact::change_surface_test {
namespace {

constexpr double rounding = 1e-10; // pressures of 1e3 from gaps of 1e-5 at coordinates of 1

/// A body 2 x 1 on a floor that it slides on; elements of several sizes.
ContactBench on_floor(mechanics::ElementKind kind, int along, int up, const Friction& friction) {
  mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3(1, 0, 0), Vec3(3, 1, 0), {along, up, 1}, {1, 1, 1}});
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool floor = still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), friction);
  floor.wear = PairWear{{1e-4, 8000.0}, Archard{1e-3, 2000.0}};
  return ContactBench(std::move(mesh), mechanics::Analysis::plane_strain, bench_material(),
                      one_tool(std::move(floor)), {Form::mixed, 100.0, 10.0}, faces);
}

/// Places of the nodes after a motion that is a function of the first place.
std::vector<double> moved(const ContactBench& bench, const std::function<Vec2(double)>& by) {
  std::vector<double> x = flat_positions(bench.mesh);
  for (std::size_t i = 0; i < x.size(); i += 2) {
    const Vec2 u = by(x[i]);
    x[i] += u[0];
    x[i + 1] += u[1];
  }
  return x;
}

/// Between which two points of the old surface those of the new one lie, by their places along it.
std::vector<PointSource> sources_between(const ContactBench& old, const ContactBench& anew) {
  std::vector<Vec3> from(old.surface.n_points()), to(anew.surface.n_points());
  old.surface.positions(old.x, from);
  anew.surface.positions(anew.x, to);
  std::vector<std::size_t> order(from.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return from[a][0] < from[b][0]; });
  std::vector<PointSource> sources;
  for (const Vec3& p : to) {
    std::size_t i = 0;
    while (i + 2 < order.size() && from[order[i + 1]][0] < p[0])
      ++i;
    const double a = from[order[i]][0], b = from[order[i + 1]][0];
    sources.push_back(
        PointSource::between(order[i], order[i + 1], std::clamp((p[0] - a) / (b - a), 0.0, 1.0)));
  }
  return sources;
}

/// A body that has been pressed down, more to the right, and slid; and a new mesh of it that lies
/// `deep` in the floor.
struct Exchange {
  explicit Exchange(mechanics::ElementKind kind,
                    const std::function<double(double)>& pressed,
                    double deep,
                    const Friction& friction = Coulomb{0.3},
                    mechanics::ElementKind onto = mechanics::ElementKind::tri6)
      : old(on_floor(kind, 3, 2, friction)), anew(on_floor(onto, 4, 3, friction)) {
    for (const double slid : {0.0, 0.02, 0.05})
      old.commit(moved(old, [&](double x) { return Vec2(slid, -pressed(x)); }), old.time_old + 1.0);
    start(deep);
  }
  /// The new body begins where the old one is.
  void start(double deep) {
    anew.x = moved(anew, [&](double) { return Vec2(0.05, -deep); });
    anew.time_old = old.time_old;
    anew.term.start(anew.x, anew.time_old);
    sources = sources_between(old, anew);
    anew.term.go_on_from(snapshot(old.term.state()), {sources, anew.x, anew.time_old});
  }
  /// The mean over the two sources of a quantity of points.
  [[nodiscard]] double between(std::size_t k,
                               const std::function<double(const PointResult&)>& of) const {
    const auto results = point_results(old.term);
    const PointSource& source = sources[k];
    return source.weights[0] * of(results[source.points[0]]) +
           source.weights[1] * of(results[source.points[1]]);
  }

  ContactBench old;
  ContactBench anew;
  std::vector<PointSource> sources;
};

double pressed_more_to_the_right(double x) { return 1e-4 * (1.0 + 0.5 * x); }

TEST(ChangeOfSurface, CarriesPressureShearAndSlidingOver) {
  for (const auto kind :
       {mechanics::ElementKind::quad8, mechanics::ElementKind::quad4, mechanics::ElementKind::tri6})
    for (const double deep : {0.0, 5e-5, -5e-5}) { // on the floor, in it, above it
      Exchange on(kind, pressed_more_to_the_right, deep);
      ASSERT_NE(on.anew.surface.penalty().normal, on.old.surface.penalty().normal);
      on.anew.assemble(on.anew.x, on.anew.time_old + 1.0); // stands still
      const auto results = point_results(on.anew.term);
      for (std::size_t k = 0; k < results.size(); ++k) {
        SCOPED_TRACE(k);
        const double p = on.between(k, [](const PointResult& r) { return r.pressure; });
        EXPECT_NEAR(results[k].pressure, p, rounding * p);
        EXPECT_NEAR(results[k].shear[0],
                    on.between(k, [](const PointResult& r) { return r.shear[0]; }), rounding * p);
        EXPECT_LT(results[k].shear[0], -0.29 * p) << "it has slid to the right";
        EXPECT_NEAR(results[k].sliding,
                    on.between(k, [](const PointResult& r) { return r.sliding; }), rounding);
        EXPECT_GT(results[k].sliding, 0.04);
      }
    }
}

TEST(ChangeOfSurface, LetsPointsSlideOnAtTheirLimit) {
  Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, 0.0);
  std::vector<double> x = on.anew.x;
  for (std::size_t i = 0; i < x.size(); i += 2)
    x[i] += 1e-3;
  on.anew.assemble(x, on.anew.time_old + 1.0);
  for (const PointResult& result : point_results(on.anew.term)) {
    EXPECT_EQ(result.status, Status::slip);
    EXPECT_NEAR(result.shear[0], -0.3 * result.pressure, rounding * result.pressure);
  }
}

TEST(ChangeOfSurface, LetsTheOffsetFadeWithTheWay) {
  constexpr double deep = 5e-5;
  // Along the floor, which is frictionless: first by less than the offsets, then by more.
  for (const double step : {1e-5, 1.0}) {
    // Onto linear faces, which are not corrected for pressure oscillation.
    Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, deep, Coulomb{0.3},
                mechanics::ElementKind::quad4);
    const double stiffness = on.anew.surface.penalty().normal;
    std::vector<double> offsets;
    on.anew.assemble(on.anew.x, on.anew.time_old + 1.0);
    for (std::size_t k = 0; k < on.anew.surface.n_points(); ++k)
      offsets.push_back(deep - trial_traction(on.anew.term, 0, k).pressure / stiffness);
    std::vector<double> x = on.anew.x;
    for (int increment = 0; increment < 8; ++increment) {
      for (std::size_t i = 0; i < x.size(); i += 2)
        x[i] += step;
      for (int tries = 0; tries < 3; ++tries) // that are not accepted change nothing
        on.anew.assemble(x, on.anew.time_old + 1.0);
      for (std::size_t k = 0; k < offsets.size(); ++k) {
        EXPECT_NEAR(trial_traction(on.anew.term, 0, k).pressure, stiffness * (deep - offsets[k]),
                    1e-9 * stiffness * deep);
        const double size = std::abs(offsets[k]);
        offsets[k] = std::copysign(std::max(0.5 * size, size - 0.25 * step), offsets[k]);
      }
      on.anew.commit(x, on.anew.time_old + 1.0);
    }
  }
}

TEST(ChangeOfSurface, LeavesNoOffsetToPointsThatHaveOpened) {
  Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, 5e-5);
  const std::vector<double> there = on.anew.x;
  std::vector<double> away = there;
  for (std::size_t i = 1; i < away.size(); i += 2)
    away[i] += 1e-2;
  on.anew.commit(away, on.anew.time_old + 1.0);
  EXPECT_EQ(on.anew.term.state().area, 0.0);
  on.anew.commit(there, on.anew.time_old + 1.0);
  const double own = on.anew.surface.penalty().normal * 5e-5;
  for (const PointResult& result : point_results(on.anew.term))
    EXPECT_NEAR(result.pressure, own, 1e-9 * own);
}

TEST(ChangeOfSurface, PressesNowhereThatWasOpen) {
  // Down on the right, up on the left: where the old points were open the new ones begin without
  // pressure though they lie in the floor; between an open and a closed one the nearer decides.
  const auto tilted = [](double x) { return 4e-4 * (x - 1.9); };
  Exchange on(mechanics::ElementKind::quad8, tilted, 5e-5);
  const auto old = point_results(on.old.term);
  on.anew.assemble(on.anew.x, on.anew.time_old + 1.0);
  const auto results = point_results(on.anew.term);
  int open = 0, closed = 0, ends = 0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const PointSource& source = on.sources[k];
    const PointResult& a = old[source.points[0]];
    const PointResult& b = old[source.points[1]];
    const PointResult& nearer = source.weights[1] < 0.5 ? a : b;
    if (nearer.pressure == 0.0) {
      EXPECT_EQ(results[k].pressure, 0.0);
      ++open;
    } else if (a.pressure == 0.0 || b.pressure == 0.0) {
      EXPECT_NEAR(results[k].pressure, nearer.pressure, rounding * nearer.pressure);
      ++ends;
    } else {
      ++closed;
    }
  }
  EXPECT_GT(open, 0);
  EXPECT_GT(closed, 0);
  EXPECT_EQ(open + closed + ends, static_cast<int>(results.size()));
}

TEST(ChangeOfSurface, ForgetsContactThatTheNewMeshIsFarFrom) {
  // A new boundary that is a twentieth of an element above the floor does not touch it.
  Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, -0.05 / 3.0);
  on.anew.assemble(on.anew.x, on.anew.time_old + 1.0);
  for (const PointResult& result : point_results(on.anew.term)) {
    EXPECT_EQ(result.pressure, 0.0);
    EXPECT_GT(result.sliding, 0.04) << "what it has slid is not forgotten";
  }
}

TEST(ChangeOfSurface, GoesOnWithSumsToolsAndPenalty) {
  Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, 0.0);
  EXPECT_GT(on.old.term.work().friction, 0.0);
  EXPECT_EQ(on.anew.term.work().friction, on.old.term.work().friction);
  EXPECT_EQ(on.anew.term.work().external, on.old.term.work().external);
  EXPECT_TRUE(lies_on(on.anew.term, 0));
  // A penalty that was raised to keep a limit stays raised.
  on.old.term.stiffen(4.0);
  on.old.commit(std::vector<double>(on.old.x), on.old.time_old + 1.0);
  on.start(0.0);
  EXPECT_EQ(on.anew.term.state().penalty.next, 4.0);
  // What tries that failed have softened does not: their mesh is gone.
  on.old.term.begin_with_stiffness(0.01);
  on.old.term.restart();
  on.start(0.0);
  EXPECT_EQ(on.anew.term.state().penalty.next, 4.0);
  on.old.term.activity().enable({0});
  on.start(0.0);
  EXPECT_FALSE(on.anew.term.acts(0, on.anew.time_old));
}

TEST(ChangeOfSurface, KeepsWhatIsWorn) {
  Exchange on(mechanics::ElementKind::quad8, pressed_more_to_the_right, 0.0);
  Wear wear(on.old.surface, on.old.tools, box_of(on.old.mesh.points));
  wear.add(on.old.term, on.old.x, on.old.time_old);
  const std::vector<double> before = wear.workpiece_depth();
  const double volume = wear.map(0)->volume(), worn = wear.workpiece(0)->volume;
  ASSERT_GT(volume, 0.0);
  wear.change_surface(on.anew.surface, on.sources);
  const std::vector<double> after = wear.workpiece_depth();
  ASSERT_EQ(after.size(), on.anew.surface.n_points());
  for (std::size_t k = 0; k < after.size(); ++k) {
    const PointSource& source = on.sources[k];
    const double mean =
        source.weights[0] * before[source.points[0]] + source.weights[1] * before[source.points[1]];
    EXPECT_NEAR(after[k], mean, rounding * mean);
  }
  EXPECT_EQ(wear.map(0)->volume(), volume);
  EXPECT_EQ(wear.workpiece(0)->volume, worn);
  // It goes on: the tool loses more as the new surface slides on.
  std::vector<double> x = on.anew.x;
  for (std::size_t i = 0; i < x.size(); i += 2)
    x[i] += 0.01;
  on.anew.commit(x, on.anew.time_old + 1.0);
  wear.add(on.anew.term, on.anew.x, on.anew.time_old);
  EXPECT_GT(wear.map(0)->volume(), volume);
  EXPECT_GT(wear.workpiece(0)->volume, worn);
}

} // namespace
} // namespace billet::contact::change_surface_test
