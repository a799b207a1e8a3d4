// Formats are told apart by how files begin, whatever their suffix.

#include "geometry/base/error.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/read_mesh.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::io::mesh_format_test {
namespace {

using test::TemporaryFolder;

constexpr const char* abaqus = "** written by cgx\n\n*NODE, NSET=Nall\n1,0,0,0\n2,1,0,0\n3,1,1,0\n"
                               "4,0,1,0\n*ELEMENT, TYPE=CPS4, ELSET=Eall\n1,1,2,3,4\n";
constexpr const char* gmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
                             "3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 0 1 1 2 3 4\n"
                             "$EndElements\n";

TEST(MeshFormatOf, a_file_follows_from_its_first_line_that_is_not_blank) {
  const TemporaryFolder folder;
  for (const char* name : {"all.msh", "all.inp", "all.txt", "all"}) {
    EXPECT_EQ(read_mesh(folder.file(name, abaqus)).mesh.n_elements(), 1) << name;
    EXPECT_EQ(read_mesh(folder.file(name, gmsh)).mesh.n_elements(), 1) << name;
  }
  EXPECT_EQ(mesh_format(folder.file("a.msh", "\r\n \n*NODE\n")), MeshFormat::abaqus);
  EXPECT_EQ(mesh_format(folder.file("a.msh", "\xEF\xBB\xBF*NODE\n")), MeshFormat::abaqus);
  EXPECT_EQ(mesh_format(folder.file("a.inp", "<?xml version=\"1.0\"?>\n")), MeshFormat::vtu);
}

TEST(MeshFormatOf, a_file_that_does_not_tell_follows_from_its_suffix) {
  const TemporaryFolder folder;
  EXPECT_EQ(mesh_format(folder.file("a.MSH", "")), MeshFormat::gmsh);
  EXPECT_EQ(mesh_format(folder.file("a.inp", "4 1 0 0 0\n")), MeshFormat::abaqus);
  EXPECT_EQ(mesh_format(folder.file("a.vtu", "garbage")), MeshFormat::vtu);
  EXPECT_THROW((void)mesh_format(folder.file("a.nas", "$ a comment\nGRID,1\n")), Error);
  EXPECT_THROW((void)mesh_format(folder.path() / "absent.msh"), Error);
}

} // namespace
} // namespace billet::io::mesh_format_test
