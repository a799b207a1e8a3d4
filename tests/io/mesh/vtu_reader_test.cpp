#include "geometry/base/error.h"
#include "io/mesh/read_mesh.h"
#include "io/results/vtk_writer.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace billet::io::vtu_reader_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;
using test::TemporaryFolder;

/// Parts of a text .vtu, to be changed one at a time.
struct Vtu {
  std::string points = "0 0 0 1 0 0 1 1 0 0 1 0";
  std::string connectivity = "0 1 2 3";
  std::string offsets = "4";
  std::string types = "9";
  std::string n_points = "4";
  std::string n_cells = "1";
  std::string point_data = "";

  [[nodiscard]] std::string text() const {
    return fmt::format(
        R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{}" NumberOfCells="{}">
<PointData>{}</PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{}</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
)",
        n_points, n_cells, point_data, points, connectivity, offsets, types);
  }
};

MeshFile read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("part.vtu", text));
}

std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.file("part.vtu", text);
  try {
    (void)read_mesh(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_FALSE(error.complaints().front().place.empty());
    return error.what();
  }
  return "";
}

TEST(VtuReader, gives_back_what_the_writer_wrote_for_every_kind) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                 ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    const TemporaryFolder folder;
    const Mesh mesh = mechanics::box_mesh({.kind = kind, .cells = {2, 2, 2}});
    WorkpieceFrame frame;
    frame.kind = kind;
    frame.points = mesh.points;
    frame.cells = mesh.cells;
    write_vtu(folder.path() / "part.vtu", frame);
    const MeshFile file = read_mesh(folder.path() / "part.vtu");
    EXPECT_EQ(file.mesh.kind, kind);
    EXPECT_EQ(file.mesh.points, mesh.points);
    EXPECT_EQ(file.mesh.cells, mesh.cells);
    EXPECT_TRUE(file.mesh.node_sets.empty());
  }
}

TEST(VtuReader, whole_number_point_data_of_zeros_and_ones_are_sets) {
  Vtu vtu;
  vtu.point_data =
      R"(<DataArray type="Int32" Name="top" format="ascii">0 0 1 1</DataArray>
<DataArray type="UInt8" Name="set:left" format="ascii">1 0 0 1</DataArray>
<DataArray type="Int32" Name="colour" format="ascii">0 1 2 3</DataArray>
<DataArray type="Float64" Name="value" format="ascii">0 0 1 1</DataArray>)";
  const MeshFile file = read_text(vtu.text());
  EXPECT_EQ(file.mesh.node_sets.size(), 2U);
  EXPECT_EQ(file.mesh.node_sets.at("top"), (std::vector<Index>{2, 3}));
  EXPECT_EQ(file.mesh.node_sets.at("left"), (std::vector<Index>{0, 3}));
}

struct Broken {
  const char* what;
  Vtu vtu;
  const char* expected;
};

std::vector<Broken> broken_files() {
  return {
      {"nan", {.points = "0 0 0 nan 0 0 1 1 0 0 1 0"}, "part.vtu"},
      {"too few coordinates", {.points = "0 0 0 1 0 0"}, "part.vtu"},
      {"missing point", {.connectivity = "0 1 2 4"}, "cell 0 has point 4"},
      {"negative point", {.connectivity = "0 1 2 -1"}, "cell 0 has point -1"},
      {"short cell", {.connectivity = "0 1 2", .offsets = "3"}, "cell 0 of type 9 has 3"},
      {"wild offset", {.offsets = "4000"}, "part.vtu"},
      {"negative offset", {.offsets = "-4"}, "part.vtu"},
      {"offsets do not grow",
       {.connectivity = "0 1 2 3 0 1 2 3", .offsets = "8 4", .types = "9 9", .n_cells = "2"},
       "part.vtu"},
      {"unknown type", {.types = "77"}, "part.vtu"},
      {"triangles", {.connectivity = "0 1 2", .offsets = "3", .types = "5"}, "1 vtkTriangle"},
      {"lines", {.connectivity = "0 1", .offsets = "2", .types = "3"}, "no plane and no solid"},
      {"mixture",
       {.connectivity = "0 1 2 3 0 1 2", .offsets = "4 7", .types = "9 5", .n_cells = "2"},
       "1 quad4, 1 vtkTriangle"},
      {"huge number of points", {.n_points = "900000000000"}, "cannot hold"},
      {"huge number of cells", {.n_cells = "900000000000"}, "cannot hold"},
      {"negative number of points", {.n_points = "-4"}, "cannot hold"},
      {"number that is none", {.n_points = "four"}, "cannot hold"},
      {"no points", {.points = "", .n_points = "0"}, "part.vtu"},
      {"no cells", {.connectivity = "", .offsets = "", .types = "", .n_cells = "0"}, "part.vtu"},
  };
}

TEST(VtuReader, broken_files_are_refused_with_place_and_reason) {
  for (const Broken& broken : broken_files()) {
    const std::string text = complaint(broken.vtu.text());
    EXPECT_NE(text.find(broken.expected), std::string::npos) << broken.what << ": " << text;
  }
  EXPECT_NE(complaint("").find("not a VTK"), std::string::npos);
  EXPECT_NE(complaint("<VTKFile type=\"PolyData\"></VTKFile>").find("not a VTK"),
            std::string::npos);
  const std::string whole = Vtu().text();
  EXPECT_NE(complaint(whole.substr(0, whole.size() / 2)).find("VTK cannot read"),
            std::string::npos);
}

TEST(VtuReader, arrays_without_a_known_type_are_refused_even_where_they_are_not_needed) {
  for (const char* array : {R"(<DataArray typ9="Int32" Name="top" format="ascii">0</DataArray>)",
                            R"(<DataArray type="U$nt8" Name="top" format="ascii">0</DataArray>)"}) {
    std::string text = Vtu().text();
    text.insert(text.find("<Piece"), fmt::format("<FieldData>{}</FieldData>", array));
    EXPECT_NE(complaint(text).find("no known type"), std::string::npos);
  }
}

TEST(VtuReader, every_truncation_of_a_compressed_file_is_an_error) {
  const TemporaryFolder folder;
  const Mesh mesh = mechanics::box_mesh({.kind = ElementKind::quad8});
  WorkpieceFrame frame;
  frame.kind = mesh.kind;
  frame.points = mesh.points;
  frame.cells = mesh.cells;
  write_vtu(folder.path() / "whole.vtu", frame);
  const std::string whole = test::content_of(folder.path() / "whole.vtu");
  const std::size_t end = whole.find("</VTKFile>");
  for (std::size_t length = 0; length < end; length += 13)
    EXPECT_NE(complaint(whole.substr(0, length)), "") << length;
}

} // namespace
} // namespace billet::io::vtu_reader_test
