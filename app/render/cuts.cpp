#include "app/render/cuts.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkCutter.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace billet::render {

namespace {

constexpr const char* element_numbers = "number of the element";

vtkNew<vtkPlane> plane_of(const HalfSpace& space) {
  vtkNew<vtkPlane> plane;
  plane->SetNormal(space.normal.data());
  const Vec3 origin = space.at * space.normal;
  plane->SetOrigin(origin.data());
  return plane;
}

HalfSpace behind(const HalfSpace& space) { return {-space.normal, -space.at}; }

/// Edges of polygons that lie between two elements, or at a rim.
vtkSmartPointer<vtkPolyData> element_lines(vtkPolyData& faces) {
  struct Edge {
    vtkIdType element = -1;
    bool inside = false; ///< the element lies on both sides of it
  };
  std::map<std::pair<vtkIdType, vtkIdType>, Edge> edges;
  vtkDataArray* const elements = faces.GetCellData()->GetArray(element_numbers);
  for (vtkIdType i = 0; i < faces.GetNumberOfCells(); ++i) {
    const vtkNew<vtkIdList> points;
    faces.GetCellPoints(i, points);
    const auto element = static_cast<vtkIdType>(elements->GetTuple1(i));
    for (vtkIdType k = 0, n = points->GetNumberOfIds(); n > 2 && k < n; ++k) {
      const vtkIdType a = points->GetId(k), b = points->GetId((k + 1) % n);
      const auto [found, is_new] = edges.try_emplace(std::minmax(a, b), Edge{element, false});
      found->second.inside = !is_new && found->second.element == element;
    }
  }
  const vtkNew<vtkCellArray> lines;
  for (const auto& [ends, edge] : edges)
    if (!edge.inside) {
      const std::array<vtkIdType, 2> line{ends.first, ends.second};
      lines->InsertNextCell(2, line.data());
    }
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(faces.GetPoints());
  result->SetLines(lines);
  return result;
}

/// The faces that one plane lays open where the cut has others as well.
vtkSmartPointer<vtkPolyData>
faces_of(vtkSmartPointer<vtkPolyData> section, const Removed& cut, std::size_t plane) {
  for (std::size_t other = 0; other < cut.size(); ++other)
    if (other != plane)
      section = part_in(*section, cut[other]);
  return section;
}

} // namespace

std::vector<Removed> removed_by(const std::vector<Cut>& cuts, const Vec3& towards) {
  constexpr double across = 1e-6;
  std::vector<Removed> result;
  for (const Cut& cut : cuts) {
    Removed& removed = result.emplace_back();
    for (const CutPlane& plane : cut) {
      const bool viewer_below = towards[plane.plane.axis] < -across;
      const double sign = plane.keep != 0 ? -plane.keep : viewer_below ? -1.0 : 1.0;
      removed.push_back({sign * Vec3::Unit(plane.plane.axis), sign * plane.plane.at});
    }
  }
  return result;
}

std::vector<Removed> before(const std::vector<Removed>& removed, const Copy& copy) {
  std::vector<Removed> result = removed;
  for (Removed& cut : result)
    for (HalfSpace& space : cut)
      space = space.before(copy);
  return result;
}

vtkSmartPointer<vtkPolyData> part_in(vtkPolyData& data, const HalfSpace& space) {
  const vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(&data);
  clip->SetClipFunction(plane_of(space));
  clip->Update();
  return clip->GetOutput();
}

vtkSmartPointer<vtkPolyData> without(vtkSmartPointer<vtkPolyData> data,
                                     const std::vector<Removed>& removed) {
  for (const Removed& cut : removed) {
    std::vector<vtkSmartPointer<vtkPolyData>> kept;
    vtkSmartPointer<vtkPolyData> rest = data;
    for (const HalfSpace& space : cut) {
      kept.push_back(part_in(*rest, behind(space)));
      rest = part_in(*rest, space);
    }
    data = joined(kept);
  }
  return data;
}

CutFaces cut_faces(vtkUnstructuredGrid& solid, const std::vector<Removed>& removed) {
  const vtkNew<vtkUnstructuredGrid> numbered;
  numbered->ShallowCopy(&solid);
  const vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName(element_numbers);
  for (vtkIdType i = 0; i < solid.GetNumberOfCells(); ++i)
    numbers->InsertNextValue(i);
  if (numbered->GetCellData()->GetArray(element_numbers) == nullptr)
    numbered->GetCellData()->AddArray(numbers);
  std::vector<vtkSmartPointer<vtkPolyData>> faces, lines;
  for (std::size_t c = 0; c < removed.size(); ++c) {
    std::vector<Removed> others = removed;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(c));
    for (std::size_t p = 0; p < removed[c].size(); ++p) {
      const vtkNew<vtkCutter> cutter;
      cutter->SetInputData(numbered);
      cutter->SetCutFunction(plane_of(removed[c][p]));
      cutter->GenerateTrianglesOff();
      cutter->Update();
      vtkPolyData* const section = cutter->GetOutput();
      if (section->GetNumberOfCells() == 0)
        continue;
      faces.push_back(without(faces_of(section, removed[c], p), others));
      lines.push_back(without(faces_of(element_lines(*section), removed[c], p), others));
    }
  }
  return {joined(faces), joined(lines)};
}

} // namespace billet::render
