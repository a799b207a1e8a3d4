// Patch tests on distorted meshes: VALIDATION ELT-01, ELT-02 and ELT-04 (i).

#include "tests/support/figures.h"
#include "tests/support/patch.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <array>

namespace billet::mechanics::patch_test {
namespace {

using support::Patch;
using support::show;
using support::show_error;

/// Mid-side nodes off-centre by 10 %, inner edges curved; `sag` over their length.
Mesh curved(Mesh mesh, double sag) {
  const std::set<Index> boundary = support::boundary_nodes(mesh);
  const auto corners = static_cast<std::size_t>(corners_per_element(mesh.kind));
  const auto edges = element_edges(mesh.kind);
  std::set<Index> done;
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Index middle = mesh.cell(e)[corners + i];
      if (!done.insert(middle).second)
        continue;
      const auto end = [&](int k) {
        return mesh.points[static_cast<std::size_t>(mesh.cell(e)[static_cast<std::size_t>(k)])];
      };
      const Vec3 along = end(edges[i][1]) - end(edges[i][0]);
      Vec3& p = mesh.points[static_cast<std::size_t>(middle)];
      p += 0.1 * along;
      if (!boundary.contains(middle))
        p += sag * Vec3(-along[1], along[0], 0.0);
    }
  return mesh;
}

struct Case {
  std::string name;
  Mesh mesh;
};

std::vector<Case> plane_cases() {
  return {{"quad4", support::plane_patch(ElementKind::quad4)},
          {"quad8", support::plane_patch(ElementKind::quad8)},
          {"quad8 curved", curved(support::plane_patch(ElementKind::quad8), 0.15)},
          {"tri6", support::plane_patch(ElementKind::tri6)},
          // A triangle of the patch is twelve times longer than high.
          {"tri6 curved", curved(support::plane_patch(ElementKind::tri6), 0.01)}};
}

std::vector<Case> solid_cases() {
  return {{"hex8", support::solid_patch(ElementKind::hex8)},
          {"hex20", support::solid_patch(ElementKind::hex20)},
          {"tet4", support::solid_patch(ElementKind::tet4)},
          {"tet10", support::solid_patch(ElementKind::tet10)}};
}

/// Stresses at all points in the limit of small strains: central differences in the size of the
/// displacement, extrapolated, so that neither second order terms nor rounding reach 1e-10.
std::vector<Mat3> small_strain_stresses(const Mesh& mesh, Analysis analysis, const Mat3& gradient) {
  const auto at = [&](double size) {
    Patch patch(mesh, analysis, {{1e6, 0.25}, Elastic{}});
    patch.impose(Mat3::Identity() + size * gradient);
    return patch.stresses();
  };
  const auto p1 = at(1.0);
  const auto m1 = at(-1.0);
  const auto p2 = at(0.5);
  const auto m2 = at(-0.5);
  std::vector<Mat3> result;
  for (std::size_t k = 0; k < p1.size(); ++k)
    result.emplace_back((4.0 * (p2[k] - m2[k]) - 0.5 * (p1[k] - m1[k])) / 3.0);
  return result;
}

constexpr double patch_tolerance = 1e-10; // VALIDATION ELT-01, relative, at every point

TEST(Patch, ELT_01_small_strains_in_the_plane_give_constant_stress) {
  Mat3 gradient = Mat3::Zero();
  gradient.topLeftCorner<2, 2>() << 1e-3, 0.5e-3, 0.5e-3, 1e-3;
  Mat3 reference = Vec3(1600, 1600, 800).asDiagonal();
  reference(0, 1) = reference(1, 0) = 400;
  for (const auto& [name, mesh] : plane_cases()) {
    const auto sigma = small_strain_stresses(mesh, Analysis::plane_strain, gradient);
    show("ELT-01", name + " sigma_xx", sigma[0](0, 0), 1600);
    show("ELT-01", name + " sigma_zz", sigma[0](2, 2), 800);
    show("ELT-01", name + " sigma_xy", sigma[0](0, 1), 400);
    const double error = support::spread(sigma, reference) / 1600;
    show_error("ELT-01", name + " worst point", error, patch_tolerance);
    EXPECT_LE(error, patch_tolerance) << name;
  }
}

TEST(Patch, ELT_01_small_strains_in_space_give_constant_stress) {
  Mat3 gradient = Mat3::Constant(0.5e-3);
  gradient.diagonal().setConstant(1e-3);
  Mat3 reference = Mat3::Constant(400);
  reference.diagonal().setConstant(2000);
  for (const auto& [name, mesh] : solid_cases()) {
    const auto sigma = small_strain_stresses(mesh, Analysis::solid, gradient);
    show("ELT-01", name + " sigma_xx", sigma[0](0, 0), 2000);
    show("ELT-01", name + " sigma_yz", sigma[0](1, 2), 400);
    const double error = support::spread(sigma, reference) / 2000;
    show_error("ELT-01", name + " worst point", error, patch_tolerance);
    EXPECT_LE(error, patch_tolerance) << name;
  }
}

// Deformations and stresses of elt02_finite_patch.csv (E = 1000, nu = 0.3, Hencky), 8 digits.
struct FinitePatch {
  std::string name;
  Mat3 F;
  Mat3 sigma;
};

Mat3 tensor(std::array<double, 9> v) {
  Mat3 A;
  A << v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8];
  return A;
}

FinitePatch plane_stretch() {
  return {"plane", tensor({1.2896733, 0.10600536, 0, 0.10600536, 0.86565184, 0, 0, 0, 1}),
          tensor({226.20935, 69.602878, 0, 69.602878, -52.202159, 0, 0, 0, 52.202159})};
}
FinitePatch plane_general() {
  return {"general", tensor({1.3, 0.4, 0, 0.1, 0.85, 0, 0, 0, 1}),
          tensor({233.95702, 148.97005, 0, 148.97005, -120.24304, 0, 0, 0, 34.114192})};
}
FinitePatch solid_stretch() {
  return {"solid",
          tensor({1.2263196, 0.082195651, -0.055673377, 0.082195651, 0.89173122, 0.057518752,
                  -0.055673377, 0.057518752, 1.1083681}),
          tensor({215.24271, 51.401244, -32.125777, 51.401244, 9.6377332, 38.550933, -32.125777,
                  38.550933, 150.99115})};
}

void check_finite(const Case& mesh, Analysis analysis, const FinitePatch& reference, int steps) {
  constexpr double tolerance = 1e-9; // VALIDATION ELT-02
  constexpr double digits = 3e-7;    // stress change by 8-digit F, at E = 1000: 3e-5 of 226
  Patch patch(mesh.mesh, analysis, {{1000, 0.3}, Elastic{}});
  for (int i = 1; i <= steps; ++i)
    patch.impose(Mat3::Identity() + (reference.F - Mat3::Identity()) * i / steps);
  ASSERT_TRUE(patch.has_interior());
  const auto sigma = patch.stresses();
  const std::string what =
      mesh.name + " " + reference.name + ", " + std::to_string(steps) + " steps";
  const double scale = reference.sigma.norm();
  show("ELT-02", what + " sigma_xx", sigma[0](0, 0), reference.sigma(0, 0));
  const double error =
      support::spread(sigma, support::hencky_stress(1000, 0.3, reference.F)) / scale;
  show_error("ELT-02", what + " stress", error, tolerance);
  show_error("ELT-02", what + " places", patch.misplacement(reference.F), tolerance);
  EXPECT_LE(support::spread(sigma, reference.sigma) / scale, digits) << what;
  EXPECT_LE(error, tolerance) << what;
  EXPECT_LE(patch.misplacement(reference.F), tolerance) << what;
}

TEST(Patch, ELT_02_finite_stretch_is_homogeneous_in_any_number_of_steps) {
  for (const int steps : {1, 5}) {
    for (const Case& mesh : plane_cases()) {
      check_finite(mesh, Analysis::plane_strain, plane_stretch(), steps);
      check_finite(mesh, Analysis::plane_strain, plane_general(), steps);
    }
    for (const Case& mesh : solid_cases())
      check_finite(mesh, Analysis::solid, solid_stretch(), steps);
  }
}

TEST(Patch, ELT_02_plastic_stretch_is_homogeneous_too) {
  // Perfectly plastic and hardening: the same history at every point.
  for (const auto& [name, mesh] : plane_cases()) {
    Patch patch(mesh, Analysis::plane_strain, {{200e3, 0.3}, Linear{300.0, 500.0}});
    const FinitePatch to = plane_stretch();
    // In fewer steps rounding decides whether Newton's method arrives: points lie on their yield
    // surfaces.
    constexpr int n_steps = 8;
    for (int i = 1; i <= n_steps; ++i)
      patch.impose(Mat3::Identity() + (to.F - Mat3::Identity()) * i / n_steps);
    const auto sigma = patch.stresses();
    const double error = support::spread(sigma, sigma[0]) / sigma[0].norm();
    // Positions are good to 1e-12; E over the stress makes 1e-9 of that.
    constexpr double tolerance = 1e-8;
    show_error("ELT-02", name + " plastic, spread of stress", error, tolerance);
    EXPECT_LE(error, tolerance) << name;
    EXPECT_LE(patch.misplacement(to.F), 1e-9);
    EXPECT_GT(support::von_mises(sigma[0]), 300.0);
  }
}

TEST(Patch, ELT_04_axisymmetric_stretch_is_homogeneous_also_at_the_axis) {
  constexpr double tolerance = 1e-10; // VALIDATION
  const Mat3 F = Vec3(1.1, 0.85, 1.1).asDiagonal();
  const Mat3 reference = support::hencky_stress(1000, 0.3, F);
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
    for (const double inner_radius : {0.0, 0.1}) {
      Mesh mesh = support::plane_patch(kind);
      for (Vec3& p : mesh.points)
        p[0] += inner_radius;
      Patch patch(mesh, Analysis::axisymmetric, {{1000, 0.3}, Elastic{}});
      patch.impose(F);
      const auto sigma = patch.stresses();
      const std::string what =
          std::string(name(kind)) + " inner radius " + std::to_string(inner_radius);
      show("ELT-04", what + " hoop - radial stress", sigma[0](2, 2) - sigma[0](0, 0), 0.0);
      const double error = support::spread(sigma, reference) / reference.norm();
      show_error("ELT-04", what + " stress", error, tolerance);
      EXPECT_LE(error, tolerance) << what;
      EXPECT_LE(patch.misplacement(F), tolerance) << what;
    }
}

} // namespace
} // namespace billet::mechanics::patch_test
