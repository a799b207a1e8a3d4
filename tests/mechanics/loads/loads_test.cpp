// Loads other than contact: VALIDATION ELT-05, ELT-04 (iv), tangents of follower pressure.

#include "mechanics/loads/loads.h"
#include "mechanics/loads/rigid_body_stabilization.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/differences.h"
#include "tests/support/element_probe.h"
#include "tests/support/figures.h"
#include "tests/support/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace billet::mechanics::loads_test {
namespace {

using support::every_element;
using support::flat;

/// A load on a mesh of one or a few cells.
struct Bench {
  Bench(Mesh mesh_in, Analysis analysis_in)
      : mesh(std::move(mesh_in)), analysis(analysis_in), pattern(block_pattern(mesh)),
        X(flat(mesh)), system{{&pattern, std::vector<double>(pattern.n_entries())},
                              std::vector<double>(X.size())} {}
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  Outcome<Assembled> assemble(ForceTerm& load, const std::vector<double>& x, double time = 1.0) {
    system.clear();
    return load.assemble({0.0, time, X, x}, system);
  }
  [[nodiscard]] double residual(Index node, int component) const {
    return system.residual[static_cast<std::size_t>(node * mesh.dimension() + component)];
  }
  /// Sum of one component over all nodes.
  [[nodiscard]] double total(int component) const {
    double sum = 0.0;
    for (Index a = 0; a < mesh.n_points(); ++a)
      sum += residual(a, component);
    return sum;
  }

  Mesh mesh;
  Analysis analysis;
  BlockPattern pattern;
  std::vector<double> X;
  System system;
};

std::vector<Face> faces_where(const Mesh& mesh, int component, double value) {
  std::vector<Face> list;
  for (const Face& face : boundary_faces(mesh))
    if (std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index a) {
          return mesh.points[static_cast<std::size_t>(a)][component] == value;
        }))
      list.push_back(face);
  return list;
}

constexpr double load_tolerance = 1e-14; // VALIDATION ELT-05

/// Weights of the first face of a unit box (half of its side for tetrahedra), corners and
/// mid-sides, through both functions that make them.
void check_weights(ElementKind kind, double corner, double middle) {
  const bool planar = dimension(kind) == 2;
  const bool triangle = !planar && is_simplex(kind);
  Bench bench(box_mesh({.kind = kind}), planar ? Analysis::plane_strain : Analysis::solid);
  auto faces = faces_where(bench.mesh, 0, 1.0);
  ASSERT_EQ(faces.size(), triangle ? 2U : 1U);
  faces.resize(1);
  const auto pressure =
      make_pressure(bench.mesh, bench.analysis, bench.pattern, faces, TimeFunction(1.0));
  ASSERT_TRUE(bench.assemble(*pressure, bench.X));
  const auto traction = traction_forces(bench.mesh, bench.analysis, faces, Vec3(-1.0, 0.0, 0.0));
  const auto& nodes = faces[0].nodes;
  const std::size_t corners = planar ? 2 : triangle ? 3 : 4;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double expected = i < corners ? corner : middle;
    const auto at = static_cast<std::size_t>(nodes[i] * bench.mesh.dimension());
    // The residual is internal minus external: a pressure on x = 1 pushes towards -x.
    EXPECT_NEAR(bench.residual(nodes[i], 0), expected, load_tolerance) << name(kind) << i;
    EXPECT_NEAR(traction[at], -expected, load_tolerance) << name(kind) << i;
    if (i == 0 || i == corners)
      support::show("ELT-05", std::string(name(kind)) + (i == 0 ? " corner" : " middle"),
                    bench.residual(nodes[i], 0), expected);
  }
  EXPECT_NEAR(bench.total(0), triangle ? 0.5 : 1.0, load_tolerance);
}

TEST(Loads, ELT_05_faces_share_a_uniform_pressure_as_their_shape_functions_do) {
  check_weights(ElementKind::quad4, 1.0 / 2.0, 0.0);
  check_weights(ElementKind::quad8, 1.0 / 6.0, 4.0 / 6.0);
  check_weights(ElementKind::hex8, 1.0 / 4.0, 0.0);
  check_weights(ElementKind::hex20, -1.0 / 12.0, 1.0 / 3.0);
  check_weights(ElementKind::tri6, 1.0 / 6.0, 4.0 / 6.0);
  check_weights(ElementKind::tet4, 1.0 / 3.0 / 2.0, 0.0);
  check_weights(ElementKind::tet10, 0.0, 1.0 / 3.0 / 2.0);
}

TEST(Loads, ELT_05_an_axisymmetric_edge_weighs_with_the_radius) {
  constexpr double r1 = 2.0;
  constexpr double r2 = 5.0;
  constexpr double length = r2 - r1;
  Bench bench(box_mesh({.kind = ElementKind::quad4, .low = {r1, 0, 0}, .high = {r2, 1, 0}}),
              Analysis::axisymmetric);
  const auto faces = faces_where(bench.mesh, 1, 1.0);
  const auto forces = traction_forces(bench.mesh, bench.analysis, faces, Vec3(0, 1, 0));
  const double turn = 2.0 * std::numbers::pi * length;
  for (const Index node : faces[0].nodes) {
    const bool inner = bench.mesh.points[static_cast<std::size_t>(node)][0] == r1;
    const double expected = turn * (inner ? (2 * r1 + r2) / 6 : (r1 + 2 * r2) / 6);
    support::show("ELT-05", inner ? "inner node" : "outer node",
                  forces[static_cast<std::size_t>(2 * node + 1)], expected);
    EXPECT_NEAR(forces[static_cast<std::size_t>(2 * node + 1)], expected,
                load_tolerance * turn * r2);
  }
}

TEST(Loads, ELT_04_pressure_on_the_lateral_surface_is_that_of_the_full_turn) {
  constexpr double tolerance = 1e-12; // VALIDATION
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6}) {
    Bench bench(box_mesh({.kind = kind, .high = {3.0, 7.0, 0.0}, .cells = {2, 5, 1}}),
                Analysis::axisymmetric);
    const auto load = make_pressure(bench.mesh, bench.analysis, bench.pattern,
                                    faces_where(bench.mesh, 0, 3.0), TimeFunction(11.0));
    ASSERT_TRUE(bench.assemble(*load, bench.X));
    const double expected = 11.0 * 2.0 * std::numbers::pi * 3.0 * 7.0;
    support::show("ELT-04", std::string(name(kind)) + " lateral force", bench.total(0), expected);
    EXPECT_NEAR(bench.total(0), expected, tolerance * expected);
    EXPECT_NEAR(bench.total(1), 0.0, tolerance * expected);
  }
}

/// A small distorted mesh of an element under test, at radii 1 and more.
Mesh distorted_mesh(const support::ElementCase& element) {
  Mesh mesh =
      box_mesh({.kind = element.kind, .low = {1, 0, 0}, .high = {3, 2, 2}, .cells = {2, 2, 2}});
  support::Random random(21);
  for (Vec3& p : mesh.points)
    for (int i = 0; i < element.dim(); ++i)
      p[i] += random.number(-0.1, 0.1);
  return mesh;
}

TEST(Loads, follower_pressure_has_the_exact_tangent_in_every_analysis) {
  constexpr double tolerance = 1e-8; // VALIDATION asks 1e-6; forces are polynomials of degree 3
  for (const auto& element : every_element) {
    Bench bench(distorted_mesh(element), element.analysis);
    const auto load = make_pressure(bench.mesh, element.analysis, bench.pattern,
                                    boundary_faces(bench.mesh), TimeFunction(3.0));
    support::Random random(22);
    const auto direction = random.list(bench.X.size(), 1.0);
    std::vector<double> x = bench.X;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += 0.05 * direction[x.size() - 1 - i];
    ASSERT_TRUE(bench.assemble(*load, x));
    EXPECT_FALSE(bench.system.symmetric);
    Eigen::VectorXd derivative(static_cast<Eigen::Index>(x.size()));
    bench.system.tangent.multiply(direction, {derivative.data(), x.size()});
    const auto residual = [&](double h) -> Eigen::VectorXd {
      std::vector<double> moved = x;
      for (std::size_t i = 0; i < x.size(); ++i)
        moved[i] += h * direction[i];
      EXPECT_TRUE(bench.assemble(*load, moved));
      return Eigen::Map<const Eigen::VectorXd>(bench.system.residual.data(), derivative.size());
    };
    const double error = support::best_difference_error(residual, derivative, 1.0);
    support::show_error("ELT-07", element.name() + " follower pressure", error, tolerance);
    EXPECT_LE(error, tolerance) << element.name();
  }
}

TEST(Loads, pressure_has_a_finite_tangent_on_the_axis) {
  Bench bench(box_mesh({.kind = ElementKind::quad8, .high = {3, 2, 0}, .cells = {2, 2, 1}}),
              Analysis::axisymmetric);
  const auto load = make_pressure(bench.mesh, bench.analysis, bench.pattern,
                                  faces_where(bench.mesh, 0, 0.0), TimeFunction(3.0));
  ASSERT_TRUE(bench.assemble(*load, bench.X));
  for (const double r : bench.system.residual)
    EXPECT_EQ(r, 0.0);
  for (const double k : bench.system.tangent.values)
    EXPECT_TRUE(std::isfinite(k));
}

TEST(Loads, pressure_all_around_a_body_has_no_resultant) {
  constexpr double rounding = 1e-12;
  for (const auto& element : every_element) {
    Bench bench(distorted_mesh(element), element.analysis);
    const auto load = make_pressure(bench.mesh, element.analysis, bench.pattern,
                                    boundary_faces(bench.mesh), TimeFunction(3.0));
    ASSERT_TRUE(bench.assemble(*load, bench.X));
    // In axisymmetry only the axial force is a resultant.
    for (int c = element.analysis == Analysis::axisymmetric ? 1 : 0; c < element.dim(); ++c)
      EXPECT_NEAR(bench.total(c), 0.0, rounding * 100.0) << element.name() << c;
  }
}

TEST(Loads, pressure_follows_its_amplitude_and_is_nothing_at_zero) {
  Bench bench(box_mesh({.kind = ElementKind::quad4}), Analysis::plane_strain);
  const auto load =
      make_pressure(bench.mesh, bench.analysis, bench.pattern, faces_where(bench.mesh, 0, 1.0),
                    TimeFunction({{0.0, 0.0}, {2.0, 8.0}}));
  ASSERT_TRUE(bench.assemble(*load, bench.X, 1.5));
  EXPECT_NEAR(bench.total(0), 6.0, load_tolerance * 6);
  ASSERT_TRUE(bench.assemble(*load, bench.X, 0.0));
  EXPECT_EQ(bench.total(0), 0.0);
  EXPECT_TRUE(bench.system.symmetric);
}

TEST(Loads, work_is_pressure_times_the_volume_swept) {
  // A face of area 2 x 3 moves by 0.25 against a constant pressure of 4; pressure pushes inward.
  Bench bench(box_mesh({.kind = ElementKind::hex20, .high = {1, 2, 3}}), Analysis::solid);
  const auto load = make_pressure(bench.mesh, bench.analysis, bench.pattern,
                                  faces_where(bench.mesh, 0, 1.0), TimeFunction(4.0));
  const auto x = support::moved(bench.X, 3, Vec3(0.75, 1, 1).asDiagonal());
  ASSERT_TRUE(bench.assemble(*load, x));
  load->commit({0.0, 1.0, bench.X, x});
  EXPECT_NEAR(load->work(), 4.0 * 6.0 * 0.25, 1e-12);
  load->commit({1.0, 2.0, x, bench.X});
  EXPECT_NEAR(load->work(), 0.0, 1e-12);
}

TEST(Loads, dead_forces_are_scaled_by_their_amplitude_and_do_work) {
  Bench bench(box_mesh({.kind = ElementKind::quad4}), Analysis::plane_strain);
  std::vector<double> forces(bench.X.size(), 0.0);
  forces[3] = 10.0;
  const auto load = make_dead_load(forces, TimeFunction({{0.0, 0.0}, {1.0, 1.0}}));
  ASSERT_TRUE(bench.assemble(*load, bench.X, 0.5));
  EXPECT_EQ(bench.system.residual[3], -5.0);
  EXPECT_TRUE(bench.system.symmetric);
  std::vector<double> x = bench.X;
  x[3] += 0.2;
  load->commit({0.0, 1.0, bench.X, x});
  EXPECT_NEAR(load->work(), 0.5 * 10.0 * 0.2, 1e-15); // trapezoidal: the force grew from 0
}

TEST(Loads, body_forces_sum_to_force_times_volume) {
  constexpr double rounding = 1e-13;
  for (const auto& element : every_element) {
    const Mesh mesh =
        box_mesh({.kind = element.kind, .low = {1, 0, 0}, .high = {3, 2, 2}, .cells = {3, 2, 2}});
    const Vec3 force(0.5, -2.0, 3.0);
    const auto forces = body_forces(mesh, element.analysis, force);
    const double volume = element.analysis == Analysis::axisymmetric ? std::numbers::pi * 8.0 * 2.0
                          : element.planar()                         ? 4.0
                                                                     : 8.0;
    for (int c = 0; c < element.dim(); ++c) {
      double sum = 0.0;
      for (Index a = 0; a < mesh.n_points(); ++a)
        sum += forces[static_cast<std::size_t>(a * element.dim() + c)];
      EXPECT_NEAR(sum, force[c] * volume, rounding * volume) << element.name();
    }
  }
}

TEST(RigidBodyStabilization, resists_motion_within_the_increment_only) {
  Bench bench(box_mesh({.kind = ElementKind::hex8}), Analysis::solid);
  RigidBodyStabilization stabilization(8.0, bench.pattern);
  stabilization.set_share(0.25);
  std::vector<double> x = bench.X;
  x[4] += 0.5;
  ASSERT_TRUE(bench.assemble(stabilization, x));
  std::vector<double> y(x.size());
  std::vector<double> unit(x.size(), 0.0);
  unit[4] = 1.0;
  bench.system.tangent.multiply(unit, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(bench.system.residual[i], i == 4 ? 1.0 : 0.0);
    EXPECT_EQ(y[i], i == 4 ? 2.0 : 0.0);
  }
  const Trial trial{0.0, 1.0, bench.X, x};
  EXPECT_EQ(stabilization.force_in(trial), 1.0);
  EXPECT_EQ(stabilization.work_in(trial), 0.5);
  ASSERT_TRUE(bench.assemble(stabilization, bench.X));
  EXPECT_EQ(bench.system.residual[4], 0.0);
}

} // namespace
} // namespace billet::mechanics::loads_test
