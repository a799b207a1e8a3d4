// VTK's .vtu through VTK's own reader; what it hands over is checked before it is used.

#include "geometry/base/error.h"
#include "io/mesh/raw_mesh.h"
#include "io/mesh/scanner.h"
#include "io/mesh/vtu_guard.h"
#include "io/text.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

struct VtkType {
  int number;
  int n_nodes; ///< in the file
  ElementKind kind;
};

constexpr std::array vtk_types{
    VtkType{VTK_QUAD, 4, ElementKind::quad4},
    VtkType{VTK_QUADRATIC_QUAD, 8, ElementKind::quad8},
    VtkType{VTK_BIQUADRATIC_QUAD, 9, ElementKind::quad8},
    VtkType{VTK_QUADRATIC_TRIANGLE, 6, ElementKind::tri6},
    VtkType{VTK_HEXAHEDRON, 8, ElementKind::hex8},
    VtkType{VTK_QUADRATIC_HEXAHEDRON, 20, ElementKind::hex20},
    VtkType{VTK_TRIQUADRATIC_HEXAHEDRON, 27, ElementKind::hex20},
    VtkType{VTK_QUADRATIC_TETRA, 10, ElementKind::tet10},
};

/// Collects VTK's messages instead of printing them, as long as it lives.
class CapturedMessages {
public:
  CapturedMessages()
      : before_(vtkOutputWindow::GetInstance()),
        verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(window_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~CapturedMessages() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  CapturedMessages(const CapturedMessages&) = delete;
  CapturedMessages& operator=(const CapturedMessages&) = delete;

  /// The essence of the first message; empty if there was none.
  [[nodiscard]] std::string first() const {
    std::string all = window_->GetOutput();
    const std::size_t colon = all.find("): ");
    if (all.empty() || colon == std::string::npos)
      return all;
    return std::string(trimmed(all.substr(colon + 3, all.find('\n', colon) - colon - 3)));
  }

private:
  vtkNew<vtkStringOutputWindow> window_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
};

[[noreturn]] void refuse(const std::filesystem::path& path,
                         const std::string& message,
                         const std::string& remedy = {}) {
  throw Error(Fault::geometry, path.string(), message, remedy);
}

const VtkType* find_type(int number) {
  for (const VtkType& known : vtk_types)
    if (known.number == number)
      return &known;
  return nullptr;
}

/// Name and dimension of a cell the solver does not know.
std::pair<std::string, int> describe(int number) {
  const char* name = vtkCellTypes::GetClassNameFromTypeId(number);
  vtkNew<vtkGenericCell> cell;
  if (number > 0 && number < VTK_NUMBER_OF_CELL_TYPES)
    cell->SetCellType(number);
  return {name != nullptr ? name : "unknown cells", cell->GetCellDimension()};
}

/// Where each cell begins among the point numbers, checked against their count.
std::vector<vtkIdType> checked_offsets(vtkUnstructuredGrid& grid,
                                       const std::filesystem::path& path) {
  vtkCellArray* cells = grid.GetCells();
  vtkDataArray* offsets = cells == nullptr ? nullptr : cells->GetOffsetsArray();
  const vtkIdType n =
      grid.GetCellTypesArray() == nullptr ? 0 : grid.GetCellTypesArray()->GetNumberOfTuples();
  if (offsets == nullptr || n == 0)
    refuse(path, "the file has no cells");
  if (offsets->GetNumberOfTuples() != n + 1)
    refuse(path, fmt::format("there are {} cell types, but {} cells", n,
                             offsets->GetNumberOfTuples() - 1));
  std::vector<vtkIdType> begin;
  for (vtkIdType i = 0; i <= n; ++i)
    begin.push_back(static_cast<vtkIdType>(offsets->GetTuple1(i)));
  const vtkIdType size = cells->GetConnectivityArray()->GetNumberOfTuples();
  if (begin.front() != 0 || begin.back() != size || !std::is_sorted(begin.begin(), begin.end()))
    refuse(path, "the offsets of the cells do not fit their point numbers");
  return begin;
}

void read_points(vtkUnstructuredGrid& grid, const std::filesystem::path& path, RawMesh& mesh) {
  if (grid.GetPoints() == nullptr || grid.GetNumberOfPoints() == 0)
    refuse(path, "the file has no points");
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    Vec3 point;
    grid.GetPoint(i, point.data());
    if (!point.allFinite())
      refuse(path, fmt::format("a coordinate of point {} is not a finite number", i));
    mesh.points.push_back(point);
  }
}

void read_cells(vtkUnstructuredGrid& grid, const std::filesystem::path& path, RawMesh& mesh) {
  const std::vector<vtkIdType> begin = checked_offsets(grid, path);
  vtkDataArray* nodes = grid.GetCells()->GetConnectivityArray();
  std::map<int, std::pair<std::string, int>> unknown;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    const int number = grid.GetCellTypesArray()->GetValue(static_cast<vtkIdType>(i));
    const VtkType* type = find_type(number);
    if (type == nullptr) {
      const auto [entry, is_new] = unknown.try_emplace(number);
      if (is_new)
        entry->second = describe(number);
      CellBlock& block = mesh.blocks[entry->second.first];
      block.dimension = entry->second.second;
      ++block.count;
      continue;
    }
    if (begin[i + 1] - begin[i] != type->n_nodes)
      refuse(path, fmt::format("cell {} of type {} has {} points, not {}", i, number,
                               begin[i + 1] - begin[i], type->n_nodes));
    CellBlock& block = mesh.blocks[std::string(mechanics::name(type->kind))];
    block.dimension = mechanics::dimension(type->kind);
    block.kind = type->kind;
    ++block.count;
    for (vtkIdType k = 0; k < mechanics::nodes_per_element(type->kind); ++k) {
      const double node = nodes->GetTuple1(begin[i] + k);
      if (!(node >= 0.0) || node >= static_cast<double>(mesh.points.size()))
        refuse(path, fmt::format("cell {} has point {}; points are numbered 0 to {}", i, node,
                                 mesh.points.size() - 1));
      block.nodes.push_back(static_cast<Index>(node));
    }
  }
}

/// Point data of integer type with nothing but 0 and 1 are sets.
void read_sets(vtkUnstructuredGrid& grid, RawMesh& mesh) {
  vtkPointData* data = grid.GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    if (array == nullptr || array->GetName() == nullptr || array->GetNumberOfComponents() != 1 ||
        array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE ||
        array->GetNumberOfTuples() != grid.GetNumberOfPoints())
      continue;
    std::vector<Index> set;
    bool flags = true;
    for (vtkIdType k = 0; flags && k < array->GetNumberOfTuples(); ++k) {
      const double value = array->GetTuple1(k);
      flags = value == 0.0 || value == 1.0;
      if (value == 1.0)
        set.push_back(static_cast<Index>(k));
    }
    const std::string_view name = array->GetName();
    if (flags)
      mesh.node_sets[std::string(name.starts_with("set:") ? name.substr(4) : name)] = set;
  }
}

} // namespace

RawMesh read_vtu(const std::filesystem::path& path) {
  require_plausible_vtu(read_content(path), path);
  const CapturedMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::exception&) { // sizes in damaged data: bad_alloc, length_error
    refuse(path, "the file asks for more memory than there is", "it may be damaged");
  }
  if (reader->GetErrorCode() != 0 || !messages.first().empty())
    refuse(path, fmt::format("VTK cannot read the file: {}", messages.first()),
           "it may be damaged or cut short");
  RawMesh mesh;
  read_points(*reader->GetOutput(), path, mesh);
  read_cells(*reader->GetOutput(), path, mesh);
  read_sets(*reader->GetOutput(), mesh);
  return mesh;
}

} // namespace billet::io
