#include "geometry/base/error.h"
#include "io/mesh/read_mesh.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace billet::io::abaqus_reader_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;
using test::TemporaryFolder;

MeshFile read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("part.inp", text));
}

std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.file("part.inp", text);
  try {
    (void)read_mesh(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_FALSE(error.complaints().front().place.empty());
    return error.what();
  }
  return "";
}

std::string nodes_text(const Mesh& mesh) {
  std::string text = "*NODE, NSET=NALL\n";
  for (Index i = 0; i < mesh.n_points(); ++i) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(i)];
    text += fmt::format("{}, {}, {}, {}\n", 10 * i + 7, p.x(), p.y(), p.z());
  }
  return text;
}

/// Elements, at most eight numbers a line, so that long ones go on over several lines.
std::string elements_text(const Mesh& mesh, const std::string& type) {
  std::string text = fmt::format("*Element, type={}, elset=Body\n", type);
  for (Index i = 0; i < mesh.n_elements(); ++i) {
    text += std::to_string(i + 1);
    int n = 1;
    for (const Index node : mesh.cell(i)) {
      text += n++ % 8 == 0 ? ",\n" : ", ";
      text += std::to_string(10 * node + 7);
    }
    text += "\n";
  }
  return text;
}

TEST(AbaqusReader, gives_back_points_cells_and_sets_of_every_type) {
  const std::vector<std::pair<ElementKind, std::vector<const char*>>> types{
      {ElementKind::quad4, {"CPE4", "CAX4", "CAX4R", "CPS4", "cpe4rh"}},
      {ElementKind::quad8, {"CPE8", "CAX8R", "CPS8"}},
      {ElementKind::tri6, {"CPE6", "CAX6", "CAX6M"}},
      {ElementKind::hex8, {"C3D8", "C3D8R", "C3D8I"}},
      {ElementKind::hex20, {"C3D20", "C3D20R"}},
      {ElementKind::tet10, {"C3D10", "C3D10M"}},
  };
  for (const auto& [kind, names] : types)
    for (const char* type : names) {
      const Mesh mesh = mechanics::box_mesh({.kind = kind, .cells = {2, 2, 1}});
      const MeshFile file = read_text(nodes_text(mesh) + elements_text(mesh, type));
      EXPECT_EQ(file.mesh.kind, kind);
      EXPECT_EQ(file.mesh.points, mesh.points) << type;
      EXPECT_EQ(file.mesh.cells, mesh.cells) << type;
      EXPECT_EQ(file.mesh.node_sets.at("NALL").size(), mesh.points.size());
      EXPECT_EQ(file.mesh.node_sets.at("Body").size(), mesh.points.size());
    }
}

constexpr const char* square = "*NODE\n1,0.,0.\n2,1.,0.\n3,1.D0,+1E+0\n4,,1.\n";
constexpr const char* quad = "*ELEMENT,TYPE=CPE4\n1, 1,2,3,4\n";

TEST(AbaqusReader, reads_sets_of_all_forms) {
  const MeshFile file =
      read_text(std::string("** a comment\n*HEADING\nany, text\n\n") + square + quad +
                "*NSET, NSET=Top\n3,4,\n*nset, nset=GEN, Generate\n1,3,2\n"
                "*NSET,\nNSET=Both\nTOP, 1\n"
                "*ELEMENT, TYPE=T2D2, ELSET=EDGE\n7,2,3\n*ELSET,ELSET=E2\n7,EDGE\n"
                "*STEP\n*STATIC\n0.1,1.\n*NODE PRINT, NSET=Top\nU\n*END STEP\n");
  const auto& sets = file.mesh.node_sets;
  EXPECT_EQ(file.mesh.points[2], Vec3(1, 1, 0));
  EXPECT_EQ(sets.at("Top"), (std::vector<Index>{2, 3}));
  EXPECT_EQ(sets.at("GEN"), (std::vector<Index>{0, 2}));
  EXPECT_EQ(sets.at("Both"), (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(sets.at("EDGE"), (std::vector<Index>{1, 2}));
  EXPECT_EQ(sets.at("E2"), (std::vector<Index>{1, 2}));
}

TEST(AbaqusReader, names_of_sets_do_not_depend_on_capitals_and_keep_their_first_spelling) {
  const MeshFile file = read_text(std::string(square) + quad +
                                  "*NSET,NSET=Top\n3\n*NSET,NSET=TOP\n4\n*ELSET,ELSET=top\n1\n");
  EXPECT_EQ(file.mesh.node_sets.size(), 1U);
  EXPECT_EQ(file.mesh.node_sets.at("Top"), (std::vector<Index>{2, 3}));
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("left out"), std::string::npos);
}

TEST(AbaqusReader, files_with_windows_line_ends_are_read) {
  std::string text = std::string(square) + quad;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  EXPECT_EQ(read_text(text).mesh.n_points(), 4);
}

TEST(AbaqusReader, shells_and_trusses_beside_a_solid_mesh_only_name_sets) {
  const Mesh mesh = mechanics::box_mesh({.kind = ElementKind::hex8});
  const MeshFile file = read_text(nodes_text(mesh) + elements_text(mesh, "C3D8") +
                                  "*ELEMENT,TYPE=S4R,ELSET=skin\n91,7,17,37,27\n");
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.at("skin").size(), 4U);
}

TEST(AbaqusReader, springs_masses_and_couplings_beside_a_body_are_passed_over) {
  const MeshFile file =
      read_text(std::string(square) + quad +
                "*ELEMENT,TYPE=SPRINGA,ELSET=E1\n7,1,3\n*ELEMENT,TYPE=springa\n8,2,4\n"
                "*ELEMENT, TYPE=DCOUP3D, ELSET=E2\n9,1\n*ELSET,ELSET=all\n1,7,9\n");
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.at("all").size(), 4U);
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_EQ(file.notes[0],
            "warning: [passed-over] line 8: elements of type SPRINGA are passed over");
}

TEST(AbaqusReader, a_single_part_with_an_instance_in_place_is_read) {
  EXPECT_EQ(read_text(std::string("*PART,NAME=P\n") + square + quad +
                      "*END PART\n*ASSEMBLY,NAME=A\n*INSTANCE,NAME=P-1,PART=P\n*END INSTANCE\n"
                      "*NSET,NSET=T,INSTANCE=P-1\n1,2\n*END ASSEMBLY\n")
                .mesh.node_sets.at("T")
                .size(),
            2U);
}

struct Broken {
  const char* what;
  std::string content;
  const char* expected;
};

std::vector<Broken> broken_files() {
  const std::string nodes = square;
  return {
      {"empty", "", "no *NODE"},
      {"no keyword", "1, 2, 3\n", "part.inp:1: a keyword"},
      {"no nodes", quad, "node 1, which is not given"},
      {"no elements", nodes, "no plane and no solid"},
      {"short node", "*NODE\n1,\n", "part.inp:2: a node is written"},
      {"nan", "*NODE\n1,nan,0\n", "\"nan\""},
      {"text for a number", "*NODE\n1,0,x\n", "\"x\""},
      {"text for a node number", "*NODE\nfirst,0,1\n", "\"first\""},
      {"node twice", nodes + "4,0,0\n", "part.inp:6: node 4 is given twice"},
      {"element twice", nodes + quad + "1, 1,2,3,4\n", "element 1 is given twice"},
      {"missing node", nodes + "*ELEMENT,TYPE=CAX4\n1,1,2,3,9\n", "node 9"},
      {"too few nodes", nodes + "*ELEMENT,TYPE=CAX4\n1,1,2,3\n", "only 3 of its 4"},
      {"too many nodes", nodes + "*ELEMENT,TYPE=CAX4\n1,1,2,3,4,1\n", "more than 4"},
      {"no type", nodes + "*ELEMENT\n1,1,2,3,4\n", "type \"\""},
      {"unknown type", nodes + "*ELEMENT,TYPE=DC2D4\n1,1,2,3,4\n", "\"DC2D4\""},
      {"linear tetrahedra", nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n", "second order"},
      {"shells", nodes + "*ELEMENT,TYPE=S4R\n1,1,2,3,4\n", "1 S4R"},
      {"nothing to include", nodes + "*INCLUDE\n", "part.inp:6: the name of the file"},
      {"encrypted", nodes + "*INCLUDE, INPUT=a.inp, PASSWORD=b\n", "part.inp:6: an encrypted"},
      {"generated nodes", nodes + "*NGEN\n1,4,1\n", "*NGEN"},
      {"cylindrical nodes", "*NODE, SYSTEM=C\n1,0,0\n", "not rectangular"},
      {"system", "*SYSTEM\n1,2,3\n" + nodes, "*SYSTEM"},
      {"moved instance", "*INSTANCE,NAME=A,PART=B\n1.,0.,0.\n", "moved or turned"},
      {"set without a name", nodes + quad + "*NSET\n1\n", "no name"},
      {"set of missing nodes", nodes + quad + "*NSET,NSET=A\n1,99\n", "node 99"},
      {"set of missing elements", nodes + quad + "*ELSET,ELSET=A\n5\n", "element 5"},
      {"set of an unknown set", nodes + quad + "*NSET,NSET=A\nB\n", "\"B\" is neither"},
      {"backward range", nodes + quad + "*NSET,NSET=A,GENERATE\n4,1,1\n", "cannot be"},
      {"no step", nodes + quad + "*NSET,NSET=A,GENERATE\n1,4,0\n", "cannot be"},
      {"huge range", nodes + quad + "*NSET,NSET=A,GENERATE\n1,9000000000000000000,1\n",
       "more members"},
      {"mixture", nodes + quad + "*ELEMENT,TYPE=CPE3\n2,1,2,3\n", "1 CPE3, 1 quad4"},
      {"huge number", nodes + "99999999999999999999,0,0\n", "not a whole number"},
  };
}

TEST(AbaqusReader, broken_files_are_refused_with_place_and_reason) {
  for (const Broken& broken : broken_files()) {
    const std::string text = complaint(broken.content);
    EXPECT_NE(text.find(broken.expected), std::string::npos) << broken.what << ": " << text;
  }
}

TEST(AbaqusReader, sets_that_double_again_and_again_do_not_fill_the_memory) {
  std::string text = std::string(square) + quad + "*NSET,NSET=A\n1,2,3,4\n";
  for (int i = 0; i < 40; ++i)
    text += "A,\n";
  EXPECT_NE(complaint(text).find("members together"), std::string::npos);
}

TEST(AbaqusReader, every_truncation_gives_a_mesh_or_an_error) {
  const std::string whole = std::string(square) + quad + "*NSET,NSET=Top,GENERATE\n3,4\n";
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NO_FATAL_FAILURE((void)complaint(whole.substr(0, length)));
}

} // namespace
} // namespace billet::io::abaqus_reader_test
