// Metal that comes to a plane of symmetry or to the axis of revolution.

#include "process/loop/process.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace billet::process::symmetry_walls_test {
namespace {

constexpr double bore = 1.0, radius = 6.0, height = 4.0;

/// A ring between planes, squeezed from outside in a second until there is no bore left.
Scene squeezed_ring(ElementKind kind) {
  Scene scene;
  scene.part.analysis = Analysis::axisymmetric;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3(bore, 0, 0), Vec3(radius, height, 0), {10, 8, 1}, {1, 1, 1}});
  scene.part.supports = {held(scene.part.mesh, 1, 0.0), held(scene.part.mesh, 1, height),
                         held(scene.part.mesh, 0, radius)};
  scene.part.supports.back().displacement = TimeFunction({{0.0, 0.0}, {1.0, -0.11}});
  scene.material = {{200e3, 0.3}, mechanics::Linear{20.0, 5.0}}; // hoops shrink to nothing
  scene.stages = {{"squeeze", 1.0, {}, false}};
  return scene;
}

/// Of the part, by its elements [mm^3].
double volume(const FinishedRun& done) {
  const auto& end = done.process->view();
  return end.model.bulk->volume(end.state.x);
}

double least_radius(const FinishedRun& done) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < done.last().positions.size(); i += 2)
    least = std::min(least, done.last().positions[i]);
  return least;
}

const Wall* met_wall(const FinishedRun& done) {
  for (const Wall& wall : done.process->view().state.walls)
    if (wall.met)
      return &wall;
  return nullptr;
}

void expect_bore_closed(const FinishedRun& done) {
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& end = done.process->view();
  const Wall* wall = met_wall(done);
  ASSERT_NE(wall, nullptr) << least_radius(done);
  std::printf("[WALL] %s met since %.4f s from %.3f to %.3f mm, %d increments, %d cut-backs, least "
              "radius %.1e mm, balance %.1e, %zu new meshes\n",
              name_of_wall(*wall).c_str(), wall->met->since, wall->met->box.low.y(),
              wall->met->box.high.y(), end.state.increment, end.state.counters.cutbacks,
              least_radius(done), end.state.energy.error(), end.state.record.remeshings.size());
  EXPECT_GE(least_radius(done), 0.0);
  // A cylinder without a bore, but for what is left at the axis: there is no pocket between.
  const double least = least_radius(done), outside = radius - 0.11;
  const double whole = std::numbers::pi * (outside * outside - least * least) * height;
  EXPECT_NEAR(volume(done), whole, 1e-4 * whole);
  EXPECT_LE(end.state.energy.error(), 0.01);
}

TEST(SymmetryWall, a_bore_closes_on_it_and_metal_goes_no_further) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8}) {
    SCOPED_TRACE(mechanics::name(kind));
    expect_bore_closed(run(squeezed_ring(kind)));
  }
}

TEST(SymmetryWall, a_bore_that_has_closed_stays_closed_on_a_new_mesh) {
  Scene scene = squeezed_ring(ElementKind::quad8);
  scene.remesh = every(0.9);
  scene.remesh->quality = 1e-3;
  const FinishedRun done = run(std::move(scene));
  expect_bore_closed(done);
  EXPECT_GE(done.process->view().state.record.remeshings.size(), 1u);
}

TEST(SymmetryWall, are_planes_that_supports_hold_and_the_axis) {
  const auto walls = [](const Scene& scene) { return Process(scene).view().state.walls; };
  Scene billet_half = upsetting_scene(billet(ElementKind::quad8, 4, 0.1, {}));
  billet_half.contact.self = contact::Frictionless{};
  const std::vector<Wall> of_billet = walls(billet_half);
  ASSERT_EQ(of_billet.size(), 2u);
  EXPECT_TRUE(of_billet[0].axis);
  EXPECT_EQ(of_billet[1].component, 1);
  EXPECT_EQ(of_billet[1].at, 0.0);
  EXPECT_EQ(of_billet[1].sense, 1.0);
  EXPECT_FALSE(of_billet[1].off.empty());

  Scene clamped = billet_half; // at the foot, in both directions
  clamped.part.supports.push_back(held(clamped.part.mesh, 1, 0.0));
  clamped.part.supports.back().component = 0;
  EXPECT_EQ(walls(clamped).size(), 1u);

  Scene moved = billet_half;
  for (Support& support : moved.part.supports)
    if (support.component == 1)
      support.displacement = TimeFunction({{0.0, 0.0}, {1.0, 0.1}});
  EXPECT_EQ(walls(moved).size(), 1u);

  Scene deaf = billet_half;
  deaf.contact.self.reset();
  EXPECT_EQ(walls(deaf).size(), 1u);
}

TEST(SymmetryWall, is_known_on_a_coarse_quarter_whose_planes_share_most_nodes) {
  Scene quarter;
  quarter.part.analysis = Analysis::solid;
  quarter.part.mesh =
      mechanics::box_mesh({ElementKind::hex8, Vec3::Zero(), Vec3(4, 4, 4), {2, 2, 2}, {1, 1, 1}});
  for (int axis = 0; axis < 3; ++axis)
    quarter.part.supports.push_back(held(quarter.part.mesh, axis, 0.0));
  quarter.material = billet_steel();
  quarter.stages = {{"rest", 1.0, {}, false}};
  quarter.contact.self = contact::Frictionless{};
  EXPECT_EQ(Process(quarter).view().state.walls.size(), 3u);

  Scene clamped = quarter; // at the foot, in all directions
  for (const int axis : {0, 1}) {
    clamped.part.supports.push_back(held(clamped.part.mesh, 2, 0.0));
    clamped.part.supports.back().component = axis;
  }
  const std::vector<Wall> walls = Process(clamped).view().state.walls;
  EXPECT_TRUE(std::none_of(walls.begin(), walls.end(),
                           [](const Wall& wall) { return wall.component == 2; }));
}

/// Supports that hold a part against rigid motion, or at its feet, are no planes of symmetry: the
/// metal between them is free to come to that height.
TEST(SymmetryWall, is_no_single_node_edge_or_foot) {
  Scene beam;
  beam.part.analysis = Analysis::plane_strain;
  beam.part.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(20, 1, 0), {20, 2, 1}, {1, 1, 1}});
  beam.material = billet_steel();
  beam.stages = {{"rest", 1.0, {}, false}};
  beam.contact.self = contact::Frictionless{};
  const auto n_walls = [&](double foot) {
    Scene scene = beam;
    Support feet = held(scene.part.mesh, 1, 0.0);
    std::erase_if(feet.nodes, [&](Index node) {
      const double x = scene.part.mesh.points[as_size(node)].x();
      return x > foot && x < 20.0 - foot;
    });
    scene.part.supports = {feet, {{0}, 0, TimeFunction(0.0)}};
    return Process(std::move(scene)).view().state.walls.size();
  };
  EXPECT_EQ(n_walls(0.0), 0u);
  EXPECT_EQ(n_walls(2.0), 0u);
  EXPECT_EQ(n_walls(10.0), 1u);

  Scene edge; // of a block in space
  edge.part.analysis = Analysis::solid;
  edge.part.mesh =
      mechanics::box_mesh({ElementKind::hex8, Vec3::Zero(), Vec3(4, 4, 4), {2, 2, 2}, {1, 1, 1}});
  Support one = held(edge.part.mesh, 0, 0.0);
  std::erase_if(one.nodes,
                [&](Index node) { return edge.part.mesh.points[as_size(node)].y() > 0.0; });
  edge.part.supports = {one};
  for (const int axis : {1, 2})
    edge.part.supports.push_back({{0, 2, 6}, axis, TimeFunction(0.0)});
  edge.material = billet_steel();
  edge.stages = beam.stages;
  edge.contact.self = contact::Frictionless{};
  EXPECT_TRUE(Process(std::move(edge)).view().state.walls.empty());
}

/// Half of a block with a crack that is open to one side, pressed down by 0.4 mm in a second.
Scene cracked_block(double crack, bool is_wall) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(10, 4, 0), {10, 4, 1}, {1, 1, 1}});
  Support plane = held(scene.part.mesh, 1, 0.0);
  std::erase_if(plane.nodes,
                [&](Index node) { return scene.part.mesh.points[as_size(node)].x() > crack; });
  Support top = held(scene.part.mesh, 1, 4.0);
  top.displacement = TimeFunction({{0.0, 0.0}, {1.0, -0.4}});
  scene.part.supports = {plane, held(scene.part.mesh, 0, 0.0), top};
  scene.material = billet_steel();
  scene.stages = {{"press", 1.0, {}, false}};
  if (is_wall)
    scene.contact.self = contact::Frictionless{};
  return scene;
}

double force_from_above(const FinishedRun& done) {
  const auto& end = done.process->view();
  double force = 0.0;
  for (const Index node : end.part().supports.back().nodes)
    force += end.state.reactions[as_size(2 * node + 1)];
  return force;
}

TEST(SymmetryWall, a_crack_that_is_pressed_shut_bears_as_the_whole_does) {
  const FinishedRun whole = run(cracked_block(10.0, true)), cracked = run(cracked_block(5.0, true)),
                    without = run(cracked_block(5.0, false));
  ASSERT_EQ(whole.status, RunStatus::done);
  ASSERT_EQ(cracked.status, RunStatus::done);
  std::printf("[WALL] force %.6g N, without a crack %.6g, where it is no wall %.6g\n",
              force_from_above(cracked), force_from_above(whole), force_from_above(without));
  EXPECT_NEAR(force_from_above(cracked), force_from_above(whole),
              1e-3 * std::abs(force_from_above(whole)));
  Scene remeshed_block = cracked_block(5.0, true);
  remeshed_block.remesh = every(0.3);
  const FinishedRun on_new_meshes = run(std::move(remeshed_block));
  ASSERT_EQ(on_new_meshes.status, RunStatus::done);
  EXPECT_GE(on_new_meshes.process->view().state.record.remeshings.size(), 3u);
  EXPECT_NEAR(force_from_above(on_new_meshes), force_from_above(whole),
              5e-3 * std::abs(force_from_above(whole)));
  EXPECT_GT(std::abs(force_from_above(without) - force_from_above(whole)),
            0.05 * std::abs(force_from_above(whole)));
}

TEST(SymmetryWall, a_solid_part_has_no_bore) {
  Scene scene = remeshed(billet(ElementKind::quad8, 6, 0.3, contact::Sticking{}), every(0.2));
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(met_wall(done), nullptr);
}

} // namespace
} // namespace billet::process::symmetry_walls_test
