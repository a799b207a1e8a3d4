#include "app/render/body.h"

#include "app/render/flow_lines.h"
#include "app/render/revolve.h"
#include "geometry/base/error.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGridGeometryFilter.h>

#include <array>

namespace billet::render {

namespace {

constexpr double sharp = 30.0; // edges of bodies [degree]

/// Edges of the faces as they are: parabolas where the cells are quadratic.
vtkSmartPointer<vtkPolyData> element_edges(vtkDataSet& faces) {
  constexpr int n_segments = 8;
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> lines;
  for (vtkIdType i = 0; i < faces.GetNumberOfCells(); ++i) {
    vtkCell* face = faces.GetCell(i);
    for (int k = 0; k < face->GetNumberOfEdges(); ++k) {
      vtkCell* edge = face->GetEdge(k);
      const int n = edge->IsLinear() != 0 ? 1 : n_segments;
      lines->InsertNextCell(n + 1);
      for (int s = 0; s <= n; ++s) {
        std::array<double, 3> place{};
        std::array<double, 3> parameter{static_cast<double>(s) / n, 0.0, 0.0};
        std::array<double, 3> weights{};
        int part = 0;
        edge->EvaluateLocation(part, parameter.data(), place.data(), weights.data());
        lines->InsertCellPoint(points->InsertNextPoint(place.data()));
      }
    }
  }
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetPoints(points);
  edges->SetLines(lines);
  return edges;
}

vtkSmartPointer<vtkPolyData> with_normals(vtkPolyData& faces) {
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&faces);
  normals->SetFeatureAngle(sharp);
  normals->Update();
  return normals->GetOutput();
}

/// The outside of what was computed.
struct Outside {
  vtkSmartPointer<vtkUnstructuredGrid> cells;
  vtkSmartPointer<vtkPolyData> faces, lines;
};

vtkSmartPointer<vtkPolyData> sharp_edges(vtkPolyData& faces) {
  const vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(&faces);
  edges->SetFeatureAngle(sharp);
  edges->BoundaryEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

Outside outside_of(const vtkSmartPointer<vtkUnstructuredGrid>& grid,
                   const SceneOptions& options,
                   const Completion& completion) {
  const vtkNew<vtkUnstructuredGridGeometryFilter> faces;
  faces->SetInputData(grid);
  faces->Update();
  const vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(faces->GetOutputPort());
  surface->SetNonlinearSubdivisionLevel(3);
  surface->Update();
  // Mirror images of quadrilaterals would be drawn along the other diagonal.
  const vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(surface->GetOutputPort());
  triangles->Update();
  Outside outside{grid, triangles->GetOutput(), nullptr};
  if (options.flow_lines)
    outside.lines = flow_lines(*outside.faces, *options.flow_lines);
  else if (options.mesh)
    outside.lines = element_edges(*faces->GetOutput());
  if (options.flow_lines && outside.lines == nullptr)
    throw Error(Fault::usage, "--flow-lines", "the results have no \"displacement\"");
  if (!completion.revolve)
    return outside;
  outside.cells = revolved(*grid, *completion.revolve);
  const vtkNew<vtkDataSetSurfaceFilter> body;
  body->SetInputData(outside.cells);
  body->Update();
  outside.faces = body->GetOutput();
  std::vector<vtkSmartPointer<vtkPolyData>> lines{sharp_edges(*outside.faces)};
  if (outside.lines != nullptr)
    lines.push_back(at_both_ends(*outside.lines, *completion.revolve));
  outside.lines = joined(lines);
  return outside;
}

} // namespace

Body body_of(const Frame& frame,
             const Shown& shown,
             const SceneOptions& options,
             const Completion& completion) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(frame.workpiece);
  if (shown.on == Place::workpiece || shown.touched)
    add_values(*grid, shown);
  if (!options.arrows.empty())
    grid->GetPointData()->SetActiveVectors(options.arrows.c_str());
  const Outside outside = outside_of(grid, options, completion);
  std::vector<vtkSmartPointer<vtkPolyData>> all_faces, all_lines;
  for (const Copy& copy : completion.copies) {
    const std::vector<Removed> removed = before(completion.removed, copy);
    // Normals last: clipping joins the points of faces that meet in a sharp edge.
    const auto kept = without(outside.faces, removed);
    std::vector<vtkSmartPointer<vtkPolyData>> parts{
        completion.flat || kept->GetNumberOfCells() == 0 ? kept : with_normals(*kept)};
    std::vector<vtkSmartPointer<vtkPolyData>> lines;
    if (outside.lines != nullptr)
      lines.push_back(without(outside.lines, removed));
    if (!completion.flat && !removed.empty()) {
      const CutFaces laid_open = cut_faces(*outside.cells, removed);
      if (laid_open.faces->GetNumberOfCells() > 0)
        parts.push_back(with_normals(*laid_open.faces));
      if (options.mesh)
        lines.push_back(laid_open.lines);
    }
    if (const auto whole = joined(parts); whole->GetNumberOfCells() > 0)
      all_faces.push_back(copied(*whole, copy));
    if (const auto whole = joined(lines); whole->GetNumberOfCells() > 0)
      all_lines.push_back(copied(*whole, copy));
  }
  return {joined(all_faces), joined(all_lines)};
}

vtkSmartPointer<vtkPolyData> completed(vtkPolyData& surface, const Completion& completion) {
  vtkSmartPointer<vtkPolyData> whole = &surface;
  if (completion.revolve)
    whole = revolved_lines(surface, *completion.revolve);
  std::vector<vtkSmartPointer<vtkPolyData>> all;
  for (const Copy& copy : completion.copies) {
    const auto part = without(whole, before(completion.removed, copy));
    if (part->GetNumberOfCells() > 0)
      all.push_back(copied(*part, copy));
  }
  return joined(all);
}

} // namespace billet::render
