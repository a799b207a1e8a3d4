#include "contact/term/contact_term.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

namespace billet::contact::contact_term_test {
namespace {

constexpr double rounding = 1e-12; // a few hundred units in the last place of sizes of order 1

ContactBench bench_on(const BodyKind& body, std::vector<Tool> tools, const ContactSettings& s) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = mechanics::boundary_faces(mesh);
  return ContactBench(std::move(mesh), body.analysis, bench_material(), std::move(tools), s, faces);
}

std::vector<double> moved(const ContactBench& bench, const Vec3& by) {
  std::vector<double> x = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += by[static_cast<Eigen::Index>(i % dim)];
  return x;
}

geometry::SurfacePtr floor_plane() { return geometry::make_plane({0, 0, 0}, {0, 1, 0}); }

constexpr BodyKind plane_quad8{mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain};
constexpr BodyKind solid_hex20{mechanics::ElementKind::hex20, mechanics::Analysis::solid};

TEST(ContactTerm, GivesNoForceAcrossAGapAndKpTimesDepthBeyondIt) {
  // VALIDATION CON-08: a gap of 1e-9 and a penetration of 1e-9; bottom area 2.
  ContactBench bench = bench_on(plane_quad8, one_tool(still_tool(floor_plane(), Coulomb{0.3})),
                                {Form::mixed, 100.0, 10.0});
  bench.commit(moved(bench, {0, 1e-9, 0}), 1.0);
  EXPECT_EQ(bench.force().norm(), 0.0);
  EXPECT_EQ(bench.term.state().area, 0.0);
  bench.commit(moved(bench, {0, -2e-9, 0}), 2.0);
  const double exact = bench.surface.penalty().normal * 1e-9 * 2.0;
  constexpr double digits = 1e-6; // 1e-9 has that many as a difference of coordinates of order 1
  EXPECT_NEAR(bench.term.loads()[0].force[1], -exact, digits * exact);
  EXPECT_NEAR(bench.term.state().area, 2.0, rounding);
}

// (N.10)
TEST(ContactTerm, ResistsOnlyMorePenetrationSoftly) {
  for (const Form form : {Form::mixed, Form::compatible}) {
    ContactBench bench = bench_on(plane_quad8, one_tool(still_tool(floor_plane(), Coulomb{0.3})),
                                  {form, 100.0, 10.0});
    bench.commit(moved(bench, {0, -1e-6, 0}), 1.0);
    const Eigen::VectorXd pressed = bench.force();
    bench.softening = {1e-4, 1e-4};
    bench.assemble(bench.x, 2.0);
    EXPECT_LT((bench.force() - pressed).norm(), 1e-9 * pressed.norm()) << "nothing has moved";
    bench.assemble(moved(bench, {0, -1e-3, 0}), 2.0);
    const Eigen::VectorXd deeper = bench.force();
    // A thousand times deeper: 1 + 1e-4 * 1000 of the force, on the same area.
    EXPECT_NEAR(deeper.norm(), 1.1 * pressed.norm(), 1e-6 * pressed.norm());
    bench.softening = {};
    bench.assemble(moved(bench, {0, -1e-3, 0}), 2.0);
    EXPECT_NEAR(bench.force().norm(), 1001.0 * pressed.norm(), 1e-4 * pressed.norm());
  }
}

TEST(ContactTerm, FeelsBothOfTwoDiesAThousandthFromItsFlanks) {
  // VALIDATION CON-08. The body spans 1 <= x <= 3; it grows by 2e-3 to both sides.
  std::vector<Tool> dies;
  dies.push_back(still_tool(geometry::make_plane({0.999, 0, 0}, {1, 0, 0}), Frictionless{}));
  dies.push_back(still_tool(geometry::make_plane({3.001, 0, 0}, {-1, 0, 0}), Frictionless{}));
  ContactBench bench = bench_on(plane_quad8, std::move(dies), {Form::mixed, 100.0, 10.0});
  bench.assemble(bench.x, 0.5);
  EXPECT_EQ(bench.force().norm(), 0.0);
  std::vector<double> x = bench.x;
  for (std::size_t i = 0; i < x.size(); i += 2)
    x[i] += 2e-3 * (x[i] - 2.0);
  bench.commit(x, 1.0);
  const double left = bench.term.loads()[0].force[0], right = bench.term.loads()[1].force[0];
  EXPECT_GT(right, 0.0);
  EXPECT_NEAR(left, -right, 1e-9 * right); // depth 1e-3 of coordinates of order 1
}

TEST(ContactTerm, LetsAPointTouchTwoToolsInACorner) {
  std::vector<Tool> walls;
  walls.push_back(still_tool(floor_plane(), Frictionless{}));
  walls.push_back(still_tool(geometry::make_plane({1, 0, 0}, {1, 0, 0}), Frictionless{}));
  ContactBench bench = bench_on(plane_quad8, std::move(walls), {Form::mixed, 100.0, 10.0});
  bench.commit(moved(bench, {-0.5, -0.3, 0}), 1.0);
  const auto results = point_results(bench.term);
  std::vector<Vec3> points(results.size());
  bench.surface.positions(bench.x, points);
  const double Kp = bench.surface.penalty().normal;
  int both = 0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const double deep = std::max(0.0, -points[k][1]), aside = std::max(0.0, 1.0 - points[k][0]);
    EXPECT_NEAR(results[k].pressure, Kp * (deep + aside), rounding * Kp);
    both += deep > 0.0 && aside > 0.0 ? 1 : 0;
  }
  EXPECT_GT(both, 0) << "points in the corner carry the sum of both pressures";
  EXPECT_LT(bench.term.loads()[0].force[1], 0.0);
  EXPECT_LT(bench.term.loads()[1].force[0], 0.0);
}

TEST(ContactTerm, ReportsLoadsEqualAndOppositeToTheForcesOnTheNodes) {
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> component(-2e-3, 2e-3);
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench =
        bench_on(body, one_tool(still_tool(floor_plane(), Coulomb{0.3})), {Form::mixed, 10.0, 5.0});
    bench.tools[0].reference = Vec3(0.3, -0.2, 0.1);
    for (double time = 1.0; time < 4.0; time += 1.0) {
      std::vector<double> x = moved(bench, {0.01, -0.003, 0.0});
      for (double& coordinate : x)
        coordinate += component(generator);
      bench.commit(x, time);
    }
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    const int dim = bench.mesh.dimension();
    for (mechanics::Index a = 0; a < bench.mesh.n_points(); ++a) {
      Vec3 p = Vec3::Zero(), f = Vec3::Zero();
      for (int d = 0; d < dim; ++d) {
        p[d] = bench.x[as_size(a * dim + d)];
        f[d] = bench.force()[a * dim + d];
      }
      force += f;
      torque += (p - bench.tools[0].reference).cross(f);
    }
    const ToolLoad& load = bench.term.loads()[0];
    EXPECT_LT(load.force[1], 0.0) << body.name();
    if (body.analysis == mechanics::Analysis::axisymmetric) {
      EXPECT_EQ(load.force[0], 0.0) << "radial forces cancel around the turn";
      EXPECT_EQ(load.torque, Vec3::Zero());
      EXPECT_NEAR(load.force[1], -force[1], rounding * force.norm());
    } else {
      EXPECT_NEAR((load.force + force).norm(), 0.0, rounding * force.norm()) << body.name();
      EXPECT_NEAR((load.torque + torque).norm(), 0.0, 10.0 * rounding * force.norm());
      EXPECT_NE(load.force[0], 0.0) << "friction acts";
    }
  }
}

TEST(ContactTerm, ForgetsFrictionWhereAPointHasLifted) {
  ContactBench bench = bench_on(plane_quad8, one_tool(still_tool(floor_plane(), Coulomb{0.5})),
                                {Form::mixed, 100.0, 10.0});
  bench.commit(moved(bench, {0, -1e-3, 0}), 1.0);
  bench.commit(moved(bench, {1e-3, 0, 0}), 2.0);
  EXPECT_GT(bench.term.loads()[0].force[0], 0.0) << "the floor is dragged along";
  bench.commit(moved(bench, {0, 2e-3, 0}), 3.0);
  EXPECT_EQ(bench.term.loads()[0].force, Vec3::Zero());
  bench.commit(moved(bench, {0, -2e-3, 0}), 4.0);
  EXPECT_EQ(bench.term.loads()[0].force[0], 0.0) << "history was reset";
  EXPECT_LT(bench.term.loads()[0].force[1], 0.0);
  bench.commit(moved(bench, {1e-4, 0, 0}), 5.0);
  EXPECT_GT(bench.term.loads()[0].force[0], 0.0) << "and begins anew";
}

TEST(ContactTerm, RepeatsATrialToTheBitWhateverWasTriedBetween) {
  std::mt19937 generator(29);
  std::uniform_real_distribution<double> component(-0.01, 0.01);
  ContactBench bench =
      bench_on(solid_hex20, one_tool(still_tool(floor_plane(), Tresca{0.4, {}})), {});
  bench.commit(moved(bench, {0, -5e-3, 0}), 1.0);
  std::vector<double> first = bench.x;
  for (double& c : first)
    c += component(generator);
  const mechanics::System once = bench.assemble(first, 2.0);
  for (int i = 0; i < 5; ++i) {
    std::vector<double> other = moved(bench, {0, 0.1 * i, 0});
    bench.assemble(other, 2.0 + i);
  }
  const mechanics::System again = bench.assemble(first, 2.0);
  EXPECT_EQ(once.residual, again.residual);
  EXPECT_EQ(once.tangent.values, again.tangent.values);
}

TEST(ContactTerm, SkipsNoPointThatHasComeWithinReachOfATool) {
  // The search leaves out points that cannot have arrived yet; a fresh term asks about all of them.
  // Nothing else may tell them apart: no friction, no springs of the mixed form.
  const ContactSettings settings{Form::compatible, 100.0, 10.0};
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> component(-1.5, 1.5);
  const auto tools = [] {
    return one_tool(still_tool(geometry::make_sphere({0, -1, 0}, 1.5, false), Frictionless{}));
  };
  ContactBench old = bench_on(solid_hex20, tools(), settings);
  const ContactBench home = bench_on(solid_hex20, tools(), settings);
  int touching = 0;
  for (int i = 0; i < 60; ++i) {
    const std::vector<double> x =
        moved(home, {component(generator) - 2.0, component(generator) + 0.5, component(generator)});
    ContactBench fresh = bench_on(solid_hex20, tools(), settings);
    EXPECT_EQ(old.assemble(x, 1.0).residual, fresh.assemble(x, 1.0).residual);
    touching += old.force().norm() > 0.0 ? 1 : 0;
    if (i % 5 == 4)
      old.commit(x, 1.0);
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT(touching, 60);
}

TEST(ContactTerm, IgnoresToolsThatDoNotActNow) {
  ContactBench bench = bench_on(plane_quad8, one_tool(still_tool(floor_plane(), Sticking{})), {});
  const std::vector<double> x = moved(bench, {0, -1e-3, 0});
  bench.assemble(x, 1.0);
  EXPECT_GT(bench.force().norm(), 0.0);
  bench.tools[0].active_from = 2.0;
  bench.tools[0].active_to = 3.0;
  for (const double time : {1.0, 3.5}) {
    bench.assemble(x, time);
    EXPECT_EQ(bench.force().norm(), 0.0) << time;
  }
  bench.assemble(x, 2.5);
  EXPECT_GT(bench.force().norm(), 0.0);
  bench.term.activity().enable({0});
  bench.assemble(x, 2.5);
  EXPECT_EQ(bench.force().norm(), 0.0);
}

TEST(ContactTerm, ShowsWhatIsCommittedWhateverHasBeenTriedSince) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_on(body, one_tool(still_tool(floor_plane(), Coulomb{0.1})), {});
    bench.commit(moved(bench, {0, -1e-3, 0}), 1.0);
    bench.commit(moved(bench, {1e-2, 0, 0}), 2.0);
    const std::vector<PointResult> before = point_results(bench.term);
    EXPECT_TRUE(std::any_of(before.begin(), before.end(), [](const PointResult& p) {
      return p.status == Status::slip;
    })) << body.name();
    for (const Vec3& tried : {Vec3(0, -1.0, 0), Vec3(0, 1.0, 0)}) { // far too deep; off
      bench.assemble(moved(bench, tried), 3.0);
      const std::vector<PointResult> after = point_results(bench.term);
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(after[k].pressure, before[k].pressure);
        EXPECT_EQ(after[k].shear, before[k].shear);
        EXPECT_EQ(after[k].status, before[k].status);
        EXPECT_EQ(after[k].gap, before[k].gap);
      }
    }
  }
}

TEST(ContactTerm, HandsOverItsForcesWhenAToolIsReleased) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_on(body, one_tool(still_tool(floor_plane(), Sticking{})), {});
    bench.commit(moved(bench, {0, -1e-3, 0}), 1.0);
    bench.commit(moved(bench, {1e-3, 0, 0}), 2.0);
    EXPECT_GT(bench.term.work().stored, 0.0);
    EXPECT_FALSE(leaves(bench.term, 0, 3.0));
    bench.term.activity().enable({0});
    EXPECT_TRUE(leaves(bench.term, 0, 3.0));
    const Eigen::VectorXd before = bench.force();
    const std::vector<double> forces = bench.term.release(0);
    const Eigen::Map<const Eigen::VectorXd> released(forces.data(), before.size());
    EXPECT_LT((released - before).norm(), rounding * before.norm()) << body.name();
    EXPECT_EQ(bench.term.work().stored, 0.0);
    EXPECT_FALSE(leaves(bench.term, 0, 3.0)) << "it has left";
    bench.commit(bench.x, 3.0);
    EXPECT_EQ(bench.force().norm(), 0.0);
    EXPECT_EQ(bench.term.state().area, 0.0);
    EXPECT_EQ(bench.term.loads()[0].force, Vec3::Zero());
    for (const PointResult& point : point_results(bench.term)) {
      EXPECT_EQ(point.status, Status::open);
      EXPECT_EQ(point.pressure, 0.0);
    }
  }
}

} // namespace
} // namespace billet::contact::contact_term_test
