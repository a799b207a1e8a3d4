#include "app/render/copies.h"

#include "app/render/option_values.h"
#include "app/render/results.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkAppendPolyData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkReverseSense.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::render {

namespace {

/// The planes of symmetry that the results know: "x = 0, y = 2.5".
std::vector<AxisPlane> known_planes(vtkUnstructuredGrid& part) {
  std::vector<AxisPlane> planes;
  for (const std::string& text : split(text_in(part, "symmetry"), ',')) {
    const std::size_t name = text.find_first_of(axis_names), sign = text.find("= ");
    if (name != std::string::npos && sign != std::string::npos)
      planes.push_back({axis(text.substr(name, 1)), number(text.substr(sign + 2))});
  }
  const auto on_axis = [](const AxisPlane& plane) { return plane.axis == 0; };
  if (text_in(part, "analysis") == "axisymmetric" &&
      std::none_of(planes.begin(), planes.end(), on_axis))
    planes.push_back({0, 0.0});
  return planes;
}

std::string in_words(const AxisPlane& plane) {
  return fmt::format("{}={:g}", axis_names[static_cast<std::size_t>(plane.axis)], plane.at);
}

/// One plane of each axis. Two are the ends of a slice, which images would only prolong.
std::vector<AxisPlane> known_of(vtkUnstructuredGrid& part, const std::vector<int>& axes) {
  const std::vector<AxisPlane> known = known_planes(part);
  std::vector<AxisPlane> planes;
  for (int d = 0; d < 3; ++d) {
    std::vector<AxisPlane> across;
    std::copy_if(known.begin(), known.end(), std::back_inserter(across),
                 [&](const AxisPlane& plane) { return plane.axis == d; });
    const bool asked = std::find(axes.begin(), axes.end(), d) != axes.end();
    const char name = axis_names[static_cast<std::size_t>(d)];
    if (asked && across.empty())
      throw Error(Fault::usage, "--mirror",
                  fmt::format("the results know no plane of symmetry across {}", name),
                  fmt::format("say where it is: --mirror {}=0", name));
    if (asked || (axes.empty() && across.size() == 1))
      planes.push_back(across.front());
  }
  if (planes.empty())
    throw Error(Fault::usage, "--mirror", "the results know no plane of symmetry",
                "say where they are: --mirror x=0,y=2.5");
  return planes;
}

void require_one_side(const AxisPlane& plane, vtkUnstructuredGrid& part) {
  std::array<double, 6> box{};
  part.GetBounds(box.data());
  const auto d = 2 * static_cast<std::size_t>(plane.axis);
  const double slack = 0.01 * (box[d + 1] - box[d]);
  if (plane.at > box[d] + slack && plane.at < box[d + 1] - slack)
    throw Error(Fault::usage, "--mirror",
                fmt::format("the part lies on both sides of {}", in_words(plane)),
                fmt::format("it reaches from {:g} to {:g}", box[d], box[d + 1]));
}

Copy mirrored(const AxisPlane& plane) {
  Copy copy;
  copy.turn(plane.axis, plane.axis) = -1.0;
  copy.shift[plane.axis] = 2.0 * plane.at;
  return copy;
}

Copy after(const Copy& second, const Copy& first) {
  return {second.turn * first.turn, second.turn * first.shift + second.shift};
}

Copy turned(int axis, double angle) {
  Copy copy;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  copy.turn(u, u) = copy.turn(v, v) = std::cos(angle);
  copy.turn(v, u) = std::sin(angle);
  copy.turn(u, v) = -std::sin(angle);
  return copy;
}

} // namespace

std::vector<AxisPlane> mirror_planes(vtkUnstructuredGrid& part, const SceneOptions& options) {
  const bool axisymmetric = text_in(part, "analysis") == "axisymmetric";
  std::vector<AxisPlane> planes;
  switch (options.mirror.planes) {
  case Mirror::Planes::none:
    break;
  case Mirror::Planes::usual:
    if (axisymmetric && !options.revolve)
      planes.push_back({0, 0.0});
    break;
  case Mirror::Planes::known:
    planes = known_of(part, options.mirror.axes);
    break;
  case Mirror::Planes::given:
    planes = options.mirror.given;
    break;
  }
  if (options.revolve) // about x = 0: the body has both halves
    std::erase_if(planes, [](const AxisPlane& plane) { return plane.axis == 0; });
  for (const AxisPlane& plane : planes)
    require_one_side(plane, part);
  return planes;
}

std::vector<Copy> copies_of(const std::vector<AxisPlane>& planes, int n_turned, int axis) {
  std::vector<Copy> copies{Copy{}};
  for (const AxisPlane& plane : planes)
    for (std::size_t i = 0, n = copies.size(); i < n; ++i)
      copies.push_back(after(mirrored(plane), copies[i]));
  for (std::size_t i = 0, n = copies.size(); i < n; ++i)
    for (int k = 1; k < n_turned; ++k)
      copies.push_back(after(turned(axis, 2.0 * std::numbers::pi * k / n_turned), copies[i]));
  return copies;
}

std::vector<HalfSpace> sides_of(const std::vector<AxisPlane>& planes, vtkDataSet& part) {
  std::array<double, 6> box{};
  part.GetBounds(box.data());
  std::vector<HalfSpace> sides;
  for (const AxisPlane& plane : planes) {
    const auto d = 2 * static_cast<std::size_t>(plane.axis);
    const double sign = 0.5 * (box[d] + box[d + 1]) > plane.at ? 1.0 : -1.0;
    sides.push_back({sign * Vec3::Unit(plane.axis), sign * plane.at});
  }
  return sides;
}

vtkSmartPointer<vtkPolyData> copied(vtkPolyData& data, const Copy& copy) {
  const vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      matrix->SetElement(i, j, copy.turn(i, j));
    matrix->SetElement(i, 3, copy.shift[i]);
  }
  const vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  const vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(&data);
  filter->SetTransform(transform);
  filter->Update();
  if (copy.turn.determinant() > 0.0)
    return filter->GetOutput();
  // An image's faces are turned inside out: back again, as the light falls by that.
  const vtkNew<vtkReverseSense> turned_back;
  turned_back->SetInputConnection(filter->GetOutputPort());
  turned_back->ReverseCellsOn();
  turned_back->ReverseNormalsOff();
  turned_back->Update();
  return turned_back->GetOutput();
}

vtkSmartPointer<vtkPolyData> joined(const std::vector<vtkSmartPointer<vtkPolyData>>& parts) {
  const vtkNew<vtkAppendPolyData> all;
  for (const vtkSmartPointer<vtkPolyData>& part : parts)
    if (part != nullptr && part->GetNumberOfCells() > 0)
      all->AddInputData(part);
  if (all->GetNumberOfInputConnections(0) == 0)
    return vtkSmartPointer<vtkPolyData>::New();
  all->Update();
  return all->GetOutput();
}

} // namespace billet::render
