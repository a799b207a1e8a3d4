#include "io/mesh/vtu_content.h"

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
#include <exception>

namespace billet::io {

namespace {

std::vector<double> values_of(vtkDataArray& array) {
  std::vector<double> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    values.push_back(array.GetTuple1(i));
  return values;
}

VtuType described(int number) {
  const char* name = vtkCellTypes::GetClassNameFromTypeId(number);
  vtkNew<vtkGenericCell> cell;
  if (number > 0 && number < VTK_NUMBER_OF_CELL_TYPES)
    cell->SetCellType(number);
  return {number, name != nullptr ? name : "unknown cells", cell->GetCellDimension()};
}

void take_points(vtkUnstructuredGrid& grid, VtuContent& content) {
  if (grid.GetPoints() == nullptr)
    return;
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    const double* point = grid.GetPoint(i);
    content.points.insert(content.points.end(), point, point + 3);
  }
}

void take_cells(vtkUnstructuredGrid& grid, VtuContent& content) {
  if (vtkUnsignedCharArray* types = grid.GetCellTypesArray(); types != nullptr)
    for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
      content.types.push_back(types->GetValue(i));
  std::vector<int> numbers = content.types;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (const int number : numbers)
    content.known_types.push_back(described(number));
  vtkCellArray* cells = grid.GetCells();
  if (cells == nullptr || cells->GetOffsetsArray() == nullptr)
    return;
  content.has_offsets = true;
  for (const double offset : values_of(*cells->GetOffsetsArray()))
    content.offsets.push_back(static_cast<std::int64_t>(offset));
  content.nodes = values_of(*cells->GetConnectivityArray());
}

void take_arrays(vtkUnstructuredGrid& grid, VtuContent& content) {
  vtkPointData* data = grid.GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    if (array == nullptr || array->GetName() == nullptr || array->GetNumberOfComponents() != 1 ||
        array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE ||
        array->GetNumberOfTuples() != grid.GetNumberOfPoints())
      continue;
    content.arrays.push_back({array->GetName(), values_of(*array)});
  }
}

} // namespace

struct CapturedMessages::Windows {
  vtkNew<vtkStringOutputWindow> own;
  vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
};

CapturedMessages::CapturedMessages() : windows_(std::make_unique<Windows>()) {
  vtkOutputWindow::SetInstance(windows_->own);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

CapturedMessages::~CapturedMessages() {
  vtkLogger::SetStderrVerbosity(windows_->verbosity);
  vtkOutputWindow::SetInstance(windows_->before);
}

std::string CapturedMessages::first() const {
  std::string all = windows_->own->GetOutput();
  const std::size_t colon = all.find("): ");
  if (all.empty() || colon == std::string::npos)
    return all;
  return all.substr(colon + 3, all.find('\n', colon) - colon - 3);
}

namespace {

void take_unit_system(vtkUnstructuredGrid& grid, VtuContent& content) {
  const std::string key = "unit_system: "; // in the name of an array, as frames have it
  vtkFieldData& data = *grid.GetFieldData();
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    const char* const name = data.GetArrayName(i);
    if (const std::string text = name == nullptr ? "" : name; text.starts_with(key))
      content.unit_system = text.substr(key.size());
  }
}

} // namespace

VtuContent vtu_content(const std::filesystem::path& path) {
  const CapturedMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  VtuContent content;
  try {
    reader->Update();
  } catch (const std::exception&) { // sizes in damaged data: bad_alloc, length_error
    content.exceeds_memory = true;
    return content;
  }
  content.complaint = messages.first();
  if (content.complaint.empty() && reader->GetErrorCode() != 0)
    content.complaint = "no reason given";
  if (!content.complaint.empty())
    return content;
  take_points(*reader->GetOutput(), content);
  take_cells(*reader->GetOutput(), content);
  take_arrays(*reader->GetOutput(), content);
  take_unit_system(*reader->GetOutput(), content);
  return content;
}

} // namespace billet::io
