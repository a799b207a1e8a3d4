#include "geometry/base/error.h"
#include "io/mesh/read_mesh.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace billet::io::read_mesh_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;
using test::TemporaryFolder;

const char* abaqus_type(ElementKind kind) {
  constexpr std::array names{"CPE4", "CPE8", "CPE6", "C3D8", "C3D20", "C3D4", "C3D10"};
  return names[static_cast<std::size_t>(kind)];
}

std::string text_of(const Mesh& mesh) {
  std::string text = "*NODE\n";
  for (Index i = 0; i < mesh.n_points(); ++i) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(i)];
    text += fmt::format("{}, {}, {}, {}\n", i + 1, p.x(), p.y(), p.z());
  }
  text += fmt::format("*ELEMENT, TYPE={}\n", abaqus_type(mesh.kind));
  for (Index i = 0; i < mesh.n_elements(); ++i) {
    text += std::to_string(i + 1);
    for (const Index node : mesh.cell(i))
      text += fmt::format(", {}", node + 1);
    text += "\n";
  }
  return text;
}

MeshFile read_text(const std::string& text, double factor = 1.0) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("part.inp", text), factor);
}

std::string complaint(const std::string& text) {
  try {
    (void)read_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReadMesh, cells_that_all_turn_the_wrong_way_are_mirrored_with_a_note) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                 ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    Mesh mesh = mechanics::box_mesh({.kind = kind, .cells = {2, 2, 2}, .grading = {2, 3, 1}});
    for (Vec3& point : mesh.points)
      point.x() = -point.x();
    const MeshFile file = read_text(text_of(mesh));
    EXPECT_TRUE(check_mesh(file.mesh, "", false).empty()) << name(kind);
    const std::vector<double> qualities = element_qualities(file.mesh, file.mesh.points);
    EXPECT_GT(*std::min_element(qualities.begin(), qualities.end()), 0.2) << name(kind);
    ASSERT_EQ(file.notes.size(), 1U);
    EXPECT_NE(file.notes[0].find("mirrored"), std::string::npos);
  }
}

TEST(ReadMesh, cells_of_both_senses_are_refused_and_the_first_is_named) {
  Mesh mesh =
      mechanics::box_mesh({.kind = ElementKind::quad4, .high = {3, 1, 0}, .cells = {3, 1, 1}});
  std::swap(mesh.cells[5], mesh.cells[7]);
  const std::string text = complaint(text_of(mesh));
  EXPECT_NE(text.find("the first is element 2, with its centre at (1.5, 0.5, 0)"),
            std::string::npos)
      << text;
}

TEST(ReadMesh, nodes_and_elements_keep_the_labels_of_the_file) {
  const MeshFile file = read_text("*NODE\n700,9,9\n10,0,0\n20,1,0\n30,2,0\n40,0,1\n50,1,1\n60,2,1\n"
                                  "*ELEMENT,TYPE=CPE4\n1001,10,20,50,40\n1002,20,50,40,10\n"
                                  "1005,20,30,60,50\n");
  EXPECT_EQ(file.labels.nodes, (std::vector<std::int64_t>{10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(file.labels.elements, (std::vector<std::int64_t>{1001, 1005}));
  EXPECT_EQ(file.labels.element(1), "element 1005");
  EXPECT_EQ(mechanics::MeshLabels{}.element(1), "element number 1 (counted from 0)");
  const std::string twice = "*NODE\n10,0,0\n20,1,0\n40,0,1\n50,1,1\n11,0,0\n21,1,0\n41,0,1\n"
                            "51,1,1\n*ELEMENT,TYPE=CPE4\n1001,10,20,50,40\n1005,11,21,51,41\n";
  EXPECT_NE(complaint(twice).find("elements 1001 and 1005 lie on each other"), std::string::npos)
      << complaint(twice);
}

TEST(ReadMesh, coordinates_are_multiplied_by_the_length_factor) {
  const MeshFile file = read_text(text_of(mechanics::box_mesh({.kind = ElementKind::hex8})), 25.4);
  EXPECT_EQ(file.mesh.points.back(), Vec3(25.4, 25.4, 25.4));
}

TEST(ReadMesh, nodes_without_cells_are_left_out_and_counted) {
  std::string text = text_of(mechanics::box_mesh({.kind = ElementKind::quad4}));
  text.insert(6, "50, 9, 9, 9\n51, 8, 8, 8\n");
  const MeshFile file = read_text(text + "*NSET,NSET=A\n50,1\n*NSET,NSET=B\n51\n");
  EXPECT_EQ(file.mesh.n_points(), 4);
  EXPECT_EQ(file.mesh.node_sets.at("A"), std::vector<Index>{0});
  EXPECT_FALSE(file.mesh.node_sets.contains("B"));
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_EQ(file.notes[0], "2 nodes that no element uses were left out");
}

TEST(ReadMesh, a_plane_mesh_is_moved_to_z_zero_but_not_turned) {
  Mesh mesh = mechanics::box_mesh({.kind = ElementKind::quad8});
  for (Vec3& point : mesh.points)
    point.z() = 4.0;
  EXPECT_EQ(read_text(text_of(mesh)).mesh.points[0].z(), 0.0);
  for (Vec3& point : mesh.points)
    std::swap(point.y(), point.z());
  EXPECT_NE(complaint(text_of(mesh)).find("z goes from 0 to 1"), std::string::npos);
}

TEST(ReadMesh, parts_that_share_no_node_are_noted) {
  const Mesh one = mechanics::box_mesh({.kind = ElementKind::quad4});
  Mesh two = one;
  for (const Index node : one.cells)
    two.cells.push_back(node + 4);
  for (const Vec3& point : one.points)
    two.points.emplace_back(point + Vec3(1, 0, 0));
  const MeshFile file = read_text(text_of(two));
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_NE(file.notes[0].find("warning: [loose-mesh] the mesh is not joined along 1 pair"),
            std::string::npos);
  EXPECT_NE(file.notes[1].find("2 parts"), std::string::npos);
}

TEST(ReadMesh, files_that_are_not_there_or_not_meshes_are_refused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.msh");
  for (const auto& path : {folder.path() / "absent.msh", folder.path() / "folder.msh",
                           folder.file("part.stl", "solid"), folder.file("noname", ""),
                           std::filesystem::path("/dev/zero.msh")}) {
    try {
      (void)read_mesh(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::geometry);
      EXPECT_EQ(error.complaints().front().place, path.string());
    }
  }
}

TEST(ReadMesh, the_suffix_may_be_in_capitals) {
  const TemporaryFolder folder;
  const auto path =
      folder.file("PART.INP", text_of(mechanics::box_mesh({.kind = ElementKind::quad4})));
  EXPECT_EQ(read_mesh(path).mesh.n_elements(), 1);
}

} // namespace
} // namespace billet::io::read_mesh_test
