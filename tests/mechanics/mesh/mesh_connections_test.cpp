#include "mechanics/mesh/mesh_connections.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::mechanics::mesh_connections_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet10};

Mesh two_by_two(ElementKind kind) {
  return box_mesh({.kind = kind, .high = {2, 2, 2}, .cells = {2, 2, 2}});
}

std::string flaws(const Mesh& mesh) {
  std::string text;
  for (const Complaint& complaint : check_connections(mesh, "part.msh"))
    text += complaint.text() + "\n";
  return text;
}

std::string loose(const Mesh& mesh) {
  std::string text;
  for (const std::string& sentence : loose_connections(mesh))
    text += sentence + "\n";
  return text;
}

/// The cell at the end of the list once more.
Mesh with_last_twice(Mesh mesh) {
  const auto cell = mesh.cell(mesh.n_elements() - 1);
  const std::vector<Index> nodes(cell.begin(), cell.end());
  mesh.cells.insert(mesh.cells.end(), nodes.begin(), nodes.end());
  return mesh;
}

/// Both meshes with nodes of their own, the second moved.
Mesh beside(const Mesh& first, const Mesh& second, const Vec3& by) {
  Mesh both = first;
  for (const Vec3& point : second.points)
    both.points.push_back(point + by);
  for (const Index node : second.cells)
    both.cells.push_back(node + first.n_points());
  return both;
}

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

TEST(MeshConnections, OfAMeshThatIsOneBodyAreSound) {
  for (const ElementKind kind : all_kinds) {
    EXPECT_EQ(flaws(two_by_two(kind)), "") << name(kind);
    EXPECT_EQ(loose(two_by_two(kind)), "") << name(kind);
  }
}

TEST(MeshConnections, RefuseACellThatIsThereTwice) {
  for (const ElementKind kind : all_kinds)
    EXPECT_TRUE(has(flaws(with_last_twice(two_by_two(kind))), "part.msh: ")) << name(kind);
  EXPECT_TRUE(has(flaws(with_last_twice(two_by_two(ElementKind::quad4))),
                  "3 elements share the side at (1.5, 1)"));
  EXPECT_TRUE(has(
      flaws(with_last_twice(two_by_two(ElementKind::quad4))),
      "elements number 3 and 4 (counted from 0) lie on the same side of their side at (1.5, 2)"));
}

TEST(MeshConnections, RefuseABodyThatIsThereTwiceWithNodesOfItsOwn) {
  for (const ElementKind kind : all_kinds) {
    const Mesh mesh = two_by_two(kind);
    EXPECT_TRUE(has(flaws(beside(mesh, mesh, Vec3::Zero())), "lie on each other")) << name(kind);
  }
}

TEST(MeshConnections, RefuseSidesThatShareCornersOnly) {
  for (const ElementKind kind :
       {ElementKind::quad8, ElementKind::tri6, ElementKind::hex20, ElementKind::tet10}) {
    Mesh mesh = two_by_two(kind);
    // The first node in the middle of a side that a second cell has too gets a copy there.
    const auto corners = static_cast<std::size_t>(kind == ElementKind::tri6    ? 3
                                                  : kind == ElementKind::quad8 ? 4
                                                  : kind == ElementKind::tet10 ? 4
                                                                               : 8);
    const auto n = static_cast<std::size_t>(nodes_per_element(kind));
    bool copied = false;
    for (std::size_t i = n; i < mesh.cells.size() && !copied; ++i)
      if (i % n >= corners && std::count(mesh.cells.begin(), mesh.cells.end(), mesh.cells[i]) > 1) {
        mesh.points.push_back(mesh.points[static_cast<std::size_t>(mesh.cells[i])]);
        mesh.cells[i] = mesh.n_points() - 1;
        copied = true;
      }
    ASSERT_TRUE(copied);
    EXPECT_TRUE(has(flaws(mesh), "but not the nodes in its middle")) << name(kind);
  }
}

TEST(MeshConnections, TellOfSidesThatLieOnEachOtherAndOfParts) {
  for (const ElementKind kind : all_kinds) {
    const Mesh mesh = two_by_two(kind);
    const Mesh cracked = beside(mesh, mesh, {2, 0, 0});
    EXPECT_EQ(flaws(cracked), "") << name(kind);
    EXPECT_TRUE(has(loose(cracked), "not joined along")) << name(kind);
    EXPECT_TRUE(has(loose(cracked), "2 parts that share no node")) << name(kind);
    const Mesh apart = beside(mesh, mesh, {2.1, 0, 0});
    EXPECT_FALSE(has(loose(apart), "not joined along")) << name(kind);
    EXPECT_TRUE(has(loose(apart), "2 parts")) << name(kind);
  }
}

TEST(MeshConnections, TellOfHangingNodes) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::hex8}) {
    const Mesh coarse = box_mesh({.kind = kind, .high = {1, 1, 1}, .cells = {1, 1, 1}});
    const Mesh fine = box_mesh({.kind = kind, .high = {1, 1, 1}, .cells = {2, 2, 2}});
    EXPECT_TRUE(has(loose(beside(coarse, fine, {1, 0, 0})), "lie in the middle of")) << name(kind);
    EXPECT_FALSE(has(loose(beside(coarse, fine, {1.01, 0, 0})), "lie in the middle of"));
  }
}

} // namespace
} // namespace billet::mechanics::mesh_connections_test
