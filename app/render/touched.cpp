#include "app/render/touched.h"

#include "geometry/base/vector.h"

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

using Triangle = std::array<Vec3, 3>;

/// The number of the longest edge, from corner i to the next.
std::size_t longest_edge(const Triangle& t) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if ((t[i] - t[(i + 1) % 3]).norm() > (t[longest] - t[(longest + 1) % 3]).norm())
      longest = i;
  return longest;
}

std::vector<Triangle> triangles_of(vtkPolyData& faces) {
  const vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(&faces);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  vtkPolyData& divided = *filter->GetOutput();
  std::vector<Triangle> triangles;
  for (vtkIdType i = 0; i < divided.GetNumberOfCells(); ++i) {
    const vtkNew<vtkIdList> ids;
    divided.GetCellPoints(i, ids);
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      divided.GetPoint(ids->GetId(static_cast<vtkIdType>(k)), triangle[k].data());
  }
  return triangles;
}

/// Faces in triangles without edges longer than `longest`, or as many as memory is asked to hold.
vtkSmartPointer<vtkPolyData> divided_faces(vtkPolyData& faces, double longest) {
  constexpr double most = 400000.0;
  std::vector<Triangle> waiting = triangles_of(faces);
  double area = 0.0;
  for (const Triangle& t : waiting)
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  longest = std::max(longest, 2.0 * std::sqrt(area / most));
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> pieces;
  while (!waiting.empty()) {
    const Triangle t = waiting.back();
    waiting.pop_back();
    const std::size_t a = longest_edge(t), b = (a + 1) % 3, c = (a + 2) % 3;
    if ((t[a] - t[b]).norm() > longest) {
      const Vec3 middle = 0.5 * (t[a] + t[b]);
      waiting.push_back({t[a], middle, t[c]});
      waiting.push_back({middle, t[b], t[c]});
      continue;
    }
    pieces->InsertNextCell(3);
    for (const Vec3& corner : t)
      pieces->InsertCellPoint(points->InsertNextPoint(corner.data()));
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(pieces);
  return result;
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
        value += weights[static_cast<std::size_t>(a)] *
                 known->GetTuple1(cell->GetPointId(static_cast<int>(a)));
    }
    values->InsertNextValue(value);
  }
  divided->GetPointData()->AddArray(values);
  return divided;
}

} // namespace billet::render
