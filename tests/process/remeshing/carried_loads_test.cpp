// Tractions, body forces, and nodes inside a part, on its new meshes.

#include "mechanics/loads/loads.h"
#include "process/loop/process.h"
#include "process/remeshing/inner_nodes.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace billet::process::carried_loads_test {
namespace {

constexpr double young = 1000.0; ///< of rubber: shapes change [MPa]
constexpr double side = 10.0;

/// A block or cylinder that is held on planes through the origin, in one stage of a second.
Scene block(Analysis analysis, const mechanics::Material& material) {
  Scene scene;
  const bool solid = analysis == Analysis::solid;
  scene.part.analysis = analysis;
  scene.part.mesh = mechanics::box_mesh({solid ? ElementKind::hex8 : ElementKind::quad8,
                                         Vec3::Zero(),
                                         solid ? Vec3(side, side, side) : Vec3(side, side, 0),
                                         {4, 4, 4},
                                         {1, 1, 1}});
  for (int axis = 0; axis <= up(analysis); ++axis)
    if (axis != 0 || analysis != Analysis::axisymmetric)
      scene.part.supports.push_back(held(scene.part.mesh, axis, 0.0));
  if (analysis == Analysis::axisymmetric)
    scene.part.supports.push_back(held(scene.part.mesh, 0, 0.0));
  scene.material = material;
  scene.stages = {{"load", 1.0, {}, false}};
  scene.increments.first = scene.increments.max = 0.05;
  scene.remesh = every(0.2);
  return scene;
}

DeadForces traction_on(const Scene& scene, int axis, const Vec3& traction) {
  const std::vector<mechanics::Face> faces = faces_on(scene.part.mesh, axis, side);
  return {mechanics::traction_forces(scene.part.mesh, scene.part.analysis, faces, traction),
          TimeFunction({{0.0, 0.0}, {1.0, 1.0}}),
          {.faces = faces,
           .tractions = std::vector<Vec3>(faces.size(), traction),
           .body = Vec3::Zero()}};
}

DeadForces weight(const Scene& scene, const Vec3& force) {
  return {mechanics::body_forces(scene.part.mesh, scene.part.analysis, force),
          TimeFunction({{0.0, 0.0}, {1.0, 1.0}}),
          {.faces = {}, .tractions = {}, .body = force}};
}

/// Of the supports, along an axis [N].
double reaction(const Run& run, int axis) {
  const int dim = run.mesh().dimension();
  double sum = 0.0;
  for (std::size_t i = as_size(axis); i < run.state.reactions.size(); i += as_size(dim))
    sum += run.state.reactions[i];
  return sum;
}

std::string name_of(Analysis analysis) {
  return analysis == Analysis::solid          ? "solid"
         : analysis == Analysis::plane_strain ? "plane strain"
                                              : "axisymmetric";
}

TEST(CarriedLoads, a_traction_stretches_evenly_over_new_meshes) {
  for (const Analysis analysis :
       {Analysis::plane_strain, Analysis::axisymmetric, Analysis::solid}) {
    SCOPED_TRACE(name_of(analysis));
    const int axis = up(analysis);
    Scene scene = block(analysis, elastic_body(young, 0.0));
    scene.part.loads.emplace_back(traction_on(scene, axis, 200.0 * Vec3::Unit(axis)));
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    const auto& end = done.process->view();
    ASSERT_GE(end.state.record.remeshings.size(), 4u);
    const double area = analysis == Analysis::axisymmetric ? std::numbers::pi * side * side
                        : analysis == Analysis::solid      ? side * side
                                                           : side;
    // Kirchhoff's stress E ln(h / h0) over h / h0 is the traction, without lateral strain.
    double strain = 0.0;
    for (int k = 0; k < 100; ++k)
      strain = 0.2 * std::exp(strain);
    const double exact = side * std::exp(strain);
    const double found = largest_position(done.last(), end.mesh().dimension(), axis);
    std::printf("[TRACTION] %s: reaction %.8f of it, length %.6f mm of %.6f\n",
                name_of(analysis).c_str(), -reaction(end, axis) / (200.0 * area), found, exact);
    EXPECT_NEAR(reaction(end, axis), -200.0 * area, 1e-6 * 200.0 * area);
    EXPECT_NEAR(found, exact, 1e-3 * side);
  }
}

TEST(CarriedLoads, a_traction_on_a_cylinder_stays_what_it_was_in_all) {
  Scene scene = block(Analysis::axisymmetric, elastic_body(young, 0.3));
  scene.part.loads.emplace_back(traction_on(scene, 0, Vec3(150.0, 30.0, 0.0)));
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& end = done.process->view();
  ASSERT_GE(end.state.record.remeshings.size(), 4u);
  const double area = 2.0 * std::numbers::pi * side * side;
  EXPECT_NEAR(reaction(end, 1), -30.0 * area, 1e-6 * 30.0 * area);
  const auto& load = std::get<DeadForces>(end.part().loads[0]);
  double radial = 0.0;
  for (std::size_t i = 0; i < load.forces.size(); i += 2)
    radial += load.forces[i];
  EXPECT_NEAR(radial, 150.0 * area, 1e-6 * 150.0 * area);
}

TEST(CarriedLoads, a_body_force_stays_the_weight_of_the_part) {
  for (const Analysis analysis : {Analysis::plane_strain, Analysis::solid}) {
    SCOPED_TRACE(name_of(analysis));
    const int axis = up(analysis);
    Scene scene = block(analysis, elastic_body(young, 0.0));
    const double heavy = 10.0; // N/mm^3
    scene.part.loads.emplace_back(weight(scene, -heavy * Vec3::Unit(axis)));
    Scene alone = scene;
    alone.remesh.reset();
    const FinishedRun done = run(std::move(scene)), without = run(std::move(alone));
    ASSERT_EQ(done.status, RunStatus::done);
    const auto& end = done.process->view();
    ASSERT_GE(end.state.record.remeshings.size(), 4u);
    const double all = heavy * (analysis == Analysis::solid ? side * side * side : side * side);
    const int dim = end.mesh().dimension();
    const double height = largest_position(done.last(), dim, axis);
    const double expected = largest_position(without.last(), dim, axis);
    std::printf("[WEIGHT] %s: reaction %.8f of it, height %.6f mm, without new meshes %.6f\n",
                name_of(analysis).c_str(), reaction(end, axis) / all, height, expected);
    EXPECT_NEAR(reaction(end, axis), all, 1e-6 * all);
    EXPECT_NEAR(height, expected, 2e-3 * side);
  }
}

// ------------------------------------------------------------------- nodes inside

/// Where the material at a node was at the start.
Vec3 origin_of(const Run& run, Index node) {
  const int dim = run.mesh().dimension();
  Vec3 origin = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
    origin[i] = run.state.origins[as_size(dim * node + i)];
  return origin;
}

TEST(CarriedLoads, sets_inside_the_part_stay_with_their_metal) {
  for (const Analysis analysis : {Analysis::plane_strain, Analysis::solid}) {
    SCOPED_TRACE(name_of(analysis));
    const bool solid = analysis == Analysis::solid;
    const int axis = up(analysis);
    Scene scene = block(analysis, elastic_body(young, 0.3));
    scene.part.loads.emplace_back(traction_on(scene, axis, 200.0 * Vec3::Unit(axis)));
    const Vec3 place(7.5, 5.0, solid ? 2.5 : 0.0);
    mechanics::Mesh& mesh = scene.part.mesh;
    for (Index a = 0; a < mesh.n_points(); ++a) {
      const Vec3& x = mesh.points[as_size(a)];
      if ((x - place).norm() < 1e-9)
        mesh.node_sets["probe"].push_back(a);
      if (x.x() < 5.1 && x.y() < 5.1)
        mesh.node_sets["region"].push_back(a);
    }
    ASSERT_EQ(mesh.node_sets["probe"].size(), 1u);
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    const auto& end = done.process->view();
    ASSERT_GE(end.state.record.remeshings.size(), 4u);
    const auto& sets = end.mesh().node_sets;
    ASSERT_EQ(sets.at("probe").size(), 1u);
    const Vec3 origin = origin_of(end, sets.at("probe")[0]);
    // What is on the wrong side of the region's edge by so much [mm].
    const auto astray = [&](double margin) {
      std::size_t count = 0;
      for (Index a = 0; a < end.mesh().n_points(); ++a) {
        const Vec3 x = origin_of(end, a);
        const bool in = std::binary_search(sets.at("region").begin(), sets.at("region").end(), a);
        const bool inside = x.x() < 5.0 - margin && x.y() < 5.0 - margin;
        const bool beyond = x.x() > 5.0 + margin || x.y() > 5.0 + margin;
        count += (inside && !in) || (beyond && in) ? 1u : 0u;
      }
      return count;
    };
    std::printf("[SETS] %s: the node is %.2e mm from its metal; %zu nodes of the region\n",
                name_of(analysis).c_str(), (origin - place).norm(), sets.at("region").size());
    EXPECT_NEAR((origin - place).norm(), 0.0, 0.02);
    // Half an element, which is 2.5 mm long, with each of the new meshes.
    EXPECT_LE(astray(2.6), sets.at("region").size() / 40);
    EXPECT_EQ(astray(4.5), 0u);
  }
}

TEST(CarriedLoads, a_support_inside_the_part_holds_on_new_meshes) {
  Scene scene = block(Analysis::plane_strain, elastic_body(young, 0.3));
  scene.part.loads.emplace_back(traction_on(scene, 1, Vec3(0, 100.0, 0)));
  Support inner{{}, 1, TimeFunction(0.0)};
  for (Index a = 0; a < scene.part.mesh.n_points(); ++a)
    if ((scene.part.mesh.points[as_size(a)] - Vec3(5, 5, 0)).norm() < 1e-9)
      inner.nodes.push_back(a);
  ASSERT_EQ(inner.nodes.size(), 1u);
  scene.part.supports.push_back(inner);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& end = done.process->view();
  ASSERT_GE(end.state.record.remeshings.size(), 4u);
  ASSERT_EQ(end.part().supports.back().nodes.size(), 1u);
  const Index node = end.part().supports.back().nodes[0];
  EXPECT_NEAR(end.state.x[as_size(2 * node + 1)], 5.0, 1e-6);
  EXPECT_LT(end.state.reactions[as_size(2 * node + 1)], -1.0);
}

} // namespace
} // namespace billet::process::carried_loads_test
