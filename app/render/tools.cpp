#include "app/render/tools.h"

#include "app/render/revolve.h"
#include "app/render/touched.h"

#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>

namespace billet::render {

namespace {

/// Sharp edges and rims of a tool.
vtkSmartPointer<vtkPolyData> edges_of(vtkPolyData& tool) {
  const vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(&tool);
  const vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(joined->GetOutputPort());
  // Cells of wear meet with hanging corners: their rims are no edges of the tool.
  edges->SetBoundaryEdges(tool.GetCellData()->HasArray("wear_depth") == 0);
  edges->SetNonManifoldEdges(tool.GetCellData()->HasArray("wear_depth") == 0);
  edges->SetFeatureAngle(30.0);
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

vtkSmartPointer<vtkPolyData> in_window(vtkSmartPointer<vtkPolyData> tool, const Box& window) {
  for (int d = 0; d < 3; ++d)
    for (const double sign : {1.0, -1.0}) {
      const double at = sign > 0.0 ? window.low[d] : -window.high[d];
      tool = part_in(*tool, {sign * Vec3::Unit(d), at});
    }
  return tool;
}

/// What lies where the part is of the planes of symmetry: images show the rest.
vtkSmartPointer<vtkPolyData>
on_sides(vtkSmartPointer<vtkPolyData> tool, const std::vector<HalfSpace>& sides, double size) {
  constexpr double rounding = 1e-9;
  for (const HalfSpace& side : sides)
    tool = part_in(*tool, {side.normal, side.at - rounding * size});
  return tool;
}

} // namespace

std::vector<DrawnTool>
tools_of(const Frame& frame, const Shown& shown, const Completion& completion, const Box& window) {
  std::vector<DrawnTool> tools;
  for (const auto& [name, surface] : frame.tools) {
    if (surface->GetNumberOfCells() == 0)
      continue;
    const vtkNew<vtkPolyData> whole;
    whole->ShallowCopy(surface);
    const bool coloured = shown.on == Place::tools && !shown.plain;
    if (coloured && !shown.touched)
      add_values(*whole, shown);
    const bool lines = surface->GetNumberOfPolys() == 0;
    const auto near = in_window(vtkSmartPointer<vtkPolyData>(whole), window);
    vtkSmartPointer<vtkPolyData> drawn = on_sides(near, completion.sides, window.size());
    if (coloured && shown.touched)
      drawn = with_touched_values(*drawn, frame, shown, window.size());
    const auto completed_faces = completed(*drawn, completion);
    if (lines && !completion.revolve) {
      tools.push_back({nullptr, completed_faces});
    } else if (lines) {
      Completion ends = completion;
      ends.revolve.reset();
      const auto rims = at_both_ends(*drawn, *completion.revolve);
      tools.push_back({completed_faces, completed(*rims, ends)});
    } else {
      const auto edges = on_sides(edges_of(*near), completion.sides, window.size());
      tools.push_back({completed_faces, completed(*edges, completion)});
    }
  }
  return tools;
}

} // namespace billet::render
