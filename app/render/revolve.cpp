#include "app/render/revolve.h"

#include "app/render/copies.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace billet::render {

namespace {

constexpr double degrees_a_step = 5.0;

/// Angles at which the section stands. The last one of a closed body is the first.
struct Turn {
  int n_steps;
  double step; ///< [rad]
  bool closed;

  explicit Turn(double angle)
      : n_steps(std::max(2, static_cast<int>(std::ceil(angle / degrees_a_step)))),
        step(angle / n_steps * std::numbers::pi / 180.0), closed(angle >= 360.0) {}
  [[nodiscard]] int n_rings() const { return closed ? n_steps : n_steps + 1; }
  [[nodiscard]] int ring(int i) const { return closed && i == n_steps ? 0 : i; }
};

std::array<double, 3> turned(const std::array<double, 3>& x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * x[0] + s * x[2], x[1], -s * x[0] + c * x[2]};
}

/// Straight triangles and quadrilaterals, of points of the grid and middles of its cells.
struct Section {
  std::vector<std::vector<vtkIdType>> faces;
  std::vector<vtkIdType> cells;   ///< of the faces
  std::vector<vtkIdType> middles; ///< cells in whose middle there is a point, behind all others
};

Section section_of(vtkUnstructuredGrid& grid) {
  Section section;
  const vtkIdType n_points = grid.GetNumberOfPoints();
  const auto add = [&](vtkIdType cell, std::vector<vtkIdType> face) {
    section.faces.push_back(std::move(face));
    section.cells.push_back(cell);
  };
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
    const vtkNew<vtkIdList> ids;
    grid.GetCellPoints(i, ids);
    const vtkIdType* const p = ids->GetPointer(0);
    if (grid.GetCellType(i) == VTK_QUADRATIC_QUAD) {
      const vtkIdType middle = n_points + static_cast<vtkIdType>(section.middles.size());
      section.middles.push_back(i);
      for (int k = 0; k < 4; ++k)
        add(i, {p[k], p[4 + k], middle, p[4 + (k + 3) % 4]});
    } else if (grid.GetCellType(i) == VTK_QUADRATIC_TRIANGLE) {
      for (int k = 0; k < 3; ++k)
        add(i, {p[k], p[3 + k], p[3 + (k + 2) % 3]});
      add(i, {p[3], p[4], p[5]});
    } else {
      add(i, std::vector<vtkIdType>(p, p + ids->GetNumberOfIds()));
    }
  }
  return section;
}

/// The points of the section, those in the middle of cells by the shape functions there.
void points_of(vtkUnstructuredGrid& grid,
               const Section& section,
               std::vector<std::array<double, 3>>& places,
               vtkPointData& data) {
  const vtkIdType n = grid.GetNumberOfPoints();
  places.resize(static_cast<std::size_t>(n) + section.middles.size());
  data.InterpolateAllocate(grid.GetPointData());
  for (vtkIdType i = 0; i < n; ++i) {
    grid.GetPoint(i, places[static_cast<std::size_t>(i)].data());
    data.CopyData(grid.GetPointData(), i, i);
  }
  std::array<double, 8> weights{-0.25, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 0.5};
  for (std::size_t k = 0; k < section.middles.size(); ++k) {
    const vtkNew<vtkIdList> ids;
    grid.GetCellPoints(section.middles[k], ids);
    std::array<double, 3>& place = places[static_cast<std::size_t>(n) + k];
    place = {0.0, 0.0, 0.0};
    for (vtkIdType a = 0; a < 8; ++a)
      for (std::size_t d = 0; d < 3; ++d)
        place[d] += weights[static_cast<std::size_t>(a)] *
                    places[static_cast<std::size_t>(ids->GetId(a))][d];
    data.InterpolatePoint(grid.GetPointData(), n + static_cast<vtkIdType>(k), ids, weights.data());
  }
}

void turn_vectors(vtkPointData& data, vtkIdType n_section, const Turn& turn) {
  vtkDataArray* const vectors = data.GetVectors();
  for (vtkIdType i = 0; vectors != nullptr && i < vectors->GetNumberOfTuples(); ++i) {
    std::array<double, 3> v{};
    vectors->GetTuple(i, v.data());
    v = turned(v, turn.step * static_cast<double>(i / n_section));
    vectors->SetTuple(i, v.data());
  }
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> revolved(vtkUnstructuredGrid& grid, double angle) {
  const Turn turn(angle);
  const Section section = section_of(grid);
  std::vector<std::array<double, 3>> places;
  const vtkNew<vtkPointData> data;
  points_of(grid, section, places, *data);
  const auto n = static_cast<vtkIdType>(places.size());
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  auto body = vtkSmartPointer<vtkUnstructuredGrid>::New();
  body->GetPointData()->CopyAllocate(data, n * turn.n_rings());
  for (int ring = 0; ring < turn.n_rings(); ++ring)
    for (vtkIdType i = 0; i < n; ++i) {
      points->InsertNextPoint(turned(places[static_cast<std::size_t>(i)], ring * turn.step).data());
      body->GetPointData()->CopyData(data, i, ring * n + i);
    }
  body->SetPoints(points);
  body->GetCellData()->CopyAllocate(grid.GetCellData());
  for (int step = 0; step < turn.n_steps; ++step)
    for (std::size_t f = 0; f < section.faces.size(); ++f) {
      std::vector<vtkIdType> corners;
      for (const int ring : {turn.ring(step), turn.ring(step + 1)})
        for (const vtkIdType p : section.faces[f])
          corners.push_back(ring * n + p);
      const int type = corners.size() == 8 ? VTK_HEXAHEDRON : VTK_WEDGE;
      const vtkIdType cell =
          body->InsertNextCell(type, static_cast<vtkIdType>(corners.size()), corners.data());
      body->GetCellData()->CopyData(grid.GetCellData(), section.cells[f], cell);
    }
  turn_vectors(*body->GetPointData(), n, turn);
  body->SetFieldData(grid.GetFieldData());
  return body;
}

vtkSmartPointer<vtkPolyData> revolved_lines(vtkPolyData& lines, double angle) {
  const Turn turn(angle);
  const vtkIdType n = lines.GetNumberOfPoints();
  auto body = vtkSmartPointer<vtkPolyData>::New();
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  body->GetPointData()->CopyAllocate(lines.GetPointData(), n * turn.n_rings());
  for (int ring = 0; ring < turn.n_rings(); ++ring)
    for (vtkIdType i = 0; i < n; ++i) {
      std::array<double, 3> x{};
      lines.GetPoint(i, x.data());
      points->InsertNextPoint(turned(x, ring * turn.step).data());
      body->GetPointData()->CopyData(lines.GetPointData(), i, ring * n + i);
    }
  const vtkNew<vtkCellArray> faces;
  body->GetCellData()->CopyAllocate(lines.GetCellData());
  for (vtkIdType line = 0; line < lines.GetNumberOfCells(); ++line) {
    const vtkNew<vtkIdList> ids;
    lines.GetCellPoints(line, ids);
    for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k)
      for (int step = 0; step < turn.n_steps; ++step) {
        const vtkIdType first = turn.ring(step) * n, second = turn.ring(step + 1) * n;
        const std::array<vtkIdType, 4> face{first + ids->GetId(k), first + ids->GetId(k + 1),
                                            second + ids->GetId(k + 1), second + ids->GetId(k)};
        const vtkIdType cell = faces->InsertNextCell(4, face.data());
        body->GetCellData()->CopyData(lines.GetCellData(), line, cell);
      }
  }
  body->SetPoints(points);
  body->SetPolys(faces);
  return body;
}

vtkSmartPointer<vtkPolyData> at_both_ends(vtkPolyData& lines, double angle) {
  const Turn turn(angle);
  if (turn.closed)
    return vtkSmartPointer<vtkPolyData>::New();
  const double end = turn.n_steps * turn.step;
  Copy last;
  last.turn << std::cos(end), 0.0, std::sin(end), 0.0, 1.0, 0.0, -std::sin(end), 0.0, std::cos(end);
  return joined({copied(lines, Copy{}), copied(lines, last)});
}

} // namespace billet::render
