// Friction that decides a forming force or shape: the ring test (FRM-03), the slab method (FRM-02),
// upper bounds (FRM-04), the capstan (FRI-01).

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

namespace billet::process::forming_friction_test {
namespace {

/// Perfectly plastic but for the hardening of the reference code.
mechanics::Material soft_steel(double yield, double hardening) {
  return {{200e3, 0.3}, mechanics::Linear{yield, hardening}};
}

// --- The ring, outer diameter 18, bore 9, height 6 -----------------------------------------------

struct Bore {
  double middle;  ///< decrease of the bore's diameter in the middle plane [%]
  double contact; ///< at the die [%]
  double force;   ///< [kN]
};

/// The upper half of the ring, a 12 x 6 mesh as the reference's.
Scene ring_scene(const contact::Friction& friction) {
  Upsetting u;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3(4.5, 0, 0), Vec3(9, 3, 0), {12, 6, 1}, {1, 1, 1}});
  u.height = 3.0;
  u.friction = friction;
  u.material = soft_steel(400.0, 2.0);
  u.reduction = 0.6;
  Scene scene = upsetting_scene(std::move(u));
  scene.part.supports = {held(scene.part.mesh, 1, 0.0)};
  scene.landing_times = {0.4 * 3.0};
  return scene;
}

Bore bore_of(const Entry& entry, const mechanics::Mesh& mesh) {
  double middle = 1e9;
  double contact = 1e9;
  for (std::size_t a = 0; a < mesh.points.size(); ++a) {
    if (mesh.points[a][1] == 0.0)
      middle = std::min(middle, entry.positions[2 * a]);
    if (mesh.points[a][1] == 3.0)
      contact = std::min(contact, entry.positions[2 * a]);
  }
  const auto decrease = [](double r) { return 100.0 * (1.0 - r / 4.5); };
  return {decrease(middle), decrease(contact), entry.loads[0].force.norm() / 1e3};
}

struct RingRow {
  double m;
  std::array<double, 2> middle; ///< at 40 and 60 % [%]
  std::array<double, 2> force;  ///< [kN]
  double tolerance;             ///< of the bore [points]
};

TEST(Ring, HasTheBoreOfTheReference) {
  // VALIDATION FRM-03, frm_ring_632_fe.csv.
  for (const RingRow& row : {RingRow{0.0, {-28.90, -57.79}, {127.27, 191.08}, 1.0},
                             RingRow{0.05, {-20.82, -33.07}, {135.26, 210.79}, 1.0},
                             RingRow{0.1, {-12.77, -11.95}, {141.13, 224.79}, 1.0},
                             RingRow{0.2, {1.93, 18.28}, {149.38, 245.58}, 3.0}}) {
    const FinishedRun done = run(ring_scene(contact::Tresca{row.m, {}}));
    ASSERT_EQ(done.status, RunStatus::done) << row.m;
    for (const std::size_t i : {0U, 1U}) {
      const double reduction = i == 0 ? 0.4 : 0.6;
      const Bore bore = bore_of(done.at(3.0 * reduction), done.process->view().mesh());
      std::printf("FRM-03 m = %.2f at %.0f %%: bore -%.2f %% in the middle (%.2f), %.2f %% at the "
                  "die; force %.2f kN (%.2f)\n",
                  row.m, 100.0 * reduction, bore.middle, row.middle[i], bore.contact, bore.force,
                  row.force[i]);
      EXPECT_NEAR(bore.middle, row.middle[i], row.tolerance) << row.m;
      EXPECT_NEAR(bore.force, row.force[i], 0.02 * row.force[i]) << row.m;
    }
  }
}

// --- Cylinders at first yield --------------------------------------------------------------------

/// Mean pressure over yield stress of a cylinder pressed by a few per cent. Upper half.
double mean_pressure(double radius,
                     double half_height,
                     std::array<int, 3> cells,
                     const contact::Friction& friction,
                     double reduction) {
  constexpr double yield = 400.0;
  Upsetting u;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(radius, half_height, 0), cells, {1, 1, 1}});
  u.height = half_height;
  u.friction = friction;
  u.material = soft_steel(yield, 0.0);
  u.reduction = reduction;
  const FinishedRun done = run(upsetting_scene(std::move(u)));
  EXPECT_EQ(done.status, RunStatus::done);
  const double area = std::numbers::pi * radius * radius / (1.0 - reduction);
  return done.last().loads[0].force.norm() / (yield * area);
}

TEST(Disk, HasThePressureOfTheSlabMethod) {
  // VALIDATION FRM-02: R/h = 4, Coulomb, 2 / x^2 (e^x - x - 1) with x = 2 mu R / h; Tresca.
  constexpr double R = 20.0, half_height = 2.5, reduction = 0.03;
  const double ratio = R / (2.0 * half_height) / std::pow(1.0 - reduction, 1.5);
  for (const double mu : {0.05, 0.1}) {
    const double x = 2.0 * mu * ratio;
    const double slab = 2.0 / (x * x) * (std::exp(x) - x - 1.0);
    const double p = mean_pressure(R, half_height, {32, 4, 1}, contact::Coulomb{mu}, reduction);
    std::printf("FRM-02 R/h = %.2f, mu = %.2f: p/sigma %.4f (slab %.4f, 2 %%)\n", ratio, mu, p,
                slab);
    EXPECT_NEAR(p, slab, 0.02 * slab);
  }
  const double slab = 1.0 + 2.0 * 0.1 * ratio / (3.0 * std::numbers::sqrt3);
  const double p = mean_pressure(R, half_height, {32, 4, 1}, contact::Tresca{0.1, {}}, reduction);
  std::printf("FRM-02 R/h = %.2f, m = 0.1: p/sigma %.4f (slab %.4f, 2 %%)\n", ratio, p, slab);
  EXPECT_NEAR(p, slab, 0.02 * slab);
}

TEST(Cylinder, YieldsBelowItsUpperBound) {
  // VALIDATION FRM-04: h/d, m, the bulging upper bound.
  for (const auto& [ratio, m, bound] :
       {std::array{0.25, 0.5, 1.3491162}, std::array{0.25, 1.0, 1.6177953},
        std::array{0.5, 0.5, 1.1594303}, std::array{0.5, 1.0, 1.2576611},
        std::array{1.0, 1.0, 1.0977875}}) {
    const int layers = ratio < 0.4 ? 6 : 10;
    const double p =
        mean_pressure(10.0, 10.0 * ratio, {14, layers, 1}, contact::Tresca{m, {}}, 0.02);
    std::printf("FRM-04 h/d = %.2f, m = %.1f: p/sigma %.4f (1 to %.4f)\n", ratio, m, p, bound);
    EXPECT_GE(p, 1.0);
    EXPECT_LE(p, 1.01 * bound);
    EXPECT_GE(p, 0.93 * bound) << "nor far below it";
  }
}

// --- The capstan ---------------------------------------------------------------------------------

constexpr double drum = 10.0;  // radius [mm]
constexpr double thick = 0.05; // of the strip [mm]

/// A strip of `n` elements around half a drum.
mechanics::Mesh wrapped_strip(int n) {
  mechanics::Mesh mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(1, thick, 0), {n, 1, 1}, {1, 1, 1}});
  for (Vec3& p : mesh.points) {
    const double angle = std::numbers::pi * (1.0 - p[0]); // from the slack end to the pulled one
    const double r = drum + p[1];
    p = Vec3(r * std::cos(angle), r * std::sin(angle), 0.0);
  }
  return mesh;
}

/// Nodes at the end of the strip on one side of the drum, with their share of a force.
std::vector<std::pair<Index, double>> end_nodes(const mechanics::Mesh& mesh, double side) {
  std::vector<std::pair<Index, double>> nodes;
  for (const Index a : nodes_at(mesh, 1, 0.0)) {
    const Vec3& p = mesh.points[as_size(a)];
    if (p[0] * side > 0.0)
      nodes.emplace_back(a, std::abs(std::abs(p[0]) - drum - 0.5 * thick) < 1e-9 ? 4.0 / 6.0
                                                                                 : 1.0 / 6.0);
  }
  return nodes;
}

/// Pull over slack of a strip that slides around half a drum.
double capstan_ratio(const contact::Friction& friction, int n) {
  constexpr double slack = 1.0; // [N/mm]
  Scene scene;
  scene.title = "capstan";
  scene.part.mesh = wrapped_strip(n);
  scene.material = elastic_body(5e4, 0.0);
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.tools.push_back(
      moving_tool("drum", geometry::make_circle({0, 0, 0}, drum, false), Vec3::Zero(), friction));
  scene.touch = {0};
  DeadForces pull{std::vector<double>(2 * scene.part.mesh.points.size(), 0.0),
                  TimeFunction({{0.0, 0.0}, {1.0, 1.0}})};
  for (const auto& [node, share] : end_nodes(scene.part.mesh, -1.0))
    pull.forces[2 * as_size(node) + 1] = -slack * share;
  scene.part.loads.emplace_back(std::move(pull));
  Support drawn{{}, 1, TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {2.0, -0.2}})};
  for (const auto& [node, share] : end_nodes(scene.part.mesh, 1.0))
    drawn.nodes.push_back(node);
  scene.part.supports.push_back(std::move(drawn));
  scene.stages.push_back({"slide", 2.0, {1}, false});
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::done);
  // Light contact: with the penalty for forming pressures it takes ten thousand (C.24).
  EXPECT_LT(done.process->view().state.increment, 200);
  return (-done.last().loads[0].force[1] - slack) / slack;
}

TEST(Capstan, MultipliesThePullByTheExponentialOfTheAngle) {
  // VALIDATION FRI-01: e^(mu theta) over half a turn; the strip's axis runs at R + t/2.
  for (const double mu : {0.1, 0.3}) {
    const double ratio = capstan_ratio(contact::Coulomb{mu}, 60);
    const double exact = std::exp(mu * std::numbers::pi);
    std::printf("FRI-01 mu = %.1f over 180 degrees: %.4f (%.4f, 2 %%)\n", mu, ratio, exact);
    EXPECT_NEAR(ratio, exact, 0.02 * exact);
  }
}

} // namespace
} // namespace billet::process::forming_friction_test
