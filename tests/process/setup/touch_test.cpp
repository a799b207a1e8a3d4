#include "geometry/base/error.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "process/loop/process.h"
#include "process/setup/touch.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace billet::process::touch_test {
namespace {

/// One element of side 2 with its top at 0, in the middle of x and z (and y in space), a tool
/// above.
Scene one_face(Analysis analysis, geometry::SurfacePtr surface, double height) {
  const bool solid = analysis == Analysis::solid;
  Scene scene;
  scene.part.analysis = analysis;
  scene.part.mesh = mechanics::box_mesh({solid ? ElementKind::hex8 : ElementKind::quad4,
                                         solid ? Vec3(-1, -1, -2) : Vec3(-1, -2, 0),
                                         solid ? Vec3(1, 1, 0) : Vec3(1, 0, 0),
                                         {1, 1, 1},
                                         {1, 1, 1}});
  scene.material = elastic_body(1000.0, 0.3);
  const int axis = up(analysis);
  for (int d = 0; d <= axis; ++d)
    scene.part.supports.push_back({nodes_at(scene.part.mesh, axis, -2.0), d, TimeFunction(0.0)});
  scene.tools.push_back(moving_tool("tool", std::move(surface), -Vec3::Unit(axis)));
  scene.tools[0].motion.place.translation = height * Vec3::Unit(axis);
  scene.touch = {1};
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.stages.push_back({"press", 1.0, {1}, false});
  return scene;
}

/// How far the tool went down.
double travel(Scene scene) {
  const int axis = up(scene.part.analysis);
  const Process process(std::move(scene));
  return -process.view().tools()[0].motion.offset[axis];
}

/// A slender pyramid on its tip, at the origin; it passes between points of a face.
geometry::SurfacePtr spike() {
  geometry::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0.1, 3}, {-0.1, 0.1, 3}, {-0.1, -0.1, 3}, {0.1, -0.1, 3}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 3, 2}, {1, 4, 3}};
  return geometry::make_triangle_surface(flipped(mesh));
}

TEST(Touch, ASpikeComesToRestOnTheMiddleOfAFace) {
  constexpr double precision = 1e-7; // facets touch at 1e-9 of the size of the scene
  for (const double x : {0.0, 0.3, -0.7}) {
    Scene scene = one_face(Analysis::solid, spike(), 1.5);
    scene.tools[0].motion.place.translation += Vec3(x, 0.2, 0.0);
    EXPECT_NEAR(travel(std::move(scene)), 1.5, precision) << x;
  }
}

TEST(Touch, APinThatPassesAllPointsTouchesNevertheless) {
  // A rod so thin and long that its whole length goes through the face between the points.
  geometry::TriangleMesh rod = geometry::cube();
  for (Vec3& p : rod.points)
    p = Vec3(0.02, 0.02, 0.5).cwiseProduct(p);
  EXPECT_NEAR(travel(one_face(Analysis::solid, geometry::make_triangle_surface(rod), 1.5)), 1.5,
              1e-7);
}

TEST(Touch, ASheetThatFacesAwayIsRefused) {
  const auto away = [](double x, double y) { return 0.0 * (x + y); };
  Scene scene =
      one_face(Analysis::solid, geometry::make_triangle_surface(geometry::sheet(3, away)), 1.5);
  EXPECT_THROW(Process{std::move(scene)}, Error);
}

TEST(Touch, ASpikeInTheFaceBacksOff) {
  constexpr double precision = 1e-7;
  EXPECT_NEAR(travel(one_face(Analysis::solid, spike(), -0.3)), -0.3, precision);
}

TEST(Touch, AProfilesTipComesToRestBetweenTheNodesOfAnEdge) {
  const std::vector<Vec2> tip{{-0.1, 3}, {0, 0}, {0.1, 3}};
  const auto surface = [&] { return geometry::make_profile(geometry::polygon(tip, false)); };
  EXPECT_NEAR(travel(one_face(Analysis::plane_strain, surface(), 1.5)), 1.5, 1e-7);
}

TEST(Touch, ASmallBallIsNotSwallowed) {
  // Drawn in 128 chords round, along and across: twice 3.0e-4 of its radius inside of it.
  Scene scene = one_face(Analysis::solid, geometry::make_sphere({0.1, -0.2, 0.2}, 0.2, false), 1.5);
  EXPECT_NEAR(travel(std::move(scene)), 1.5, 0.2 * 6.1e-4);
}

TEST(Touch, ARollComesToRestAtTheBottomOfATroughEitherWay) {
  // The chords of a hollow face stand out of it, along its rows and along its columns.
  constexpr double radius = 2.4, hollow = 0.2;
  for (const int along : {0, 1}) {
    Scene scene =
        one_face(Analysis::solid,
                 geometry::make_cylinder({0, 0, radius}, Vec3::Unit(along), radius, false), 1.5);
    scene.part.mesh = mechanics::box_mesh(
        {ElementKind::hex20, Vec3(-1, -1, -2), Vec3(1, 1, 0), {1, 1, 1}, {1, 1, 1}});
    for (Vec3& p : scene.part.mesh.points)
      if (p.z() == 0.0)
        p.z() = hollow * p[1 - along] * p[1 - along];
    scene.part.supports.clear();
    for (int d = 0; d < 3; ++d)
      scene.part.supports.push_back({nodes_at(scene.part.mesh, 2, -2.0), d, TimeFunction(0.0)});
    scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
    std::erase_if(
        scene.part.contact_faces, [&](const mechanics::Face& face) { // the sides are as hollow
          return std::any_of(face.nodes.begin(), face.nodes.end(),
                             [&](Index a) { return scene.part.mesh.points[as_size(a)].z() < 0.0; });
        });
    EXPECT_NEAR(travel(std::move(scene)), 1.5, 1e-9) << "roll along axis " << along;
  }
}

TEST(Touch, AnEdgeAcrossAnEdgeIsContact) {
  // A bar on edge that hangs across an upper edge of the element, away from points of both.
  geometry::TriangleMesh bar = geometry::cube();
  for (Vec3& p : bar.points) {
    p = Vec3(0.1, 8, 0.1).cwiseProduct(p - Vec3::Constant(0.5));
    p = geometry::rotation_about(Vec3::Zero(), Vec3::UnitX(), 0.3).to_space(p);
    p.z() += 3.0;
  }
  const double slope = std::tan(0.3);
  // Its lower face meets the edge y = -1 of the top, at the height 3 - slope - half thickness.
  const double lower = 3.0 - slope - 0.05 / std::cos(0.3);
  EXPECT_NEAR(travel(one_face(Analysis::solid, geometry::make_triangle_surface(bar), 0.0)), lower,
              1e-6);
}

TEST(Touch, WherePointsTouchFirstNothingChanges) {
  const auto plane = [] { return geometry::make_plane({0, 0, 0}, {0, 0, -1}); };
  EXPECT_NEAR(travel(one_face(Analysis::solid, plane(), 1.5)), 1.5, 1e-12);
  // A round cone about the element meets its edges' corners; as chords it would do so earlier.
  const auto funnel = [] {
    return geometry::make_cone({0, 0, 3}, {0, 0, -1}, std::numbers::pi / 6, true);
  };
  const double apex = std::sqrt(2.0) / std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(travel(one_face(Analysis::solid, funnel(), 0.0)), 3.0 - apex, 1e-9);
}

TEST(Touch, ADrivenToolRestsOnAContactPoint) {
  Scene scene = one_face(Analysis::solid, geometry::make_plane({0, 0, 0}, {0, 0, -1}), 1.5);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.force = geometry::Drive{Vec3::Zero(), -Vec3::UnitZ(), TimeFunction(1.0)};
  EXPECT_NEAR(travel(std::move(scene)), 1.5, 1e-12);
}

TEST(Touch, ARollUnderATorqueRestsOnAContactPoint) {
  // On the middle of the face it would touch between its contact points, without friction, and
  // spin.
  constexpr double radius = 5.0;
  const auto roll = [radius](bool driven) {
    Scene scene =
        one_face(Analysis::solid,
                 geometry::make_cylinder({0, 0, radius}, Vec3::UnitY(), radius, false), 1.5);
    if (driven)
      scene.tools[0].motion.torque =
          geometry::Drive{Vec3::Zero(), Vec3::UnitY(), TimeFunction(1.0)};
    return travel(std::move(scene));
  };
  EXPECT_NEAR(roll(false), 1.5, 1e-9) << "on the face";
  const double off = 1.0 / std::sqrt(3.0); // of the points of a hex8's face from its middle
  EXPECT_NEAR(roll(true), 1.5 + radius - std::sqrt(radius * radius - off * off), 1e-9);
}

} // namespace
} // namespace billet::process::touch_test
