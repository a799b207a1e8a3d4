#include "app/render/flow_lines.h"

#include <vtkAppendPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>

namespace billet::render {

namespace {

constexpr const char* first_place = "first place";

/// Where the material at the points was along an axis before the run.
vtkNew<vtkDoubleArray> first_coordinate(vtkPolyData& faces, vtkDataArray& displacement, int axis) {
  vtkNew<vtkDoubleArray> result;
  result->SetName(first_place);
  for (vtkIdType i = 0; i < faces.GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{};
    faces.GetPoint(i, x.data());
    result->InsertNextValue(x[static_cast<std::size_t>(axis)] - displacement.GetComponent(i, axis));
  }
  return result;
}

} // namespace

vtkSmartPointer<vtkPolyData> flow_lines(vtkPolyData& faces, int count) {
  vtkDataArray* displacement = faces.GetPointData()->GetArray("displacement");
  if (displacement == nullptr)
    return nullptr;
  const vtkNew<vtkAppendPolyData> all;
  for (const int axis : {0, 1}) {
    const vtkNew<vtkDoubleArray> coordinate = first_coordinate(faces, *displacement, axis);
    const vtkNew<vtkPolyData> field;
    field->ShallowCopy(&faces);
    field->GetPointData()->SetScalars(coordinate);
    std::array<double, 2> range{};
    coordinate->GetRange(range.data());
    const vtkNew<vtkContourFilter> lines;
    lines->SetInputData(field);
    for (int i = 0; i < count; ++i)
      lines->SetValue(i, range[0] + (i + 0.5) / count * (range[1] - range[0]));
    lines->Update();
    all->AddInputData(lines->GetOutput());
  }
  all->Update();
  return all->GetOutput();
}

} // namespace billet::render
