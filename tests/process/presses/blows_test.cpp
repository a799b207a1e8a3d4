// Hammers and screw presses: a ram with an energy strikes a part that is upset without friction,
// where the work is a closed form.

#include "process/loop/process.h"
#include "process/presses/blows.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace billet::process::blows_test {
namespace {

constexpr double height = 15.0;
constexpr double yield = 700.0, hardening = 300.0, young = 200e3; // [MPa]

/// A ram in place of the velocity of a die.
geometry::Drive ram(const geometry::Blow& blow, const Vec3& axis) {
  return {Vec3::Zero(), axis, TimeFunction(0.0), blow};
}

/// A bar under a ram; nothing of the penalty is
/// felt.
Scene struck(ElementKind kind, const mechanics::Material& material, const geometry::Blow& blow) {
  Upsetting u = bar_upsetting(kind);
  u.material = material;
  Scene scene = upsetting_scene(std::move(u));
  scene.contact.penalty = 1e5;
  scene.part.contact_faces = faces_on(scene.part.mesh, up(scene.part.analysis), height);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.force = ram(blow, -Vec3::Unit(up(scene.part.analysis)));
  scene.stages[0].end = 1.0;
  return scene;
}

double volume(const Scene& scene) {
  return scene.part.analysis == Analysis::solid ? 25.0 * height : std::numbers::pi * 25.0 * height;
}

double end_height(const FinishedRun& done) {
  const int dim = done.process->view().mesh().dimension();
  return largest_position(done.last(), dim, dim - 1);
}

/// Work over volume of upsetting a bar that has the plastic strain `before`, unloaded, on to a
/// plastic strain: Kirchhoff stress yield + hardening e_p, and its elastic energy.
double upsetting_work(double before, double strain) {
  const double tau = yield + hardening * strain;
  return tau * tau / (2.0 * young) + yield * (strain - before) +
         0.5 * hardening * (strain * strain - before * before);
}

/// The plastic strain to which that work leads.
double strain_of_work(double before, double work) {
  double low = before, high = before + 2.0;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (low + high);
    (upsetting_work(before, middle) < work ? low : high) = middle;
  }
  return low;
}

double loaded_height(double strain) {
  return height * std::exp(-strain - (yield + hardening * strain) / young);
}

TEST(Blow, stops_on_an_elastic_block_where_its_energy_is_stored) {
  // In one direction and without lateral strain the energy is V E/2 ln^2(h / h0).
  Scene scene = struck(ElementKind::quad4, elastic_body(young, 0.0), {});
  const double V = volume(scene);
  const double strain = 0.01;
  const geometry::Blow blow{1.0, strain * std::sqrt(V * young)};
  scene.tools[0].motion.force->blow = blow;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_EQ(done.process->view().blows().size(), 1u);
  const BlowReport& report = done.process->view().blows()[0];
  const double exact = height * (1.0 - std::exp(-strain));
  // A spring of stiffness E A / h0 would be met for a quarter of its period; the stiffening is of
  // the order of the strain.
  const double quarter = 0.5 * std::numbers::pi * height / std::sqrt(V * young);
  std::printf("[BLOW] elastic: stroke %.6f mm of %.6f, %.4f of a quarter period, speed left %.1e, "
              "%d increments\n",
              report.stroke, exact, report.time / quarter, report.speed / blow.speed,
              done.process->view().state.increment);
  EXPECT_TRUE(report.over);
  EXPECT_TRUE(done.process->view().state.ended_by == EndedBy::energy_used_up);
  EXPECT_NEAR(report.stroke, exact, 1e-3 * exact);
  EXPECT_NEAR(report.time, quarter, 0.01 * quarter);
  EXPECT_NEAR(done.process->view().state.energy.elastic, blow.energy(), 1e-3 * blow.energy());
}

TEST(Blow, upsets_to_the_height_that_its_energy_is_worth) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8}) {
    Scene scene = struck(kind, billet_steel(), {});
    const double energy = volume(scene) * upsetting_work(0.0, 0.3);
    const geometry::Blow blow{2.0 * energy / (5000.0 * 5000.0), 5000.0};
    scene.tools[0].motion.force->blow = blow;
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    const BlowReport& report = done.process->view().blows()[0];
    const double exact = loaded_height(0.3);
    const double balance =
        std::abs(blow.energy() - done.process->view().state.energy.external - report.left) / energy;
    std::printf("[BLOW] %s: height %.5f mm of %.5f, energy given against work of the tool and rest "
                "%.1e, %d increments, %d cut-backs\n",
                std::string(mechanics::name(kind)).c_str(), end_height(done), exact, balance,
                done.process->view().state.increment, done.process->view().state.counters.cutbacks);
    EXPECT_NEAR(end_height(done), exact, 1e-3 * height);
    EXPECT_LE(balance, 1e-5);
    EXPECT_NEAR(report.used, done.process->view().state.energy.external, 1e-9 * energy);
    EXPECT_LE(report.left, 1e-6 * energy);
  }
}

/// An elastic bar struck in about `n` increments.
FinishedRun struck_in(int n) {
  Scene scene = struck(ElementKind::quad4, elastic_body(young, 0.0), {});
  const double speed = 0.1 * std::sqrt(volume(scene) * young);
  scene.tools[0].motion.force->blow = geometry::Blow{1.0, speed};
  const double quarter = 0.5 * std::numbers::pi * 0.1 * height / speed;
  scene.increments.first = scene.increments.max = quarter / n;
  return run(std::move(scene));
}

TEST(Blow, does_not_depend_on_the_increments_but_for_the_second_order) {
  const double V = std::numbers::pi * 25.0 * height;
  double last = 0.0;
  for (const int n : {10, 20, 40}) {
    const FinishedRun done = struck_in(n);
    ASSERT_EQ(done.status, RunStatus::done);
    const BlowReport& report = done.process->view().blows()[0];
    const double given = 0.5 * 0.01 * V * young;
    const double error = std::abs(report.stroke - height * (1.0 - std::exp(-0.1)));
    std::printf("[BLOW] %d increments: stroke off by %.2e mm, energy lost %.1e\n", n, error,
                std::abs(given - report.used - report.left) / given);
    EXPECT_NEAR(report.used + report.left, given, 1e-5 * given); // whatever the increments
    if (last > 0.0) {
      EXPECT_GT(last / error, 3.0);
    }
    last = error;
  }
}

TEST(Blow, is_one_of_several) {
  Scene scene = struck(ElementKind::quad4, billet_steel(), {});
  const double V = volume(scene);
  const double work = upsetting_work(0.0, 0.15);
  scene.tools[0].motion.force->blow = geometry::Blow{2.0 * V * work / 25e6, 5000.0};
  scene.stages = {
      {"first", 1.0, {1}, false}, {"lift", 2.0, {0}, true}, {"second", 3.0, {1}, false}};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_EQ(done.process->view().blows().size(), 2u);
  const double first = strain_of_work(0.0, work);
  const double exact = loaded_height(strain_of_work(first, work));
  const BlowReport& second = done.process->view().blows()[1];
  std::printf("[BLOW] two blows: height %.5f mm of %.5f; the second begins at %.3f s, strokes %.4f "
              "and %.4f mm, %d increments\n",
              end_height(done), exact, second.begun, done.process->view().blows()[0].stroke,
              second.stroke, done.process->view().state.increment);
  EXPECT_NEAR(end_height(done), exact, 2e-3 * height);
  EXPECT_EQ(second.stage, "second");
  EXPECT_EQ(second.begun, 2.0);
  EXPECT_TRUE(done.process->view().blows()[0].over && second.over);
  EXPECT_NEAR(done.at(2.0).report.time, 2.0, 1e-12); // the rest of a stage passes
}

TEST(Blow, goes_on_over_new_meshes) {
  Scene scene = struck(ElementKind::quad8, billet_steel(), {});
  const double work = upsetting_work(0.0, 0.3), V = volume(scene);
  const geometry::Blow blow{2.0 * V * work / 25e6, 5000.0};
  scene.tools[0].motion.force->blow = blow;
  scene.stages = {
      {"first", 1.0, {1}, false}, {"lift", 2.0, {0}, true}, {"second", 3.0, {1}, false}};
  scene.remesh = RemeshSettings{};
  scene.remesh->strain = 0.05;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& end = done.process->view();
  ASSERT_EQ(end.blows().size(), 2u);
  const BlowReport &first = end.blows()[0], &second = end.blows()[1];
  const double exact = loaded_height(strain_of_work(strain_of_work(0.0, work), work));
  double jump = 0.0;
  for (const RemeshReport& mesh : end.state.record.remeshings)
    jump = std::max(jump, std::abs(mesh.energy));
  std::printf("[BLOW] %zu new meshes: height %.5f mm of %.5f, used %.6g and %.6g of %.6g N mm, one "
              "new mesh changes the balance by %.1e of that\n",
              end.state.record.remeshings.size(), end_height(done), exact, first.used, second.used,
              blow.energy(), jump / blow.energy());
  EXPECT_GE(end.state.record.remeshings.size(), 6u);
  EXPECT_NEAR(end_height(done), exact, 2e-3 * height);
  EXPECT_TRUE(first.over && second.over);
  EXPECT_NEAR(first.used, blow.energy(), 1e-5 * blow.energy());
  EXPECT_NEAR(second.used, blow.energy(), 1e-5 * blow.energy());
  EXPECT_LE(jump, 1e-2 * blow.energy()); // where the second blow meets the yield stress again
}

TEST(Blow, of_a_metal_that_follows_the_rate_goes_on_over_a_new_mesh_at_its_end) {
  const mechanics::Material metal{{young, 0.3}, mechanics::NortonHoff{.K = 100.0, .m = 0.2}};
  Scene scene = struck(ElementKind::quad8, metal, geometry::Blow{0.02, 5000.0});
  Scene alone = scene;
  scene.remesh = RemeshSettings{};
  scene.remesh->strain = 0.04;
  const FinishedRun done = run(std::move(scene)), without = run(std::move(alone));
  ASSERT_EQ(done.status, RunStatus::done);
  double jump = 0.0;
  for (const RemeshReport& mesh : done.process->view().state.record.remeshings)
    jump = std::max(jump, mesh.force_jump());
  std::printf("[BLOW] Norton: height %.5f mm, without new meshes %.5f; forces jump by %.2e\n",
              end_height(done), end_height(without), jump);
  EXPECT_GE(done.process->view().state.record.remeshings.size(), 3u);
  EXPECT_NEAR(end_height(done), end_height(without), 1e-3 * height);
  EXPECT_LE(jump, 0.01);
}

TEST(Blow, goes_on_in_the_next_stage_if_it_is_not_over) {
  Scene whole = struck(ElementKind::quad4, billet_steel(), {});
  const geometry::Blow blow{2.0 * volume(whole) * upsetting_work(0.0, 0.15) / 25e6, 5000.0};
  whole.tools[0].motion.force->blow = blow;
  Scene parted = struck(ElementKind::quad4, billet_steel(), blow);
  parted.stages = {{"one", 3e-4, {1}, false}, {"two", 1.0, {1}, false}};
  const FinishedRun a = run(std::move(whole)), b = run(std::move(parted));
  ASSERT_EQ(a.status, RunStatus::done);
  ASSERT_EQ(b.status, RunStatus::done);
  ASSERT_EQ(b.process->view().blows().size(), 1u);
  EXPECT_NEAR(end_height(a), end_height(b), 1e-4 * height);
}

TEST(Blow, flies_to_the_workpiece_and_needs_one) {
  Scene scene = struck(ElementKind::quad4, billet_steel(), {});
  const geometry::Blow blow{2.0 * volume(scene) * upsetting_work(0.0, 0.05) / 25e6, 5000.0};
  scene.touch = {0};
  scene.tools[0].motion.force->blow = blow;
  scene.tools[0].motion.place.translation = Vec3(0, 2.0, 0);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const BlowReport& report = done.process->view().blows()[0];
  EXPECT_NEAR(done.process->view().driven(0).travel, 2.0 + report.stroke, 1e-9);

  Scene away = struck(ElementKind::quad4, billet_steel(), blow);
  away.touch = {0};
  away.tools[0].motion.place.translation = Vec3(0, 2.0, 0);
  away.tools[0].motion.force->axis = Vec3::UnitY();
  const FinishedRun missed = run(std::move(away));
  EXPECT_EQ(missed.status, RunStatus::not_converged);
  ASSERT_EQ(missed.recorder.failures.size(), 1u);
  EXPECT_NE(missed.recorder.failures[0].reason.find("strikes nothing"), std::string::npos);
}

TEST(Blow, is_driven_on_by_a_load) {
  Scene scene = struck(ElementKind::quad4, elastic_body(young, 0.0), {});
  const double V = volume(scene), speed = 0.01 * std::sqrt(V * young);
  scene.tools[0].motion.force->blow = geometry::Blow{1.0, speed};
  scene.tools[0].motion.force->load = TimeFunction(20e3);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const BlowReport& report = done.process->view().blows()[0];
  EXPECT_NEAR(report.driven, 20e3 * report.stroke, 1e-9 * report.energy);
  EXPECT_NEAR(report.energy + report.driven, report.used + report.left, 1e-5 * report.energy);
}

TEST(Blow, is_the_same_in_any_unit_and_frame) {
  const auto figures = [](double mm, const geometry::Pose& frame) {
    // Newtons and seconds stay; powers of two scale without rounding.
    Scene scene = struck(ElementKind::hex8, billet_steel(), {});
    const double energy = volume(scene) * upsetting_work(0.0, 0.1);
    const double MPa = 1.0 / (mm * mm);
    for (Vec3& p : scene.part.mesh.points)
      p = mm * frame.to_space(p);
    scene.material = {{young * MPa, 0.3}, mechanics::Linear{yield * MPa, hardening * MPa}};
    const Vec3 along = frame.rotation.col(2);
    scene.tools.clear();
    const auto flat = [&](double z, const Vec3& normal) {
      return moving_tool("flat", geometry::make_plane(mm * frame.to_space(Vec3(0, 0, z)), normal),
                         Vec3::Zero(), contact::Coulomb{0.2});
    };
    scene.tools.push_back(flat(0.0, along));
    scene.tools.push_back(flat(height, -along));
    scene.tools[1].motion.velocity.reset();
    scene.tools[1].motion.force = ram({2.0 * energy / (5000.0 * 5000.0 * mm), 5000.0 * mm}, -along);
    scene.part.supports.clear();
    scene.touch = {0, 0};
    scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
    scene.stages[0].tools = {1, 1};
    // The same, whatever rounding does; a first one that ends in yield may be cut back or not.
    scene.increments.first = 1e-7;
    scene.increments.max = 1e-5;
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.status, RunStatus::done);
    return done.process->view().blows()[0].stroke / mm;
  };
  const double plain = figures(1.0, {});
  EXPECT_GT(plain, 0.5);
  EXPECT_EQ(figures(0x1p-10, {}), plain);
  const double turned =
      figures(1.0, geometry::rotation_about({3, -8, 5}, Vec3(1, 2, -2) / 3.0, 1.1));
  EXPECT_NEAR(turned, plain, 1e-6 * plain);
}

} // namespace
} // namespace billet::process::blows_test
