#include "io/results/read_frames.h"

#include "geometry/base/error.h"
#include "io/mesh/vtu_content.h"
#include "io/results/pvd.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <system_error>

namespace billet::io {

namespace {

namespace fs = std::filesystem;
using mechanics::ElementKind;
using mechanics::Index;

[[noreturn]] void refuse_frame(const fs::path& file, const std::string& message) {
  throw Error(Fault::input_output, file.string(), message,
              "the file is damaged, or another program has written it",
              error_code::results_unreadable);
}

ElementKind kind_of_cells(int vtk_type, const fs::path& file) {
  static const std::map<int, ElementKind> kinds{{VTK_QUAD, ElementKind::quad4},
                                                {VTK_QUADRATIC_QUAD, ElementKind::quad8},
                                                {VTK_QUADRATIC_TRIANGLE, ElementKind::tri6},
                                                {VTK_HEXAHEDRON, ElementKind::hex8},
                                                {VTK_QUADRATIC_HEXAHEDRON, ElementKind::hex20},
                                                {VTK_TETRA, ElementKind::tet4},
                                                {VTK_QUADRATIC_TETRA, ElementKind::tet10}};
  const auto found = kinds.find(vtk_type);
  if (found == kinds.end())
    refuse_frame(file, "has cells of a type that no result has");
  return found->second;
}

/// What VTK makes of a file; its own words about one that is damaged are not printed.
template <class Reader> auto read_with(const fs::path& file) {
  if (std::error_code error; !fs::is_regular_file(file, error))
    refuse_frame(file, "the file is not there");
  const CapturedMessages messages;
  const vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0 || !messages.first().empty())
    refuse_frame(file, "cannot be read: " + messages.first());
  return vtkSmartPointer(reader->GetOutput());
}

/// The text behind "NAME: " among the names of the field data; empty: there is none.
std::string note_in(vtkFieldData& data, const std::string& name) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    const char* const array = data.GetArrayName(i);
    const std::string text = array == nullptr ? "" : array;
    if (text.starts_with(name + ": "))
      return text.substr(name.size() + 2);
  }
  return {};
}

double time_in(vtkFieldData& data) {
  vtkDataArray* const time = data.GetArray("TimeValue");
  return time != nullptr && time->GetNumberOfTuples() > 0 ? time->GetTuple1(0) : 0.0;
}

std::vector<Field> fields_in(vtkFieldData& values, vtkFieldData& notes) {
  std::vector<Field> fields;
  for (int i = 0; i < values.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = values.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr)
      continue;
    Field field{array->GetName(), array->GetNumberOfComponents(), {}, {}};
    field.unit = note_in(notes, "unit of " + field.name);
    field.values.reserve(static_cast<std::size_t>(array->GetNumberOfValues()));
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
      for (int c = 0; c < field.components; ++c)
        field.values.push_back(array->GetComponent(k, c));
    fields.push_back(std::move(field));
  }
  return fields;
}

std::vector<Vec3> points_in(vtkPointSet& set) {
  std::vector<Vec3> points(static_cast<std::size_t>(set.GetNumberOfPoints()));
  for (vtkIdType i = 0; i < set.GetNumberOfPoints(); ++i)
    set.GetPoint(i, points[static_cast<std::size_t>(i)].data());
  return points;
}

std::vector<std::vector<Index>> cells_in(vtkCellArray* cells) {
  std::vector<std::vector<Index>> lists;
  if (cells == nullptr)
    return lists;
  const vtkNew<vtkIdList> nodes;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    cells->GetCellAtId(i, nodes);
    std::vector<Index>& list = lists.emplace_back();
    for (vtkIdType k = 0; k < nodes->GetNumberOfIds(); ++k)
      list.push_back(static_cast<Index>(nodes->GetId(k)));
  }
  return lists;
}

std::optional<fs::path> list_in(const fs::path& folder) {
  std::optional<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".pvd") {
      if (found)
        return std::nullopt;
      found = entry.path();
    }
  return found;
}

/// "symmetry: x = 0, y = 2.5", as `frames.cpp` notes it.
std::vector<SymmetryPlane> symmetry_in(vtkFieldData& data) {
  constexpr std::string_view note = "symmetry: ";
  std::vector<SymmetryPlane> planes;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    const char* const array = data.GetArrayName(i);
    std::string_view text = array == nullptr ? "" : array;
    if (!text.starts_with(note))
      continue;
    text.remove_prefix(note.size());
    while (!text.empty()) {
      constexpr std::size_t before_value = 4; // "x = "
      double value = 0.0;
      if (text.find(" = ") == 1 && text[0] >= 'x' && text[0] <= 'z' &&
          std::from_chars(text.data() + before_value, text.data() + text.size(), value).ec ==
              std::errc())
        planes.push_back({text[0] - 'x', value});
      const std::size_t comma = text.find(", ");
      text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 2);
    }
  }
  const std::vector<SymmetryPlane> all = planes;
  std::erase_if(planes, [&](const SymmetryPlane& plane) {
    return std::count_if(all.begin(), all.end(),
                         [&](const SymmetryPlane& other) { return other.axis == plane.axis; }) > 1;
  });
  return planes;
}

} // namespace

std::vector<FrameFiles> frames_in(const fs::path& folder) {
  const std::optional<fs::path> list = list_in(folder);
  std::vector<FrameFiles> frames;
  if (!list)
    return frames;
  constexpr std::string_view tool = "tool-";
  bool is_there = false; // the workpiece that the following parts belong to
  for (const PvdEntry& entry : read_pvd(*list)) {
    const fs::path file = folder / entry.file;
    std::error_code error;
    if (entry.part == "workpiece") {
      is_there = fs::is_regular_file(file, error);
      if (is_there)
        frames.push_back({entry.time, file, {}, {}});
    } else if (is_there && fs::is_regular_file(file, error)) {
      if (entry.part == "contact")
        frames.back().contact = file;
      else if (entry.part.starts_with(tool))
        frames.back().tools.emplace_back(entry.part.substr(tool.size()), file);
    }
  }
  return frames;
}

StoredWorkpiece read_workpiece(const fs::path& file) {
  const auto grid = read_with<vtkXMLUnstructuredGridReader>(file);
  if (grid->GetNumberOfCells() == 0)
    refuse_frame(file, "has no cells");
  StoredWorkpiece workpiece;
  workpiece.time = time_in(*grid->GetFieldData());
  workpiece.mesh.kind = kind_of_cells(grid->GetCellType(0), file);
  workpiece.mesh.points = points_in(*grid);
  const auto n_nodes = static_cast<std::size_t>(mechanics::nodes_per_element(workpiece.mesh.kind));
  for (const std::vector<Index>& cell : cells_in(grid->GetCells())) {
    if (cell.size() != n_nodes)
      refuse_frame(file, "has cells of more than one kind");
    workpiece.mesh.cells.insert(workpiece.mesh.cells.end(), cell.begin(), cell.end());
  }
  workpiece.points = fields_in(*grid->GetPointData(), *grid->GetFieldData());
  workpiece.cells = fields_in(*grid->GetCellData(), *grid->GetFieldData());
  workpiece.symmetry = symmetry_in(*grid->GetFieldData());
  return workpiece;
}

SurfaceFrame read_surface(const fs::path& file) {
  const auto surface = read_with<vtkXMLPolyDataReader>(file);
  SurfaceFrame frame;
  frame.time = time_in(*surface->GetFieldData());
  frame.points = points_in(*surface);
  frame.lines = cells_in(surface->GetLines());
  frame.polygons = cells_in(surface->GetPolys());
  frame.point_fields = fields_in(*surface->GetPointData(), *surface->GetFieldData());
  frame.cell_fields = fields_in(*surface->GetCellData(), *surface->GetFieldData());
  return frame;
}

} // namespace billet::io
