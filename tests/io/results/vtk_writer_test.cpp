#include "geometry/base/error.h"
#include "io/results/vtk_writer.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/io/full_disk.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace billet::io::vtk_writer_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;
using test::content_of;
using test::TemporaryFolder;

/// A mesh with a field of each sort, each value different.
WorkpieceFrame sample(const Mesh& mesh) {
  WorkpieceFrame frame;
  frame.time = 0.375;
  frame.kind = mesh.kind;
  frame.points = mesh.points;
  frame.cells = mesh.cells;
  const auto field = [](const char* name, int components, Index n, const char* unit) {
    Field result{name, components, {}, unit};
    for (Index i = 0; i < n * components; ++i)
      result.values.push_back(i / 7.0);
    return result;
  };
  frame.point_fields = {field("displacement", 3, mesh.n_points(), "mm"),
                        field("stress", 6, mesh.n_points(), "MPa"),
                        field("plastic_strain", 1, mesh.n_points(), "")};
  frame.cell_fields = {field("element_quality", 1, mesh.n_elements(), "-")};
  frame.notes = {{"configuration", "current coordinates"}, {"analysis", "axisymmetric"}};
  return frame;
}

/// Names as ParaView shows them in its list of components.
void expect_named(vtkDataArray& array) {
  const std::vector<const char*> names =
      array.GetNumberOfComponents() == 3   ? std::vector<const char*>{"X", "Y", "Z"}
      : array.GetNumberOfComponents() == 6 ? std::vector{"XX", "YY", "ZZ", "XY", "YZ", "XZ"}
                                           : std::vector<const char*>{};
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_STREQ(array.GetComponentName(static_cast<vtkIdType>(i)), names[i]);
}

void expect_same(const Field& field, vtkDataArray* array) {
  ASSERT_NE(array, nullptr) << field.name;
  EXPECT_EQ(array->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(array->GetNumberOfComponents(), field.components);
  expect_named(*array);
  ASSERT_EQ(array->GetNumberOfValues(), static_cast<vtkIdType>(field.values.size()));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const auto at = static_cast<int>(i);
    EXPECT_EQ(array->GetComponent(at / field.components, at % field.components), field.values[i]);
  }
}

/// Writes a frame over a mesh; VTK reads the same from it.
void expect_read_back(const Mesh& mesh, int type) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.vtu";
  const WorkpieceFrame frame = sample(mesh);
  write_vtu(path, frame);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.n_elements());
  ASSERT_EQ(grid->GetNumberOfPoints(), mesh.n_points());
  EXPECT_EQ(grid->GetCellType(0), type);
  for (Index i = 0; i < mesh.n_points(); ++i) {
    Vec3 point;
    grid->GetPoint(i, point.data());
    EXPECT_EQ(point, mesh.points[static_cast<std::size_t>(i)]);
  }
  for (const Field& field : frame.point_fields)
    expect_same(field, grid->GetPointData()->GetArray(field.name.c_str()));
  expect_same(frame.cell_fields[0], grid->GetCellData()->GetArray("element_quality"));
}

TEST(VtkWriter, vtk_reads_back_cells_points_and_fields_to_the_bit) {
  for (const auto& [kind, type] : {std::pair{ElementKind::quad4, 9},
                                   {ElementKind::quad8, 23},
                                   {ElementKind::tri6, 22},
                                   {ElementKind::hex8, 12},
                                   {ElementKind::hex20, 25},
                                   {ElementKind::tet10, 24}})
    expect_read_back(mechanics::box_mesh({.kind = kind, .cells = {2, 2, 1}, .grading = {3, 1, 1}}),
                     type);
}

TEST(VtkWriter, packs_large_frames_and_small_ones_in_turn) {
  for (const int cells : {90, 2, 90, 2}) // 1 MB in blocks of 32 kB each, a kilobyte
    expect_read_back(mechanics::box_mesh({.kind = ElementKind::quad4, .cells = {cells, cells, 1}}),
                     9);
}

TEST(VtkWriter, arrays_of_any_length_fill_their_last_characters) {
  for (const int cells : {1, 2, 3, 4, 5, 6}) // as many bytes say their types
    expect_read_back(mechanics::box_mesh({.kind = ElementKind::quad4, .cells = {cells, 1, 1}}), 9);
}

TEST(VtkWriter, names_and_notes_may_hold_what_xml_has_a_meaning_for) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.vtu";
  const Mesh mesh = mechanics::box_mesh({});
  WorkpieceFrame frame = sample(mesh);
  frame.notes.emplace_back("title", "\"hot\" & <cold>, 'half'");
  write_vtu(path, frame);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_NE(reader->GetOutput()->GetFieldData()->GetArray("title: \"hot\" & <cold>, 'half'"),
            nullptr);
}

TEST(VtkWriter, time_notes_and_units_are_in_the_field_data) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.vtu";
  const Mesh mesh = mechanics::box_mesh({});
  write_vtu(path, sample(mesh));
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkFieldData* data = reader->GetOutput()->GetFieldData();
  EXPECT_EQ(data->GetArray("TimeValue")->GetTuple1(0), 0.375);
  for (const char* text : {"configuration: current coordinates", "analysis: axisymmetric",
                           "unit of displacement: mm", "unit of element_quality: -"})
    EXPECT_NE(data->GetArray(text), nullptr) << text;
  EXPECT_EQ(data->GetNumberOfArrays(), 6);
}

TEST(VtkWriter, there_are_no_string_arrays_which_meshio_refuses) {
  const TemporaryFolder folder;
  const Mesh mesh = mechanics::box_mesh({});
  write_vtu(folder.path() / "w.vtu", sample(mesh));
  EXPECT_EQ(content_of(folder.path() / "w.vtu").find("String"), std::string::npos);
}

TEST(VtkWriter, files_are_compressed_inline_with_wide_headers) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.vtu";
  const Mesh mesh = mechanics::box_mesh({.cells = {50, 50, 1}});
  write_vtu(path, sample(mesh));
  const std::string text = content_of(path);
  EXPECT_NE(text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("compressor=\"vtkZLibDataCompressor\""), std::string::npos);
  EXPECT_EQ(text.find("AppendedData"), std::string::npos);
  EXPECT_EQ(text.find("format=\"ascii\""), std::string::npos);
}

TEST(VtkWriter, the_same_frame_gives_the_same_bytes) {
  const TemporaryFolder folder;
  const Mesh mesh = mechanics::box_mesh({.cells = {5, 5, 1}});
  write_vtu(folder.path() / "a.vtu", sample(mesh));
  write_vtu(folder.path() / "b.vtu", sample(mesh));
  EXPECT_EQ(content_of(folder.path() / "a.vtu"), content_of(folder.path() / "b.vtu"));
}

TEST(VtkWriter, surfaces_hold_lines_and_polygons_with_their_data) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.vtp";
  SurfaceFrame frame;
  frame.time = 2.0;
  frame.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 2}};
  frame.lines = {{0, 4}, {0, 1, 2}};
  frame.polygons = {{0, 1, 2}, {0, 1, 2, 3}};
  frame.point_fields = {{"wear_depth", 1, {1, 2, 3, 4, 5}, "mm"}};
  frame.cell_fields = {{"gap", 1, {10, 20, 30, 40}, ""}};
  write_vtp(path, frame);
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* surface = reader->GetOutput();
  EXPECT_EQ(surface->GetNumberOfLines(), 2);
  EXPECT_EQ(surface->GetNumberOfPolys(), 2);
  expect_same(frame.point_fields[0], surface->GetPointData()->GetArray("wear_depth"));
  expect_same(frame.cell_fields[0], surface->GetCellData()->GetArray("gap"));
  EXPECT_EQ(surface->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 2.0);
}

TEST(VtkWriter, an_empty_surface_is_a_valid_file) {
  const TemporaryFolder folder;
  write_vtp(folder.path() / "t.vtp", {});
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder.path() / "t.vtp").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0U);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
}

TEST(VtkWriter, faces_become_lines_in_the_plane_and_polygons_in_turn_in_space) {
  SurfaceFrame frame;
  add_face(frame, std::array<Index, 2>{4, 5}, 2);
  add_face(frame, std::array<Index, 3>{4, 6, 5}, 2);
  EXPECT_EQ(frame.lines, (std::vector<std::vector<Index>>{{4, 5}, {4, 5, 6}}));
  add_face(frame, std::array<Index, 4>{0, 1, 2, 3}, 3);
  add_face(frame, std::array<Index, 6>{0, 1, 2, 3, 4, 5}, 3);
  add_face(frame, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 3);
  EXPECT_EQ(frame.polygons, (std::vector<std::vector<Index>>{
                                {0, 1, 2, 3}, {0, 3, 1, 4, 2, 5}, {0, 4, 1, 5, 2, 6, 3, 7}}));
}

TEST(VtkWriter, a_full_disk_is_told_and_leaves_the_earlier_frame) {
  const TemporaryFolder folder;
  const auto path = folder.file("w.vtu", "earlier");
  const Mesh mesh = mechanics::box_mesh({.cells = {30, 30, 1}});
  bool told = false;
  {
    const test::FullDisk disk(1000);
    try {
      write_vtu(path, sample(mesh));
    } catch (const Error& error) {
      told = error.fault() == Fault::input_output;
    }
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(content_of(path), "earlier");
  EXPECT_THROW(write_vtp(path / "t.vtp", {}), Error);
}

} // namespace
} // namespace billet::io::vtk_writer_test
