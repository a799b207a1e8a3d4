#include "io/results/earlier_results.h"

#include "geometry/base/error.h"
#include "io/results/checkpoint.h"
#include "io/results/pvd.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace billet::io {

namespace {

/// A file such as workpiece_0012.vtu, as write_frame calls them.
bool is_frame(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t number = name.find_last_of('_');
  const std::size_t dot = name.find_last_of('.');
  if (number == std::string::npos || dot == std::string::npos || dot < number + 2)
    return false;
  const std::string_view part = std::string_view(name).substr(0, number);
  const std::string_view digits = std::string_view(name).substr(number + 1, dot - number - 1);
  const std::string_view suffix = std::string_view(name).substr(dot);
  return (part == "workpiece" || part == "contact" || part.starts_with("tool-")) &&
         digits.find_first_not_of("0123456789") == std::string_view::npos &&
         (suffix == ".vtu" || suffix == ".vtp");
}

/// Whether a list for ParaView is of frames of this folder alone, as a run writes it.
bool lists_own_frames(const std::filesystem::path& pvd) {
  std::vector<PvdEntry> entries;
  try {
    entries = read_pvd(pvd);
  } catch (const Error&) {
    return false; // somebody else's
  }
  return !entries.empty() && std::all_of(entries.begin(), entries.end(), [](const PvdEntry& entry) {
    return *entry.file.begin() == "frames" && is_frame(entry.file);
  });
}

/// As earlier runs of this folder, maybe of cases of other names, have left them.
std::vector<std::filesystem::path> lists_of_frames(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> lists;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".pvd" && lists_own_frames(entry.path()))
      lists.push_back(entry.path());
  return lists;
}

/// Number of a frame by the name of its file.
int frame_number(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  return std::stoi(stem.substr(stem.find_last_of('_') + 1));
}

} // namespace

void remove_partial_files(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> partial;
  for (const fs::path& each : {folder, folder / "frames", folder / "checkpoints"})
    for (const auto& entry : fs::directory_iterator(each, error))
      if (entry.path().extension() == ".partial" &&
          entry.path().filename().string().starts_with('.'))
        partial.push_back(entry.path());
  for (const fs::path& file : partial)
    fs::remove(file, error);
}

void remove_later(const std::filesystem::path& folder, int first_frame, const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (const fs::path& file : {folder / "summary.json", folder / "failure" / "last_good.vtu",
                               folder / "failure" / "post_mortem.txt"})
    fs::remove(file, error);
  fs::remove(folder / "failure", error);
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    if (is_frame(entry.path()) && frame_number(entry.path()) >= first_frame)
      later.push_back(entry.path());
  for (const fs::path& list : lists_of_frames(folder))
    if (list.filename() != name + ".pvd")
      later.push_back(list);
  for (const fs::path& file : later)
    fs::remove(file, error);
}

void remove_earlier_run(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> old{folder / "summary.json",
                            folder / "run.log",
                            folder / "remesh.csv",
                            folder / "starts.json",
                            folder / "failure" / "last_good.vtu",
                            folder / "failure" / "post_mortem.txt"};
  for (const fs::path& list : lists_of_frames(folder))
    old.push_back(list);
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    if (is_frame(entry.path()))
      old.push_back(entry.path());
  for (const fs::path& file : checkpoints_of(folder))
    old.push_back(file);
  std::error_code error;
  for (const fs::path& file : old)
    if (!fs::remove(file, error) && error && error != std::errc::no_such_file_or_directory)
      throw Error(Fault::input_output, file.string(),
                  "of an earlier run, cannot be removed: " + error.message(),
                  "choose another folder with -o");
  fs::remove(folder / "failure", error); // stays if it holds anything of the user's
}

} // namespace billet::io
