#include "io/results/vtk_writer.h"

#include "io/results/atomic_file.h"
#include "io/results/pvd.h"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string_view>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

/// VTK's number of a cell's type.
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

/// What the components of a vector or a tensor are called, as a person picks one in ParaView.
std::span<const char* const> component_names(int components) {
  static constexpr std::array vector{"X", "Y", "Z"};
  static constexpr std::array tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  if (components == 3)
    return vector;
  return components == 6 ? std::span<const char* const>(tensor) : std::span<const char* const>();
}

/// VTK's view of values that stay where they are; it only reads them.
template <class Array, class T>
vtkNew<Array> array_of(std::span<const T> values, int components = 1) {
  vtkNew<Array> array;
  constexpr int not_deleted = 1;
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()),
                  not_deleted);
  return array;
}

vtkNew<vtkPoints> vtk_points(std::span<const Vec3> points) {
  const double* const first = points.empty() ? nullptr : points.front().data();
  vtkNew<vtkPoints> result;
  result->SetData(array_of<vtkDoubleArray>(std::span(first, 3 * points.size()), 3));
  return result;
}

void add_fields(vtkFieldData& data,
                const std::vector<Field>& fields,
                [[maybe_unused]] std::size_t n) {
  for (const Field& field : fields) {
    assert(field.values.size() == n * idx(field.components));
    const auto array = array_of<vtkDoubleArray>(std::span(field.values), field.components);
    array->SetName(xml_encoded(field.name).c_str());
    vtkIdType number = 0;
    for (const char* name : component_names(field.components))
      array->SetComponentName(number++, name);
    if (!field.unit.empty())
      array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), xml_encoded(field.unit).c_str());
    data.AddArray(array);
  }
}

/// A text is the name of an array with one number. VTK writes names as they are.
void add_note(vtkFieldData& data, std::string_view name, std::string_view value) {
  const vtkNew<vtkUnsignedCharArray> array;
  array->SetName(xml_encoded(fmt::format("{}: {}", name, value)).c_str());
  array->InsertNextValue(1);
  data.AddArray(array);
}

/// Time, notes and units: what is true for a frame as a whole.
template <class Frame> void add_frame_data(vtkFieldData& data, const Frame& frame) {
  const vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time);
  data.AddArray(time);
  for (const auto& [name, value] : frame.notes)
    add_note(data, name, value);
  for (const std::vector<Field>* fields : {&frame.point_fields, &frame.cell_fields})
    for (const Field& field : *fields)
      if (!field.unit.empty())
        add_note(data, "unit of " + field.name, field.unit);
}

/// Compresses what a disk would feel. Packing a small frame costs more than all the rest of
/// writing it.
template <class Frame> bool is_large(const Frame& frame) {
  std::size_t values = 3 * frame.points.size();
  for (const std::vector<Field>* fields : {&frame.point_fields, &frame.cell_fields})
    for (const Field& field : *fields)
      values += field.values.size();
  constexpr std::size_t large = 65536;
  return values >= large;
}

/// VTK's writers go on where memory that they need is not given, and crash: so there is room for
/// them, or none of them begins.
/// @throws std::bad_alloc
void ensure_room_for(vtkDataObject& data) {
  constexpr std::size_t kibibyte = 1024, copies = 4, least = 4096 * kibibyte;
  void* volatile const room =
      std::malloc(std::max(least, copies * kibibyte * data.GetActualMemorySize()));
  if (room == nullptr)
    throw std::bad_alloc();
  std::free(room);
}

/// Writes through memory, so that the system reports what fails (atomic_file.h).
template <class Writer>
void write(const std::filesystem::path& path, vtkDataObject& data, bool compressed) {
  ensure_room_for(data);
  vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetDataModeToBinary();
  writer->SetHeaderTypeToUInt64();
  if (compressed) {
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
  } else {
    writer->SetCompressorTypeToNone();
  }
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0)
    cannot_write(path, 0);
  write_file(path, writer->GetOutputString());
}

/// Cells of any length: their nodes one after another, and where each begins and the last one ends.
struct CellLists {
  std::vector<Index> nodes;
  std::vector<Index> offsets{0};

  explicit CellLists(const std::vector<std::vector<Index>>& cells) {
    for (const std::vector<Index>& cell : cells) {
      nodes.insert(nodes.end(), cell.begin(), cell.end());
      offsets.push_back(static_cast<Index>(nodes.size()));
    }
  }
};

vtkNew<vtkCellArray> cells_of(std::span<const Index> offsets, std::span<const Index> nodes) {
  vtkNew<vtkCellArray> cells;
  cells->SetData(array_of<vtkTypeInt32Array>(offsets), array_of<vtkTypeInt32Array>(nodes));
  return cells;
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
  const std::size_t n_nodes = idx(mechanics::nodes_per_element(frame.kind));
  const std::size_t n_cells = frame.cells.size() / n_nodes;
  std::vector<Index> offsets(n_cells + 1);
  for (std::size_t i = 0; i <= n_cells; ++i)
    offsets[i] = static_cast<Index>(i * n_nodes);
  const vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(vtk_points(frame.points));
  grid->SetCells(vtk_type(frame.kind), cells_of(offsets, frame.cells));
  add_fields(*grid->GetPointData(), frame.point_fields, frame.points.size());
  add_fields(*grid->GetCellData(), frame.cell_fields, n_cells);
  add_frame_data(*grid->GetFieldData(), frame);
  write<vtkXMLUnstructuredGridWriter>(path, *grid, is_large(frame));
}

void write_vtp(const std::filesystem::path& path, const SurfaceFrame& frame) {
  const CellLists lines(frame.lines), polygons(frame.polygons);
  const vtkNew<vtkPolyData> surface;
  surface->SetPoints(vtk_points(frame.points));
  surface->SetLines(cells_of(lines.offsets, lines.nodes));
  surface->SetPolys(cells_of(polygons.offsets, polygons.nodes));
  add_fields(*surface->GetPointData(), frame.point_fields, frame.points.size());
  add_fields(*surface->GetCellData(), frame.cell_fields,
             frame.lines.size() + frame.polygons.size());
  add_frame_data(*surface->GetFieldData(), frame);
  write<vtkXMLPolyDataWriter>(path, *surface, is_large(frame));
}

} // namespace billet::io
