// CON-01: the contact patch test (Taylor and Papadopoulos 1991).
//
// A block 2 x 1 (x 1) with distorted interior nodes lies on a rigid plane, frictionless; pressure
// 10 on its top. Pressure at every contact point is 10 (per current area), penetration uniform.

#include "geometry/surfaces/triangle_surface.h"
#include "tests/support/contact_scenes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace billet::process::contact_patch_test {
namespace {

constexpr double pressure = 10.0;
constexpr double tolerance = 1e-8; // VALIDATION CON-01, relative

struct Patch {
  ElementKind kind = ElementKind::quad8;
  contact::Form form = contact::Form::mixed;
  double tilt = 0.0; ///< of block and plane about z [rad]
  bool facets = false;
  bool free = false;          ///< no support: the block may slide; stabilization holds it
  double surface_shift = 0.0; ///< distorts the contact faces in their own plane
  bool depths_differ = false; ///< the layer that touches is distorted as well
};

mechanics::Mesh block(const Patch& patch) {
  mechanics::Mesh mesh =
      mechanics::box_mesh({patch.kind, Vec3::Zero(), Vec3(2, 1, 1), {4, 4, 3}, {1, 1, 1}});
  if (patch.surface_shift > 0.0)
    for (Vec3& p : mesh.points) {
      const double bump = std::sin(std::numbers::pi * p[0] / 2.0) *
                          (mesh.dimension() == 3 ? std::sin(std::numbers::pi * p[2]) : 1.0);
      const double x = p[0];
      p[0] += patch.surface_shift * bump;
      if (mesh.dimension() == 3)
        p[2] += patch.surface_shift * bump * std::cos(3.0 * x);
    }
  // The penalty of a face goes with the depth of the parent element.
  distort_inside(mesh, 0.06, 1, patch.depths_differ ? 0.0 : 0.3, 1.0);
  return mesh;
}

/// A square of triangles whose edges match nothing on the block.
geometry::SurfacePtr facetted_floor() {
  geometry::TriangleMesh floor;
  constexpr int n = 7;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      floor.points.emplace_back(-3.1 + 1.13 * i, 0.0, -3.3 + 1.07 * j);
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      floor.triangles.push_back({a, c, b}); // counter-clockwise seen from above (+y)
      floor.triangles.push_back({b, c, d});
    }
  return geometry::make_triangle_surface(floor);
}

Scene patch_scene(const Patch& patch) {
  Scene scene;
  const bool solid = mechanics::dimension(patch.kind) == 3;
  scene.part.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  scene.part.mesh = block(patch);
  scene.material = elastic_body(1000.0, 0.3);
  if (!patch.free) {
    scene.part.supports.push_back(held(scene.part.mesh, 0, 0.0));
    if (solid)
      scene.part.supports.push_back(held(scene.part.mesh, 2, 0.0));
  }
  scene.part.contact_faces = faces_on(scene.part.mesh, 1, 0.0);
  // Raised in the first second and held in the next: at rest the stabilization vanishes.
  scene.part.loads.push_back(
      PressureOn{faces_on(scene.part.mesh, 1, 1.0),
                 TimeFunction({{0.0, 0.0}, {1.0, pressure}, {2.0, pressure}})});
  const geometry::Pose pose = geometry::rotation_about(Vec3::Zero(), Vec3::UnitZ(), patch.tilt);
  for (Vec3& p : scene.part.mesh.points)
    p = pose.to_space(p);
  contact::Tool tool;
  tool.name = "floor";
  tool.surface = patch.facets ? facetted_floor() : geometry::make_plane({0, 0, 0}, {0, 1, 0});
  tool.motion.place = pose;
  // A little inside the block: what only touches gives Newton's first iteration no stiffness
  // (see PressedBlock).
  tool.motion.offset = 1e-5 * (pose.rotation * Vec3::UnitY());
  scene.tools.push_back(std::move(tool));
  scene.touch = {0};
  scene.contact.form = patch.form;
  scene.stages.push_back({"press", 2.0, {1}, false});
  scene.landing_times = {1.0};
  scene.increments.first = scene.increments.max = 0.5;
  scene.tolerance = 1e-10;
  return scene;
}

/// Largest deviation of the pressure, relative.
double pressure_error(const Patch& patch, const std::string& name) {
  const FinishedRun done = run(patch_scene(patch));
  EXPECT_EQ(done.status, RunStatus::done) << name;
  double worst = 0.0, shear = 0.0, stress = 0.0;
  const auto results = contact::point_results(*done.process->view().contact());
  for (const auto& point : results) {
    worst = std::max(worst, std::abs(point.pressure / pressure - 1.0));
    shear = std::max(shear, point.shear.norm());
  }
  const Vec3 normal(-std::sin(patch.tilt), std::cos(patch.tilt), 0.0);
  for (const Mat3& sigma :
       done.process->view().model.bulk->stresses(done.process->view().positions()))
    stress = std::max(stress, (sigma * normal + pressure * normal).norm() / pressure);
  std::printf("%-34s %3zu points: p = 10 (1 +- %.1e) (<= 1e-8), traction inside %.1e\n",
              name.c_str(), results.size(), worst, stress);
  EXPECT_EQ(shear, 0.0) << name;
  EXPECT_FALSE(results.empty());
  if (!patch.depths_differ) {
    EXPECT_LT(stress, 1e-7) << name; // all points inside see the same traction
  }
  return worst;
}

std::string label(const Patch& patch) {
  return std::string(mechanics::name(patch.kind)) +
         (patch.form == contact::Form::mixed ? " mixed" : " compatible") +
         (patch.tilt > 0.0 ? " inclined 30 deg" : "") + (patch.facets ? " facetted" : "") +
         (patch.surface_shift > 0.0 ? " distorted faces" : "") +
         (patch.depths_differ ? " depths differ" : "");
}

constexpr std::array kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                           ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                           ElementKind::tet10};

TEST(ContactPatch, HasUniformPressureOnAPlane) {
  for (const ElementKind kind : kinds)
    for (const auto form : {contact::Form::mixed, contact::Form::compatible}) {
      const Patch patch{kind, form};
      EXPECT_LT(pressure_error(patch, label(patch)), tolerance) << label(patch);
    }
}

TEST(ContactPatch, HasUniformPressureOnAnInclinedPlaneWithoutSupports) {
  for (const ElementKind kind : kinds) {
    const Patch patch{kind, contact::Form::mixed, std::numbers::pi / 6.0, false, true};
    EXPECT_LT(pressure_error(patch, label(patch)), tolerance) << label(patch);
  }
}

TEST(ContactPatch, HasUniformPressureOnAFacettedPlane) {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    for (const double tilt : {0.0, std::numbers::pi / 6.0}) {
      const Patch patch{kind, contact::Form::mixed, tilt, true, tilt > 0.0};
      EXPECT_LT(pressure_error(patch, label(patch)), tolerance) << label(patch);
    }
}

TEST(ContactPatch, HasUniformPressureOnContactFacesThatAreDistorted) {
  for (const ElementKind kind : kinds)
    for (const auto form : {contact::Form::mixed, contact::Form::compatible}) {
      const Patch patch{kind, form, 0.0, false, false, 0.08};
      EXPECT_LT(pressure_error(patch, label(patch)), tolerance) << label(patch);
    }
}

// Where neighbouring faces have elements of different depth beneath, their penalties differ while
// the gap is continuous: the pressure cannot be uniform, whatever the penalty. The gate holds the
// error to the spread of the depths; the next test asks for what CON-01 asks, and fails so far.
TEST(ContactPatch, KeepsThePressureToTheSpreadOfThePenalties) {
  constexpr double spread = 0.25; // of the depths: nodes move by .06 of .25
  for (const ElementKind kind : kinds) {
    const Patch patch{kind, contact::Form::mixed, 0.0, false, false, 0.0, true};
    EXPECT_LT(pressure_error(patch, label(patch)), spread) << label(patch);
  }
}

TEST(ContactPatch, HasUniformPressureWhereDepthsDiffer) {
  for (const ElementKind kind : kinds) {
    const Patch patch{kind, contact::Form::mixed, 0.0, false, false, 0.0, true};
    EXPECT_LT(pressure_error(patch, label(patch)), tolerance) << label(patch);
  }
}

/// One hex8, 10 x 10 x 10, on a floor that it touches, pressed on it by 100 MPa; nothing else holds
/// its height. Height of its lowest node at the end.
double lowest_after_pressing(double inside) {
  Scene scene;
  scene.part.analysis = Analysis::solid;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::hex8, Vec3::Zero(), Vec3(10, 10, 10), {1, 1, 1}, {1, 1, 1}});
  scene.material = elastic_body(1e5, 0.3);
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0)};
  scene.part.loads.push_back(
      PressureOn{faces_on(scene.part.mesh, 2, 10.0), TimeFunction({{0, 0}, {1, 100}})});
  scene.tools.push_back(
      moving_tool("floor", geometry::make_plane({0, 0, inside}, {0, 0, 1}), Vec3::Zero()));
  scene.touch = {0};
  scene.part.contact_faces = faces_on(scene.part.mesh, 2, 0.0);
  scene.stages.push_back({"press", 1.0, {1}, false});
  const FinishedRun done = run(std::move(scene));
  double lowest = 1e300;
  for (std::size_t i = 2; i < done.last().positions.size(); i += 3)
    lowest = std::min(lowest, done.last().positions[i]);
  std::printf("floor at %.0e: %s, lowest node at %.6g\n", inside,
              done.status == RunStatus::done ? "done" : "not done", lowest);
  return lowest;
}

// Fail so far. An iterate at which no point is inside the tool leaves a body that only forces press
// with no stiffness but the stabilization's: the next correction throws it beyond the reach of the
// search. The scenes above start 1e-5 inside and take few steps; that helps them, it is no cure.
TEST(PressedBlock, IsStoppedByAFloorThatItOnlyTouches) {
  EXPECT_GT(lowest_after_pressing(0.0), -0.1);
}

TEST(PressedBlock, IsStoppedByAFloorThatItIsALittleInside) {
  EXPECT_GT(lowest_after_pressing(1e-5), -0.1);
}

} // namespace
} // namespace billet::process::contact_patch_test
