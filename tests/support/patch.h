// The patch test: MacNeal and Harder's distorted meshes, boundary positions prescribed to F X.
//
// R. H. MacNeal, R. L. Harder: A proposed standard set of problems to test finite element accuracy,
// Finite Elements in Analysis and Design 1 (1985), 3-20.

#pragma once

#include "mechanics/bulk/bulk.h"
#include "mechanics/equilibrium/newton.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "mechanics/mesh/simplex_cells.h"
#include "tests/support/element_probe.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace billet::support {

using mechanics::Index;

/// A mesh of a kind from quadrilaterals or hexahedra; simplices by cutting each of them.
inline mechanics::Mesh
mesh_of(mechanics::ElementKind kind, std::vector<Vec3> points, std::vector<Index> corners) {
  if (mechanics::is_simplex(kind))
    corners = mechanics::cut_into_simplices(mechanics::dimension(kind), corners);
  if (mechanics::is_quadratic(kind))
    return mechanics::quadratic_mesh(kind, std::move(points), corners);
  return {.kind = kind, .points = std::move(points), .cells = std::move(corners), .node_sets = {}};
}

/// 5 cells in a rectangle 0.24 x 0.12.
inline mechanics::Mesh plane_patch(mechanics::ElementKind kind) {
  return mesh_of(kind,
                 {{0, 0, 0},
                  {0.24, 0, 0},
                  {0.24, 0.12, 0},
                  {0, 0.12, 0},
                  {0.04, 0.02, 0},
                  {0.18, 0.03, 0},
                  {0.16, 0.08, 0},
                  {0.08, 0.08, 0}},
                 {4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7});
}

/// 7 cells in a unit cube.
inline mechanics::Mesh solid_patch(mechanics::ElementKind kind) {
  return mesh_of(kind,
                 {{0, 0, 0},
                  {1, 0, 0},
                  {1, 1, 0},
                  {0, 1, 0},
                  {0, 0, 1},
                  {1, 0, 1},
                  {1, 1, 1},
                  {0, 1, 1},
                  {0.249, 0.342, 0.192},
                  {0.826, 0.288, 0.288},
                  {0.850, 0.649, 0.263},
                  {0.273, 0.750, 0.230},
                  {0.320, 0.186, 0.643},
                  {0.677, 0.305, 0.683},
                  {0.788, 0.693, 0.644},
                  {0.165, 0.745, 0.702}},
                 {8,  9,  10, 11, 12, 13, 14, 15, 0, 1, 2, 3,  8,  9, 10, 11, 12, 13, 14,
                  15, 4,  5,  6,  7,  0,  1,  9,  8, 4, 5, 13, 12, 9, 1,  2,  10, 13, 5,
                  6,  14, 11, 10, 2,  3,  15, 14, 6, 7, 0, 8,  11, 3, 4,  12, 15, 7});
}

inline std::set<Index> boundary_nodes(const mechanics::Mesh& mesh) {
  std::set<Index> nodes;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh))
    nodes.insert(face.nodes.begin(), face.nodes.end());
  return nodes;
}

inline std::vector<double> flat(const mechanics::Mesh& mesh) {
  std::vector<double> x;
  for (const Vec3& p : mesh.points)
    x.insert(x.end(), p.data(), p.data() + mesh.dimension());
  return x;
}

/// A mesh in equilibrium with its boundary where it is prescribed to be.
class Patch {
public:
  Patch(mechanics::Mesh mesh, mechanics::Analysis analysis, const mechanics::Material& material)
      : mesh_(std::move(mesh)), pattern_(mechanics::block_pattern(mesh_)),
        bulk_(mesh_, analysis, material, pattern_), boundary_(boundary_nodes(mesh_)),
        X_(flat(mesh_)), x_(X_),
        // Far below what is asked of the result; the floor only counts without any load.
        newton_(pattern_,
                mechanics::SolverSettings{},
                {1e-12, 40, 1e-9 * material.elasticity.young}) {}
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;

  /// Moves the boundary to F X in one increment, finds the interior and commits.
  void impose(const Mat3& F) {
    const std::vector<double> wanted = moved(X_, mesh_.dimension(), F);
    mechanics::Prescribed prescribed;
    for (const Index node : boundary_)
      for (Index i = node * mesh_.dimension(); i < (node + 1) * mesh_.dimension(); ++i) {
        prescribed.unknowns.push_back(i);
        prescribed.positions.push_back(wanted[static_cast<std::size_t>(i)]);
      }
    const std::vector<double> old = x_;
    mechanics::ForceTerm* terms[] = {&bulk_};
    const auto outcome = newton_.solve(terms, prescribed, time_, time_ + 1.0, old, x_);
    ASSERT_TRUE(outcome) << outcome.error().reason;
    bulk_.commit({time_, time_ + 1.0, old, x_});
    time_ += 1.0;
  }

  /// Largest distance of a node from F X.
  [[nodiscard]] double misplacement(const Mat3& F) const {
    const std::vector<double> wanted = moved(X_, mesh_.dimension(), F);
    double worst = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i)
      worst = std::max(worst, std::abs(x_[i] - wanted[i]));
    return worst;
  }
  [[nodiscard]] std::vector<Mat3> stresses() const { return bulk_.stresses(x_); }
  [[nodiscard]] const mechanics::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] bool has_interior() const { return boundary_.size() < mesh_.points.size(); }

private:
  mechanics::Mesh mesh_;
  mechanics::BlockPattern pattern_;
  mechanics::Bulk bulk_;
  std::set<Index> boundary_;
  std::vector<double> X_;
  std::vector<double> x_;
  double time_ = 0.0;
  mechanics::Newton newton_;
};

/// Largest difference of the stresses from one value.
inline double spread(const std::vector<Mat3>& stresses, const Mat3& reference) {
  double worst = 0.0;
  for (const Mat3& sigma : stresses)
    worst = std::max(worst, (sigma - reference).cwiseAbs().maxCoeff());
  return worst;
}

} // namespace billet::support
