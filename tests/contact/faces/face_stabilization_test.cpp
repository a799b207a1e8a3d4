// What holds the shape of quadratic faces on a tool in the mixed form. (C.44)

#include "contact/faces/face_stabilization.h"
#include "mechanics/elements/shapes.h"
#include "mechanics/mesh/mesh_edges.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace billet::contact::face_stabilization_test {
namespace {

using Eigen::VectorXd;
using mechanics::Index;

constexpr double stiffness = 1e5; // [MPa/mm]

/// The kinds whose faces have a mode, off the axis or in the plane.
std::vector<BodyKind> quadratic_kinds() {
  std::vector<BodyKind> kinds;
  for (const BodyKind& body : body_kinds())
    if (mechanics::is_quadratic(body.kind))
      kinds.push_back(body);
  return kinds;
}

/// A body of 2 x 1 (x 1) elements whose lower side lies on the floor y = 0.
ContactBench on_floor(const BodyKind& body, const Friction& friction = Frictionless{}) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = faces_at(mesh, 1, 0.0);
  Tool floor = still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), friction);
  return ContactBench(std::move(mesh), body.analysis, bench_material(), one_tool(std::move(floor)),
                      {Form::mixed, 100.0, 10.0}, faces);
}

/// A point that is pressed so much that its face's springs are not short of it.
PointHistory pressed(double pressure = 1e6) {
  return {.normal = Vec3::UnitY(), .pressure = pressure};
}

std::vector<PointHistory> all_closed(const ContactBench& bench) {
  return std::vector<PointHistory>(bench.surface.n_points(), pressed());
}

FaceStabilization held(const ContactBench& bench, std::span<const PointHistory> history) {
  FaceStabilization stabilization;
  const geometry::Pose pose;
  stabilization.set(bench.surface, history, {*bench.tools[0].surface, pose, ContactBench::reach},
                    bench.x, stiffness);
  return stabilization;
}

VectorXd
residual(ContactBench& bench, const FaceStabilization& held, const std::vector<double>& x) {
  bench.system.clear();
  held.add(bench.surface, bench.pattern, x, bench.system);
  return -bench.force();
}

std::size_t dimension(const ContactBench& bench) {
  return static_cast<std::size_t>(bench.mesh.dimension());
}

/// Moves the nodes of one face by the mode that does no work on the contact stress.
std::vector<double> with_mode(const ContactBench& bench, Index face, double amplitude) {
  std::vector<double> x = bench.x;
  const auto nodes = bench.surface.scatter().nodes(face);
  mechanics::visit_face(bench.mesh.kind, [&](auto shape) {
    using Shape = decltype(shape);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto& xi = Shape::corners[a];
      double mode = 0.0; // the sides' middles of a triangle rest
      if constexpr (std::is_same_v<Shape, mechanics::Tri6>)
        mode = a < 3 ? 1.0 : 0.0;
      else
        mode = 3.0 * xi[0] * xi[0] - 1.0;
      x[as_size(nodes[a]) * dimension(bench) + 1] -= amplitude * mode;
    }
  });
  return x;
}

TEST(FaceStabilization, CostsTheModeAndItsOppositeWhatALayerAsStiffWould) {
  for (const BodyKind& body : quadratic_kinds()) {
    if (body.analysis == mechanics::Analysis::axisymmetric)
      continue;
    const ContactBench bench = on_floor(body);
    const FaceStabilization springs = held(bench, all_closed(bench));
    std::vector<double> areas(bench.surface.n_points());
    bench.surface.areas(bench.x, areas);
    double area = 0.0;
    for (int i = 0; i < bench.surface.points(); ++i)
      area += areas[as_size(i)];
    constexpr double amplitude = 1e-3;
    // Mean of the mode's square: of 3 xi^2 - 1; of 2 sum of squares - 1 on a triangle.
    const double mean = body.kind == mechanics::ElementKind::tet10 ? 1.0 / 15.0 : 0.8;
    const double exact = 0.5 * stiffness * mean * amplitude * amplitude * area;
    // Each place presses in one of the two.
    std::vector<PointHistory> others = all_closed(bench);
    for (int i = 0; i < bench.surface.points(); ++i)
      others[as_size(i)] = {};
    const FaceStabilization neighbours = held(bench, others); // they share nodes with the face
    double energy = 0.0;
    for (const double sign : {1.0, -1.0}) {
      const std::vector<double> x = with_mode(bench, 0, sign * amplitude);
      energy += springs.energy(bench.surface, x) - neighbours.energy(bench.surface, x);
    }
    std::printf("%-18s energy of the mode %.6e, closed form %.6e N mm\n", body.name().c_str(),
                energy, exact);
    EXPECT_NEAR(energy, exact, 1e-5 * exact) << body.name();
  }
}

TEST(FaceStabilization, DoesNothingToWhatTheStressWorksOn) {
  for (const BodyKind& body : quadratic_kinds()) {
    ContactBench bench = on_floor(body);
    const FaceStabilization springs = held(bench, all_closed(bench));
    std::vector<double> x = bench.x;
    for (std::size_t i = 0; i < x.size(); i += dimension(bench)) {
      x[i + 1] -= 0.01 + 0.02 * x[i] + (dimension(bench) == 3 ? 0.03 * x[i + 2] : 0.0);
      x[i] += 0.2;
    }
    EXPECT_LT(residual(bench, springs, x).norm(), 1e-9 * stiffness * 0.05) << body.name();
  }
}

TEST(FaceStabilization, IsInBalanceWithItselfAndHasTheDerivativeOfItsForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.01, 0.01);
  for (const BodyKind& body : quadratic_kinds()) {
    ContactBench bench = on_floor(body);
    const FaceStabilization springs = held(bench, all_closed(bench));
    const auto moved = [&](std::vector<double> x, double by) {
      for (double& value : x)
        value += by * shift(random);
      return x;
    };
    const std::vector<double> x = moved(bench.x, 1.0);
    const std::vector<double> other = moved(x, 1e-6); // no spring begins or ends
    const VectorXd at_other = residual(bench, springs, other);
    const VectorXd at_x = residual(bench, springs, x);
    VectorXd step(at_x.size());
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      step[i] = other[k] - x[k];
      sum[static_cast<Eigen::Index>(k % dimension(bench))] += at_x[i];
    }
    ASSERT_GT(at_x.norm(), 1.0) << body.name();
    EXPECT_LT(sum.norm(), 1e-12 * at_x.norm()) << body.name();
    const Eigen::MatrixXd K = bench.tangent();
    EXPECT_LT((at_other - at_x - K * step).norm(), 1e-6 * (K * step).norm()) << body.name();
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm()) << body.name();
    // The force is the derivative of the energy.
    const double work = springs.energy(bench.surface, other) - springs.energy(bench.surface, x);
    EXPECT_NEAR(0.5 * (at_other + at_x).dot(step), work, 1e-6 * std::abs(work)) << body.name();
  }
}

/// Places of the nodes of face 0 at heights above the floor: its ends and its middle.
std::vector<double>
at_heights(const ContactBench& bench, double first, double second, double middle) {
  std::vector<double> x = flat_positions(bench.mesh);
  const auto nodes = bench.surface.scatter().nodes(0);
  x[as_size(2 * nodes[0] + 1)] = first;
  x[as_size(2 * nodes[1] + 1)] = second;
  x[as_size(2 * nodes[2] + 1)] = middle;
  return x;
}

TEST(FaceStabilization, PressesOnlyWhereAPlaceIsInsideAndDeeperThanItsPoints) {
  const BodyKind body{mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain};
  const auto energy = [&](double first, double second, double middle, int closed) {
    ContactBench bench = on_floor(body);
    bench.x = at_heights(bench, first, second, middle);
    std::vector<PointHistory> history(bench.surface.n_points());
    for (int i = 0; i < closed; ++i)
      history[as_size(i)] = pressed();
    return held(bench, history).energy(bench.surface, bench.x);
  };
  // The mode by 1e-3: ends sunk by 2, the middle risen by 1. Only the ends press, at 4/5 of 1e-3
  // with 5/18 of the face each.
  const double ends = 0.5 * stiffness * (10.0 / 18.0) * 0.64e-6;
  EXPECT_NEAR(energy(-2e-3, -2e-3, 1e-3, 2), ends, 1e-4 * ends)
      << "a wave is longer than its chord";
  // The mode the other way, the middle sunk: there it presses with 8/18 of the face.
  const double middle = 0.5 * stiffness * (8.0 / 18.0) * 1e-6;
  EXPECT_NEAR(energy(2e-3, 2e-3, -1e-3, 2), middle, 1e-4 * middle);
  EXPECT_EQ(energy(-1e-3, -1e-3, -1e-3, 2), 0.0) << "straight: its points do all";
  EXPECT_EQ(energy(-3e-3, 1e-3, -1e-3, 2), 0.0) << "straight and slanted";
  EXPECT_EQ(energy(3e-3, 3e-3, 6e-3, 2), 0.0) << "deeper than its points, but outside";
  EXPECT_EQ(energy(-2e-3, -2e-3, 1e-3, 0), 0.0) << "no point touches";
  EXPECT_GT(energy(-1e-5, -1e-3, 5e-4, 1), 0.0) << "a point is lost, and the end sinks in";
  EXPECT_EQ(energy(-1e-5, 2e-3, 3e-4, 1), 0.0) << "a point is lost, and the end lifts off";
}

TEST(FaceStabilization, PressesNoMoreThanTenTimesWhatTheFaceCarries) {
  // A slender strip under a nose: its corner can be deep inside before a point next to it closes.
  ContactBench bench = on_floor({mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain});
  bench.x = at_heights(bench, -2e-3, -2e-3, 1e-3);
  const auto energy = [&](double pressure) {
    std::vector<PointHistory> history(bench.surface.n_points());
    history[0] = pressed(pressure);
    return held(bench, history).energy(bench.surface, bench.x);
  };
  constexpr double pressure = 0.5; // the ends would be pressed by 4/5 of 1e-3 x 1e5 = 80
  const double ends = 0.5 * (10.0 * pressure) * (10.0 * pressure) / stiffness * (10.0 / 18.0);
  EXPECT_NEAR(energy(pressure), ends, 1e-4 * ends);
  EXPECT_NEAR(energy(0.1 * pressure), 0.01 * ends, 1e-5 * ends) << "begins with nothing";
  EXPECT_EQ(energy(0.0), 0.0);
  EXPECT_DOUBLE_EQ(energy(8.1), energy(1e6)) << "more is not needed";
}

TEST(FaceStabilization, GoesHalfOfTheWayEachTime) {
  ContactBench bench = on_floor({mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain});
  bench.x = at_heights(bench, -2e-3, -2e-3, 1e-3);
  FaceStabilization springs;
  const geometry::Pose pose;
  const auto energy = [&](const std::vector<PointHistory>& history) {
    springs.set(bench.surface, history, {*bench.tools[0].surface, pose, ContactBench::reach},
                bench.x, stiffness);
    return springs.energy(bench.surface, bench.x);
  };
  const double whole = energy(all_closed(bench));
  EXPECT_GT(whole, 0.0);
  EXPECT_DOUBLE_EQ(energy(all_closed(bench)), whole) << "where nothing changes nothing does";
  const std::vector<PointHistory> open(bench.surface.n_points());
  EXPECT_NEAR(energy(open), whole / 4.0, 1e-6 * whole) << "its points have opened";
  EXPECT_NEAR(energy(open), whole / 16.0, 1e-6 * whole);
  EXPECT_NEAR(energy(all_closed(bench)), whole * 25.0 / 64.0, 1e-6 * whole);
  for (int increment = 0; increment < 30; ++increment)
    (void)energy(open);
  EXPECT_EQ(energy(open), 0.0) << "and are gone in the end";
}

TEST(FaceStabilization, BeginsAndEndsWithoutAJump) {
  // A face that is bent the wrong way comes down on the floor and leaves it: the force of a spring
  // goes with the lesser of both depths, so it is continuous where either is zero.
  ContactBench bench = on_floor({mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain});
  const std::vector<PointHistory> history = all_closed(bench);
  double before = 0.0, largest_step = 0.0, largest = 0.0;
  for (int i = 0; i <= 400; ++i) {
    bench.x = at_heights(bench, 1e-5 * (200 - i), 1e-5 * (200 - i), 1e-5 * (500 - i));
    const double force = residual(bench, held(bench, history), bench.x).norm();
    if (i > 0)
      largest_step = std::max(largest_step, std::abs(force - before));
    largest = std::max(largest, force);
    before = force;
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(largest_step, 0.02 * largest);
}

TEST(FaceStabilization, KeepsTheBooksOfEnergyAndLeavesWithItsTool) {
  for (const BodyKind& body : quadratic_kinds()) {
    ContactBench bench = on_floor(body);
    const auto sunk = [&](double by, double wave) {
      std::vector<double> x = flat_positions(bench.mesh);
      for (std::size_t i = 0; i < x.size(); i += dimension(bench))
        x[i + 1] -= by + wave * std::cos(7.0 * x[i]);
      return x;
    };
    bench.commit(sunk(1e-3, 0.0), 1.0);
    const ContactWork down = bench.term.work();
    const double entered_down = bench.entered;
    double springs = 0.0;
    for (int increment = 1; increment <= 4; ++increment) {
      bench.commit(sunk(1e-3, 2e-4 * increment), 1.0 + increment);
      springs = bench.term.work().stored - down.stored;
    }
    const ContactWork& work = bench.term.work();
    const double error = bench.entered - entered_down + work.penalty_update - down.penalty_update -
                         work.friction - springs;
    std::printf("%-18s stored %.4e more N mm: error %.1e\n", body.name().c_str(), springs, error);
    EXPECT_LT(std::abs(error), 1e-3 * std::abs(springs)) << body.name();
    // What it does now and what it leaves behind are the same, once pressure has been evened.
    for (int increment = 6; increment <= 60; ++increment)
      bench.commit(bench.x, increment);
    bench.assemble(bench.x, 61.0);
    const VectorXd before = bench.force();
    const std::vector<double> left = bench.term.release(0);
    const VectorXd after =
        Eigen::Map<const VectorXd>(left.data(), static_cast<Eigen::Index>(left.size()));
    EXPECT_LT((before - after).norm(), 1e-9 * before.norm()) << body.name();
    bench.assemble(bench.x, 62.0);
    bench.term.activity().enable({0});
    bench.assemble(bench.x, 63.0);
    EXPECT_EQ(bench.force().norm(), 0.0) << body.name();
  }
}

} // namespace
} // namespace billet::contact::face_stabilization_test
