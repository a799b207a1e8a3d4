#include "contact/wear/wear.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::contact::wear_test {
namespace {

constexpr PairWear law{{1e-4, 8000.0}, Archard{1e-3, 2000.0}};

/// A body on a floor, with wear.
struct WearBench {
  WearBench(const BodyKind& body, const Friction& friction, Form form = Form::mixed)
      : mesh(bench_mesh(body)), faces(faces_at(mesh, 1, 0.0)), bench(mesh,
                                                                     body.analysis,
                                                                     bench_material(),
                                                                     one_tool(floor(friction)),
                                                                     {form, 1.0, 1.0},
                                                                     faces),
        wear(bench.surface, bench.tools, box_of(mesh.points)) {}
  static Tool floor(const Friction& friction) {
    Tool tool = still_tool(geometry::make_plane(Vec3::Zero(), Vec3::UnitY()), friction);
    tool.wear = law;
    return tool;
  }
  /// Moves the whole body and accepts that.
  void move(const Vec3& by) {
    std::vector<double> x = bench.x;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += by[static_cast<Eigen::Index>(i) % mesh.dimension()];
    bench.commit(x, bench.time_old + 1.0);
    wear.add(bench.term, bench.x, bench.time_old);
  }
  [[nodiscard]] double volume() const { return wear.map(0)->volume(); }

  mechanics::Mesh mesh;
  std::vector<mechanics::Face> faces;
  ContactBench bench;
  Wear wear;
};

TEST(Wear, is_the_contact_integral_for_every_element) {
  for (const BodyKind& body : body_kinds())
    for (const Form form : {Form::mixed, Form::compatible}) {
      WearBench on(body, Frictionless{}, form);
      on.move({0, -1e-3, 0});
      const double pressure = point_results(on.bench.term)[0].pressure;
      const double area = on.bench.term.state().area;
      const double before = on.volume();
      on.move({0, 0, 0});
      EXPECT_EQ(on.volume(), before) << "nothing has slid";
      const bool radial = body.analysis == mechanics::Analysis::axisymmetric;
      if (radial) // its areas grow on the way
        continue;
      on.move({0.5, 0, 0});
      const double depth = law.tool.depth(pressure * 0.5);
      EXPECT_NEAR(on.volume() - before, depth * area, 1e-12 * depth * area) << body.name();
      const WorkpieceWear& workpiece = *on.wear.workpiece(0);
      for (const double worn : workpiece.depth)
        EXPECT_NEAR(worn, law.workpiece->depth(pressure * 0.5), 1e-12 * worn);
      EXPECT_NEAR(workpiece.volume, law.workpiece->depth(pressure * 0.5) * area,
                  1e-12 * workpiece.volume);
    }
}

TEST(Wear, is_even_beneath_a_body_that_slides_evenly) {
  // 2 x 1 slid by 3 in steps: between the starting and the last place every place has seen 2 of
  // way.
  for (const BodyKind& body :
       {body_kinds()[1], body_kinds()[4], body_kinds()[5], body_kinds()[8]}) {
    WearBench on(body, Frictionless{});
    on.move({0, -1e-3, 0});
    const double pressure = point_results(on.bench.term)[0].pressure;
    for (int i = 0; i < 30; ++i)
      on.move({0.1, 0, 0});
    const double expected = law.tool.depth(pressure * 2.0);
    double least = 1e300, most = 0.0;
    for (const WearCell& cell : on.wear.map(0)->cells()) {
      const Vec3 at = cell.shape.middle();
      const bool inside = !body.solid() || (at[2] > 0.15 && at[2] < 0.85);
      if (inside && at[0] > 3.25 && at[0] < 3.75) {
        least = std::min(least, cell.depth);
        most = std::max(most, cell.depth);
      }
    }
    std::printf("%-20s depth %.4e to %.4e, expected %.4e\n", body.name().c_str(), least, most,
                expected);
    EXPECT_NEAR(least, expected, 0.02 * expected) << body.name();
    EXPECT_NEAR(most, expected, 0.02 * expected) << body.name();
  }
}

TEST(Wear, is_none_while_a_point_sticks) {
  for (const Friction& friction : {Friction(Sticking{}), Friction(Coulomb{0.5})}) {
    WearBench on(body_kinds()[4], friction);
    on.move({0, -1e-3, 0});
    on.move({1e-5, 0, 1e-5});
    on.move({-1e-5, 0, 0});
    ASSERT_EQ(point_results(on.bench.term)[0].status, Status::stick);
    EXPECT_EQ(on.volume(), 0.0);
    EXPECT_EQ(on.wear.workpiece_depth(), std::vector<double>(on.bench.surface.n_points(), 0.0));
  }
}

TEST(Wear, counts_half_of_the_increments_at_its_ends_only_for_points_that_slide) {
  // Down on the floor while it moves on, on, and up again while it moves on. (W.10)
  for (const bool sticks : {false, true}) {
    WearBench on(body_kinds()[4], sticks ? Friction(Sticking{}) : Friction(Frictionless{}));
    on.move({0, 1e-2, 0});
    on.move({0.1, -1.1e-2, 0});
    EXPECT_EQ(on.volume(), 0.0) << "not known yet whether it slides";
    const double pressure = point_results(on.bench.term)[0].pressure;
    const double full = law.tool.depth(pressure * 0.1) * on.bench.term.state().area;
    on.move({sticks ? 1e-7 : 0.1, 0, 0});
    EXPECT_NEAR(on.volume(), sticks ? 0.0 : 1.25 * full, 1e-9 * full);
    on.move({0.1, 1.1e-2, 0});
    EXPECT_NEAR(on.volume(), sticks ? 0.0 : 1.5 * full, 1e-9 * full);
    on.move({0.1, 0, 0});
    EXPECT_NEAR(on.volume(), sticks ? 0.0 : 1.5 * full, 1e-9 * full) << "in the air";
  }
}

TEST(Wear, is_untouched_by_tries_that_are_refused) {
  const auto worn = [](bool with_tries) {
    WearBench on(body_kinds()[5], Coulomb{0.2});
    on.move({0, -1e-3, 0});
    for (int i = 0; i < 5; ++i) {
      std::vector<double> far = on.bench.x;
      for (double& value : far)
        value += 0.01 * i;
      if (with_tries)
        on.bench.assemble(far, on.bench.time_old + 2.0);
      on.move({0.05, -1e-5, 0.02});
    }
    return std::pair{on.volume(), on.wear.workpiece_depth()};
  };
  EXPECT_EQ(worn(true), worn(false)); // to the bit
  EXPECT_GT(worn(false).first, 0.0);
}

TEST(Wear, turns_with_the_tool) {
  // A roll turns by 90 degrees beneath a body that stands: the worn arc is a quarter of its
  // circumference and the length of contact.
  constexpr double radius = 4.0, quarter = std::numbers::pi / 2.0;
  mechanics::Mesh mesh = bench_mesh(body_kinds()[1]);
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool roll = still_tool(geometry::make_circle({2, -radius, 0}, radius, false), Frictionless{});
  roll.motion.rotation =
      geometry::Rotation{Vec3(2, -radius, 0), Vec3::UnitZ(), TimeFunction(quarter)};
  roll.wear = law;
  const Box box = box_of(mesh.points);
  ContactBench bench(std::move(mesh), mechanics::Analysis::plane_strain, bench_material(),
                     one_tool(std::move(roll)), {Form::mixed, 1.0, 1.0}, faces);
  Wear wear(bench.surface, bench.tools, box);
  std::vector<double> x = bench.x;
  for (std::size_t i = 1; i < x.size(); i += 2)
    x[i] -= 0.02;
  bench.commit(x, 0.0);
  double expected = 0.0, pressed = 0.0;
  const auto results = point_results(bench.term);
  std::vector<double> areas(results.size());
  bench.surface.areas(bench.x, areas);
  for (std::size_t k = 0; k < results.size(); ++k)
    pressed += results[k].pressure * areas[k];
  for (int step = 1; step <= 90; ++step) {
    bench.commit(x, step / 90.0);
    wear.add(bench.term, bench.x, bench.time_old);
    for (const ClosedPoint& at : bench.term.closed()[0])
      expected += law.tool.depth(at.pressure * at.slip) * at.area;
  }
  EXPECT_NEAR(wear.map(0)->volume(), expected, 1e-12 * expected);
  const double way = radius * quarter;
  EXPECT_NEAR(expected, law.tool.depth(pressed * way), 0.02 * expected); // chords, places inside
  double arc = 0.0;
  for (const WearCell& cell : wear.map(0)->cells())
    if (cell.depth > 0.0)
      arc += (cell.shape.corners()[1] - cell.shape.corners()[0]).norm();
  EXPECT_GT(arc, way);
  EXPECT_LT(arc, way + 2.0 + 0.5);
}

TEST(Wear, is_wanted_only_with_a_law) {
  std::vector<Tool> tools = one_tool(WearBench::floor(Frictionless{}));
  EXPECT_TRUE(Wear::wanted(tools));
  tools[0].wear.reset();
  EXPECT_FALSE(Wear::wanted(tools));
}

} // namespace
} // namespace billet::contact::wear_test
