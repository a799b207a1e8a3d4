#include "app/render/frame_files.h"

#include "geometry/base/error.h"
#include "io/results/pvd.h"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <system_error>

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

template <class Reader> auto read(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    fail(path, "the file does not exist");
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0 || reader->GetOutput()->GetNumberOfPoints() == 0)
    fail(path, "the file cannot be read or is empty");
  return vtkSmartPointer(reader->GetOutput());
}

/// The time in the list nearest to the one asked for; without one, the last.
double nearest(const std::vector<io::PvdEntry>& entries, const std::optional<double>& time) {
  double best = entries.back().time;
  for (const io::PvdEntry& entry : entries)
    if (time ? std::abs(entry.time - *time) < std::abs(best - *time) : entry.time > best)
      best = entry.time;
  return best;
}

Frame read_list(const std::filesystem::path& path, const std::optional<double>& time) {
  const std::vector<io::PvdEntry> entries = io::read_pvd(path);
  if (entries.empty())
    fail(path, "the list of frames is empty");
  Frame frame;
  frame.time = nearest(entries, time);
  for (const io::PvdEntry& entry : entries) {
    if (entry.time != frame.time)
      continue;
    const std::filesystem::path file = path.parent_path() / entry.file;
    if (file.extension() == ".vtu")
      frame.workpiece = read<vtkXMLUnstructuredGridReader>(file);
    else if (entry.part != "contact")
      frame.tools[entry.part] = read<vtkXMLPolyDataReader>(file);
  }
  if (frame.workpiece == nullptr)
    fail(path, fmt::format("there is no workpiece at time {}", frame.time));
  return frame;
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

Frame read_frame(const Options& options) {
  std::filesystem::path path = options.results;
  if (std::filesystem::is_directory(path))
    path = list_in(path);
  Frame frame;
  if (path.extension() == ".vtu") {
    frame.workpiece = read<vtkXMLUnstructuredGridReader>(path);
    vtkDataArray* time = frame.workpiece->GetFieldData()->GetArray("TimeValue");
    frame.time = time == nullptr ? 0.0 : time->GetTuple1(0);
  } else {
    frame = read_list(path, options.time);
  }
  frame.title = text_in(*frame.workpiece, "title");
  if (frame.title.empty())
    frame.title = path.stem().string();
  return frame;
}

} // namespace billet::render
