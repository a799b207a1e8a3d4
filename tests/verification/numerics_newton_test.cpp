// Newton's order, the balance of energy and the same bits for any number of threads, with stick,
// slip and plastic flow in one problem, for each element kind.

#include "tests/support/contact_scenes.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace billet::process::numerics_newton_test {
namespace {

/// A punch with a round nose goes into a block with friction: points stick in the middle and slide
/// around it, the block yields under it.
Scene indentation(ElementKind kind,
                  int steps,
                  const contact::Friction& friction = contact::Coulomb{0.3}) {
  const bool solid = mechanics::dimension(kind) == 3;
  const int n = kind == ElementKind::hex20 ? 3 : 5;
  const double radius = solid ? 20.0 : 10.0;
  Scene scene;
  scene.part.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  scene.part.mesh =
      solid ? mechanics::box_mesh({kind, Vec3::Zero(), Vec3(6, 6, 4), {n, n, 3}, {1, 1, 1}})
            : mechanics::box_mesh({kind, Vec3::Zero(), Vec3(6, 4, 0), {12, 8, 1}, {1, 1, 1}});
  scene.material = billet_steel();
  for (int axis = 0; axis <= up(scene.part.analysis); ++axis)
    scene.part.supports.push_back(held(scene.part.mesh, axis, 0.0));
  const Vec3 along = Vec3::Unit(up(scene.part.analysis));
  auto nose = solid ? geometry::make_sphere((4.0 + radius) * along, radius, false)
                    : geometry::make_circle((4.0 + radius) * along, radius, false);
  scene.tools.push_back(moving_tool("punch", std::move(nose), -along, friction));
  scene.touch = {1};
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  scene.stages.push_back({"indent", 0.4, {1}, false});
  scene.increments.first = scene.increments.max = 0.4 / steps;
  scene.tolerance = to_rounding;
  return scene;
}

struct Statuses {
  int stick = 0, slip = 0;
};

Statuses statuses(const Run& process) {
  Statuses count;
  for (const auto& point : contact::point_results(*process.contact())) {
    count.stick += point.status == contact::Status::stick ? 1 : 0;
    count.slip += point.status == contact::Status::slip ? 1 : 0;
  }
  return count;
}

TEST(Newton, ConvergesQuadraticallyWithStickSlipAndFlow) {
  // ELT-07. An inexact tangent gives 1.
  constexpr double order = 1.8;
  constexpr double balance = 5e-3;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                 ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    const FinishedRun done = run(indentation(kind, 50));
    ASSERT_EQ(done.status, RunStatus::done);
    const Statuses count = statuses(*done.process);
    const std::vector<double> orders = newton_orders(done.recorder.entries);
    ASSERT_GE(orders.size(), 5u);
    const double median = orders[orders.size() / 2];
    const std::vector<double> of_residuals =
        newton_orders(done.recorder.entries, &mechanics::IterationRecord::residual, 2e-10);
    const IncrementReport& end = done.last().report;
    std::printf(
        "%-5s stick %d slip %d plastic strain %.3f: order %.2f in the middle of %zu "
        "increments (>= 1.8), lowest %.2f, by residuals %.2f; energy error %.1e (<= 5e-3); %.1f "
        "iterations an "
        "increment\n",
        std::string(mechanics::name(kind)).c_str(), count.stick, count.slip, end.max_plastic_strain,
        median, orders.size(), orders.front(),
        of_residuals.empty() ? 0.0 : of_residuals[of_residuals.size() / 2], end.energy.error(),
        static_cast<double>(done.process->view().state.counters.iterations) /
            done.process->view().state.increment);
    EXPECT_GT(count.stick, 0);
    EXPECT_GT(count.slip, 0);
    EXPECT_GT(end.max_plastic_strain, 0.02);
    EXPECT_GE(median, order);
    EXPECT_LT(end.energy.error(), balance);
    EXPECT_GT(end.energy.friction, 0.0);
  }
}

struct LawCase {
  const char* name;
  ElementKind kind;
  contact::Friction friction;
  contact::Integrator integrator = contact::Integrator::radial;
};

/// Every law, and what modifies one, at forming pressures.
std::vector<LawCase> law_cases() {
  using namespace contact;
  Friction evolving = Coulomb{0.1};
  evolving.evolution = {{{{}, {}, {0.0, 0.02, 0.2}}}, {1.0, 1.5, 4.0}};
  Friction tabled = Coulomb{1.0};
  tabled.table = {{{{0.0, 3000.0}, {0.0, 1.0}, {}}}, {0.3, 0.2, 0.1, 0.05}};
  Friction anisotropic = Coulomb{1.0};
  anisotropic.tensor =
      FrictionTensor{(Mat2() << 0.05, 0.02, -0.02, 0.25).finished(), Vec3(1, 1, 0)};
  const Friction mises = Tresca{0.4, FollowedStress::von_mises};
  const ElementKind plane = ElementKind::quad4;
  const ElementKind solid = ElementKind::hex8;
  return {{"sticking", plane, Sticking{}},
          {"coulomb capped at k", plane, Coulomb{0.3, 0.0, FollowedStress::yield}},
          {"coulomb quadratic", plane, Coulomb{0.1, 50.0, FollowedStress::yield, 1e-4}},
          {"tresca of the material", plane, Tresca{0.4, {}}},
          {"tresca of von Mises", plane, mises},
          {"shaw", plane, Shaw{{}, 0.4}},
          {"asperity", plane, Asperity{0.5, {}, 0.5}},
          {"thick film", plane, ThickFilm{0.5, 0.002}},
          {"viscoplastic", plane, Viscoplastic{150.0, 1.0, 0.2}},
          {"coulomb evolving", plane, evolving},
          {"coulomb by table", plane, tabled},
          {"tresca of the material", solid, Tresca{0.4, {}}},
          {"viscoplastic", solid, Viscoplastic{150.0, 1.0, 0.2}},
          {"coulomb anisotropic", solid, anisotropic},
          {"coulomb, mid-point", solid, Coulomb{0.2}, Integrator::midpoint},
          {"coulomb, exact", solid, Coulomb{0.2}, Integrator::exact},
          {"shaw, exact", solid, Shaw{{}, 0.4}, Integrator::exact}};
}

TEST(Newton, ConvergesQuadraticallyWithEveryLaw) {
  constexpr double order = 1.8;
  for (const LawCase& law : law_cases()) {
    Scene scene = indentation(law.kind, 50, law.friction);
    scene.contact.scheme.integrator = law.integrator;
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done) << law.name;
    const std::vector<double> orders = newton_orders(done.recorder.entries);
    ASSERT_GE(orders.size(), 5u) << law.name;
    const double median = orders[orders.size() / 2];
    std::printf(
        "%-5s %-24s order %.2f in the middle of %zu increments (>= 1.8); %.1f iterations an "
        "increment, %d cut-backs\n",
        std::string(mechanics::name(law.kind)).c_str(), law.name, median, orders.size(),
        static_cast<double>(done.process->view().state.counters.iterations) /
            done.process->view().state.increment,
        done.process->view().state.counters.cutbacks);
    EXPECT_GE(median, order) << law.name;
  }
}

/// Indents with a flow law under friction that follows it: its tangent must hold the rate as well.
void check_flow_law(ElementKind kind,
                    const support::NamedMaterial& named,
                    contact::FollowedStress followed) {
  constexpr double order = 1.8;
  // In larger steps the middle order of the plane kinds scatters from 1.7 to 2, and so it does
  // where springs of mixed faces (C.44) begin and end to press, which is no change of a contact
  // point.
  Scene scene = indentation(kind, 80, contact::Tresca{0.4, followed});
  scene.contact.form = contact::Form::compatible;
  scene.material = named.material;
  const FinishedRun done = run(std::move(scene));
  const std::string name = std::string(mechanics::name(kind)) + " " + named.name;
  ASSERT_EQ(done.status, RunStatus::done) << name;
  const std::vector<double> orders = newton_orders(done.recorder.entries);
  ASSERT_GE(orders.size(), 5u) << name;
  const double median = orders[orders.size() / 2];
  std::printf("%-20s k by %-10s order %.2f in the middle of %zu increments (>= 1.8), lowest %.2f; "
              "%.1f iterations an increment, %d cut-backs; plastic strain %.3f\n",
              name.c_str(), followed == contact::FollowedStress::yield ? "yield" : "von Mises",
              median, orders.size(), orders.front(),
              static_cast<double>(done.process->view().state.counters.iterations) /
                  done.process->view().state.increment,
              done.process->view().state.counters.cutbacks, done.last().report.max_plastic_strain);
  EXPECT_GE(median, order) << name;
}

TEST(Newton, ConvergesQuadraticallyWithEveryFlowLaw) {
  using contact::FollowedStress;
  for (const auto& named : support::every_material())
    for (const FollowedStress followed : {FollowedStress::yield, FollowedStress::von_mises})
      if (support::yields(named.material))
        check_flow_law(ElementKind::hex8, named, followed);
}

TEST(Newton, ConvergesQuadraticallyWithRateLawsInThePlaneKinds) {
  for (const auto& named : support::every_material())
    for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
      if (mechanics::follows_rate(named.material.flow))
        check_flow_law(kind, named, contact::FollowedStress::yield);
}

TEST(NewtonLong, ConvergesQuadraticallyWithEveryFlowLawInEveryKind) {
  for (const auto& named : support::every_material())
    for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                   ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
      if (support::yields(named.material))
        check_flow_law(kind, named, contact::FollowedStress::yield);
}

TEST(Threads, GiveTheSameBitsHoweverMany) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex8}) {
    std::vector<double> one, two;
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
      const oneapi::tbb::global_control control(
          oneapi::tbb::global_control::max_allowed_parallelism, threads);
      const FinishedRun done = run(indentation(kind, 10));
      ASSERT_EQ(done.status, RunStatus::done);
      auto& positions = threads == 1 ? one : two;
      positions = done.last().positions;
      positions.push_back(done.last().loads[0].force.norm());
      positions.push_back(done.last().report.energy.friction);
    }
    EXPECT_EQ(one, two) << mechanics::name(kind);
  }
}

} // namespace
} // namespace billet::process::numerics_newton_test
