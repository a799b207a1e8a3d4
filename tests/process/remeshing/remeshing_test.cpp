// The part meshed anew in the midst of a run: what the run keeps, and what it says of it.

#include "geometry/surfaces/analytic_surfaces.h"
#include "mechanics/elements/mesh_locator.h"
#include "process/loop/process.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace billet::process::remeshing_test {
namespace {

std::string name_of(ElementKind kind, Analysis analysis) {
  return std::string(mechanics::name(kind)) +
         (analysis == Analysis::axisymmetric ? " axisymmetric" : " plane strain");
}

/// Looks at a process just before and just after each exchange of its mesh.
class Watcher final : public Observer {
public:
  explicit Watcher(std::function<void(const Run&)> before,
                   std::function<void(const Run&, const RemeshReport&)> after)
      : before_(std::move(before)), after_(std::move(after)) {}
  void remeshing(const Run& process) override { before_(process); }
  void remeshed(const Run& process, const RemeshReport& report) override {
    after_(process, report);
  }

private:
  std::function<void(const Run&)> before_;
  std::function<void(const Run&, const RemeshReport&)> after_;
};

// ------------------------------------------------------------------- budgets

void expect_whole_ledger(const FinishedRun& done, Index first_elements) {
  const std::span<const RemeshReport> ledger = done.process->view().state.record.remeshings;
  ASSERT_GE(ledger.size(), 3u);
  Index elements = first_elements;
  double time = 0.0;
  for (std::size_t i = 0; i < ledger.size(); ++i) {
    const RemeshReport& r = ledger[i];
    SCOPED_TRACE(i);
    EXPECT_EQ(r.number, static_cast<int>(i) + 1);
    EXPECT_GT(r.time, time);
    EXPECT_EQ(r.time, done.recorder.entries[as_size(r.increment) - 1].report.time);
    EXPECT_EQ(r.cause, "interval");
    EXPECT_EQ(r.elements[0], elements);
    EXPECT_GT(r.nodes[0], 0);
    EXPECT_GT(r.quality.before, 0.0);
    EXPECT_GT(r.quality.after, 0.4);
    EXPECT_GT(r.plastic_work.before, 0.0);
    EXPECT_LT(r.work_change(), 5e-3) << "the budget of RM-01";
    EXPECT_LT(r.mean_strain.change(), 5e-3);
    EXPECT_GT(r.largest_strain.before, r.mean_strain.before);
    // 0.3 % above it was found, in the corner where the billet folds over.
    EXPECT_LT(r.largest_strain.after, 1.01 * r.largest_strain.before);
    ASSERT_EQ(r.forces.size(), 1u);
    EXPECT_GT(r.forces[0].before, 0.0);
    EXPECT_GT(r.forces[0].after, 0.0);
    EXPECT_GT(r.residual, 0.0);
    EXPECT_TRUE(r.balanced);
    EXPECT_GT(r.returned, 0);
    EXPECT_GT(r.seconds, 0.0);
    elements = r.elements[1];
    time = r.time;
  }
  EXPECT_EQ(elements, done.process->view().mesh().n_elements());
  EXPECT_EQ(ledger.back().nodes[1], done.process->view().mesh().n_points());
  EXPECT_EQ(done.process->view().mesh().kind, ElementKind::tri6);
}

TEST(Remeshing, KeepsTheVolumeAndFillsItsLedger) {
  for (const Analysis analysis : {Analysis::axisymmetric, Analysis::plane_strain})
    for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4}) {
      const std::string name = name_of(kind, analysis);
      SCOPED_TRACE(name);
      // On 6 x 6 or 8 x 8 a mesh falls on the moment when the side folds over: 1.4 %.
      Upsetting u = billet(kind, 7, 0.3, contact::Sticking{});
      u.analysis = analysis;
      const FinishedRun done = run(remeshed(std::move(u), every(0.9)));
      ASSERT_EQ(done.status, RunStatus::done);
      expect_whole_ledger(done, 49);
      double most = 0.0, sum = 0.0, jump = 0.0, work = 0.0;
      for (const RemeshReport& r : done.process->view().state.record.remeshings) {
        most = std::max(most, r.volume.change());
        sum += r.volume.change();
        jump = std::max(jump, r.force_jump());
        work = std::max(work, r.work_change());
      }
      std::printf("%s: %zu remeshings, volume %.1e at most, %.1e in all; plastic work %.1e, force "
                  "%.1e\n",
                  name.c_str(), done.process->view().state.record.remeshings.size(), most, sum,
                  work, jump);
      EXPECT_LT(sum, 1e-8) << "RM-01 allows 1e-4 a remeshing";
      EXPECT_LT(jump, 0.01) << "the budget";
      EXPECT_LT(work, 0.005) << "the budget";
    }
}

TEST(Remeshing, ComplainsOfWhatIsBeyondTheBudget) {
  RemeshReport report;
  report.number = 2;
  report.volume = {100.0, 100.005};
  report.plastic_work = {100.0, 100.4};
  report.forces = {{100.0, 99.1}, {1.0, 0.5}};
  report.balanced = true;
  EXPECT_TRUE(report.complaints().empty()) << "half of a force that hardly acts is little";
  EXPECT_NEAR(report.force_jump(), 0.009, 1e-12);
  report.volume.after = 100.02;
  report.plastic_work.after = 99.0;
  report.forces[0].after = 97.0;
  ASSERT_EQ(report.complaints().size(), 3u);
  EXPECT_EQ(
      report.complaints()[0],
      "warning: [remeshing-changed] remeshing 2 changed the volume by 0.02 %, more than 0.01 %");
  report.balanced = false;
  EXPECT_NE(report.complaints()[2].find("not followed by equilibrium"), std::string::npos);
  EXPECT_EQ((RemeshReport::Pair{0.0, 0.0}.change()), 0.0);
  report.plastic_work = {7e-70, 9e-70}; // the state begins where the tool first touched
  report.work_of_run = 1e4;
  EXPECT_LT(report.work_change(), 1e-60);
  report.plastic_work = {2.0, 1.8};
  EXPECT_NEAR(report.work_change(), 0.02, 1e-15) << "of 10";
  report.plastic_work = {100.0, 99.0};
  EXPECT_NEAR(report.work_change(), 0.01, 1e-15);
  EXPECT_EQ(RemeshReport{}.work_change(), 0.0);
}

// ---------------------------------------------------- the same run otherwise

TEST(Remeshing, GivesTheForceAndTheBulgeOfTheBilletThatIsNot) {
  for (const int n : {6, 8}) {
    const auto scene = [n] {
      Scene s = upsetting_scene(billet(ElementKind::quad8, n, 0.3, contact::Sticking{}));
      s.landing_times = {0.15 * billet_height};
      return s;
    };
    const FinishedRun plain = run(scene());
    Scene with = scene();
    with.remesh = every(0.9);
    const FinishedRun done = run(std::move(with));
    ASSERT_EQ(done.status, RunStatus::done);
    for (const double reduction : {0.15, 0.3}) {
      const Entry& a = plain.at(reduction * billet_height);
      const Entry& b = done.at(reduction * billet_height);
      const double force = b.loads[0].force.norm(), radius = largest_position(b, 2, 0);
      const double force_off = force / a.loads[0].force.norm() - 1.0;
      const double radius_off = radius / largest_position(a, 2, 0) - 1.0;
      std::printf("%d x %d at %.0f %%: F = %.2f kN (%+.2f %% of the run without), R = %.4f "
                  "(%+.3f %%)\n",
                  n, n, 100.0 * reduction, force / 1e3, 100.0 * force_off, radius,
                  100.0 * radius_off);
      if (reduction == 0.15) {
        EXPECT_LT(std::abs(force_off), 0.01);
        EXPECT_LT(std::abs(radius_off), 0.002);
        continue;
      }
      // There the kept mesh has folded over and is 2.8 % (6 x 6) and 1.7 % above 20 x 20 elements.
      // VALIDATION FRM-06: 363.7 kN by two codes, 1.5 %; 12.546 with 20 x 20 quad8.
      EXPECT_NEAR(force, 363.7e3, 0.015 * 363.7e3);
      EXPECT_NEAR(radius, 12.546, 0.002 * 12.546);
    }
  }
}

TEST(Remeshing, LeavesAHomogeneousStateAlone) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4}) {
    const FinishedRun done =
        run(remeshed(billet(kind, 3, 0.3, contact::Frictionless{}), every(0.9)));
    ASSERT_EQ(done.status, RunStatus::done);
    ASSERT_GE(done.process->view().state.record.remeshings.size(), 3u);
    const double h = largest_position(done.last(), 2, 1), R = largest_position(done.last(), 2, 0);
    const double e = std::log(billet_height / h);
    const double exact = // FRM-01
        100.0 * std::numbers::pi * (700.0 + 300.0 * e) / (1.0 + 300.0 / 200e3) * billet_height / h;
    const double force = done.last().loads[0].force[1] / exact - 1.0;
    double low = 1e300, high = 0.0, off = 0.0;
    for (const mechanics::PointState& state : done.process->view().model.bulk->states()) {
      low = std::min(low, state.plastic_strain);
      high = std::max(high, state.plastic_strain);
    }
    // Displacements go on from mesh to mesh: origins are linear in the present place.
    const std::span<const double> x = done.process->view().positions(),
                                  x0 = done.process->view().state.origins;
    for (std::size_t i = 0; i < x.size(); i += 2)
      off = std::max({off, std::abs(x0[i] - x[i] * 10.0 / R),
                      std::abs(x0[i + 1] - x[i + 1] * billet_height / h)});
    std::printf("%s: force %+.1e, plastic strain %.7f to %.7f, origins %.1e off\n",
                std::string(mechanics::name(kind)).c_str(), force, low, high, off);
    // The boundary is put onto the die, by the penetration: 4e-5 of an element. Four times that
    // was found to leave 1.3e-5, 1.2e-4 and 4e-5.
    EXPECT_LT(std::abs(force), 3e-5);
    EXPECT_LT(high - low, 3e-4 * high);
    EXPECT_LT(off, 1e-4 * billet_height);
  }
}

TEST(Remeshing, IsFinerWhereTheRateOfFlowVaries) { // (P.22)
  const auto elements = [](const contact::Friction& friction) {
    const FinishedRun done =
        run(remeshed(billet(ElementKind::quad8, 6, 0.2, friction), every(0.9)));
    EXPECT_EQ(done.status, RunStatus::done);
    return done.process->view().state.record.remeshings.back().elements[1];
  };
  const Index even = elements(contact::Frictionless{}), uneven = elements(contact::Sticking{});
  std::printf("new mesh of a billet: %d elements without friction, %d sticking\n", even, uneven);
  EXPECT_GT(uneven, 1.2 * even); // 100 to 92 without: by the shape alone
}

/// Mean over the contact surface of what its points have slid, and of what they have worn [mm].
struct OnSurface {
  double sliding = 0.0;
  double worn = 0.0;
};

OnSurface on_surface(const Run& process) {
  const std::vector<contact::PointResult> results = contact::point_results(*process.contact());
  std::vector<double> areas(results.size());
  process.model.surface->areas(process.state.x, areas);
  const std::vector<double> depth = process.model.wear->workpiece_depth();
  OnSurface mean;
  double area = 0.0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    mean.sliding += areas[k] * results[k].sliding;
    mean.worn += areas[k] * depth[k];
    area += areas[k];
  }
  return {mean.sliding / area, mean.worn / area};
}

Scene sliding_billet(int n = 6) {
  Scene scene = upsetting_scene(billet(ElementKind::quad8, n, 0.2, contact::Coulomb{0.1}));
  scene.tools[0].wear = contact::PairWear{{1e-4, 8000.0}, contact::Archard{1e-3, 2000.0}};
  return scene;
}

TEST(Remeshing, CarriesSlidingAndWearOn) {
  constexpr int n = 10;
  const FinishedRun plain = run(sliding_billet(n));
  Scene scene = sliding_billet(n);
  scene.remesh = every(0.6);
  Process process(std::move(scene));
  Recorder recorder;
  OnSurface before;
  double worn_before = 0.0;
  Watcher watcher(
      [&](const auto& p) {
        before = on_surface(p);
        worn_before = p.model.wear->map(0)->volume();
      },
      [&](const auto& p, const RemeshReport& r) {
        const OnSurface after = on_surface(p);
        std::printf("remeshing %d: slid %.6f -> %.6f, worn %.4e -> %.4e\n", r.number,
                    before.sliding, after.sliding, before.worn, after.worn);
        // The first time, when only the rim has slid, 3.0 and 3.9 % were found, later below 1 %.
        EXPECT_NEAR(after.sliding, before.sliding, 0.05 * before.sliding);
        EXPECT_NEAR(after.worn, before.worn, 0.05 * before.worn);
        EXPECT_EQ(p.model.wear->map(0)->volume(), worn_before) << "tools keep what they have lost";
      });
  std::vector<double> wear, workpiece;
  ASSERT_EQ(process.run({&recorder, &watcher}), RunStatus::done);
  ASSERT_GE(process.view().state.record.remeshings.size(), 3u);
  double friction = 0.0;
  for (const Entry& entry : recorder.entries) {
    EXPECT_GE(entry.report.energy.friction, friction);
    friction = entry.report.energy.friction;
  }
  // 0.6 and 0.4 % were found; the mesh kept is 1 % above one of 20 x 20 elements.
  const double volume = process.view().model.wear->map(0)->volume();
  const double plain_volume = plain.process->view().model.wear->map(0)->volume();
  std::printf("worn %.6e (without %.6e), friction %.6g (%.6g)\n", volume, plain_volume, friction,
              plain.process->view().state.energy.friction);
  EXPECT_NEAR(volume, plain_volume, 0.01 * plain_volume);
  EXPECT_NEAR(friction, plain.process->view().state.energy.friction, 0.01 * friction);
}

TEST(Remeshing, LetsDisplacementsAndEnergiesGoOn) {
  const FinishedRun plain = run(sliding_billet());
  Scene scene = sliding_billet();
  scene.remesh = every(0.6);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& with = done.process->view();
  const auto& without = plain.process->view();
  const mechanics::MeshLocator locator(without.mesh(), without.positions());
  double most = 0.0;
  const std::span<const double> x = with.positions();
  for (std::size_t i = 0; i < x.size(); i += 2) {
    std::array<double, 2> origin{};
    mechanics::interpolate(without.mesh(), locator.locate(Vec3(x[i], x[i + 1], 0.0)),
                           without.state.origins, origin);
    most = std::max(
        most, std::hypot(origin[0] - with.state.origins[i], origin[1] - with.state.origins[i + 1]));
  }
  double external = 0.0, plastic = 0.0;
  for (const Entry& entry : done.recorder.entries) {
    EXPECT_GT(entry.report.energy.external, external);
    EXPECT_GE(entry.report.energy.plastic, plastic);
    external = entry.report.energy.external;
    plastic = entry.report.energy.plastic;
  }
  std::printf("origins %.1e of the stroke off; balance %.1e (without %.1e); plastic work %.7g "
              "(%.7g)\n",
              most / 3.0, with.state.energy.error(), without.state.energy.error(), plastic,
              without.state.energy.plastic);
  EXPECT_LT(most, 0.02 * 3.0);
  EXPECT_LT(with.state.energy.error(), 5e-3);
  EXPECT_NEAR(plastic, without.state.energy.plastic, 2e-3 * plastic);
}

TEST(Remeshing, TellsItsObserversBeforeAndAfter) {
  Process process(remeshed(billet(ElementKind::quad8, 4, 0.2, contact::Sticking{}), every(0.9)));
  int about_to = 0, done = 0;
  Watcher watcher(
      [&](const auto& p) {
        EXPECT_EQ(about_to++, done);
        EXPECT_EQ(static_cast<int>(p.state.record.remeshings.size()), done);
        EXPECT_EQ(p.mesh().kind, done == 0 ? ElementKind::quad8 : ElementKind::tri6);
      },
      [&](const auto& p, const RemeshReport& report) {
        EXPECT_EQ(++done, about_to);
        EXPECT_EQ(report.number, done);
        EXPECT_EQ(report.time, p.state.time);
        EXPECT_EQ(p.mesh().n_elements(), report.elements[1]);
        EXPECT_EQ(p.positions().size(), 2 * as_size(p.mesh().n_points()));
        EXPECT_EQ(p.state.origins.size(), p.positions().size());
        EXPECT_EQ(p.state.velocity.size(), p.positions().size());
        EXPECT_EQ(p.state.plastic_rate.size(), p.model.bulk->states().size());
        EXPECT_EQ(contact::point_results(*p.contact()).size(), p.model.surface->n_points());
      });
  ASSERT_EQ(process.run({&watcher}), RunStatus::done);
  EXPECT_GE(done, 3);
  EXPECT_EQ(about_to, done);
}

/// What a round punch touches first in the increments that follow an exchange of the mesh.
class FirstTouches final : public Observer {
public:
  struct Touch {
    double share;    ///< of the increment
    double by_speed; ///< what it is by the velocity that the new mesh has taken over
  };
  FirstTouches(double radius, double speed) : radius_(radius), speed_(speed) {}
  void remeshed(const Run& process, const RemeshReport&) override {
    velocity_.resize(process.model.surface->n_points());
    process.model.surface->positions(process.state.velocity, velocity_);
    history_ = process.contact()->state().tools[0].committed.history;
  }
  void incremented(const Run& process, const IncrementReport& report) override {
    for (const contact::ClosedPoint& at : process.contact()->closed()[0])
      if (const double gap = at.from.norm() - radius_;
          !velocity_.empty() && at.pressure_old == 0.0 && gap > 0.0) {
        const Vec3 way = report.dt * (velocity_[at.point] + Vec3(0, speed_, 0));
        const double off = history_[at.point].added();
        const double deep = std::max(0.0, radius_ - off - (at.from + way).norm());
        touches.push_back({at.touching, deep / (gap + off + deep)});
      }
    velocity_.clear();
  }
  std::vector<Touch> touches;

private:
  double radius_, speed_;
  std::vector<Vec3> velocity_; ///< of the contact points; empty: the mesh is not new
  std::vector<contact::PointHistory> history_; ///< of the contact points
};

TEST(Remeshing, ForetellsFirstTouchByTheMotionBeforeTheBalance) {
  // The balance moves points by hair's breadths in next to no time: that is no speed to go by.
  constexpr double radius = 6.0;
  Upsetting u = billet(ElementKind::quad4, 10, 0.2, contact::Coulomb{0.2});
  u.analysis = Analysis::plane_strain;
  Scene scene = remeshed(std::move(u), every(0.2));
  contact::Tool& punch = scene.tools[0];
  punch.surface = geometry::make_circle(Vec3::Zero(), radius, false);
  punch.motion.place.translation = Vec3(0.0, billet_height + radius, 0.0);
  Process process(std::move(scene));
  FirstTouches seen(radius, 1.0);
  ASSERT_EQ(process.run({&seen}), RunStatus::done);
  int rubbed = 0;
  for (const auto& [share, by_speed] : seen.touches) {
    std::printf("%.3f of the increment\n", share);
    EXPECT_NEAR(share, by_speed, 1e-9);
    rubbed += share > 0.05 && share < 0.95 ? 1 : 0;
  }
  EXPECT_GE(rubbed, 3) << "neither all of the increment nor nothing of it";
}

// ------------------------------------------------------ threads and units

TEST(Remeshing, IsTheSameToTheBitForAnyNumberOfThreads) {
  const auto results = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Scene scene = sliding_billet();
    scene.remesh = every(0.9);
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.status, RunStatus::done);
    std::vector<double> all(done.process->view().positions().begin(),
                            done.process->view().positions().end());
    for (const Entry& entry : done.recorder.entries)
      all.insert(all.end(),
                 {entry.loads[0].force[1], entry.report.energy.external, entry.report.residual});
    for (const RemeshReport& r : done.process->view().state.record.remeshings)
      all.insert(all.end(), {r.volume.after, r.plastic_work.after, r.residual, r.forces[0].after});
    return all;
  };
  EXPECT_EQ(results(1), results(2));
}

TEST(Remeshing, DoesNotDependOnTheUnits) {
  constexpr double tolerance = 1e-9; // 2e-10 was found: rounding, seen through Newton's tolerance
  const auto pressed = [](ElementKind kind, double mm, double MPa) {
    Upsetting u = billet(kind, 6, 0.2, contact::Coulomb{0.2});
    for (Vec3& p : u.mesh.points)
      p *= mm;
    u.height *= mm;
    u.material = {{200e3 * MPa, 0.3}, mechanics::Linear{700.0 * MPa, 300.0 * MPa}};
    Scene scene = remeshed(std::move(u), every(0.9));
    scene.tools[0].motion.velocity = Vec3(0.0, -mm, 0.0);
    scene.stages[0].end = 0.2 * billet_height;
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.process->view().state.record.remeshings.size(), 3u);
    std::vector<double> all;
    for (const double x : done.process->view().positions())
      all.push_back(x / (mm * billet_height));
    for (const Entry& entry : done.recorder.entries)
      all.push_back(entry.loads[0].force[1] / (MPa * mm * mm) / 1e5);
    return all;
  };
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4}) {
    const std::vector<double> reference = pressed(kind, 1.0, 1.0);
    for (const auto& [mm, MPa] : {std::pair{1e-3, 1e6}, {1e3, 1.0}}) {
      const std::vector<double> other = pressed(kind, mm, MPa);
      ASSERT_EQ(other.size(), reference.size());
      double most = 0.0;
      for (std::size_t i = 0; i < other.size(); ++i)
        most = std::max(most, std::abs(other[i] - reference[i]));
      std::printf("%s, mm = %g: %.1e off\n", std::string(mechanics::name(kind)).c_str(), mm, most);
      EXPECT_LT(most, tolerance);
    }
  }
}

// ------------------------------------------------- what hangs on the part

TEST(Remeshing, KeepsAPressureOnItsFaces) {
  const auto pressed = [](bool remesh) {
    Scene scene;
    scene.increments.max =
        0.0025; // what is solved again has others: their trapezoids must not tell
    scene.part.analysis = Analysis::axisymmetric;
    scene.part.mesh = mechanics::box_mesh(
        {ElementKind::quad8, Vec3::Zero(), Vec3(10, billet_height, 0), {3, 4, 1}, {1, 1, 1}});
    scene.material = billet_steel();
    scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0)};
    scene.part.loads.push_back(PressureOn{faces_on(scene.part.mesh, 1, billet_height),
                                          TimeFunction({{0.0, 0.0}, {1.0, 900.0}})});
    scene.stages.push_back({"press", 1.0, {}, false});
    if (remesh)
      scene.remesh = every(0.2);
    return run(std::move(scene));
  };
  const auto reaction = [](const FinishedRun& done) {
    double sum = 0.0;
    for (std::size_t i = 1; i < done.process->view().state.reactions.size(); i += 2)
      sum += done.process->view().state.reactions[i];
    return sum;
  };
  const FinishedRun plain = pressed(false), done = pressed(true);
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_GE(done.process->view().state.record.remeshings.size(), 3u);
  constexpr double rounding = 1e-7; // the state is homogeneous; Newton's tolerance remains
  const double R = largest_position(plain.last(), 2, 0);
  EXPECT_NEAR(largest_position(done.last(), 2, 0), R, rounding * R);
  EXPECT_NEAR(largest_position(done.last(), 2, 1), largest_position(plain.last(), 2, 1),
              rounding * billet_height);
  EXPECT_NEAR(reaction(done), 900.0 * std::numbers::pi * R * R, 1e-6 * reaction(done));
  EXPECT_NEAR(done.process->view().state.energy.external,
              plain.process->view().state.energy.external,
              1e-6 * plain.process->view().state.energy.external)
      << "work of loads on earlier meshes is kept";
}

TEST(Remeshing, CarriesTemperaturesOn) {
  Scene scene = upsetting_scene(billet(ElementKind::quad8, 6, 0.3, contact::Sticking{}));
  scene.material.heating = 0.25; // [degC/MPa]: steel at nine tenths of the work
  scene.remesh = every(0.9);
  const auto mean = [](const auto& p) {
    double sum = 0.0, volume = 0.0;
    for (std::size_t k = 0; k < p.model.bulk->volumes().size(); ++k) {
      sum += p.model.bulk->volumes()[k] * p.model.bulk->temperature(k);
      volume += p.model.bulk->volumes()[k];
    }
    return sum / volume;
  };
  Process process(std::move(scene));
  double before = 0.0;
  Watcher watcher([&](const auto& p) { before = mean(p); },
                  [&](const auto& p, const RemeshReport& r) {
                    std::printf("remeshing %d: %.4f -> %.4f degC\n", r.number, before, mean(p));
                    EXPECT_NEAR(mean(p), before, 3e-3 * (before - 20.0));
                  });
  ASSERT_EQ(process.run({&watcher}), RunStatus::done);
  ASSERT_GE(process.view().state.record.remeshings.size(), 3u);
  // Nine tenths of all plastic work is in the metal.
  const double volume = 100.0 * std::numbers::pi * billet_height;
  const double rise = 0.25 * process.view().state.energy.plastic / volume;
  std::printf("rise %.4f, of the work %.4f degC\n", mean(process.view()) - 20.0, rise);
  EXPECT_NEAR(mean(process.view()) - 20.0, rise, 5e-3 * rise);
}

TEST(Remeshing, TakesNothingForStabilizationThatDidNotMove) {
  // Two dies press a billet that no support holds along its axis.
  Scene scene = upsetting_scene(billet(ElementKind::quad8, 4, 0.2, contact::Coulomb{0.1}));
  scene.part.supports.pop_back();
  scene.tools.push_back(moving_tool("anvil", geometry::make_plane({0, 0, 0}, {0, 1, 0}),
                                    Vec3::Zero(), contact::Coulomb{0.1}));
  scene.touch = {1, 0};
  scene.part.contact_faces = faces_on(scene.part.mesh, 0, 0.0, true);
  scene.stages[0].tools = {1, 1};
  scene.remesh = every(0.6);
  Process process(std::move(scene));
  ASSERT_EQ(process.view().model.free_motions, 1);
  double before = 0.0;
  Watcher watcher([&](const auto& p) { before = p.state.energy.stabilization; },
                  [&](const auto& p, const RemeshReport&) {
                    EXPECT_GT(before, 0.0);
                    // Squares of steps: what is solved again in longer ones has more of it.
                    EXPECT_LT(p.state.energy.stabilization, 1.5 * before);
                  });
  ASSERT_EQ(process.run({&watcher}), RunStatus::done);
  EXPECT_GE(process.view().state.record.remeshings.size(), 3u);
}

} // namespace
} // namespace billet::process::remeshing_test
