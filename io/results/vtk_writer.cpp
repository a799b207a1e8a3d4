#include "io/results/vtk_writer.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"
#include "io/results/frame_compressor.h"
#include "io/results/vtk_threads.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cassert>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

int vtk_type(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
    return VTK_QUAD;
  case ElementKind::quad8:
    return VTK_QUADRATIC_QUAD;
  case ElementKind::tri6:
    return VTK_QUADRATIC_TRIANGLE;
  case ElementKind::hex8:
    return VTK_HEXAHEDRON;
  case ElementKind::hex20:
    return VTK_QUADRATIC_HEXAHEDRON;
  case ElementKind::tet4:
    return VTK_TETRA;
  case ElementKind::tet10:
    return VTK_QUADRATIC_TETRA;
  }
  return VTK_EMPTY_CELL;
}

vtkNew<vtkPoints> vtk_points(std::span<const Vec3> points) {
  vtkNew<vtkPoints> result;
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  return result;
}

void add_fields(vtkFieldData& data,
                const std::vector<Field>& fields,
                [[maybe_unused]] vtkIdType n) {
  for (const Field& field : fields) {
    assert(static_cast<vtkIdType>(field.values.size()) == n * field.components);
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(field.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size()) / field.components);
    std::copy(field.values.begin(), field.values.end(), array->GetPointer(0));
    data.AddArray(array);
  }
}

/// A text in the field data: the name of an array with one number.
void add_text(vtkFieldData& data, const std::string& name, const std::string& value) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(fmt::format("{}: {}", name, value).c_str());
  array->InsertNextValue(1);
  data.AddArray(array);
}

/// Time, notes and units: what is true for a frame as a whole.
template <class Frame> void add_field_data(vtkFieldData& data, const Frame& frame) {
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time);
  data.AddArray(time);
  for (const auto& [name, value] : frame.notes)
    add_text(data, name, value);
  for (const std::vector<Field>* fields : {&frame.point_fields, &frame.cell_fields})
    for (const Field& field : *fields)
      if (!field.unit.empty())
        add_text(data, "unit of " + field.name, field.unit);
}

/// Writes into memory first: a full disk is then found by `write_file` and leaves nothing behind.
void write(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& path) {
  keep_vtk_to_one_thread();
  writer.SetInputData(&data);
  writer.SetHeaderTypeToUInt64();
  writer.SetDataModeToBinary();
  constexpr unsigned long large = 256; // [KiB]
  const bool small = data.GetActualMemorySize() < large;
  writer.SetCompressor(
      &frame_compressor(small ? CompressorSearch::runs : CompressorSearch::repeats));
  writer.WriteToOutputStringOn();
  if (writer.Write() == 0 || writer.GetErrorCode() != 0)
    throw Error(Fault::input_output, path.string(), "VTK could not write the frame",
                "this may be a lack of memory");
  write_file(path, writer.GetOutputString());
}

vtkNew<vtkCellArray> vtk_cells(const std::vector<std::vector<Index>>& cells) {
  vtkNew<vtkCellArray> result;
  for (const std::vector<Index>& cell : cells) {
    result->InsertNextCell(static_cast<int>(cell.size()));
    for (const Index node : cell)
      result->InsertCellPoint(node);
  }
  return result;
}

} // namespace

void add_face(SurfaceFrame& frame, std::span<const Index> nodes, int dimension) {
  if (dimension == 2) {
    std::vector<Index>& line = frame.lines.emplace_back(nodes.begin(), nodes.end());
    if (line.size() == 3)
      std::swap(line[1], line[2]);
    return;
  }
  std::vector<Index>& polygon = frame.polygons.emplace_back();
  const bool quadratic = nodes.size() > 4;
  const std::size_t n_corners = quadratic ? nodes.size() / 2 : nodes.size();
  for (std::size_t i = 0; i < n_corners; ++i) {
    polygon.push_back(nodes[i]);
    if (quadratic)
      polygon.push_back(nodes[n_corners + i]);
  }
}

void write_vtu(const std::filesystem::path& path, const WorkpieceFrame& frame) {
  const auto n_nodes = static_cast<vtkIdType>(mechanics::nodes_per_element(frame.kind));
  const auto n_cells = static_cast<vtkIdType>(frame.cells.size()) / n_nodes;
  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(frame.cells.size()));
  std::copy(frame.cells.begin(), frame.cells.end(), connectivity->GetPointer(0));
  vtkNew<vtkIdTypeArray> offsets;
  for (vtkIdType i = 0; i <= n_cells; ++i)
    offsets->InsertNextValue(i * n_nodes);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(vtk_points(frame.points));
  grid->SetCells(vtk_type(frame.kind), cells);
  add_fields(*grid->GetPointData(), frame.point_fields,
             static_cast<vtkIdType>(frame.points.size()));
  add_fields(*grid->GetCellData(), frame.cell_fields, n_cells);
  add_field_data(*grid->GetFieldData(), frame);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write(*writer, *grid, path);
}

void write_vtp(const std::filesystem::path& path, const SurfaceFrame& frame) {
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(vtk_points(frame.points));
  surface->SetLines(vtk_cells(frame.lines));
  surface->SetPolys(vtk_cells(frame.polygons));
  add_fields(*surface->GetPointData(), frame.point_fields,
             static_cast<vtkIdType>(frame.points.size()));
  const std::size_t n_cells = frame.lines.size() + frame.polygons.size();
  add_fields(*surface->GetCellData(), frame.cell_fields, static_cast<vtkIdType>(n_cells));
  add_field_data(*surface->GetFieldData(), frame);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write(*writer, *surface, path);
}

} // namespace billet::io
