#include "mechanics/elements/mesh_jacobian.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace billet::mechanics::mesh_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                               ElementKind::tet10};

/// Nodes of the reference cell: corners, then the middles of the edges.
std::vector<Vec3> reference_nodes(ElementKind kind) {
  const auto corners = reference_corners(kind);
  std::vector<Vec3> nodes(corners.begin(), corners.end());
  if (is_quadratic(kind))
    for (const auto& [a, b] : element_edges(kind))
      nodes.emplace_back(
          0.5 * (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]));
  return nodes;
}

Vec3 centre(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points)
    sum += point;
  return sum / static_cast<double>(points.size());
}

std::size_t corners_of(const std::vector<int>& face, ElementKind kind) {
  if (dimension(kind) == 2)
    return 2;
  return is_quadratic(kind) ? face.size() / 2 : face.size();
}

TEST(Mesh, kinds_have_the_nodes_and_the_dimension_their_names_say) {
  for (const ElementKind kind : all_kinds) {
    const std::string text(name(kind));
    EXPECT_EQ(text.substr(text.find_first_of("0123456789")),
              std::to_string(nodes_per_element(kind)));
    EXPECT_EQ(dimension(kind), text.starts_with("hex") || text.starts_with("tet") ? 3 : 2);
    EXPECT_EQ(reference_nodes(kind).size(), static_cast<std::size_t>(nodes_per_element(kind)));
  }
}

TEST(Mesh, normals_of_all_faces_point_outwards) {
  for (const ElementKind kind : all_kinds) {
    const std::vector<Vec3> nodes = reference_nodes(kind);
    for (const std::vector<int>& face : face_nodes(kind)) {
      std::vector<Vec3> at;
      for (const int node : face)
        at.push_back(nodes[static_cast<std::size_t>(node)]);
      const Vec3 first = at[1] - at[0];
      // In the plane the body is on the left of the way from the first node to the second.
      const Vec3 normal =
          dimension(kind) == 2 ? first.cross(Vec3::UnitZ()) : first.cross(at[2] - at[0]);
      EXPECT_GT(normal.dot(centre(at) - centre(nodes)), 0.0) << name(kind);
    }
  }
}

TEST(Mesh, mid_side_nodes_of_a_face_lie_between_its_corners_in_turn) {
  for (const ElementKind kind : all_kinds) {
    const std::vector<Vec3> nodes = reference_nodes(kind);
    for (const std::vector<int>& face : face_nodes(kind)) {
      const std::size_t n = corners_of(face, kind);
      for (std::size_t i = n; i < face.size(); ++i) {
        const Vec3& a = nodes[static_cast<std::size_t>(face[i - n])];
        const Vec3& b = nodes[static_cast<std::size_t>(face[(i - n + 1) % n])];
        EXPECT_EQ(nodes[static_cast<std::size_t>(face[i])], Vec3(0.5 * (a + b))) << name(kind);
      }
    }
  }
}

TEST(Mesh, the_faces_of_a_cell_cover_its_outline_once) {
  for (const ElementKind kind : all_kinds) {
    std::multiset<std::pair<int, int>> ways;
    for (const std::vector<int>& face : face_nodes(kind)) {
      const std::size_t n = corners_of(face, kind);
      for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i)
        ways.insert({face[i], face[(i + 1) % n]});
    }
    for (const auto& [a, b] : ways) {
      EXPECT_EQ(ways.count({a, b}), 1U) << name(kind);
      EXPECT_EQ(ways.count({b, a}), dimension(kind) == 3 ? 1U : 0U) << name(kind);
    }
  }
}

TEST(Mesh, boundary_faces_of_a_box_are_those_on_its_sides) {
  for (const ElementKind kind : all_kinds) {
    const Mesh mesh = box_mesh({.kind = kind, .high = {2, 3, 4}, .cells = {2, 3, 4}});
    const std::vector<Face> faces = boundary_faces(mesh);
    const bool simplex = is_simplex(kind) && dimension(kind) == 3;
    const std::size_t expected = dimension(kind) == 2 ? 10 : (simplex ? 2 : 1) * 52;
    EXPECT_EQ(faces.size(), expected) << name(kind);
    double flux = 0.0; // the divergence theorem gives the volume: flux of the position
    for (const Face& face : faces) {
      const auto at = [&](std::size_t i) {
        return mesh.points[static_cast<std::size_t>(face.nodes[i])];
      };
      if (dimension(kind) == 2)
        flux += at(0).dot((at(1) - at(0)).cross(Vec3::UnitZ())) / 2.0;
      else if (simplex)
        flux += at(0).dot((at(1) - at(0)).cross(at(2) - at(0))) / 6.0;
      else
        flux += at(0).dot((at(1) - at(0)).cross(at(3) - at(0))) / 3.0;
    }
    EXPECT_NEAR(flux, dimension(kind) == 2 ? 6.0 : 24.0, 1e-12) << name(kind);
  }
}

TEST(Mesh, boundary_faces_come_in_the_order_of_cells_and_local_faces) {
  const Mesh mesh = box_mesh({.kind = ElementKind::hex8, .cells = {3, 2, 2}});
  const std::vector<Face> faces = boundary_faces(mesh);
  EXPECT_TRUE(std::is_sorted(faces.begin(), faces.end(),
                             [](const Face& a, const Face& b) { return a.element < b.element; }));
  const std::vector<Index> first = faces.front().nodes;
  const std::vector<int>& local = face_nodes(mesh.kind)[0];
  for (std::size_t i = 0; i < local.size(); ++i)
    EXPECT_EQ(first[i], mesh.cell(0)[static_cast<std::size_t>(local[i])]);
}

TEST(Mesh, a_single_cell_is_all_boundary) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex20}) {
    const Mesh mesh = box_mesh({.kind = kind});
    EXPECT_EQ(boundary_faces(mesh).size(), face_nodes(kind).size());
  }
}

TEST(Mesh, an_empty_mesh_has_no_boundary) { EXPECT_TRUE(boundary_faces(Mesh{}).empty()); }

} // namespace
} // namespace billet::mechanics::mesh_test
