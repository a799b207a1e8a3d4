// Cook's membrane at finite strain, compressible and nearly incompressible: VALIDATION ELT-06.

#include "mechanics/loads/loads.h"
#include "mechanics/mesh/mesh_edges.h"
#include "tests/support/figures.h"
#include "tests/support/problems.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace billet::process::mechanics_cook_test {
namespace {

using mechanics::Analysis;
using mechanics::ElementKind;

/// 48 wide, 44 high at the left, 16 at the right, n x n cells, load 100 on the right edge. In space
/// one layer of unit thickness between rigid walls.
Scene membrane(ElementKind kind, int n, double poisson) {
  Scene scene;
  const bool solid = mechanics::dimension(kind) == 3;
  scene.part.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh({.kind = kind, .cells = {n, n, 1}});
  for (const char* wall : {"z-min", "z-max"})
    if (solid)
      support::support(scene, wall, 2);
  support::support(scene, "x-min", 0);
  support::support(scene, "x-min", 1);
  const auto right =
      support::faces_where(scene.part.mesh, [](const Vec3& p) { return p[0] == 1.0; });
  for (Vec3& p : scene.part.mesh.points) {
    const double x = 48.0 * p[0];
    p = Vec3(x, 44.0 / 48.0 * x + p[1] * (44.0 - 28.0 / 48.0 * x), p[2]);
  }
  scene.material = {{240.565, poisson}, mechanics::Elastic{}};
  scene.part.loads.push_back(
      DeadForces{mechanics::traction_forces(scene.part.mesh, scene.part.analysis, right,
                                            Vec3(0.0, 100.0 / 16.0, 0.0)),
                 TimeFunction({{0.0, 0.0}, {1.0, 1.0}})});
  support::one_stage(scene, 1.0, 5);
  return scene;
}

/// By how much the mean stress at the points differs from the mean at the nodes around, root mean
/// square over that of the mean stress itself: large where it alternates.
double roughness(const Run& process) {
  const mechanics::Mesh& mesh = process.mesh();
  const auto stresses = process.model.bulk->stresses(process.positions());
  const int points = process.model.bulk->points();
  std::vector<double> at_nodes(mesh.points.size(), 0.0);
  std::vector<double> count(mesh.points.size(), 0.0);
  const auto of_element = [&](Index e) {
    double mean = 0.0;
    for (int g = 0; g < points; ++g)
      mean += stresses[static_cast<std::size_t>(e * points + g)].trace() / 3.0 / points;
    return mean;
  };
  const auto corners = static_cast<std::size_t>(mechanics::corners_per_element(mesh.kind));
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (const Index node : mesh.cell(e).first(corners)) {
      at_nodes[static_cast<std::size_t>(node)] += of_element(e);
      count[static_cast<std::size_t>(node)] += 1.0;
    }
  double difference = 0.0, size = 0.0;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    double around = 0.0;
    for (const Index node : mesh.cell(e).first(corners))
      around += at_nodes[static_cast<std::size_t>(node)] / count[static_cast<std::size_t>(node)];
    around /= static_cast<double>(corners);
    for (int g = 0; g < points; ++g) {
      const double own = stresses[static_cast<std::size_t>(e * points + g)].trace() / 3.0;
      difference += (own - around) * (own - around);
      size += own * own;
    }
  }
  return std::sqrt(difference / size);
}

/// Vertical displacement of the top right corner.
double corner_rise(ElementKind kind, int n, double poisson) {
  Process process(membrane(kind, n, poisson));
  support::Recorder recorder;
  support::run_to_end(process, recorder);
  support::show(
      "ELT-06",
      fmt::format("{} nu {} n {} roughness of the mean stress", mechanics::name(kind), poisson, n),
      roughness(process), 0.0);
  const auto corner = support::nodes_where(process.view().mesh(), [](const Vec3& p) {
    return p[0] == 48.0 && std::abs(p[1] - 60.0) < 1e-9;
  });
  EXPECT_GE(corner.size(), 1U);
  return support::displacement(process, corner.at(0))[1];
}

struct Reference {
  double poisson;
  std::array<double, 3> quad8; ///< fe_cook.csv, n = 4, 8, 16
  double converged;            ///< VALIDATION's estimate
  double estimate_tolerance;
};
// The nearly incompressible estimate is an extrapolation of slowly converging values.
constexpr std::array references{Reference{0.3, {7.7988147, 7.8574768, 7.8745757}, 7.88, 0.01},
                                Reference{0.4999, {6.4031351, 6.7148801, 6.8402283}, 6.92, 0.02}};

TEST(Cook, ELT_06_quad8_agrees_with_an_independent_program_mesh_by_mesh) {
  // The same element, law and load; the table has 8 digits, its program a tolerance of its own.
  constexpr double tolerance = 1e-5;
  for (const Reference& reference : references)
    for (std::size_t i = 0; i < 3; ++i) {
      const int n = 4 << i;
      const double v = corner_rise(ElementKind::quad8, n, reference.poisson);
      support::show("ELT-06", fmt::format("quad8 nu {} n {} v", reference.poisson, n), v,
                    reference.quad8[i]);
      EXPECT_NEAR(v, reference.quad8[i], tolerance * reference.quad8[i]);
    }
}

TEST(Cook, ELT_06_quad4_with_mean_dilatation_does_not_lock) {
  for (const Reference& reference : references) {
    const double v16 = corner_rise(ElementKind::quad4, 16, reference.poisson);
    const double v32 = corner_rise(ElementKind::quad4, 32, reference.poisson);
    support::show("ELT-06", fmt::format("quad4 nu {} n 16 v", reference.poisson), v16,
                  reference.converged);
    support::show("ELT-06", fmt::format("quad4 nu {} n 32 v", reference.poisson), v32,
                  reference.converged);
    // A locking quad4 falls more than 15 % short at n = 16 (VALIDATION).
    constexpr double locking_band = 0.05;
    EXPECT_NEAR(v16, reference.converged, locking_band * reference.converged);
    EXPECT_NEAR(v32, reference.converged, reference.estimate_tolerance * reference.converged);
    EXPECT_LT(std::abs(v32 - reference.converged), std::abs(v16 - reference.converged));
  }
}

TEST(Cook, ELT_06_simplices_do_not_lock) {
  for (const ElementKind kind : {ElementKind::tri6, ElementKind::tet10})
    for (const Reference& reference : references) {
      double last = 0.0;
      for (const int n : {4, 8, 16}) {
        last = corner_rise(kind, n, reference.poisson);
        support::show("ELT-06",
                      fmt::format("{} nu {} n {} v", mechanics::name(kind), reference.poisson, n),
                      last, reference.converged);
      }
      EXPECT_NEAR(last, reference.converged, reference.estimate_tolerance * reference.converged);
    }
}

TEST(Cook, ELT_06_small_strain_plane_strain_limit_is_linear_in_the_load) {
  // A tenth of a thousandth of the load gives that share of the linear answer: no hidden scale.
  const auto rise = [](double share) {
    Scene scene = membrane(ElementKind::quad8, 4, 0.3);
    std::get<DeadForces>(scene.part.loads[0]).amplitude = TimeFunction({{0.0, 0.0}, {1.0, share}});
    const auto corner = support::nodes_where(scene.part.mesh, [](const Vec3& p) {
      return p[0] == 48.0 && std::abs(p[1] - 60.0) < 1e-9;
    });
    Process process(std::move(scene));
    support::Recorder recorder;
    support::run_to_end(process, recorder);
    return support::displacement(process, corner.at(0))[1] / share;
  };
  const double coarse = rise(1e-3);
  const double fine = rise(1e-4);
  support::show("ELT-06", "v per load at 1e-4 of it", fine, coarse);
  constexpr double nonlinearity = 1e-3; // of a rotation of 1e-4 .. 1e-3
  EXPECT_NEAR(fine, coarse, nonlinearity * coarse);
}

} // namespace
} // namespace billet::process::mechanics_cook_test
