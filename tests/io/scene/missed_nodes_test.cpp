// Nodes that a `where` leaves out: told where they were hardly meant to be.

#include "geometry/base/index.h"
#include "io/scene/missed_nodes.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace billet::io::missed_nodes_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;

constexpr double size = 2.0; // of the mesh, about

Mesh block(ElementKind kind) { return mechanics::box_mesh({.kind = kind, .cells = {4, 4, 4}}); }

std::vector<char> on_bottom(const Mesh& mesh) {
  std::vector<char> result(mesh.points.size(), 0);
  for (Index i = 0; i < mesh.n_points(); ++i)
    result[idx(i)] = std::abs(mesh.points[idx(i)].z()) <= 1e-6 * size ? 1 : 0;
  return result;
}

TEST(MissedNodes, NearAPlaneAreTold) {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    Mesh mesh = block(kind);
    EXPECT_FALSE(
        nodes_near_plane(mesh, mechanics::boundary_faces(mesh), on_bottom(mesh), 2, 0.0, size));
    int lifted = 0;
    for (Vec3& x : mesh.points)
      if (x.z() == 0.0 && x.x() == x.y() && lifted < 2) {
        x.z() = 1e-4;
        ++lifted;
      }
    const auto told =
        nodes_near_plane(mesh, mechanics::boundary_faces(mesh), on_bottom(mesh), 2, 0.0, size);
    ASSERT_TRUE(told);
    EXPECT_EQ(told->find("2 node(s) next to those on the plane z = 0 lie up to 0.0001 off it"), 0U)
        << *told;
  }
}

TEST(MissedNodes, OfThinLayersAreMeant) {
  Mesh mesh = block(ElementKind::hex8);
  for (Vec3& x : mesh.points)
    if (x.z() == 0.25)
      x.z() = 1e-4;
  EXPECT_FALSE(
      nodes_near_plane(mesh, mechanics::boundary_faces(mesh), on_bottom(mesh), 2, 0.0, size));
}

TEST(MissedNodes, OfARoundThatLeavesThePlaneAreMeant) {
  Mesh mesh = mechanics::box_mesh({.kind = ElementKind::quad8, .cells = {40, 4, 1}});
  for (Vec3& x : mesh.points) // flat up to the middle, then round with R = 10
    if (const double past = x.x() - 0.5; x.y() == 0.0 && past > 0.0)
      x.y() = 0.05 * past * past;
  std::vector<char> on_plane(mesh.points.size(), 0);
  for (Index i = 0; i < mesh.n_points(); ++i)
    on_plane[idx(i)] = mesh.points[idx(i)].y() <= 1e-6 ? 1 : 0;
  EXPECT_FALSE(nodes_near_plane(mesh, mechanics::boundary_faces(mesh), on_plane, 1, 0.0, 1.5));
}

TEST(MissedNodes, OfCornersOfOtherFacesAreMeant) {
  const Mesh mesh = block(ElementKind::tet10); // its four walls
  std::vector<char> walls(mesh.points.size(), 0);
  for (Index i = 0; i < mesh.n_points(); ++i) {
    const Vec3& x = mesh.points[idx(i)];
    walls[idx(i)] = x.x() == 0.0 || x.x() == 1.0 || x.y() == 0.0 || x.y() == 1.0 ? 1 : 0;
  }
  EXPECT_FALSE(missed_middle_nodes(mesh, mechanics::boundary_faces(mesh), walls));
}

TEST(MissedNodes, InTheMiddleOfSidesAreTold) {
  for (const ElementKind kind : {ElementKind::hex20, ElementKind::tet10}) {
    const Mesh mesh = block(kind);
    const std::vector<mechanics::Face> surface = mechanics::boundary_faces(mesh);
    std::vector<char> meant = on_bottom(mesh);
    EXPECT_FALSE(missed_middle_nodes(mesh, surface, meant));
    const auto touches = [&](const mechanics::Face& face) {
      return mesh.points[idx(face.nodes[0])].z() == 0.0 &&
             mesh.points[idx(face.nodes[1])].z() == 0.0 &&
             mesh.points[idx(face.nodes[2])].z() == 0.0;
    };
    int bottom = 0;
    for (const mechanics::Face& face : surface)
      if (touches(face)) {
        ++bottom;
        for (std::size_t a = face.nodes.size() / 2; a < face.nodes.size(); ++a)
          meant[idx(face.nodes[a])] = 0;
      }
    const auto told = missed_middle_nodes(mesh, surface, meant);
    ASSERT_TRUE(told);
    EXPECT_EQ(std::stoi(*told), bottom) << *told;
  }
  const Mesh linear = block(ElementKind::hex8);
  EXPECT_FALSE(missed_middle_nodes(linear, mechanics::boundary_faces(linear), on_bottom(linear)));
}

} // namespace
} // namespace billet::io::missed_nodes_test
