// The whole contact tangent against differences of the residual, column by column.

#include "contact/term/contact_term.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace billet::contact::contact_term_tangent_test {
namespace {

constexpr double tolerance = 1e-6; // DESIGN: tangents to 1e-6 of their norm

/// The face y = 0 of the body lies 0.02 deep on this tool at its lowest.
geometry::SurfacePtr tool_below(bool curved) {
  return curved ? geometry::make_sphere({2.0, -3.98, 0.4}, 4.0, false)
                : geometry::make_plane({2, 0.02, 0}, {0.05, 1.0, 0});
}

/// The tool beneath a body of a kind in the plane: its section is a circle.
geometry::SurfacePtr tool_for(const BodyKind& body, bool curved) {
  if (curved && !body.solid())
    return geometry::make_circle({2.0, -3.98, 0.0}, 4.0, false);
  return tool_below(curved);
}

std::vector<double>
shaken(const std::vector<double>& x, double size, double drift, std::mt19937& generator, int dim) {
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  std::vector<double> moved = x;
  for (std::size_t i = 0; i < x.size(); ++i)
    moved[i] +=
        size * component(generator) + (i % static_cast<std::size_t>(dim) == 0 ? drift : 0.0);
  return moved;
}

/// Central differences of the residual; empty if a point changes its status on the way.
Eigen::MatrixXd
differences(ContactBench& bench, const std::vector<double>& at, double time, double h) {
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<double> x = at;
    x[static_cast<std::size_t>(j)] += h;
    bench.assemble(x, time);
    const Eigen::VectorXd above = bench.force();
    int changed = bench.system.contact_changes;
    x[static_cast<std::size_t>(j)] -= 2.0 * h;
    bench.assemble(x, time);
    changed += bench.system.contact_changes;
    K.col(j) = (bench.force() - above) / (2.0 * h);
    if (changed != 0)
      return {};
  }
  return K;
}

struct Count {
  int stick = 0, slip = 0;
};

Count statuses(const ContactTerm& term) {
  Count count;
  for (const PointResult& point : point_results(term)) {
    count.stick += point.status == Status::stick ? 1 : 0;
    count.slip += point.status == Status::slip ? 1 : 0;
  }
  return count;
}

using Choice = std::tuple<int, Form, bool>;

/// It flows in most points of a shaken body, and hardens fast.
mechanics::Material hardening_material() { return {{200e3, 0.3}, mechanics::Linear{150.0, 2e4}}; }

class WholeTangent : public testing::TestWithParam<Choice> {
protected:
  /// Two increments with history, then the tangent of a third; drift makes points slide.
  void check(const NamedLaw& law,
             const SlipScheme& scheme,
             double drift,
             const mechanics::Material& material = hardening_material(),
             const mechanics::Softening& softening = {}) {
    const auto [kind, form, curved] = GetParam();
    const BodyKind& body = body_kinds()[static_cast<std::size_t>(kind)];
    mechanics::Mesh mesh = bench_mesh(body);
    const auto faces = mechanics::boundary_faces(mesh);
    const ContactSettings settings{form, 1.0, 0.7, Method::penalty, {}, scheme};
    ContactBench bench(std::move(mesh), body.analysis, material,
                       one_tool(still_tool(tool_for(body, curved), law.second)), settings, faces);
    // No state with this seed lies where the midpoint scheme's number of parts changes: a step.
    std::mt19937 generator(18);
    const int dim = bench.mesh.dimension();
    bench.commit(shaken(bench.x, 2e-3, 0.0, generator, dim), 1.0);
    bench.commit(shaken(bench.x, 2e-3, 0.0, generator, dim), 2.0);
    const std::vector<double> trial = shaken(bench.x, 2e-3, drift, generator, dim);
    bench.softening = softening;
    bench.assemble(trial, 3.0);
    const Eigen::MatrixXd K = bench.tangent();
    const Count count = statuses(bench.term);
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-7, 1e-6, 1e-8}) {
      if (best < tolerance)
        break; // what is left of it is rounding
      bench.assemble(trial, 3.0);
      const Eigen::MatrixXd difference = differences(bench, trial, 3.0, h);
      if (difference.size() != 0)
        best = std::min(best, (difference - K).norm() / K.norm());
    }
    EXPECT_GT(count.stick + count.slip, 0);
    EXPECT_LT(best, tolerance) << body.name() << ' ' << law.first << " drift " << drift;
    worst_ = std::max(worst_, best);
    seen_.stick += count.stick;
    seen_.slip += count.slip;
  }
  void say_what_was_seen() const {
    const auto [kind, form, curved] = GetParam();
    std::printf("%-20s %-10s %-6s stick %3d slip %3d: largest error %.1e (<= 1e-6)\n",
                body_kinds()[static_cast<std::size_t>(kind)].name().c_str(),
                form == Form::mixed ? "mixed" : "compatible", curved ? "curved" : "plane",
                seen_.stick, seen_.slip, worst_);
  }
  double worst_ = 0.0;
  Count seen_;
};

/// What one law is tried with.
struct Setting {
  double drift;
  SlipScheme scheme;
};

const std::vector<Setting>& every_setting() {
  static const std::vector<Setting> all = {{0.0, {}},
                                           {0.05, {}},
                                           {0.0, {Integrator::midpoint}},
                                           {0.05, {Integrator::midpoint}},
                                           {0.0, {Integrator::exact}},
                                           {0.05, {Integrator::exact}}};
  return all;
}

bool is_quadratic_solid(int kind) {
  const BodyKind& body = body_kinds()[static_cast<std::size_t>(kind)];
  return body.solid() && bench_mesh(body).n_points() > 20;
}

// Of quadratic solids, whose differences take time, each law has one setting, the next law the
// next; WholeTangentLong has all.
TEST_P(WholeTangent, AgreesWithDifferencesOfTheResidual) {
  const std::vector<Setting>& settings = every_setting();
  const bool all = !is_quadratic_solid(std::get<0>(GetParam()));
  std::size_t laws = 0;
  for (const NamedLaw& law : every_law()) {
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (all || i == laws % settings.size())
        check(law, settings[i].scheme, settings[i].drift);
    ++laws;
  }
  say_what_was_seen();
  EXPECT_GT(seen_.stick, 0);
  EXPECT_GT(seen_.slip, 0);
}

// On the way to a solution by way of softer contact. (N.10)
TEST_P(WholeTangent, AgreesWithDifferencesOfSofterContact) {
  const std::array<mechanics::Softening, 2> softenings = {{{1e-3, 1.0}, {0.1, 0.1}}};
  const bool all = !is_quadratic_solid(std::get<0>(GetParam()));
  std::size_t laws = 0;
  for (const NamedLaw& law : every_law()) {
    for (std::size_t i = 0; i < softenings.size(); ++i)
      if (all || i == laws % softenings.size())
        check(law, {}, 0.05, hardening_material(), softenings[i]);
    ++laws;
  }
  EXPECT_GT(seen_.stick + seen_.slip, 0);
}

class WholeTangentLong : public WholeTangent {};

TEST_P(WholeTangentLong, AgreesWithDifferencesInEverySetting) {
  if (!is_quadratic_solid(std::get<0>(GetParam())))
    GTEST_SKIP() << "WholeTangent has them all";
  for (const NamedLaw& law : every_law())
    for (const Setting& setting : every_setting())
      check(law, setting.scheme, setting.drift);
  say_what_was_seen();
  EXPECT_GT(seen_.slip, 0);
}

// Shear yield stresses that follow metal whose flow stress depends on rate and temperature.
TEST_P(WholeTangent, AgreesWithDifferencesOverRateDependentMetal) {
  for (const support::NamedMaterial& metal : support::every_material())
    if (mechanics::follows_rate(metal.material.flow))
      for (const FollowedStress followed : {FollowedStress::yield, FollowedStress::von_mises})
        check({metal.name, Tresca{0.4, followed}}, {}, 0.05, metal.material);
  say_what_was_seen();
  EXPECT_GT(seen_.slip, 0);
}

const auto every_choice = testing::Combine(testing::Range(0, static_cast<int>(body_kinds().size())),
                                           testing::Values(Form::mixed, Form::compatible),
                                           testing::Bool());

INSTANTIATE_TEST_SUITE_P(EveryElement, WholeTangent, every_choice);
INSTANTIATE_TEST_SUITE_P(EveryElement, WholeTangentLong, every_choice);

} // namespace
} // namespace billet::contact::contact_term_tangent_test
