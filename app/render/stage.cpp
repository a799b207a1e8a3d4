#include "app/render/stage.h"

#include "app/render/picture.h"
#include "app/render/shown.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

namespace billet::render {

namespace {

constexpr auto samples = static_cast<float>(samples_a_side);

} // namespace

Stage::Stage(bool flat) : flat_(flat) {
  behind_->SetBackground(1.0, 1.0, 1.0);
  behind_->SetLayer(0);
  before_->SetLayer(1);
}

void Stage::enter(vtkRenderWindow& window, const std::array<double, 4>& place) {
  for (vtkRenderer* layer : {behind_.Get(), before_.Get()}) {
    layer->SetViewport(place[0], place[1], place[2], place[3]);
    layer->InteractiveOff();
    window.AddRenderer(layer);
  }
}

void Stage::look(const Aim& aim, const Sight& sight) {
  for (vtkRenderer* layer : {behind_.Get(), before_.Get()})
    place_camera(*layer->GetActiveCamera(), aim, sight);
}

void Stage::add(vtkRenderer& layer, vtkPolyDataMapper& mapper, vtkProperty& property, double lift) {
  if (flat_)
    property.LightingOff();
  const vtkNew<vtkActor> actor;
  actor->SetMapper(&mapper);
  actor->SetProperty(&property);
  actor->SetPosition(0.0, 0.0, flat_ ? lift : 0.0);
  layer.AddActor(actor);
}

void Stage::add_coloured(vtkPolyData& data, vtkLookupTable& map, float line_width, double lift) {
  const bool at_points = data.GetPointData()->HasArray(Shown::values) != 0;
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&data);
  if (at_points)
    mapper->SetScalarModeToUsePointFieldData();
  else
    mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(Shown::values);
  mapper->SetLookupTable(&map);
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetInterpolateScalarsBeforeMapping(at_points);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  const vtkNew<vtkProperty> property;
  property->SetAmbient(0.55);
  property->SetDiffuse(0.5);
  property->SetLineWidth(samples * line_width);
  if (data.GetNumberOfPolys() == 0)
    property->LightingOff();
  add(*before_, *mapper, *property, lift);
}

void Stage::add_plain(vtkPolyData& faces, const std::array<double, 3>& colour, bool hides) {
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&faces);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  if (hides)
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-8.0, -64.0);
  const vtkNew<vtkProperty> property;
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetAmbient(0.4);
  property->SetDiffuse(0.6);
  add(*before_, *mapper, *property, 0.0);
}

void Stage::add_glass(vtkPolyData& faces) {
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&faces);
  mapper->ScalarVisibilityOff();
  const vtkNew<vtkProperty> property;
  property->SetColor(0.50, 0.58, 0.70);
  property->SetOpacity(0.2);
  add(*behind_, *mapper, *property, 0.0);
}

void Stage::add_lines(vtkPolyData& lines, const Pen& pen) {
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&lines);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-2.0 * pen.ahead, -8.0 * pen.ahead);
  const vtkNew<vtkProperty> property;
  property->SetColor(pen.colour[0], pen.colour[1], pen.colour[2]);
  property->SetLineWidth(samples * pen.width);
  property->SetOpacity(pen.opacity);
  property->LightingOff();
  add(*before_, *mapper, *property, pen.lift);
}

} // namespace billet::render
