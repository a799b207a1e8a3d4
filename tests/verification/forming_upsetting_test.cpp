// FRM-01: homogeneous frictionless upsetting against the closed form.
//
// Uniaxial Kirchhoff stress tau at log strain e: eps_p = (e - sy / E) / (1 + H / E),
// tau = (sy + H e) / (1 + H / E); the force is tau / J A = tau A0 h0 / h, whatever the lateral
// strain.

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace billet::process::forming_upsetting_test {
namespace {

constexpr double young = 200e3, yield = 700.0, hardening = 300.0;
constexpr double height = 15.0;

/// Force per initial area at a reduction [MPa].
double exact_stress(double reduction) {
  const double e = -std::log(1.0 - reduction);
  return (yield + hardening * e) / (1.0 + hardening / young) / (1.0 - reduction);
}

/// frm01_homogeneous_upsetting.csv, F_elastoplastic_cauchy_kN of radius 10.
const std::map<double, double>& csv() {
  static const std::map<double, double> rows{
      {0.05, 235.88293}, {0.2, 300.26651}, {0.4, 445.33085}, {0.6, 763.04086}};
  return rows;
}

struct Body {
  std::string name;
  mechanics::Mesh mesh;
  Analysis analysis;
  double area; ///< that the die feels [mm^2]
  contact::Form form = contact::Form::mixed;
  double spread = 1e-4; ///< allowed of the pressure [-]
};

mechanics::Mesh box(ElementKind kind, int n, int m, bool distorted) {
  const bool solid = mechanics::dimension(kind) == 3;
  mechanics::Mesh mesh =
      solid ? mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, 10, height), {n, n, m}, {1, 1, 1}})
            : mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, height, 0), {n, m, 1}, {1, 1, 1}});
  if (distorted)
    distort_inside(mesh, 0.2 * 10.0 / n, solid ? 2 : 1, 0.0, 0.7 * height); // not beneath the die
  return mesh;
}

/// (largest - smallest) / largest pressure over the points in contact at the end.
double pressure_spread(const FinishedRun& done) {
  double least = 1e300, most = 0.0;
  for (const auto& point : contact::point_results(*done.process->view().contact()))
    if (point.pressure > 0.0) {
      least = std::min(least, point.pressure);
      most = std::max(most, point.pressure);
    }
  return 1.0 - least / most;
}

void check(Body body, double tolerance) {
  constexpr double cauchy_against_kirchhoff = 5e-3; // VALIDATION: J - 1 and its safety
  const double scale = 100.0 * std::numbers::pi / body.area;
  Upsetting u{std::move(body.mesh),    body.analysis,  height,
              contact::Frictionless{}, billet_steel(), 0.6};
  Scene scene = upsetting_scene(std::move(u));
  scene.contact.form = body.form;
  for (const auto& [reduction, force] : csv())
    scene.landing_times.push_back(reduction * height);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done) << body.name;
  double worst = 0.0, worst_deep = 0.0, worst_csv = 0.0;
  for (const auto& [reduction, cauchy] : csv()) {
    const Entry& entry = done.at(reduction * height);
    ASSERT_NEAR(entry.report.time, reduction * height, 1e-6);
    const double force = entry.loads[0].force.norm();
    // The part is higher than the die stands by the penetration.
    const double now =
        largest_position(entry, done.process->view().mesh().dimension(), up(body.analysis));
    const double exact = exact_stress(1.0 - now / height) * body.area;
    worst = std::max(worst, std::abs(force / exact - 1.0));
    worst_deep =
        std::max(worst_deep, std::abs(force / (exact_stress(reduction) * body.area) - 1.0));
    worst_csv = std::max(worst_csv, std::abs(force * scale / (1e3 * cauchy) - 1.0));
    EXPECT_NEAR(force, exact, tolerance * exact) << body.name << " at " << reduction;
    EXPECT_NEAR(force * scale, 1e3 * cauchy, cauchy_against_kirchhoff * 1e3 * cauchy) << body.name;
  }
  std::printf("%-22s F error %.1e (<= %.0e), with the penetration %.1e (<= 1e-3), against the "
              "Cauchy column %.1e (<= 5e-3), pressure spread %.1e, energy error %.1e (<= 5e-3)\n",
              body.name.c_str(), worst, tolerance, worst_deep, worst_csv, pressure_spread(done),
              done.last().report.energy.error());
  EXPECT_LT(worst_deep, 1e-3) << "VALIDATION FRM-01";
  EXPECT_LT(pressure_spread(done), body.spread) << body.name;
  EXPECT_LT(done.last().report.energy.error(), 5e-3);
}

// Newton's tolerance.
constexpr double exact_to = 1e-6;

TEST(HomogeneousUpsetting, HasTheExactForceInThePlaneKinds) {
  const double disk = 100.0 * std::numbers::pi;
  for (const auto form : {contact::Form::mixed, contact::Form::compatible})
    for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
      for (const int n : {1, 3, 6}) {
        const std::string name = std::string(mechanics::name(kind)) + " " + std::to_string(n) +
                                 (form == contact::Form::mixed ? " mixed" : " compatible");
        check({name, box(kind, n, n + 1, false), Analysis::axisymmetric, disk, form}, exact_to);
      }
}

TEST(HomogeneousUpsetting, HasTheExactForceInTheSolidKinds) {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    for (const int n : {1, 3}) {
      const std::string name = std::string(mechanics::name(kind)) + " " + std::to_string(n);
      check({name, box(kind, n, n, false), Analysis::solid, 100.0}, exact_to);
    }
}

TEST(HomogeneousUpsetting, HasTheExactForceOnDistortedMeshes) {
  const double disk = 100.0 * std::numbers::pi;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
    check({std::string(mechanics::name(kind)) + " distorted", box(kind, 4, 4, true),
           Analysis::axisymmetric, disk},
          exact_to);
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    check({std::string(mechanics::name(kind)) + " distorted", box(kind, 3, 4, true),
           Analysis::solid, 100.0},
          exact_to);
}

} // namespace
} // namespace billet::process::forming_upsetting_test
