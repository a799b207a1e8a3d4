// When the part is meshed anew, and what becomes of a run where it cannot be.

#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "process/loop/process.h"
#include "process/remeshing/contact_zones.h"
#include "process/remeshing/part_boundary.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/remeshing_due.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>

namespace billet::process::remeshing_due_test {
namespace {

TEST(Remeshing, ComesForWhateverItIsToldTo) {
  const auto first_cause = [](const std::function<void(RemeshSettings&)>& change) -> std::string {
    RemeshSettings settings;
    settings.penetration = 1e3; // never
    change(settings);
    const FinishedRun done =
        run(remeshed(billet(ElementKind::quad8, 6, 0.3, contact::Sticking{}), settings));
    return done.process->view().state.record.remeshings.empty()
               ? ""
               : done.process->view().state.record.remeshings[0].cause;
  };
  EXPECT_EQ(first_cause([](RemeshSettings&) {}), "") << "a good mesh stays";
  EXPECT_EQ(first_cause([](RemeshSettings& s) { s.interval = 2.0; }), "interval");
  EXPECT_TRUE(first_cause([](RemeshSettings& s) { s.strain = 0.2; }).starts_with("plastic strain"));
  EXPECT_TRUE(
      first_cause([](RemeshSettings& s) { s.penetration = 0.01; }).starts_with("penetration"));
  Upsetting bad = billet(ElementKind::quad4, 4, 0.5, contact::Sticking{});
  RemeshSettings settings;
  settings.quality = 0.9; // no new mesh is that good: worn counts from where it began
  const FinishedRun done = run(remeshed(std::move(bad), settings));
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  double began = 1.0;
  for (const RemeshReport& r : done.process->view().state.record.remeshings) {
    if (r.cause.starts_with("element quality")) {
      EXPECT_LT(r.quality.before, 0.7 * began + 1e-12);
    }
    began = r.quality.after;
  }
}

TEST(Remeshing, AMeshThatIsNearlyDueDoesNotGoIntoAnIncrementThatRuinsIt) {
  const auto scene = [] {
    Scene s = upsetting_scene(billet(ElementKind::quad4, 6, 0.5, contact::Sticking{}));
    s.increments.first = s.increments.max = 0.5; // a fifteenth of the way
    return s;
  };
  const FinishedRun whole = run(scene());
  ASSERT_EQ(whole.status, RunStatus::done);
  const auto& entries = whole.recorder.entries;
  std::size_t last = 0; // before an increment that takes a fifth off
  while (last + 1 < entries.size() &&
         entries[last + 1].report.min_quality > 0.8 * entries[last].report.min_quality)
    ++last;
  ASSERT_LT(last + 1, entries.size());
  const double quality = entries[last].report.min_quality;
  const auto first_mesh = [&](double limit) {
    RemeshSettings settings;
    settings.quality = limit;
    settings.penetration = 1e3; // never
    Scene s = scene();
    s.remesh = settings;
    const FinishedRun done = run(std::move(s));
    return done.process->view().state.record.remeshings.empty()
               ? RemeshReport{}
               : done.process->view().state.record.remeshings[0];
  };
  const RemeshReport soon = first_mesh(quality / 1.05);
  EXPECT_EQ(soon.time, entries[last].report.time);
  EXPECT_NE(soon.cause.find("in the next increment"), std::string::npos) << soon.cause;
  const RemeshReport later = first_mesh(quality / 1.15);
  EXPECT_EQ(later.time, entries[last + 1].report.time) << "not nearly due";
}

/// A bar of radius 12 mm is pressed 0.1 mm deep into half a block of n x n elements.
Scene bar_on_block(int n, ElementKind kind = ElementKind::quad8, double mm = 1.0) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), mm * Vec3(12, 12, 0), {n, n, 1}, {1, 1, 1}});
  scene.material = billet_steel();
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0)};
  const double radius = 12.0 * mm;
  constexpr double depth = 0.1;
  scene.tools.push_back(
      moving_tool("bar", geometry::make_circle(Vec3(0, 12.0 * mm + radius, 0), radius, false),
                  -mm * Vec3::UnitY()));
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  scene.contact.form = contact::Form::compatible;
  scene.stages.push_back({"press", depth, {1}, false});
  scene.landing_times = {0.05, 0.075};
  return scene;
}

/// How far the force on the first tool is off at most at these times, relative to that of `fine`.
double
most_off(const FinishedRun& other, const FinishedRun& fine, std::initializer_list<double> times) {
  double most = 0.0;
  for (const double time : times)
    most = std::max(
        most, std::abs(other.at(time).loads[0].force[1] / fine.at(time).loads[0].force[1] - 1.0));
  return most;
}

TEST(Remeshing, FollowsAContactThatBeginsAsALine) {
  const FinishedRun kept = run(bar_on_block(8));
  const FinishedRun fine = run(bar_on_block(24));
  Scene scene = bar_on_block(8);
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  const RemeshReport& first = done.process->view().state.record.remeshings.front();
  EXPECT_EQ(first.cause, "bar comes to touch on 1 edge");
  EXPECT_EQ(first.increment, 0) << "before anything is out of place";
  EXPECT_TRUE(first.balanced);
  EXPECT_EQ(first.energy, 0.0);
  EXPECT_LE(done.process->view().state.record.remeshings.size(), 3u);
  EXPECT_TRUE(poorly_resolved_tools(*done.process).empty());
  EXPECT_TRUE(poorly_resolved_tools(*fine.process).empty());
  ASSERT_EQ(poorly_resolved_tools(*kept.process).size(), 1u);
  EXPECT_EQ(poorly_resolved_tools(*kept.process)[0].tool, 0);
  const double worst = most_off(done, fine, {0.05, 0.075, 0.1});
  const double worst_kept = most_off(kept, fine, {0.05, 0.075, 0.1});
  std::printf("  force off by %.1f %% with remeshing, %.1f %% on the mesh that is kept\n",
              100.0 * worst, 100.0 * worst_kept);
  EXPECT_LT(worst, 0.03);
  EXPECT_GT(worst_kept, 2.0 * worst);
}

TEST(Remeshing, ComesBeforeASecondToolTouchesOnAFewSides) {
  Scene scene = bar_on_block(8);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement = std::array{
      TimeFunction(0.0), TimeFunction({{0.0, 0.05}, {0.05, 0.0}, {0.1, -0.05}}), TimeFunction(0.0)};
  scene.tools.push_back(
      moving_tool("table", geometry::make_plane(Vec3(12, 0, 0), -Vec3::UnitX()), Vec3(-0.2, 0, 0)));
  scene.stages[0].tools = {1, 1};
  scene.landing_times.clear();
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  const RemeshReport& first = done.process->view().state.record.remeshings.front();
  EXPECT_EQ(first.cause, "bar comes to touch on 1 edge");
  EXPECT_GT(first.increment, 0);
  EXPECT_LE(first.time, 0.05);
  EXPECT_EQ(first.forces[0].after, 0.0) << "it touches nothing yet";
  EXPECT_LT(first.force_jump(), 0.01) << "the table presses on";
}

TEST(Remeshing, ResolvesAllThatComesToTouchAtOnce) {
  Scene scene = bar_on_block(8);
  constexpr double radius = 12.0;
  scene.tools.push_back(moving_tool(
      "side", geometry::make_circle(Vec3(12.0 + radius, 12.0, 0), radius, false), -Vec3::UnitX()));
  scene.stages[0].tools = {1, 1};
  scene.stages[0].end = 0.02;
  scene.landing_times.clear();
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& made = done.process->view().state.record.remeshings;
  ASSERT_FALSE(made.empty());
  EXPECT_EQ(made[0].increment, 0);
  EXPECT_EQ(std::count_if(made.begin(), made.end(),
                          [](const RemeshReport& r) {
                            return r.cause.ends_with("touch on 1 edge") ||
                                   r.cause.ends_with("touches on 1 edge");
                          }),
            1);
  EXPECT_TRUE(poorly_resolved_tools(*done.process).empty());
}

/// A punch, half 5 mm wide, with edges of radius 1.5 mm is pressed 1 mm deep into half a block of
/// n x n elements.
Scene punch_in_block(int n, ElementKind kind = ElementKind::quad8, double mm = 1.0) {
  Scene scene = bar_on_block(n, kind, mm);
  const double radius = 1.5 * mm, half_width = 5.0 * mm, height = 8.0 * mm;
  geometry::Profile profile;
  profile.start = Vec2(-2.0 * mm, 0.0);
  profile.segments = {{Vec2(half_width - radius, 0.0), 0.0},
                      {Vec2(half_width, radius), radius},
                      {Vec2(half_width, height), 0.0}};
  geometry::SurfacePtr punch = geometry::make_profile(profile);
  scene.tools[0] = moving_tool("punch", std::move(punch), -mm * Vec3::UnitY());
  scene.tools[0].motion.offset = Vec3(0, 12.0 * mm, 0);
  scene.stages[0].end = 1.0;
  scene.landing_times = {0.25, 0.5, 0.75};
  return scene;
}

TEST(Remeshing, ComesWhereSidesCutOffTheEdgeOfATool) {
  const FinishedRun kept = run(punch_in_block(8));
  const FinishedRun fine = run(punch_in_block(32));
  Scene scene = punch_in_block(8);
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  const RemeshReport& first = done.process->view().state.record.remeshings.front();
  EXPECT_EQ(first.cause, "punch turns by 34 degrees along an edge");
  EXPECT_LT(first.time, 0.05);
  const double worst = most_off(done, fine, {0.25, 0.5, 0.75, 1.0});
  const double worst_kept = most_off(kept, fine, {0.25, 0.5, 0.75, 1.0});
  std::printf("  %zu meshes, force off by %.2f %%, %.2f %% on the mesh that is kept\n",
              done.process->view().state.record.remeshings.size(), 100.0 * worst,
              100.0 * worst_kept);
  EXPECT_LE(done.process->view().state.record.remeshings.size(), 4u)
      << "a sharp edge is no reason for ever";
  EXPECT_LT(worst, 0.006);
  EXPECT_GT(worst_kept, 0.009);
}

/// Nodes of a new mesh that lay halfway between a point that touches and one that does not went
/// onto the tool or stayed by a hair: 341 elements in metres, 349 in millimetres.
TEST(Remeshing, AtTheEdgeOfAToolDoesNotDependOnTheUnits) {
  const auto pressed = [](double mm) {
    Scene scene = punch_in_block(8, ElementKind::quad4, mm);
    scene.remesh = RemeshSettings{};
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.status, RunStatus::done);
    std::vector<double> all;
    for (const RemeshReport& r : done.process->view().state.record.remeshings)
      all.insert(all.end(),
                 {static_cast<double>(r.elements[1]), r.time, r.forces[0].after / (mm * 5e3)});
    for (const Entry& entry : done.recorder.entries)
      all.push_back(entry.loads[0].force[1] / (mm * 5e3));
    return all;
  };
  const std::vector<double> reference = pressed(1.0);
  for (const double mm : {1e-3, 0.7}) {
    const std::vector<double> other = pressed(mm);
    ASSERT_EQ(other.size(), reference.size()) << mm;
    double most = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i)
      most = std::max(most, std::abs(other[i] - reference[i]));
    std::printf("mm = %g: %.1e off\n", mm, most);
    constexpr double tolerance = 1e-8; // rounding, seen through Newton's tolerance
    EXPECT_LT(most, tolerance) << mm;
  }
}

TEST(Remeshing, DoesNotFollowACornerForEver) {
  Scene scene = punch_in_block(8);
  geometry::Profile profile;
  profile.start = Vec2(-2.0, 0.0);
  profile.segments = {{Vec2(5.0, 0.0), 0.0}, {Vec2(5.0, 8.0), 0.0}};
  scene.tools[0] = moving_tool("punch", geometry::make_profile(profile), -Vec3::UnitY());
  scene.tools[0].motion.offset = Vec3(0, 12, 0);
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::done);
  const auto for_the_corner =
      std::count_if(done.process->view().state.record.remeshings.begin(),
                    done.process->view().state.record.remeshings.end(),
                    [](const RemeshReport& r) { return r.cause.ends_with("along an edge"); });
  EXPECT_GE(for_the_corner, 1);
  EXPECT_LE(for_the_corner, 2);
}

/// A wedge with a tip of radius 0.05 enters half a block of 12 x 12 elements of 1 mm.
Scene wedge_in_block(double half_angle) {
  Scene scene = bar_on_block(12);
  constexpr double radius = 0.05, length = 8.0;
  const double turn = 0.5 * std::numbers::pi - half_angle;
  const Vec2 end_of_tip(radius * std::sin(turn), radius * (1.0 - std::cos(turn)));
  geometry::Profile profile;
  profile.start = Vec2::Zero();
  profile.segments = {{end_of_tip, radius},
                      {end_of_tip + length * Vec2(std::cos(turn), std::sin(turn)), 0.0}};
  geometry::SurfacePtr wedge = geometry::make_profile(profile);
  scene.tools[0] = moving_tool("wedge", std::move(wedge), -Vec3::UnitY());
  scene.tools[0].motion.offset = Vec3(0, 12, 0);
  scene.stages[0].end = 0.3;
  scene.landing_times.clear();
  scene.remesh = RemeshSettings{};
  return scene;
}

TEST(Remeshing, FollowsASharpWedgeFromItsFirstTouchOn) {
  for (const double degrees : {20.0, 45.0}) {
    const FinishedRun done = run(wedge_in_block(degrees * std::numbers::pi / 180.0));
    ASSERT_EQ(done.status, RunStatus::done) << degrees;
    double worst = 1.0, largest = 0.0;
    for (const Entry& entry : done.recorder.entries)
      worst = std::min(worst, entry.report.min_quality);
    // The first mesh has not seen how metal flows round the tip, a side of it is stiff beneath it.
    for (const RemeshReport& r : done.process->view().state.record.remeshings)
      if (!r.cause.ends_with("presses with a corner"))
        largest = std::max(largest, r.force_jump());
      else
        EXPECT_LT(r.time, 0.02);
    std::printf(
        "  wedge of %.0f degrees to a side: %zu meshes, quality at least %.2f, force changed "
        "by at most %.1f %%\n",
        degrees, done.process->view().state.record.remeshings.size(), worst, 100.0 * largest);
    const RemeshReport& first = done.process->view().state.record.remeshings.front();
    EXPECT_EQ(first.cause, "wedge comes to touch on 1 edge");
    EXPECT_EQ(first.forces[0].before, 0.0);
    EXPECT_TRUE(done.process->view().state.record.refusals.empty());
    EXPECT_GT(worst, 0.05);
    EXPECT_LT(largest, 0.12); // 0.5 on sides of 0.25, on which the first new mesh was made before
  }
}

TEST(Remeshing, KeepsTheSizeAtAContactThatGrows) {
  // A round punch, whose contact grows from nothing to half of the block's face.
  Scene scene = bar_on_block(8);
  scene.tools[0] = moving_tool("punch", geometry::make_circle(Vec3(0.0, 24.0, 0.0), 12.0, false),
                               -Vec3::UnitY());
  scene.stages[0].end = 2.0;
  scene.landing_times.clear();
  scene.remesh = RemeshSettings{};
  scene.remesh->size_contact = 0.4;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& made = done.process->view().state.record.remeshings;
  const auto for_size = std::count_if(made.begin(), made.end(), [](const RemeshReport& r) {
    return r.cause == "contact on edges longer than 0.64";
  });
  EXPECT_GE(for_size, 1);
  EXPECT_LE(made.size(), 8u);
  EXPECT_LT(coarse_contact(*done.process), 0.5);
}

TEST(Remeshing, DoesNotFollowAContactThatShrinks) {
  Scene scene = bar_on_block(8);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement = std::array{
      TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {1.0, -1.0}, {2.0, 0.0}}), TimeFunction(0.0)};
  scene.stages[0].end = 1.2;
  scene.increments.max = 0.02;
  scene.landing_times.clear();
  for (int i = 0; i < 50; ++i) // on its way off the bar is seen on every length
    scene.landing_times.push_back(1.0 + 0.002 * i);
  scene.remesh = every(0.24); // coarser again as the contact grows
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  for (const RemeshReport& r : done.process->view().state.record.remeshings)
    EXPECT_TRUE(r.time <= 1.0 || !r.cause.starts_with("bar touches")) << r.time << ": " << r.cause;
  EXPECT_EQ(done.last().loads[0].force.norm(), 0.0) << "it has left";
}

TEST(Remeshing, ReplacesElementsThatAreDrawnOut) {
  Upsetting u = billet(ElementKind::quad8, 3, 0.9, contact::Frictionless{});
  RemeshSettings settings;
  settings.penetration = 1e3; // never
  const FinishedRun done = run(remeshed(std::move(u), settings));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  const RemeshReport& first = done.process->view().state.record.remeshings[0];
  EXPECT_TRUE(first.cause.starts_with("element aspect")) << first.cause;
  EXPECT_GT(first.quality.before, 0.99) << "of right angles";
  EXPECT_LT(first.force_jump(), 1e-3) << "a homogeneous state";
}

TEST(Remeshing, LeavesTheMeshOfMetalThatSpringsBack) {
  const auto scene = [] {
    Scene s = upsetting_scene(billet(ElementKind::quad8, 4, 0.4, contact::Sticking{}));
    const double pressed = s.stages[0].end, back = 0.05;
    const double speed = s.tools[0].motion.velocity->y();
    s.tools[0].motion.velocity.reset();
    s.tools[0].motion.displacement =
        std::array{TimeFunction(0.0),
                   TimeFunction({{0.0, 0.0},
                                 {pressed, pressed * speed},
                                 {(1.0 + back) * pressed, (1.0 - 0.1 * back) * pressed * speed}}),
                   TimeFunction(0.0)};
    s.stages.push_back(s.stages[0]);
    s.stages[1].end = (1.0 + back) * pressed;
    return s;
  };
  const FinishedRun kept = run(scene());
  ASSERT_EQ(kept.status, RunStatus::done);
  // So bad that the mesh is due when the tool turns back, and not sooner.
  RemeshSettings settings;
  settings.penetration = 1e3; // never
  double before = 1.0;
  for (const Entry& entry : kept.recorder.entries) {
    if (entry.report.time > scene().stages[0].end)
      break;
    if (settings.quality)
      before = *settings.quality;
    settings.quality = entry.report.min_quality;
  }
  settings.quality = 0.5 * (before + *settings.quality);
  ASSERT_LT(*settings.quality, 0.7) << "of the first mesh's 1";
  Scene again = scene();
  again.remesh = settings;
  const FinishedRun done = run(std::move(again));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_LT(done.last().report.min_quality, *settings.quality);
  EXPECT_TRUE(done.process->view().state.record.remeshings.empty())
      << done.process->view().state.record.remeshings[0].cause;
}

TEST(Remeshing, AsksMoreOfSquaresThanOfTriangles) {
  RemeshSettings settings;
  EXPECT_EQ(least_quality(settings, ElementKind::tri6), 0.2);
  EXPECT_EQ(least_quality(settings, ElementKind::tet10), 0.2);
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8, ElementKind::hex20})
    EXPECT_EQ(least_quality(settings, kind), 0.35);
  settings.quality = 0.1;
  EXPECT_EQ(least_quality(settings, ElementKind::hex8), 0.1);
  EXPECT_EQ(least_quality(settings, ElementKind::tri6), 0.1);
}

/// A frictionless die that is suddenly fast: no increment as long as they are by then, nor two of
/// the tries that follow, is short enough for its strain.
Scene sudden_billet() {
  Scene scene = upsetting_scene(billet(ElementKind::quad8, 3, 0.6, contact::Frictionless{}));
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement = std::array{
      TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {1.0, -0.15}, {1.005, -9.0}, {2.0, -9.0}}),
      TimeFunction(0.0)};
  scene.stages[0].end = 2.0;
  scene.increments.first = scene.increments.max = 1.0;
  return scene;
}

TEST(Remeshing, AnswersFailedIncrements) {
  Scene scene = sudden_billet();
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  EXPECT_EQ(done.process->view().state.record.remeshings[0].cause, "failed increments");
  EXPECT_LE(done.process->view().state.record.remeshings[0].time, 1.0 + 0.005);
  // The tries that failed have softened the contact. Those on the old mesh must not soften that of
  // the new one: an increment was taken with a face half an element deep and an eighth of the
  // force.
  for (const Entry& entry : done.recorder.entries) {
    if (entry.report.time < 1.0)
      continue; // all of it flows from then on at the latest
    const double h = largest_position(entry, 2, 1), e = std::log(billet_height / h);
    const double exact =
        100.0 * std::numbers::pi * (700.0 + 300.0 * e) / (1.0 + 300.0 / 200e3) * billet_height / h;
    EXPECT_NEAR(entry.loads[0].force[1], exact, 2e-3 * exact) << entry.report.time;
    EXPECT_LT(entry.report.penetration_share, 0.05);
  }
}

TEST(Remeshing, AtTheBeginningOfAStageBalancesWhereItIs) {
  Scene scene = sudden_billet();
  scene.stages.insert(scene.stages.begin(), scene.stages[0]);
  scene.stages[0].end = 1.0;
  scene.remesh = RemeshSettings{};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_FALSE(done.process->view().state.record.remeshings.empty());
  const RemeshReport& first = done.process->view().state.record.remeshings[0];
  EXPECT_EQ(first.time, 1.0);
  EXPECT_EQ(first.again, 0) << "what other tools did is not solved again with those of this stage";
  EXPECT_TRUE(first.balanced);
  EXPECT_LT(first.force_jump(), 1e-3) << "a homogeneous state";
}

TEST(Remeshing, ThatIsNotPossibleLeavesTheRunAsItWas) {
  RemeshSettings tiny = every(0.9);
  tiny.size = tiny.size_min = tiny.size_max = 1e-4; // more than ten million triangles
  const FinishedRun plain =
      run(upsetting_scene(billet(ElementKind::quad8, 4, 0.2, contact::Sticking{})));
  const FinishedRun done =
      run(remeshed(billet(ElementKind::quad8, 4, 0.2, contact::Sticking{}), tiny));
  EXPECT_EQ(done.status, RunStatus::done);
  EXPECT_TRUE(done.process->view().state.record.remeshings.empty());
  EXPECT_EQ(done.last().positions, plain.last().positions) << "to the bit";

  Scene scene = sudden_billet();
  scene.remesh = tiny;
  scene.increments.min = 0.05;
  const FinishedRun ended = run(std::move(scene));
  EXPECT_EQ(ended.status, RunStatus::not_converged);
  ASSERT_EQ(ended.recorder.failures.size(), 1u);
  EXPECT_NE(ended.recorder.failures[0].reason.find("; the part could not be meshed anew: "),
            std::string::npos)
      << ended.recorder.failures[0].reason;
  EXPECT_EQ(ended.process->view().mesh().kind, ElementKind::quad8);
}

} // namespace
} // namespace billet::process::remeshing_due_test
