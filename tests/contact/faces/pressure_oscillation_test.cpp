// Pressure that is high and low in turn along quadratic faces. (C.45)

#include "contact/faces/pressure_oscillation.h"
#include "mechanics/mesh/mesh_edges.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <random>

namespace billet::contact::pressure_oscillation_test {
namespace {

using mechanics::Analysis;
using mechanics::ElementKind;

/// Away from the axis, with faces within a grid on all sides.
ContactBench
on_floor(const BodyKind& body, Form form, std::optional<double> max_penetration = std::nullopt) {
  mechanics::Mesh mesh =
      mechanics::box_mesh({body.kind, Vec3(1, 0, 0), Vec3(6, 1, 5), {5, 1, 5}, {1, 1, 1}});
  const auto faces = faces_at(mesh, 1, 0.0);
  ContactSettings settings{form, 100.0, 10.0};
  settings.max_penetration = max_penetration;
  return ContactBench(
      std::move(mesh), body.analysis, bench_material(),
      one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Frictionless{})), settings,
      faces);
}

void for_each_quadratic(const std::function<void(const BodyKind&, Form)>& check) {
  for (const BodyKind& body : body_kinds())
    if (mechanics::is_quadratic(body.kind))
      for (const Form form : {Form::mixed, Form::compatible}) {
        SCOPED_TRACE(body.name() + (form == Form::mixed ? ", mixed" : ", compatible"));
        check(body, form);
      }
}

/// Histories with a pressure at each place, closed where there is one.
std::vector<PointHistory> pressed(const ContactBench& bench,
                                  const std::function<double(const Vec3&)>& pressure) {
  std::vector<Vec3> places(bench.surface.n_points());
  bench.surface.positions(bench.x, places);
  std::vector<PointHistory> history(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (const double p = pressure(places[k]); p > 0.0) {
      history[k].pressure = p;
      history[k].normal = Vec3::UnitY();
    }
  return history;
}

std::vector<double> oscillation(const ContactBench& bench,
                                const std::vector<PointHistory>& history) {
  const auto n = static_cast<std::size_t>(bench.surface.points());
  std::vector<char> lying(history.size() / n, 1);
  for (std::size_t k = 0; k < history.size(); ++k)
    if (!history[k].closed())
      lying[k / n] = 0;
  std::vector<double> areas(bench.surface.n_points());
  bench.surface.areas(bench.x, areas);
  std::vector<Vec3> places(areas.size());
  bench.surface.positions(bench.x, places);
  return pressure_oscillation(smoothed_pressure(bench.surface, lying, history, places, areas),
                              history);
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

TEST(PressureOscillation, IsNoneWherePressureIsUniformOrRisesEvenly) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    const ContactBench bench = on_floor(body, form);
    EXPECT_LT(largest(oscillation(bench, pressed(bench, [](const Vec3&) { return 300.0; }))),
              1e-10);
    const auto rising = [](const Vec3& at) { return 300.0 + 20.0 * at[0] + 10.0 * at[2]; };
    EXPECT_LT(largest(oscillation(bench, pressed(bench, rising))), 1e-10);
  });
}

TEST(PressureOscillation, IsWhatAlternatesAndHasNoSumOnAFace) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    const ContactBench bench = on_floor(body, form);
    const auto alternating = [](const Vec3& at) {
      return 300.0 + (at[0] - std::floor(at[0]) < 0.5 ? 200.0 : -200.0);
    };
    const std::vector<PointHistory> history = pressed(bench, alternating);
    const std::vector<double> found = oscillation(bench, history);
    std::vector<double> areas(found.size());
    bench.surface.areas(bench.x, areas);
    const auto n = static_cast<std::size_t>(bench.surface.points());
    for (std::size_t first = 0; first < found.size(); first += n) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + n; ++k)
        sum += areas[k] * found[k];
      EXPECT_LT(std::abs(sum), 1e-9);
    }
    for (std::size_t k = 0; k < found.size(); ++k)
      if (form == Form::mixed && body.kind != ElementKind::tet10 &&
          body.analysis != Analysis::axisymmetric) {
        EXPECT_NEAR(found[k], history[k].pressure - 300.0, 1e-9);
      }
  });
}

TEST(PressureOscillation, IsNoneBesideFacesThatDoNotTouch) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    const ContactBench bench = on_floor(body, form);
    const auto parted = [](const Vec3& at) {
      return at[0] < 4.0 ? 300.0 + (at[0] - std::floor(at[0]) < 0.5 ? 200.0 : -200.0) : 0.0;
    };
    const std::vector<double> found = oscillation(bench, pressed(bench, parted));
    std::vector<Vec3> places(found.size());
    bench.surface.positions(bench.x, places);
    for (std::size_t k = 0; k < found.size(); ++k)
      if (places[k][0] > 3.0) {
        EXPECT_EQ(found[k], 0.0);
      }
    EXPECT_GT(largest(found), 50.0);
  });
}

/// The lower side by `depth` inside the floor, its nodes at every second x deeper by `wave`.
std::vector<double> waved(const ContactBench& bench, double depth, double wave) {
  std::vector<double> x = flat_positions(bench.mesh);
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); i += dim)
    x[i + 1] -= depth + wave * std::cos(3.14159265358979 * x[i]);
  return x;
}

/// Largest oscillation of the pressure, as `results` tell, and the gap correction of the points.
struct State {
  double oscillation = 0.0;    ///< over the largest pressure [-]
  double gap_correction = 0.0; ///< largest [mm]
  double force = 0.0;          ///< on the tool [N]
};

State state(const ContactBench& bench) {
  std::vector<PointHistory> history(bench.surface.n_points());
  State now;
  double most = 0.0;
  const std::vector<PointResult> results = point_results(bench.term);
  for (std::size_t k = 0; k < results.size(); ++k)
    if (results[k].pressure > 0.0) {
      history[k].pressure = results[k].pressure;
      history[k].normal = Vec3::UnitY();
      most = std::max(most, results[k].pressure);
      const double gap_correction =
          -results[k].pressure / bench.surface.penalty().normal - results[k].gap;
      now.gap_correction = std::max(now.gap_correction, std::abs(gap_correction));
    }
  now.oscillation = largest(oscillation(bench, history)) / most;
  now.force = bench.term.loads()[0].force[1];
  return now;
}

TEST(PressureOscillation, IsTakenAwayWhileNodesStandStillAndTheForceStays) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    ContactBench bench = on_floor(body, form);
    const double K = bench.surface.penalty().normal;
    const double depth = 500.0 / K;
    const std::vector<double> x = waved(bench, depth, 0.4 * depth);
    bench.commit(x, 1.0);
    const State first = state(bench);
    ASSERT_GT(first.oscillation, 0.1);
    for (int increment = 2; increment <= 60; ++increment)
      bench.commit(x, increment);
    const State last = state(bench);
    std::printf("%-18s %-10s oscillation %.3f of the pressure at first, %.4f at last\n",
                body.name().c_str(), form == Form::mixed ? "mixed" : "compatible",
                first.oscillation, last.oscillation);
    EXPECT_LT(last.oscillation, 0.02 * first.oscillation); // 1/100 is left to hold it
    EXPECT_NEAR(last.force, first.force, 1e-9 * std::abs(first.force));
    // What the penalties have lost is in the books: nothing has moved.
    const ContactWork& work = bench.term.work();
    EXPECT_NEAR(bench.entered + work.penalty_update - work.friction, work.stored,
                1e-9 * std::abs(work.stored));
  });
}

TEST(PressureOscillation, IsForgottenByPointsThatPart) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    ContactBench bench = on_floor(body, form);
    const double depth = 500.0 / bench.surface.penalty().normal;
    const std::vector<double> x = waved(bench, depth, 0.4 * depth);
    bench.commit(x, 1.0);
    const State fresh = state(bench);
    for (int increment = 2; increment <= 20; ++increment)
      bench.commit(x, increment);
    for (int increment = 21; increment <= 80; ++increment)
      bench.commit(waved(bench, -0.1, 0.0), increment);
    bench.commit(x, 81.0);
    const State again = state(bench);
    EXPECT_NEAR(again.oscillation, fresh.oscillation, 1e-6);
    EXPECT_NEAR(again.force, fresh.force, 1e-6 * std::abs(fresh.force));
  });
}

TEST(PressureOscillation, IsLeftWhereALimitOfPenetrationHasNoRoomForIt) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    const double limit = 1e-4;
    ContactBench bench = on_floor(body, form, limit);
    const double depth = 3000.0 / bench.surface.penalty().normal;
    ASSERT_GT(0.2 * depth, 0.25 * limit);
    const std::vector<double> x = waved(bench, depth, 0.9 * depth);
    for (int increment = 1; increment <= 40; ++increment)
      bench.commit(x, increment);
    EXPECT_LT(state(bench).gap_correction, 0.4 * limit);
  });
}

Eigen::VectorXd
force_at(ContactBench& bench, std::vector<double> trial, const Eigen::VectorXd& move) {
  for (std::size_t i = 0; i < trial.size(); ++i)
    trial[i] += move[static_cast<Eigen::Index>(i)];
  bench.assemble(trial, 4.0);
  return bench.force();
}

TEST(PressureOscillation, HasTheTangentOfDifferences) {
  for_each_quadratic([](const BodyKind& body, Form form) {
    for (const bool all_press : {true, false}) {
      ContactBench bench = on_floor(body, form);
      bench.tools[0].friction = Coulomb{0.3};
      const double depth = 500.0 / bench.surface.penalty().normal;
      const std::vector<double> x = waved(bench, depth, 0.4 * depth);
      for (int increment = 1; increment <= 3; ++increment)
        bench.commit(x, increment);
      std::vector<double> trial = waved(bench, all_press ? depth : 0.2 * depth, 0.5 * depth);
      const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
      for (std::size_t i = 0; i < trial.size(); i += dim)
        trial[i] += 0.1 * depth;
      bench.assemble(trial, 4.0);
      const Eigen::MatrixXd K = bench.tangent();
      // Along directions in which every node moves: K v takes all columns at once. Short: with all
      // that moves some spring or friction of a point has a kink at 1e-4 of the depth.
      const double h = 2e-5 * depth;
      std::mt19937 random(4);
      std::uniform_real_distribution<double> share(-1.0, 1.0);
      double worst = 0.0;
      for (int direction = 0; direction < 6; ++direction) {
        Eigen::VectorXd v(static_cast<Eigen::Index>(trial.size()));
        for (double& component : v)
          component = share(random);
        const Eigen::VectorXd slope =
            (force_at(bench, trial, h * v) - force_at(bench, trial, -h * v)) / (2.0 * h);
        worst = std::max(worst, (slope + K * v).norm() / (K * v).norm());
      }
      EXPECT_LT(worst, 1e-6);
    }
  });
}

} // namespace
} // namespace billet::contact::pressure_oscillation_test
