#include "app/render/touched.h"

#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStaticCellLocator.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGridGeometryFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace billet::render {

namespace {

/// Lines in pieces no longer than `longest`.
vtkSmartPointer<vtkPolyData> divided_lines(vtkPolyData& lines, double longest) {
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> pieces;
  for (vtkIdType i = 0; i < lines.GetNumberOfCells(); ++i) {
    const vtkNew<vtkIdList> ids;
    lines.GetCellPoints(i, ids);
    for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k) {
      std::array<double, 3> a{}, b{};
      lines.GetPoint(ids->GetId(k), a.data());
      lines.GetPoint(ids->GetId(k + 1), b.data());
      const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      const int n = std::max(1, static_cast<int>(std::ceil(length / longest)));
      pieces->InsertNextCell(n + 1);
      for (int s = 0; s <= n; ++s) {
        const double t = static_cast<double>(s) / n;
        pieces->InsertCellPoint(points->InsertNextPoint(
            a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])));
      }
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetLines(pieces);
  return result;
}

vtkSmartPointer<vtkPolyData> divided_faces(vtkPolyData& faces, double longest) {
  const vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(&faces);
  const vtkNew<vtkAdaptiveSubdivisionFilter> divided;
  divided->SetInputConnection(triangles->GetOutputPort());
  divided->SetMaximumEdgeLength(longest);
  constexpr vtkIdType most = 400000; // faces, so that a large tool does not take all memory
  divided->SetMaximumNumberOfTriangles(most);
  divided->Update();
  return divided->GetOutput();
}

/// The outer faces of a part in space, in the plane its outer edges.
vtkSmartPointer<vtkPolyData> boundary_of(vtkUnstructuredGrid& part) {
  const vtkNew<vtkUnstructuredGridGeometryFilter> faces;
  faces->SetInputData(&part);
  const vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(faces->GetOutputPort());
  surface->Update();
  std::array<double, 6> box{};
  part.GetBounds(box.data());
  if (box[5] - box[4] > 1e-9 * (box[1] - box[0] + box[3] - box[2]))
    return surface->GetOutput();
  const vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(surface->GetOutputPort());
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

} // namespace

vtkSmartPointer<vtkPolyData>
with_touched_values(vtkPolyData& tool, const Frame& frame, const Shown& shown, double size) {
  constexpr double piece_share = 1.0 / 200.0, reach_share = 0.01;
  const bool lines = tool.GetNumberOfPolys() == 0;
  const vtkSmartPointer<vtkPolyData> divided =
      lines ? divided_lines(tool, piece_share * size) : divided_faces(tool, piece_share * size);
  const auto part = boundary_of(*frame.workpiece);
  add_values(*part, shown);
  vtkDataArray* const known = part->GetPointData()->GetArray(Shown::values);
  const vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(part);
  locator->BuildLocator();
  const vtkNew<vtkDoubleArray> values;
  values->SetName(Shown::values);
  const vtkNew<vtkGenericCell> cell;
  const double reach = reach_share * size;
  for (vtkIdType i = 0; i < divided->GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{}, foot{}, parameter{};
    std::array<double, 8> weights{};
    divided->GetPoint(i, x.data());
    vtkIdType found = -1;
    int sub = 0;
    double distance2 = 0.0, value = std::numeric_limits<double>::quiet_NaN();
    locator->FindClosestPoint(x.data(), foot.data(), cell, found, sub, distance2);
    if (found >= 0 && distance2 <= reach * reach) {
      part->GetCell(found, cell);
      cell->EvaluatePosition(foot.data(), nullptr, sub, parameter.data(), distance2,
                             weights.data());
      value = 0.0;
      for (vtkIdType a = 0; a < cell->GetNumberOfPoints(); ++a)
        value += weights[static_cast<std::size_t>(a)] * known->GetTuple1(cell->GetPointId(static_cast<int>(a)));
    }
    values->InsertNextValue(value);
  }
  divided->GetPointData()->AddArray(values);
  return divided;
}

} // namespace billet::render
