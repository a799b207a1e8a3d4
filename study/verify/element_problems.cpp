// The patch test on every element, at finite strain.
//
// Distorted patches of MacNeal and Harder (1985). The boundary is moved to F X, far beyond small
// strains and with a turn; whatever the mesh, the deformation inside is F and the stress is that of
// Hencky's elasticity, tau = 2 G dev(ln V) + K tr(ln V) 1, sigma = tau / det F.

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "study/verify/mesh_text.h"
#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

using mechanics::ElementKind;

constexpr double patch_young = 1000.0, patch_poisson = 0.3;
// Newton's method ends at a relative residual of 1e-12; stresses then have nine digits and more.
constexpr double patch_tolerance = 1e-9;

/// sigma of a homogeneous deformation [MPa].
Mat3 hencky_stress(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> b(F * F.transpose());
  const Vec3 strains = 0.5 * b.eigenvalues().array().log().matrix();
  const double shear = patch_young / (2.0 * (1.0 + patch_poisson));
  const double bulk = patch_young / (3.0 * (1.0 - 2.0 * patch_poisson));
  const double volume = strains.sum();
  const Vec3 tau =
      2.0 * shear * (strains.array() - volume / 3.0).matrix() + bulk * volume * Vec3::Ones();
  return b.eigenvectors() * tau.asDiagonal() * b.eigenvectors().transpose() / F.determinant();
}

/// Five quadrilaterals in a rectangle of 0.24 x 0.12.
CornerMesh plane_patch() {
  return {{{0, 0, 0},
           {0.24, 0, 0},
           {0.24, 0.12, 0},
           {0, 0.12, 0},
           {0.04, 0.02, 0},
           {0.18, 0.03, 0},
           {0.16, 0.08, 0},
           {0.08, 0.08, 0}},
          {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
}

/// Seven bricks in a unit cube.
CornerMesh cube_patch() {
  CornerMesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{8, 9, 10, 11, 12, 13, 14, 15}}};
  // Theirs are moved half of the way to those of a regular brick: one of their bricks has a corner
  // at which the Jacobian is negative, and such a mesh is refused.
  const std::array<Vec3, 8> theirs{{{0.249, 0.342, 0.192},
                                    {0.826, 0.288, 0.288},
                                    {0.850, 0.649, 0.263},
                                    {0.273, 0.750, 0.230},
                                    {0.320, 0.186, 0.643},
                                    {0.677, 0.305, 0.683},
                                    {0.788, 0.693, 0.644},
                                    {0.165, 0.745, 0.702}}};
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const Vec3 regular = 0.25 * Vec3::Ones() + 0.5 * mesh.points[i];
    mesh.points.emplace_back(0.5 * (theirs[i] + regular));
  }
  // Over each side of the inner brick one that reaches to the cube's side.
  for (const std::array<int, 4>& side :
       {std::array{0, 1, 2, 3}, std::array{4, 7, 6, 5}, std::array{0, 4, 5, 1},
        std::array{1, 5, 6, 2}, std::array{2, 6, 7, 3}, std::array{3, 7, 4, 0}}) {
    std::vector<int> brick(side.begin(), side.end());
    for (const int corner : side)
      brick.push_back(corner + 8);
    mesh.cells.push_back(brick);
  }
  return mesh;
}

/// Whether a node lies on the sides of the box [0, size].
bool on_box(const Vec3& p, const Vec3& size, int dim) {
  for (int i = 0; i < dim; ++i)
    if (p[i] == 0.0 || p[i] == size[i])
      return true;
  return false;
}

struct PatchCase {
  std::string analysis;
  ElementKind kind;
  CornerMesh corners;
  Vec3 size; ///< of the box [mm]
  Mat3 F;    ///< deformation gradient [-]
};

std::string patch_case_text(const PatchCase& patch, const mechanics::Mesh& mesh) {
  std::string text =
      fmt::format(R"(title = "Patch test of {0}"
analysis = "{1}"
[workpiece]
element = "{0}"
material = "elastic"
mesh = {{ file = "patch-{1}-{0}.inp" }}
[material.elastic]
elastic = {{ young = {2}, poisson = {3} }}
[time]
end = 1
increments = {{ first = 0.25, max = 0.25 }}
[solver]
tolerance = 1e-12
)",
                  mechanics::name(patch.kind), patch.analysis, patch_young, patch_poisson);
  for (const mechanics::Index node : mesh.node_sets.at("boundary")) {
    const Vec3& X = mesh.points[static_cast<std::size_t>(node)];
    const Vec3 u = patch.F * X - X;
    text +=
        fmt::format("[[support]]\nwhere = \"set:node-{}\"\nmove = {{ x = [[0, 0], [1, {}]], y = "
                    "[[0, 0], [1, {}]]",
                    node, u[0], u[1]);
    if (mesh.dimension() == 3)
      text += fmt::format(", z = [[0, 0], [1, {}]]", u[2]);
    text += " }\n";
  }
  return text;
}

/// Largest deviation of the stress at any integration point, as a share of the stress.
double largest_stress_error(const process::Run& run, const Mat3& sigma) {
  double largest = 0.0;
  for (const Mat3& found : run.model.bulk->stresses(run.positions()))
    largest = std::max(largest, (found - sigma).norm() / sigma.norm());
  return largest;
}

void add_patch_figures(const CaseBench& bench, const PatchCase& patch, std::vector<Figure>& to) {
  const std::string name = fmt::format("patch-{}-{}", patch.analysis, mechanics::name(patch.kind));
  mechanics::Mesh mesh = with_elements(patch.kind, patch.corners);
  name_nodes(mesh, "boundary",
             [&](const Vec3& p) { return on_box(p, patch.size, mesh.dimension()); });
  name_each_node(mesh, "boundary");
  bench.write(name + ".inp", inp_text(mesh));
  const auto process = bench.run(name, patch_case_text(patch, mesh));
  const Mat3 sigma = hencky_stress(patch.F);
  const process::Run& run = process->view();
  const Mat3 first = run.model.bulk->stresses(run.positions()).front();
  const std::string element(mechanics::name(patch.kind));
  to.push_back(relative(element + ": stress xx of the first point", "MPa", first(0, 0), sigma(0, 0),
                        patch_tolerance));
  to.push_back(absolute(element + ": largest error of the stress at any point, over the stress",
                        "-", largest_stress_error(run, sigma), 0.0, patch_tolerance));
}

} // namespace

std::vector<Figure> patch_in_the_plane(const CaseBench& bench) {
  Mat3 F;
  F << 1.25, 0.30, 0.0, -0.10, 0.90, 0.0, 0.0, 0.0, 1.0;
  std::vector<Figure> figures;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
    add_patch_figures(bench, {"plane-strain", kind, plane_patch(), {0.24, 0.12, 0}, F}, figures);
  return figures;
}

std::vector<Figure> patch_of_revolution(const CaseBench& bench) {
  const Mat3 F = Vec3(1.15, 0.8, 1.15).asDiagonal();
  std::vector<Figure> figures;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6})
    add_patch_figures(bench, {"axisymmetric", kind, plane_patch(), {0.24, 0.12, 0}, F}, figures);
  return figures;
}

std::vector<Figure> patch_in_space(const CaseBench& bench) {
  Mat3 F;
  F << 1.20, 0.25, 0.10, -0.10, 0.90, 0.05, 0.15, -0.05, 1.05;
  std::vector<Figure> figures;
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    add_patch_figures(bench, {"3d", kind, cube_patch(), {1, 1, 1}, F}, figures);
  return figures;
}

} // namespace billet::study
