#include "app/render/arrows.h"

#include <vtkArrowSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <set>

namespace billet::render {

namespace {

constexpr double spacing_share = 1.0 / 25.0;

/// One point of each cell of a grid, with the vectors there; short ones are left out.
vtkSmartPointer<vtkPolyData> spread_points(vtkPolyData& faces, double spacing, double shortest) {
  std::set<std::array<long, 3>> taken;
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkDoubleArray> vectors;
  vectors->SetNumberOfComponents(3);
  vtkDataArray* const all = faces.GetPointData()->GetVectors();
  for (vtkIdType i = 0; i < faces.GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{}, v{};
    faces.GetPoint(i, x.data());
    all->GetTuple(i, v.data());
    if (!(std::hypot(v[0], v[1], v[2]) >= shortest))
      continue;
    std::array<long, 3> cell{};
    for (std::size_t d = 0; d < 3; ++d)
      cell[d] = std::lround(x[d] / spacing);
    if (!taken.insert(cell).second)
      continue;
    points->InsertNextPoint(x.data());
    vectors->InsertNextTuple(v.data());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->GetPointData()->SetVectors(vectors);
  return result;
}

} // namespace

vtkSmartPointer<vtkPolyData>
arrows_on(vtkPolyData& faces, double size, double longest, double length) {
  constexpr double negligible = 0.01;
  if (faces.GetPointData()->GetVectors() == nullptr || !(longest > 0.0))
    return nullptr;
  const auto points = spread_points(faces, spacing_share * size, negligible * longest);
  if (points->GetNumberOfPoints() == 0)
    return nullptr;
  const vtkNew<vtkArrowSource> arrow;
  arrow->SetTipLength(0.35);
  arrow->SetTipRadius(0.13);
  arrow->SetShaftRadius(0.04);
  arrow->SetTipResolution(12);
  arrow->SetShaftResolution(8);
  const vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(points);
  glyphs->SetSourceConnection(arrow->GetOutputPort());
  glyphs->SetVectorModeToUseVector();
  glyphs->SetScaleModeToScaleByVector();
  glyphs->SetScaleFactor(length / longest);
  glyphs->Update();
  return glyphs->GetOutput();
}

} // namespace billet::render
