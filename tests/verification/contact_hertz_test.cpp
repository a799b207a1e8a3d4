// CON-02: a rigid cylinder and a rigid ball on an elastic block, against Hertz.

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace billet::process {
namespace {

constexpr double young = 210e3;
constexpr double poisson = 0.3;
constexpr double R = 100.0;
constexpr double E_star = young / (1.0 - poisson * poisson);

struct Hertz {
  double force;    ///< of the half (plane, per thickness) or of the full turn [N]
  double radius;   ///< of contact [mm]
  double pressure; ///< p0 [MPa]
  double power;    ///< p = p0 (1 - (x/a)^2)^power
};

Hertz hertz(Analysis analysis, double a) {
  const double p0 = E_star * a / (2.0 * R); // line
  if (analysis == Analysis::plane_strain)
    return {std::numbers::pi / 4.0 * p0 * a, a, p0, 0.5};
  const double ball = 2.0 * E_star * a / (std::numbers::pi * R);
  return {2.0 / 3.0 * std::numbers::pi * a * a * ball, a, ball, 0.5};
}

/// A block below y = 0 with elements of width a/8 under the contact, far larger than it.
mechanics::Mesh block(ElementKind kind, double a) {
  constexpr int even = 12;  // elements of width a/8 from the axis on
  constexpr int grown = 30; // elements that grow outwards
  constexpr double ratio = 1.17;
  const double h = a / 8.0;
  const auto place = [&](double coordinate) {
    const double cells = 0.5 * std::round(2.0 * coordinate); // without its rounding
    if (cells <= even)
      return h * cells;
    // Mid-side nodes lie in the middle of their corners.
    const auto corner = [&](double n) {
      return h * even + h * ratio * (std::pow(ratio, n) - 1.0) / (ratio - 1.0);
    };
    const double n = cells - even;
    return 0.5 * (corner(std::floor(n)) + corner(std::ceil(n)));
  };
  constexpr int n = even + grown;
  mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(n, n, 0), {n, n, 1}, {1, 1, 1}});
  for (Vec3& p : mesh.points)
    p = Vec3(place(p[0]), -place(n - p[1]), 0.0);
  return mesh;
}

/// Mean of Hertz's pressure between two radii.
double mean_pressure(const Hertz& h, Analysis analysis, double from, double to) {
  constexpr int n = 400;
  double sum = 0.0;
  double weight = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = from + (to - from) * (i + 0.5) / n;
    const double w = analysis == Analysis::plane_strain ? 1.0 : x;
    const double s = 1.0 - x * x / (h.radius * h.radius);
    sum += w * h.pressure * (s > 0.0 ? std::pow(s, h.power) : 0.0);
    weight += w;
  }
  return sum / weight;
}

class HertzContact
    : public testing::TestWithParam<std::tuple<ElementKind, Analysis, contact::Form>> {};

TEST_P(HertzContact, HasThePressureOfHertzOnEveryFace) {
  const auto [kind, analysis, form] = GetParam();
  constexpr double a = 0.7427901; // VALIDATION CON-02b
  const Hertz h = hertz(analysis, a);
  Scene scene;
  scene.title = "Hertz";
  scene.analysis = analysis;
  scene.mesh = block(kind, a);
  scene.material = elastic_body(young, poisson);
  double bottom = 0.0;
  for (const Vec3& p : scene.mesh.points)
    bottom = std::min(bottom, p[1]);
  scene.supports = {held(scene.mesh, 0, 0.0), held(scene.mesh, 1, bottom)};
  scene.contact_faces = faces_on(scene.mesh, 1, 0.0);
  scene.contact.form = form;
  scene.tools.push_back(
      moving_tool("die", geometry::make_circle({0, R, 0}, R, false), Vec3::Zero()));
  contact::Tool& die = scene.tools.back();
  die.motion.velocity.reset();
  die.motion.force =
      geometry::Drive{Vec3::Zero(), -Vec3::UnitY(), TimeFunction({{0.0, 0.0}, {1.0, h.force}})};
  scene.touch = {1};
  scene.stages.push_back({"press", 1.0, {1}, false});
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_NEAR(done.last().loads[0].force.norm(), h.force, 1e-5 * h.force);

  const contact::ContactSurface& surface = *done.process->surface();
  const std::vector<contact::PointResult> points = done.process->contact()->results();
  std::vector<Vec3> at(surface.n_points());
  std::vector<double> areas(surface.n_points());
  surface.positions(done.process->positions(), at);
  surface.areas(done.process->positions(), areas);
  const auto per_face = static_cast<std::size_t>(surface.points());
  double worst = 0.0;
  double axis = 0.0;
  for (std::size_t f = 0; f * per_face < points.size(); ++f) {
    double force = 0.0, area = 0.0, middle = 0.0;
    for (std::size_t i = f * per_face; i < (f + 1) * per_face; ++i) {
      force += points[i].pressure * areas[i];
      area += areas[i];
      middle += at[i][0] / static_cast<double>(per_face);
    }
    if (middle > 1.5 * a)
      continue;
    const double from = std::floor(middle / (a / 8.0)) * a / 8.0;
    const double reference = mean_pressure(h, analysis, from, from + a / 8.0);
    const double error = (force / area - reference) / h.pressure;
    (from < 1e-9 ? axis : worst) = std::max(from < 1e-9 ? axis : worst, std::abs(error));
    std::printf("  face from %.3f a: %.1f MPa (%.1f), %+.2f %% of p0\n", from / a, force / area,
                reference, 100.0 * error);
  }
  std::printf(
      "CON-02 %s %s %s: p0 = %.2f MPa; largest error %.2f %% of p0 (3), at the axis %.2f %% (5)\n",
      std::string(mechanics::name(kind)).c_str(),
      analysis == Analysis::plane_strain ? "line" : "point",
      form == contact::Form::mixed ? "mixed" : "compatible", h.pressure, 100.0 * worst,
      100.0 * axis);
  EXPECT_LT(worst, 0.03);
  EXPECT_LT(axis, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    EveryFace,
    HertzContact,
    testing::Combine(testing::Values(ElementKind::quad4, ElementKind::quad8, ElementKind::tri6),
                     testing::Values(Analysis::plane_strain, Analysis::axisymmetric),
                     testing::Values(contact::Form::mixed, contact::Form::compatible)));

} // namespace
} // namespace billet::process
