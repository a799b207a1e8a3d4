#include "app/render/scene.h"

#include "app/render/colours.h"
#include "app/render/flow_lines.h"
#include "app/render/frame_files.h"
#include "app/render/picture.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGridBase.h>
#include <vtkUnstructuredGridGeometryFilter.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

namespace {

/// Edges of the faces as they are: parabolas where the cells are quadratic.
vtkNew<vtkPolyData> element_edges(vtkDataSet& faces) {
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
  vtkNew<vtkPolyData> edges;
  edges->SetPoints(points);
  edges->SetLines(lines);
  return edges;
}

/// Puts actors into a scene, in both halves if asked for.
class Stage {
public:
  Stage(bool planar, bool mirrored) : planar_(planar), mirrored_(mirrored) {
    renderer_->SetBackground(1.0, 1.0, 1.0);
  }
  [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }

  void add(vtkPolyDataMapper& mapper, vtkProperty& property, double lift) {
    if (planar_)
      property.LightingOff();
    for (const double side : {1.0, -1.0}) {
      if (side < 0.0 && !mirrored_)
        break;
      const vtkNew<vtkActor> actor;
      actor->SetMapper(&mapper);
      actor->SetProperty(&property);
      actor->SetScale(side, 1.0, 1.0);
      actor->SetPosition(0.0, 0.0, planar_ ? lift : 0.0);
      renderer_->AddActor(actor);
    }
  }

  void add_lines(vtkPolyData& lines, float width, double brightness, double lift) {
    const vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(&lines);
    mapper->ScalarVisibilityOff();
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-2.0, -8.0);
    const vtkNew<vtkProperty> property;
    property->SetColor(brightness, brightness, brightness);
    property->SetLineWidth(width);
    property->LightingOff();
    add(*mapper, *property, lift);
  }

private:
  bool planar_;
  bool mirrored_;
  vtkNew<vtkRenderer> renderer_;
};

void add_workpiece(Stage& stage,
                   vtkUnstructuredGrid& grid,
                   const ColouredBy& colours,
                   vtkScalarsToColors& map,
                   bool planar,
                   double size,
                   std::optional<int> n_flow_lines) {
  const vtkNew<vtkUnstructuredGridGeometryFilter> faces;
  faces->SetInputData(&grid);
  faces->Update();
  const vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(faces->GetOutputPort());
  surface->SetNonlinearSubdivisionLevel(3);
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(surface->GetOutputPort());
  normals->SetFeatureAngle(30.0);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(planar ? surface->GetOutputPort() : normals->GetOutputPort());
  if (colours.at_points)
    mapper->SetScalarModeToUsePointFieldData();
  else
    mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(colours.array.c_str());
  mapper->SetLookupTable(&map);
  if (colours.component >= 0) {
    map.SetVectorModeToComponent();
    map.SetVectorComponent(colours.component);
  } else {
    map.SetVectorModeToMagnitude();
  }
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  const vtkNew<vtkProperty> property;
  property->SetAmbient(0.35);
  property->SetDiffuse(0.65);
  stage.add(*mapper, *property, 0.0);
  if (!n_flow_lines) {
    stage.add_lines(*element_edges(*faces->GetOutput()), 1.0F, 0.15, 1e-3 * size);
    return;
  }
  surface->Update();
  const vtkSmartPointer<vtkPolyData> lines = flow_lines(*surface->GetOutput(), *n_flow_lines);
  if (lines == nullptr)
    throw Error(Fault::usage, "--flow-lines", "the results have no \"displacement\"");
  stage.add_lines(*lines, 1.5F, 0.0, 1e-3 * size);
}

void add_tool(Stage& stage, vtkPolyData& tool, double size) {
  if (tool.GetNumberOfLines() > 0)
    stage.add_lines(tool, 3.5F, 0.1, 2e-3 * size);
  if (tool.GetNumberOfPolys() == 0)
    return;
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&tool);
  mapper->ScalarVisibilityOff();
  const vtkNew<vtkProperty> property;
  property->SetColor(0.55, 0.60, 0.68);
  property->SetOpacity(0.15);
  stage.add(*mapper, *property, 0.0);
  const vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(&tool);
  const vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(joined->GetOutputPort());
  // Cells of wear meet with hanging corners: their rims are no edges of the tool.
  edges->SetBoundaryEdges(tool.GetCellData()->HasArray("wear_depth") == 0);
  edges->SetFeatureAngle(30.0);
  edges->ColoringOff();
  edges->Update();
  stage.add_lines(*edges->GetOutput(), 1.5F, 0.3, 0.0);
}

void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, int font) {
  const vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetColor(0.0, 0.0, 0.0);
  actor->GetTextProperty()->SetFontSize(font);
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  renderer.AddActor2D(actor);
}

/// The title of the colour bar.
std::string title(const ColouredBy& colours) {
  return colours.name + (colours.unit.empty() ? "" : "\n[" + colours.unit + "]");
}

/// `width` is that of the part of the picture it has [pixels].
void add_colour_bar(vtkRenderer& renderer,
                    vtkScalarsToColors& map,
                    const ColouredBy& colours,
                    double width) {
  const vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(&map);
  bar->SetTitle(title(colours).c_str());
  // A letter is a little more than half as wide as the font is high.
  const double letters = static_cast<double>(std::max<std::size_t>(colours.name.size() + 2, 10));
  const int font = std::clamp(static_cast<int>(width / (0.6 * letters)), 8, 18);
  bar->SetNumberOfLabels(6);
  bar->SetVerticalTitleSeparation(font);
  bar->SetLabelFormat("%-#.4g");
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(0.0, 0.0, 0.0);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
    text->SetFontSize(font);
  }
  bar->SetPosition(0.1, 0.15);
  bar->SetWidth(0.7);
  bar->SetHeight(0.65);
  renderer.AddActor2D(bar);
  add_text(renderer,
           fmt::format("colours: {}\nlargest {:.4g}\nsmallest {:.4g}", colours.span(),
                       colours.all[1], colours.all[0]),
           0.1, 0.03, std::max(8, font - 4));
}

/// Looks at the workpiece: flat in the plane, along a diagonal in space.
void aim(vtkRenderer& renderer,
         std::array<double, 6> bounds,
         bool planar,
         bool mirrored,
         double aspect) {
  if (mirrored)
    bounds[0] = std::min(bounds[0], -bounds[1]);
  const std::array<double, 3> half{0.5 * (bounds[1] - bounds[0]), 0.5 * (bounds[3] - bounds[2]),
                                   0.5 * (bounds[5] - bounds[4])};
  const std::array<double, 3> centre{bounds[0] + half[0], bounds[2] + half[1], bounds[4] + half[2]};
  const double reach = std::hypot(half[0], half[1], half[2]);
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->ParallelProjectionOn();
  const double scale = planar ? 1.25 * std::max(half[1], half[0] / aspect)
                              : 1.15 * reach * std::max(1.0, 1.0 / aspect);
  camera->SetFocalPoint(centre.data());
  const std::array<double, 3> from =
      planar ? std::array{0.0, 0.0, 1.0} : std::array{1.0, -1.3, 0.8};
  camera->SetPosition(centre[0] + 4.0 * reach * from[0], centre[1] + 4.0 * reach * from[1],
                      centre[2] + 4.0 * reach * from[2]);
  camera->SetViewUp(0.0, planar ? 1.0 : 0.0, planar ? 0.0 : 1.0);
  camera->SetParallelScale(scale);
  renderer.ResetCameraClippingRange();
}

} // namespace

std::string draw_scene(const Options& options, const std::filesystem::path& picture) {
  const Frame frame = read_frame(options);
  std::array<double, 6> bounds{};
  frame.workpiece->GetBounds(bounds.data());
  const double size =
      std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  const bool planar = bounds[5] - bounds[4] <= 1e-9 * size;
  const bool axisymmetric = text_in(*frame.workpiece, "analysis") == "axisymmetric";
  const bool mirrored = options.mirror.value_or(axisymmetric);
  const ColouredBy colours = coloured_by(*frame.workpiece, options);
  const vtkNew<vtkColorTransferFunction> map = colour_map(colours.range);

  if (options.flow_lines && !planar)
    throw Error(Fault::usage, "--flow-lines", "only scenes of the plane have them");
  Stage stage(planar, mirrored);
  add_workpiece(stage, *frame.workpiece, colours, *map, planar, size, options.flow_lines);
  for (const auto& [name, tool] : frame.tools)
    add_tool(stage, *tool, size);
  // The colour bar has its own part of the picture, so that no tool runs through it.
  constexpr double divide = 0.85;
  stage.renderer().SetViewport(0.0, 0.0, divide, 1.0);
  const vtkNew<vtkRenderer> margin;
  margin->SetViewport(divide, 0.0, 1.0, 1.0);
  margin->SetBackground(1.0, 1.0, 1.0);
  add_colour_bar(*margin, *map, colours, (1.0 - divide) * options.size[0]);
  add_text(stage.renderer(), options.title.empty() ? frame.title : options.title, 0.03, 0.945, 22);
  add_text(stage.renderer(), fmt::format("t = {:.6g} s", frame.time), 0.03, 0.03, 18);

  const vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(options.size[0], options.size[1]);
  window->AddRenderer(&stage.renderer());
  window->AddRenderer(margin);
  aim(stage.renderer(), bounds, planar, mirrored, divide * options.size[0] / options.size[1]);
  write_picture(*window, picture);
  const std::string unit = colours.unit.empty() ? "" : " " + colours.unit;
  return fmt::format("colours: {} from {:.6g} to {:.6g}{}, {}; all values {:.6g} to {:.6g}{}",
                     colours.name, colours.range[0], colours.range[1], unit, colours.span(),
                     colours.all[0], colours.all[1], unit);
}

} // namespace billet::render
