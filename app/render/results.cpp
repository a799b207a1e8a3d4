#include "app/render/results.h"

#include "app/render/load_stroke.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& message) {
  throw Error(Fault::input_output, path.string(), message,
              "give the folder a run wrote its results to, or a .pvd or .vtu file");
}

/// The .pvd of a folder of results.
std::filesystem::path list_in(const std::filesystem::path& folder) {
  std::filesystem::path found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".pvd") {
      if (!found.empty())
        fail(folder, "the folder has more than one .pvd");
      found = entry.path();
    }
  if (found.empty())
    fail(folder, "the folder has no .pvd");
  return found;
}

template <class Reader> auto read_file(const std::filesystem::path& path, bool may_be_empty) {
  if (!std::filesystem::is_regular_file(path))
    fail(path, "the file does not exist");
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0 ||
      (reader->GetOutput()->GetNumberOfPoints() == 0 && !may_be_empty))
    fail(path, "the file cannot be read or is empty");
  return vtkSmartPointer(reader->GetOutput());
}

} // namespace

std::string text_in(vtkDataObject& data, const std::string& name) {
  vtkFieldData* fields = data.GetFieldData();
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i) {
    const char* array = fields->GetArrayName(i);
    const std::string text = array == nullptr ? "" : array;
    if (text.starts_with(name + ": "))
      return text.substr(name.size() + 2);
  }
  return {};
}

Results::Results(const std::filesystem::path& path) : path_(path) {
  if (!std::filesystem::exists(path_))
    fail(path_, "there are no such results");
  if (std::filesystem::is_directory(path_))
    path_ = list_in(path_);
  if (path_.extension() == ".vtu") {
    const auto grid = read_file<vtkXMLUnstructuredGridReader>(path_, false);
    vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue");
    times_ = {time == nullptr ? 0.0 : time->GetTuple1(0)};
    kept_.push_back({grid, nullptr, {}, times_[0]});
    return;
  }
  entries_ = io::read_pvd(path_);
  for (const io::PvdEntry& entry : entries_)
    if (entry.file.extension() == ".vtu")
      times_.push_back(entry.time);
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  if (times_.empty())
    fail(path_, "the list of frames is empty");
  strokes_ = longest_way(path_.parent_path());
}

double Results::nearest(const AskedTime& time) const {
  if (!time)
    return times_.back();
  return *std::min_element(times_.begin(), times_.end(), [&](double a, double b) {
    return std::abs(a - *time) < std::abs(b - *time);
  });
}

const Frame& Results::frame(double time) const {
  for (const Frame& frame : kept_)
    if (frame.time == time)
      return frame;
  constexpr std::size_t most = 6;
  if (kept_.size() == most)
    kept_.pop_front();
  kept_.push_back(read(time));
  return kept_.back();
}

Frame Results::read(double time) const {
  Frame frame;
  frame.time = time;
  for (const io::PvdEntry& entry : entries_) {
    if (entry.time != time)
      continue;
    const std::filesystem::path file = path_.parent_path() / entry.file;
    if (file.extension() == ".vtu")
      frame.workpiece = read_file<vtkXMLUnstructuredGridReader>(file, false);
    else if (entry.part == "contact")
      frame.contact = read_file<vtkXMLPolyDataReader>(file, true);
    else
      frame.tools[entry.part] = read_file<vtkXMLPolyDataReader>(file, true);
  }
  return frame;
}

std::string Results::title() const {
  const std::string title = text_in(*frame(times_.back()).workpiece, "title");
  return title.empty() ? name() : title;
}

std::string Results::name() const {
  if (entries_.empty())
    return path_.stem().string();
  const std::string folder =
      std::filesystem::absolute(path_).lexically_normal().parent_path().filename().string();
  return folder.empty() ? path_.stem().string() : folder;
}

std::optional<double> Results::stroke(double time) const {
  if (strokes_.size() < 2 || strokes_.back().second == 0.0)
    return std::nullopt;
  const auto after = std::lower_bound(
      strokes_.begin(), strokes_.end(), time,
      [](const std::pair<double, double>& row, double value) { return row.first < value; });
  if (after == strokes_.begin())
    return after->second;
  if (after == strokes_.end())
    return strokes_.back().second;
  const auto& [t0, way0] = *(after - 1);
  const auto& [t1, way1] = *after;
  return t1 > t0 ? way0 + (time - t0) / (t1 - t0) * (way1 - way0) : way1;
}

} // namespace billet::render
