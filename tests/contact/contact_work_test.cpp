// Objectivity and energies of contact: a rigid motion of everything changes nothing; sliding only
// loses energy; the books balance.

#include "contact/term/contact_term.h"
#include "geometry/surfaces/profile.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace billet::contact::contact_work_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// x of every node rotated.
std::vector<double> rotated(const std::vector<double>& x, int dim, const geometry::Pose& pose) {
  std::vector<double> out(x.size());
  const auto n = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i < x.size(); i += n) {
    Vec3 p = Vec3::Zero();
    for (std::size_t d = 0; d < n; ++d)
      p[static_cast<Eigen::Index>(d)] = x[i + d];
    p = pose.to_space(p);
    for (std::size_t d = 0; d < n; ++d)
      out[i + d] = p[static_cast<Eigen::Index>(d)];
  }
  return out;
}

/// A body pressed on a ball (a roll in the plane) and sheared, all at time 0; the tool then turns
/// by `angle` until time 1.
struct Turning {
  Turning(const BodyKind& body, double angle)
      : Turning(body, angle, body.solid() ? Vec3(3, 1, -2) : Vec3(3, 1, 0)) {}
  Turning(const BodyKind& body, double angle, const Vec3& about)
      : point(about), axis(body.solid() ? Vec3(Vec3(1, 2, 2) / 3.0) : Vec3(Vec3::UnitZ())),
        bench(make(body, point, axis, angle)) {
    std::vector<double> x = bench.x;
    const int dim = bench.mesh.dimension();
    for (const Vec3& step : {Vec3(0, -0.02, 0), Vec3(2e-4, 0, 1e-4)}) {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += step[static_cast<Eigen::Index>(i) % dim];
      bench.commit(x, 0.0);
    }
  }
  static ContactBench make(const BodyKind& body, const Vec3& p, const Vec3& a, double angle) {
    mechanics::Mesh mesh = bench_mesh(body);
    const auto faces = faces_at(mesh, 1, 0.0);
    Tool tool = still_tool(body.solid() ? geometry::make_sphere({2, -4, 0.5}, 4.0, false)
                                        : geometry::make_circle({2, -4, 0}, 4.0, false),
                           Coulomb{0.5});
    tool.motion.rotation = geometry::Rotation{p, a, TimeFunction(angle)};
    return ContactBench(std::move(mesh), body.analysis, bench_material(), one_tool(std::move(tool)),
                        {Form::mixed, 1.0, 1.0}, faces);
  }
  Vec3 point, axis;
  ContactBench bench;
};

TEST(ContactObjectivity, KeepsStressesWhenToolAndBodyTurnTogetherInOneStep) {
  // VALIDATION CON-05 (the paper's Fig. 13): projecting the motion on the normal gives -d(1 - cos).
  constexpr double tolerance = 1e-10;
  for (const BodyKind& body : {body_kinds()[0], body_kinds()[1], body_kinds()[4], body_kinds()[5],
                               body_kinds()[6], body_kinds()[8]})
    for (const double angle : {1.0, 10.0, 45.0, 90.0}) {
      Turning turning(body, angle * degree);
      ContactBench& bench = turning.bench;
      const auto before = point_results(bench.term);
      const double friction = bench.term.work().friction;
      const geometry::Pose pose =
          geometry::rotation_about(turning.point, turning.axis, angle * degree);
      bench.commit(rotated(bench.x, bench.mesh.dimension(), pose), 1.0);
      const auto after = point_results(bench.term);
      double gap = 0.0, pressure = 0.0, shear = 0.0, most = 0.0;
      int stuck = 0;
      for (std::size_t k = 0; k < after.size(); ++k) {
        EXPECT_EQ(after[k].status, before[k].status);
        stuck += after[k].status == Status::stick ? 1 : 0;
        if (before[k].status == Status::open)
          continue;
        gap = std::max(gap, std::abs(after[k].gap - before[k].gap));
        pressure = std::max(pressure, std::abs(after[k].pressure - before[k].pressure));
        shear = std::max(shear, (after[k].shear - pose.rotation * before[k].shear).norm());
        most = std::max(most, before[k].pressure);
      }
      std::printf("%-20s %2.0f deg: gap %.1e, pressure %.1e, shear %.1e of it (<= 1e-10)\n",
                  body.name().c_str(), angle, gap, pressure / most, shear / most);
      EXPECT_GT(stuck, 0);
      EXPECT_LT(gap, tolerance);
      EXPECT_LT(pressure, tolerance * most);
      EXPECT_LT(shear, tolerance * most);
      EXPECT_NEAR(bench.term.work().friction, friction, tolerance * most);
    }
}

TEST(ContactObjectivity, TurnsStuckShearWithTheToolOverManySteps) {
  // 360 degrees in 24 steps: shear comes back to where it was.
  Turning turning(body_kinds()[5], 360.0 * degree);
  ContactBench& bench = turning.bench;
  const auto before = point_results(bench.term);
  const std::vector<double> x0 = bench.x;
  for (int step = 1; step <= 24; ++step) {
    const geometry::Pose pose =
        geometry::rotation_about(turning.point, turning.axis, 15.0 * step * degree);
    bench.commit(rotated(x0, 3, pose), step / 24.0);
  }
  const auto after = point_results(bench.term);
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_EQ(after[k].status, before[k].status);
    EXPECT_LT((after[k].shear - before[k].shear).norm(), 1e-9 * (1.0 + before[k].pressure));
  }
}

TEST(ContactWork, OfATurningRollIsThatOfItsTorqueWhateverTheAngle) {
  // The body stays: what the roll does is lost to friction or held by the springs against slip.
  constexpr double tolerance = 1e-12; // of the work
  for (const BodyKind& body : {body_kinds()[0], body_kinds()[1], body_kinds()[6]})
    for (const double angle : {0.01, 0.1, 0.33, 1.0}) {
      Turning turning(body, angle, {2, -4, 0}); // about its axis
      ContactTerm& contact = turning.bench.term;
      const ContactWork before = contact.work();
      turning.bench.commit(turning.bench.x, 1.0);
      const double done =
          contact.work().external - before.external + contact.work().unseen - before.unseen;
      const double lost = contact.work().friction - before.friction;
      const double held = contact.work().stored - before.stored;
      EXPECT_GT(lost, 0.0) << body.name();
      EXPECT_NEAR(done, lost + held, tolerance * lost) << body.name() << ", " << angle;
    }
}

/// A stiff block walks at random over a floor, pressed at random.
struct Walk {
  double min_dissipated = 0.0; ///< in one increment [N mm]
  double total = 0.0;          ///< friction work [N mm]
  double error = 0.0;          ///< external work against friction and stored, of the total
};

Walk random_walk(const Friction& law, double press_noise) {
  mechanics::Mesh mesh = bench_mesh(body_kinds()[4]);
  const auto faces = faces_at(mesh, 1, 0.0);
  ContactBench bench(std::move(mesh), mechanics::Analysis::solid, bench_material(),
                     one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), law)),
                     {Form::mixed, 1.0, 1.0}, faces);
  std::mt19937 generator(37);
  Walk walk;
  double height = -1e-3;
  for (int i = 1; i <= 400; ++i) {
    const double friction = bench.term.work().friction;
    const double before = height;
    height = -1e-3 * (1.0 + press_noise * random_vector(generator)[0]);
    const Vec3 step = 1e-3 * random_vector(generator);
    std::vector<double> x = bench.x;
    for (std::size_t k = 0; k < x.size(); k += 3) {
      x[k] += step[0];
      x[k + 1] += height - (i == 1 ? 0.0 : before);
      x[k + 2] += step[2];
    }
    bench.commit(x, i);
    walk.min_dissipated = std::min(walk.min_dissipated, bench.term.work().friction - friction);
  }
  walk.total = bench.term.work().friction;
  const ContactWork& work = bench.term.work();
  walk.error = std::abs(bench.entered + work.unseen - work.friction - work.stored) / bench.entered;
  return walk;
}

TEST(ContactWork, IsThatOfTheTorqueOnATurningTool) {
  // A body that rests on a roll turning a tenth of a radian an increment: all work is friction's.
  // By the chord of a material point alone the normal force would seem to do a sixth of it.
  mechanics::Mesh mesh = bench_mesh(body_kinds()[0]);
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool roll = still_tool(geometry::make_circle({2, -4, 0}, 4.0, false), Coulomb{0.3});
  roll.motion.rotation = geometry::Rotation{{2, -4, 0}, Vec3::UnitZ(), TimeFunction(0.1)};
  ContactBench bench(std::move(mesh), body_kinds()[0].analysis, bench_material(),
                     one_tool(std::move(roll)), {Form::mixed, 1.0, 1.0}, faces);
  std::vector<double> x = bench.x;
  for (std::size_t i = 1; i < x.size(); i += 2)
    x[i] -= 0.02;
  for (int i = 1; i <= 5; ++i)
    bench.commit(x, i);
  const ContactWork before = bench.term.work();
  for (int i = 6; i <= 15; ++i)
    bench.commit(x, i);
  const double external =
      bench.term.work().external - before.external + bench.term.work().unseen - before.unseen;
  const double friction = bench.term.work().friction - before.friction;
  std::printf("turning roll: external work %.6e, friction %.6e N mm\n", external, friction);
  EXPECT_GT(friction, 0.0);
  EXPECT_NEAR(external, friction, 5e-3 * friction); // the path is R sin(theta): -0.2 %
}

/// What moves when body and floor meet.
enum class Moves { body, floor };

/// Friction work of a body that comes down on a floor at a slant, or of a floor that comes up so,
/// in equal increments: 0.3 forward, 0.1 down, over the exact one.
double friction_of_a_landing(int increments, double share_in_the_air, Moves moves) {
  constexpr double mu = 0.2, forward = 0.3, down = 0.1;
  mechanics::Mesh mesh = bench_mesh(body_kinds()[0]);
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool floor = still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Coulomb{mu});
  if (moves == Moves::floor)
    floor.motion.displacement = {
        TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {2.0, -forward}, {3.0, -2.0 * forward}}),
        TimeFunction({{0.0, 0.0},
                      {1.0, -down * (1.0 + share_in_the_air)},
                      {2.0, -down * share_in_the_air},
                      {3.0, down * (1.0 - share_in_the_air)}}),
        TimeFunction(0.0)};
  ContactBench bench(std::move(mesh), body_kinds()[0].analysis, bench_material(),
                     one_tool(std::move(floor)), {Form::mixed, 1.0, 1.0}, faces);
  const auto go = [&](double dx, double dy, double dt) {
    std::vector<double> x = bench.x;
    for (std::size_t i = 0; i < x.size() && moves == Moves::body; i += 2) {
      x[i] += dx;
      x[i + 1] += dy;
    }
    bench.commit(x, bench.time_old + dt);
  };
  // Up and down again, to where it begins at the speed that it goes on with.
  go(0.0, down * (1.0 + share_in_the_air), 1.0);
  go(forward, -down, 1.0);
  for (int i = 0; i < increments; ++i)
    go(forward / increments, -down / increments, 1.0 / increments);
  const double depth = down * (1.0 - share_in_the_air);
  const double area = bench.term.state().area;
  const double pressure = bench.surface.penalty().normal * depth;
  const double exact = 0.5 * mu * pressure * forward * (1.0 - share_in_the_air) * area;
  // What the springs against slip hold is no friction work.
  return (bench.term.work().friction + bench.term.work().stored - 0.5 * pressure * depth * area) /
         exact;
}

TEST(ContactWork, OfFrictionBeginsWhereAPointTouches) {
  // (C.42). The pressure grows evenly from there, so the trapezoids are exact.
  for (const Moves moves : {Moves::body, Moves::floor})
    for (const double in_the_air : {0.0, 0.15, 0.5, 0.85})
      for (const int increments : {1, 2, 3, 10}) {
        const double found = friction_of_a_landing(increments, in_the_air, moves);
        EXPECT_NEAR(found, 1.0, 1e-3) << increments << " increments, in the air " << in_the_air;
      }
}

constexpr double mu_of_floor = 0.2;

/// A body on a floor whose friction is a fifth of the pressure.
ContactBench on_rubbing_floor(geometry::SurfacePtr floor) {
  mechanics::Mesh mesh = bench_mesh(body_kinds()[0]);
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool tool = still_tool(std::move(floor), Coulomb{mu_of_floor});
  return {std::move(mesh),           body_kinds()[0].analysis, bench_material(),
          one_tool(std::move(tool)), {Form::mixed, 1.0, 1.0},  faces};
}

/// Moves all of it in an increment.
void slide(ContactBench& bench, double dx, double dy) {
  std::vector<double> x = bench.x;
  for (std::size_t i = 0; i < x.size(); i += 2) {
    x[i] += dx;
    x[i + 1] += dy;
  }
  bench.commit(x, bench.time_old + 1.0);
}

TEST(ContactWork, OfFrictionGoesOnUntilAPointLeaves) {
  // A body slides off the rim of a floor under constant pressure, a point after the other: (C.18).
  constexpr double mu = mu_of_floor, depth = 0.001, rim = 3.05, step = 0.031;
  ContactBench bench = on_rubbing_floor(geometry::make_profile({Vec2(rim, 0), {{Vec2(-10, 0)}}}));
  slide(bench, 0.0, -depth);
  std::vector<Vec3> points(bench.surface.n_points());
  bench.surface.positions(bench.x, points);
  double way = 0.0; // over all points
  for (const Vec3& point : points)
    way += rim - point[0];
  const double area = bench.term.state().area / static_cast<double>(points.size());
  const double exact = mu * bench.surface.penalty().normal * depth * area * way;
  const double pressed = bench.entered;
  while (bench.term.state().area > 0.0)
    slide(bench, step, 0.0);
  const double found = bench.term.work().friction;
  std::printf("slid off: friction %.4e, exact %.4e, work of the nodes %.4e N mm\n", found, exact,
              bench.entered - pressed);
  EXPECT_NEAR(found, exact, 0.03 * exact); // points leave within increments
  EXPECT_NEAR(found, bench.entered - pressed + bench.term.work().unseen, 1e-9 * found);
}

TEST(ContactWork, OfASlideIsThatOfItsLimitHoweverOftenItTurns) {
  // One increment a way: a trapezoid from limit to limit sees nothing of a slide that turns, and
  // half of one that begins.
  constexpr double depth = 1e-3, way = 0.5;
  for (const double way_back : {way, -way}) {
    ContactBench bench = on_rubbing_floor(geometry::make_plane(Vec3::Zero(), Vec3::UnitY()));
    slide(bench, 0.0, -depth);
    const double limit = mu_of_floor * bench.surface.penalty().normal * depth *
                         bench.term.state().area; // of the shear, summed up
    double sign = 1.0;
    for (int i = 0; i < 6; ++i) {
      slide(bench, sign * way, 0.0);
      sign = way_back < 0.0 ? -sign : sign;
    }
    const double exact = limit * 6.0 * way;
    EXPECT_NEAR(bench.term.work().friction, exact, 0.03 * exact) << "turns " << (way_back < 0.0);
  }
}

TEST(ContactWork, NeverGainsFromFrictionAtConstantPressure) {
  for (const auto& [name, law] : every_law()) {
    const Walk walk = random_walk(law, 0.0);
    std::printf("%-22s friction work %.4e N mm, least in an increment %.2e, balance %.1e\n",
                name.c_str(), walk.total, walk.min_dissipated, walk.error);
    // Where the limit changes with speed or direction the trapezoids may count a little gain at a
    // turn: see the next test.
    const double dip = law.depends_on_slip() || law.tensor ? 2e-3 * walk.total : 0.0;
    EXPECT_GE(walk.min_dissipated, -dip - 1e-12 * (1.0 + walk.total)) << name;
    EXPECT_LT(walk.error, 1e-10) << name; // the trapezoidal ledger closes to rounding
  }
}

TEST(ContactWork, BalancesAtVaryingPressure) {
  // The ledger is the trapezoidal one, which closes to rounding. In an increment in which the limit
  // falls and the sliding turns back it may count a little gain; the law itself never gains
  // (InterfaceLaw.NeverGainsEnergyOnARandomWalk). The dip stays a small share of the total.
  constexpr double share = 0.01;
  for (const auto& [name, law] : every_law()) {
    const Walk walk = random_walk(law, 0.9);
    std::printf("%-22s friction work %.4e N mm, least in an increment %.2e, balance %.1e\n",
                name.c_str(), walk.total, walk.min_dissipated, walk.error);
    EXPECT_GE(walk.min_dissipated, -share * walk.total) << name;
    EXPECT_LT(walk.error, 1e-10) << name;
  }
}

} // namespace
} // namespace billet::contact::contact_work_test
