// A part in space remeshed in the middle of a run, compared with the same run without.

#include "mechanics/elements/mesh_check.h"
#include "mechanics/elements/mesh_locator.h"
#include "process/loop/process.h"
#include "process/remeshing/solid_part.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace billet::process::solid_remeshing_test {
namespace {

constexpr double radius = 5.0;
constexpr double height = 7.5;
constexpr double rounding = 1e-12;

/// A quarter of the upper half of a cylinder.
Upsetting quarter(ElementKind kind, const contact::Friction& friction, double reduction) {
  Upsetting u;
  u.analysis = Analysis::solid;
  u.height = height;
  u.mesh = mechanics::cylinder_mesh({.kind = kind,
                                     .radius = radius,
                                     .height = height,
                                     .n_radius = 4,
                                     .n_height = 5,
                                     .sector = 90});
  u.friction = friction;
  u.reduction = reduction;
  return u;
}

RemeshSettings every(double interval, double size = 0.0) {
  RemeshSettings settings;
  settings.interval = interval;
  if (size > 0.0)
    settings.size = size;
  return settings;
}

std::vector<Index> unique_nodes(const std::vector<mechanics::Face>& faces) {
  std::set<Index> nodes;
  for (const mechanics::Face& face : faces)
    nodes.insert(face.nodes.begin(), face.nodes.end());
  return {nodes.begin(), nodes.end()};
}

// ------------------------------------------------------------- what hangs on the boundary

TEST(SolidPart, FindsSupportsSetsAndLoadsAgain) {
  for (const ElementKind kind : {ElementKind::hex20, ElementKind::hex8, ElementKind::tet10}) {
    SCOPED_TRACE(mechanics::name(kind));
    Scene scene = upsetting_scene(quarter(kind, contact::Frictionless{}, 0.1));
    scene.part.loads.push_back(
        PressureOn{faces_on(scene.part.mesh, 2, height), TimeFunction(10.0)});
    // A line and a point that carry something alone.
    std::vector<Index> line, point;
    for (Index a = 0; a < scene.part.mesh.n_points(); ++a) {
      const Vec3& x = scene.part.mesh.points[as_size(a)];
      if (std::abs(std::hypot(x.x(), x.y()) - radius) < 1e-6 && std::abs(x.z() - height) < rounding)
        line.push_back(a);
      if (std::abs(x.z() - height) < rounding && std::hypot(x.x(), x.y()) < rounding)
        point.push_back(a);
    }
    scene.part.supports.push_back({line, 2, TimeFunction(0.0)});
    scene.part.mesh.node_sets["pole"] = point;
    const std::vector<double> x = mechanics::node_positions(scene.part.mesh);
    std::vector<int> touching; // the die, above: what touches is not moved for the volume
    for (const mechanics::Face& face : scene.part.contact_faces)
      touching.push_back(std::all_of(face.nodes.begin(), face.nodes.end(),
                                     [&](Index a) {
                                       return std::abs(scene.part.mesh.points[as_size(a)].z() -
                                                       height) < rounding;
                                     })
                             ? 0
                             : -1);
    const SolidPart part = solid_part(scene.part, x, touching, {});
    geometry::SolidSizes sizes;
    sizes.min = 0.4;
    sizes.max = 1.6;
    const RemeshedPart anew = remesh_part(scene.part, part, sizes, {});
    const double off = anew.measure / part.volume - 1.0;
    const std::vector<double> qualities = mechanics::element_qualities(anew.mesh, anew.mesh.points);
    std::printf("%s: %d tet10, worst %.2f, volume %+.1e\n",
                std::string(mechanics::name(kind)).c_str(),
                static_cast<int>(anew.mesh.n_elements()),
                *std::min_element(qualities.begin(), qualities.end()), off);
    EXPECT_LT(std::abs(off), 1e-10);
    ASSERT_EQ(anew.supports.size(), scene.part.supports.size());
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(anew.supports[as_size(axis)].nodes, nodes_at(anew.mesh, axis, 0.0)) << axis;
    std::vector<Index> rim;
    for (const mechanics::Face& face : mechanics::boundary_faces(anew.mesh))
      for (const Index a : face.nodes) {
        const Vec3& p = anew.mesh.points[as_size(a)];
        if (std::abs(std::hypot(p.x(), p.y()) - radius) < 0.02 &&
            std::abs(p.z() - height) < rounding)
          rim.push_back(a);
      }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    EXPECT_EQ(anew.supports[3].nodes, rim);
    ASSERT_EQ(anew.mesh.node_sets.at("pole").size(), 1u);
    const Vec3& pole = anew.mesh.points[as_size(anew.mesh.node_sets.at("pole")[0])];
    EXPECT_EQ(pole, Vec3(0, 0, height));
    const auto& pressed = std::get<PressureOn>(anew.loads[0]).faces;
    EXPECT_EQ(unique_nodes(pressed), nodes_at(anew.mesh, 2, height));
    EXPECT_EQ(unique_nodes(anew.contact_faces),
              unique_nodes(free_faces(anew.mesh, Analysis::solid)));
  }
}

TEST(SolidPart, ContactPointsAreFoundBetweenTheOldOnes) {
  const Scene scene = upsetting_scene(bar_upsetting(ElementKind::hex20));
  const std::vector<double> x = mechanics::node_positions(scene.part.mesh);
  const SolidPart part =
      solid_part(scene.part, x, std::vector<int>(scene.part.contact_faces.size(), -1), {});
  const mechanics::Bulk bulk(scene.part.mesh, scene.part.analysis, scene.material,
                             mechanics::block_pattern(scene.part.mesh));
  const mechanics::BlockPattern pattern = mechanics::block_pattern(scene.part.mesh);
  const contact::ContactSurface surface(scene.part.mesh, bulk, pattern, scene.part.contact_faces,
                                        scene.contact);
  std::vector<Vec3> old(surface.n_points());
  surface.positions(x, old);
  const ContactNeighbours neighbours(part, surface.face_coordinates());
  // Where old points are they are found, and linear fields between them.
  for (std::size_t k = 0; k < old.size(); ++k) {
    const contact::PointSource same = neighbours.around(old[k]);
    EXPECT_EQ(same.nearest(), k);
    double sum = 0.0;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(same.weights[i], 0.0);
      sum += same.weights[i];
      mean += same.weights[i] * old[same.points[i]];
    }
    EXPECT_NEAR(sum, 1.0, rounding);
    EXPECT_LT((mean - old[k]).norm(), rounding * height);
  }
}

// ------------------------------------------------------------------- whole runs

TEST(SolidRemeshingLong, GivesTheForceOfTheRunWithout) {
  const auto scene = [] {
    Scene s = upsetting_scene(quarter(ElementKind::hex20, contact::Coulomb{0.2}, 0.3));
    s.landing_times = {0.15 * height};
    return s;
  };
  const FinishedRun plain = run(scene());
  Scene with = scene();
  with.remesh = every(0.08 * height, 1.6);
  const FinishedRun done = run(std::move(with));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_GE(done.process->view().state.record.remeshings.size(), 3u);
  EXPECT_EQ(done.process->view().mesh().kind, ElementKind::tet10);
  for (const RemeshReport& r : done.process->view().state.record.remeshings) {
    std::printf("remeshing %d at %.3f: %d -> %d elements, quality %.2f -> %.2f, volume %+.1e, work "
                "%.1e, force %.1e, residual %.1e\n",
                r.number, r.time, static_cast<int>(r.elements[0]), static_cast<int>(r.elements[1]),
                r.quality.before, r.quality.after, r.volume.after / r.volume.before - 1.0,
                r.work_change(), r.force_jump(), r.residual);
    EXPECT_TRUE(r.balanced);
    EXPECT_LT(r.volume.change(), 1e-6);
    EXPECT_LT(r.work_change(), 5e-3) << "the budget of RM-01";
    EXPECT_GT(r.quality.after, 0.1);
  }
  for (const double reduction : {0.15, 0.3}) {
    const Entry& a = plain.at(reduction * height);
    const Entry& b = done.at(reduction * height);
    const double force_off = b.loads[0].force.norm() / a.loads[0].force.norm() - 1.0;
    const double radius_off = largest_position(b, 3, 0) / largest_position(a, 3, 0) - 1.0;
    std::printf("at %.0f %%: force %+.2f %%, radius %+.3f %% of the run without\n",
                100.0 * reduction, 100.0 * force_off, 100.0 * radius_off);
    EXPECT_LT(std::abs(force_off), 0.01);
    EXPECT_LT(std::abs(radius_off), 0.002);
  }
}

TEST(SolidRemeshing, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<double>> positions;
  for (const std::size_t threads : {1, 2}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    Scene scene = upsetting_scene(quarter(ElementKind::hex8, contact::Coulomb{0.2}, 0.05));
    scene.remesh = every(0.02 * height, 2.5);
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    ASSERT_GE(done.process->view().state.record.remeshings.size(), 2u);
    positions.push_back(done.last().positions);
  }
  EXPECT_EQ(positions[0], positions[1]);
}

} // namespace
} // namespace billet::process::solid_remeshing_test
