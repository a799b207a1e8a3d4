// The last frames of two runs: every field, node by node where the meshes are the same.

#include "geometry/base/error.h"
#include "io/compare/compare_parts.h"
#include "io/mesh/vtu_content.h"
#include "io/results/pvd.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <map>
#include <optional>

namespace billet::io {

namespace {

struct LastFrame {
  double time;
  vtkSmartPointer<vtkUnstructuredGrid> grid;
};

std::filesystem::path list_of_frames(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".pvd")
      return entry.path();
  return {};
}

/// None: the folder has no frames.
std::optional<LastFrame> last_frame(const std::filesystem::path& folder) {
  const std::filesystem::path list = list_of_frames(folder);
  if (list.empty())
    return std::nullopt;
  std::optional<PvdEntry> last;
  for (PvdEntry& entry : read_pvd(list))
    if (entry.part == "workpiece")
      last = std::move(entry);
  if (!last)
    return std::nullopt;
  const std::filesystem::path file = folder / last->file;
  const CapturedMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!messages.first().empty() || reader->GetErrorCode() != 0)
    throw Error(Fault::input_output, file.string(),
                "the frame cannot be read: " + messages.first());
  return LastFrame{last->time, reader->GetOutput()};
}

/// The fields of points and cells by name, and whether they are of cells.
std::map<std::string, std::pair<vtkDataArray*, bool>> fields_of(const LastFrame& frame) {
  std::map<std::string, std::pair<vtkDataArray*, bool>> fields;
  const auto add = [&](vtkDataSetAttributes& data, bool of_cells) {
    for (int i = 0; i < data.GetNumberOfArrays(); ++i)
      if (vtkDataArray* const array = data.GetArray(i); array != nullptr && array->GetName())
        fields[array->GetName()] = {array, of_cells};
  };
  add(*frame.grid->GetPointData(), false);
  add(*frame.grid->GetCellData(), true);
  if (frame.grid->GetPoints() != nullptr)
    fields["position"] = {frame.grid->GetPoints()->GetData(), false};
  return fields;
}

Difference each_value(const std::string& name, vtkDataArray& a, vtkDataArray& b, bool of_cells) {
  LargestDifference largest;
  for (vtkIdType i = 0; i < a.GetNumberOfTuples(); ++i)
    for (int c = 0; c < a.GetNumberOfComponents(); ++c)
      largest.look_at(a.GetComponent(i, c), b.GetComponent(i, c),
                      fmt::format("{} {}", of_cells ? "element" : "node", i + 1));
  return largest.of("field " + name);
}

/// Smallest and largest value of each component.
Difference ranges(const std::string& name, vtkDataArray& a, vtkDataArray& b) {
  LargestDifference largest;
  for (int c = 0; c < a.GetNumberOfComponents(); ++c) {
    double of_a[2], of_b[2];
    a.GetRange(of_a, c);
    b.GetRange(of_b, c);
    largest.look_at(of_a[0], of_b[0], "smallest");
    largest.look_at(of_a[1], of_b[1], "largest");
  }
  return largest.of("field " + name);
}

bool same_mesh(const LastFrame& first, const LastFrame& second) {
  return first.grid->GetNumberOfPoints() == second.grid->GetNumberOfPoints() &&
         first.grid->GetNumberOfCells() == second.grid->GetNumberOfCells();
}

void note_meshes(const LastFrame& first, const LastFrame& second, Comparison& into) {
  if (!same_mesh(first, second))
    into.notes.push_back(fmt::format(
        "fields: the meshes have {} and {} nodes: only smallest and largest values are compared",
        first.grid->GetNumberOfPoints(), second.grid->GetNumberOfPoints()));
  if (first.time != second.time)
    into.notes.push_back(fmt::format("fields: the last frames are of t = {:.6g} and {:.6g}",
                                     first.time, second.time));
}

} // namespace

void compare_frames(const std::filesystem::path& first_folder,
                    const std::filesystem::path& second_folder,
                    Comparison& into) {
  const std::optional<LastFrame> first = last_frame(first_folder),
                                 second = last_frame(second_folder);
  if (!first || !second) {
    if (first.has_value() != second.has_value())
      into.quantities.push_back(
          text_difference("frames", first ? "there" : "absent", second ? "there" : "absent"));
    else
      into.notes.push_back("fields: neither has frames");
    return;
  }
  note_meshes(*first, *second, into);
  const auto of_first = fields_of(*first), of_second = fields_of(*second);
  auto all = of_first;
  all.insert(of_second.begin(), of_second.end());
  for (const auto& [name, ignored] : all) {
    const auto a = of_first.find(name), b = of_second.find(name);
    if (a == of_first.end() || b == of_second.end() ||
        a->second.first->GetNumberOfComponents() != b->second.first->GetNumberOfComponents()) {
      into.quantities.push_back(text_difference("field " + name,
                                                a == of_first.end() ? "absent" : "there",
                                                b == of_second.end() ? "absent" : "there"));
      continue;
    }
    into.quantities.push_back(
        same_mesh(*first, *second)
            ? each_value(name, *a->second.first, *b->second.first, a->second.second)
            : ranges(name, *a->second.first, *b->second.first));
  }
}

} // namespace billet::io
