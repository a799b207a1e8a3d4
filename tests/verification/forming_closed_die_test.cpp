// A block that fills a closed die: corners with two tools, volume with nowhere to go.
//
// Plane strain, half model: floor y = 0, wall x = 11, punch from y = 10 down. Without friction the
// block stays homogeneous; its principal logarithmic strains are coaxial and add up, so small steps
// of the radial return give the exact stress. A tenth of a per cent of the way beyond filling the
// pressure has doubled.

#include "tests/support/contact_scenes.h"
#include "tests/support/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace billet::process::forming_closed_die_test {
namespace {

constexpr double side = 10.0;
constexpr double wall = 11.0;
constexpr double stroke = 0.95;

/// Principal Kirchhoff stresses of a homogeneous block pressed to a height in a die of a width
/// [MPa].
Vec3 exact_stresses(double wide, double high) {
  const mechanics::Material steel = billet_steel();
  const auto& flow = std::get<mechanics::Linear>(steel.flow);
  const double mu = steel.elasticity.shear();
  const double kappa = steel.elasticity.bulk();
  Vec3 strain = Vec3::Zero(); // deviatoric elastic part
  double volume = 0.0;        // ln J
  double plastic = 0.0;
  double width = 0.0; // ln of the stretch along x
  constexpr int steps = 200'000;
  const double end = std::log(high / side);
  for (int i = 0; i < steps; ++i) {
    const auto step = [&](double dx) {
      Vec3 e = strain;
      const double dy = end / steps;
      e += Vec3(dx, dy, 0.0) - (dx + dy) / 3.0 * Vec3::Ones();
      const double q = std::sqrt(6.0) * mu * e.norm();
      const double excess = q - (flow.yield + flow.hardening * plastic);
      const double flowed = std::max(0.0, excess / (3.0 * mu + flow.hardening));
      if (q > 0.0)
        e *= 1.0 - 3.0 * mu * flowed / q;
      return std::pair{e, plastic + flowed};
    };
    const auto across = [&](double dx) {
      return 2.0 * mu * step(dx).first[0] + kappa * (volume + dx + end / steps);
    };
    // Free along x until the wall is met: the stress across vanishes.
    double least = 0.0;
    double most = -2.0 * end / steps;
    for (int k = 0; k < 60; ++k)
      (across(0.5 * (least + most)) > 0.0 ? most : least) = 0.5 * (least + most);
    const double dx = std::min(0.5 * (least + most), std::log(wide / side) - width);
    const auto [e, p] = step(dx);
    strain = e;
    plastic = p;
    volume += dx + end / steps;
    width += dx;
  }
  return 2.0 * mu * strain + kappa * volume * Vec3::Ones();
}

Scene closed_die(ElementKind kind, const contact::Friction& friction) {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3(side, side, 0), {8, 8, 1}, {1, 1, 1}});
  u.height = side;
  u.friction = friction;
  u.reduction = stroke / side;
  Scene scene = upsetting_scene(std::move(u));
  scene.part.supports.resize(1); // the symmetry plane; the floor is a tool
  const auto still = [&](const char* name, const Vec3& point, const Vec3& normal) {
    scene.tools.push_back(
        moving_tool(name, geometry::make_plane(point, normal), Vec3::Zero(), friction));
  };
  still("wall", {wall, 0, 0}, {-1, 0, 0});
  still("floor", {0, 0, 0}, {0, 1, 0});
  scene.touch = {1, 0, 0};
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.stages = {{"press", stroke, {1, 1, 1}, false}};
  return scene;
}

TEST(ClosedDie, HasTheForcesOfAHomogeneousBlockWithoutFriction) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8}) {
    Scene scene = closed_die(kind, contact::Frictionless{});
    scene.increments.max = stroke / 500.0; // the wall is met within one: the path has a corner
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    // Penetrations give the block room: it is as large as its nodes say.
    const double wide = largest_position(done.last(), 2, 0);
    double low = side;
    for (std::size_t i = 1; i < done.last().positions.size(); i += 2)
      low = std::min(low, done.last().positions[i]);
    const double high = largest_position(done.last(), 2, 1) - low;
    const Vec3 exact = exact_stresses(wide, high);
    const double J = wide * high / (side * side);
    const double punch = done.last().loads[0].force[1] / wide;
    const double across = done.last().loads[1].force[0] / high;
    const std::string name(mechanics::name(kind));
    support::show("closed die", name + ": pressure on the punch", punch, -exact[1] / J);
    support::show("closed die", name + ": pressure on the wall", across, -exact[0] / J);
    constexpr double increments = 1e-3; // of the punch's pressure; halves with them
    EXPECT_NEAR(punch, -exact[1] / J, increments * punch);
    EXPECT_NEAR(across, -exact[0] / J, increments * punch);
  }
}

TEST(ClosedDie, FillsItsCornersWhateverTheFriction) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8})
    for (const double mu : {0.1, 0.3, 1.0}) {
      const FinishedRun done = run(closed_die(kind, contact::Coulomb{mu}));
      ASSERT_EQ(done.status, RunStatus::done) << mu;
      EXPECT_LE(done.process->view().state.counters.cutbacks, 2) << mu;
      Vec3 sum = Vec3::Zero();
      double largest = 0.0;
      for (const auto& load : done.last().loads) {
        sum += load.force;
        largest = std::max(largest, load.force.norm());
      }
      EXPECT_NEAR(sum[1], 0.0, 1e-5 * largest) << "the tools hold each other's balance";
      EXPECT_GT(done.last().loads[1].force[0], 0.05 * largest) << "the wall is met";
      // Rough corners on three nodes bend between the contact points of the mixed form.
      const double allowed = kind == ElementKind::quad8 && mu == 1.0 ? 0.1 * side / 8 : 1e-3 * side;
      EXPECT_LT(done.last().report.max_penetration, allowed) << mu;
      EXPECT_LT(done.last().report.energy.error(), 5e-3);
    }
}

} // namespace
} // namespace billet::process::forming_closed_die_test
