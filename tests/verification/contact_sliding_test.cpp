// CON-04: the sliding block, FRI-03: the Tresca cap follows the material.
//
// A block of area A on a floor, pressure p, pushed by u: T = A Kt u until T = mu p A; a cycle +-U
// encloses 4 mu p A (U - mu p / Kt). With mu .2, p 100, A 100, Kt 1000, U .1: T 2000 N, loop 640
// mJ.

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace billet::process::contact_sliding_test {
namespace {

constexpr double mu = 0.2, pressure = 100.0, area = 100.0, stick_stiffness = 1000.0;
constexpr double tolerance = 1e-6; // VALIDATION CON-04

/// A block 10 x 10 x 10 whose nodes all follow u(t) along x: only friction gives way. It is
/// pressed in the first second, then cycled: to +U, -U, +U.
Scene block_scene(ElementKind kind) {
  constexpr double young = 1e5;
  Scene scene;
  scene.part.analysis = Analysis::solid;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, 10, 10), {1, 1, 1}, {1, 1, 1}});
  scene.material = elastic_body(young, 0.0);
  Support pushed;
  pushed.component = 0;
  for (Index a = 0; a < scene.part.mesh.n_points(); ++a)
    pushed.nodes.push_back(a);
  pushed.displacement = TimeFunction({{1, 0}, {2, 0.1}, {4, -0.1}, {6, 0.1}});
  scene.part.supports = {pushed, held(scene.part.mesh, 1, 0.0)};
  scene.part.loads.push_back(
      PressureOn{faces_on(scene.part.mesh, 2, 10.0), TimeFunction({{0, 0}, {1, pressure}})});
  scene.tools.push_back(moving_tool("floor", geometry::make_plane({0, 0, 0}, {0, 0, 1}),
                                    Vec3::Zero(), contact::Coulomb{mu}));
  // A little inside the block: what only touches gives Newton's first iteration no stiffness.
  scene.tools[0].motion.offset = Vec3(0, 0, 1e-6);
  scene.touch = {0};
  scene.part.contact_faces = faces_on(scene.part.mesh, 2, 0.0);
  scene.contact.penalty = 1.0;
  scene.contact.penalty_tangent = stick_stiffness * 10.0 / young;
  scene.stages.push_back({"cycle", 6.0, {1}, false});
  // Steps of .01 mm: stick and slip change at .02 and .04, at the end of a step.
  scene.increments.first = scene.increments.max = 0.1;
  scene.tolerance = 1e-8;
  return scene;
}

double exact_force(double time) {
  const double limit = mu * pressure * area, k = stick_stiffness * area;
  if (time <= 1.0)
    return 0.0;
  if (time <= 2.0)
    return std::min(limit, k * 0.1 * (time - 1.0));
  if (time <= 4.0)
    return std::max(-limit, limit - k * 0.1 * (time - 2.0));
  return std::min(limit, -limit + k * 0.1 * (time - 4.0));
}

TEST(SlidingBlock, FollowsTheStickSlopeTheLimitAndTheLoop) {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20}) {
    const FinishedRun done = run(block_scene(kind));
    ASSERT_EQ(done.status, RunStatus::done);
    double worst = 0.0, at_first = 0.0, loop = 0.0, last_force = 0.0, last_u = 0.0;
    for (const Entry& entry : done.recorder.entries) {
      const double t = entry.report.time;
      const double force = entry.loads[0].force[0];
      worst = std::max(worst, std::abs(force - exact_force(t)));
      const double u = t <= 2.0 ? 0.1 * (t - 1.0) : t <= 4.0 ? 0.1 * (3.0 - t) : 0.1 * (t - 5.0);
      if (t > 2.0 + 1e-6)
        loop += 0.5 * (force + last_force) * (u - last_u);
      else
        at_first = entry.report.energy.friction;
      last_force = force;
      last_u = u;
    }
    const double dissipated = done.last().report.energy.friction - at_first;
    std::printf("%s: force within %.1e N of the loop (T = %.6f N, ref 2000), area %.6f, dissipated "
                "%.6f mJ (ref 640), energy error %.1e\n",
                std::string(mechanics::name(kind)).c_str(), worst, last_force, loop, dissipated,
                done.last().report.energy.error());
    EXPECT_LT(worst, tolerance * 2000.0);
    EXPECT_NEAR(last_force, 2000.0, tolerance * 2000.0);
    EXPECT_NEAR(loop, 640.0, tolerance * 640.0);
    EXPECT_NEAR(dissipated, 640.0, tolerance * 640.0);
    EXPECT_LT(done.last().report.energy.error(), tolerance);
  }
}

/// A block pressed and free to slide on a plane tilted by an angle, under its own weight's
/// stand-in: pressure normal, dead force along the slope.
TEST(SlidingBlock, StaysOnASlopeUpToTheAngleOfFriction) {
  for (const double share : {0.99, 1.01}) {
    Scene scene = block_scene(ElementKind::hex8);
    scene.part.supports.clear();
    scene.part.supports.push_back(held(scene.part.mesh, 1, 0.0));
    // tan(angle) = share * mu: the tangential force is that share of the normal one.
    const auto faces = faces_on(scene.part.mesh, 2, 0.0);
    auto forces = mechanics::traction_forces(scene.part.mesh, scene.part.analysis, faces,
                                             Vec3(share * mu * pressure, 0, 0));
    scene.part.loads.push_back(DeadForces{std::move(forces), TimeFunction({{1, 0}, {2, 1}})});
    scene.stages[0].end = 2.0;
    const FinishedRun done = run(std::move(scene));
    double moved = 0.0;
    if (done.status == RunStatus::done)
      moved = largest_position(done.last(), 3, 0) - 10.0;
    std::printf("slope %.2f of mu: %s, moved %.4g mm (elastic %.4g)\n", share,
                done.status == RunStatus::done ? "held" : "slides away", moved,
                share * mu * pressure / stick_stiffness);
    if (share < 1.0) {
      EXPECT_EQ(done.status, RunStatus::done);
      EXPECT_NEAR(moved, share * mu * pressure / stick_stiffness, 1e-4);
    } else {
      // No equilibrium but the stabilization's: far away, or none found.
      EXPECT_TRUE(done.status == RunStatus::not_converged || moved > 1.0);
    }
  }
}

/// tau / (m k) at every slipping point, k before and after each increment.
class CapWatch final : public Observer {
public:
  explicit CapWatch(double m) : m_(m) {}
  void started(const Run& process) override { remember(process); }
  void incremented(const Run& process, const IncrementReport&) override {
    const auto results = contact::point_results(*process.contact());
    const std::vector<double> old = k_;
    remember(process);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].status != contact::Status::slip || results[i].shear.isZero(0.0))
        continue;
      ++slipping;
      const double tau = results[i].shear.norm();
      against_old = std::max(against_old, std::abs(tau / (m_ * old[i]) - 1.0));
      against_now = std::max(against_now, std::abs(tau / (m_ * k_[i]) - 1.0));
    }
  }
  int slipping = 0;
  double against_old = 0.0, against_now = 0.0;

private:
  void remember(const Run& process) {
    k_.clear();
    for (std::size_t i = 0; i < process.model.surface->n_points(); ++i)
      k_.push_back(
          mechanics::yield_stress(
              process.model.bulk->material().flow,
              {process.model.bulk->states()[process.model.surface->bulk_point(i)].plastic_strain,
               0.0, 20.0}) /
          std::numbers::sqrt3);
  }
  double m_;
  std::vector<double> k_;
};

TEST(TrescaFriction, IsCappedByTheHardeningMaterialBeneath) {
  // VALIDATION FRI-03: tau / k = m at every slipping point, k that of the same iterate.
  constexpr double m = 0.2, exact = 1e-8;
  Scene scene = billet_scene(ElementKind::quad8, 8, 8, contact::Tresca{m, {}}, 0.3);
  CapWatch watch(m);
  Process process(std::move(scene));
  ASSERT_EQ(process.run({&watch}), RunStatus::done);
  std::printf(
      "tau / (m k) - 1 at %d slipping points: %.1e with k at the end of the increment (<= 1e-8), "
      "%.1e with k at its start\n",
      watch.slipping, watch.against_now, watch.against_old);
  EXPECT_GT(watch.slipping, 100);
  EXPECT_LT(watch.against_now, exact);
  EXPECT_GT(watch.against_old, 1e3 * exact) << "the metal hardens enough to tell the two apart";
}

} // namespace
} // namespace billet::process::contact_sliding_test
