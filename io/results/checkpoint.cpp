#include "io/results/checkpoint.h"

#include "geometry/base/archive.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "io/case/document.h"
#include "io/results/atomic_file.h"
#include "io/results/checksum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>

namespace billet::io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view beginning = "billet checkpoint\n";
constexpr std::uint32_t layout = 11; ///< raised where the meaning of bytes changes
constexpr std::string_view ending = ".checkpoint";
constexpr std::size_t most_kept = 2;
constexpr std::array<std::string_view, 4> section_names{"about", "case", "run", "results"};

struct Section {
  std::uint64_t size = 0;
  std::uint32_t checksum = 0;

  template <class Archive> void fields(Archive& archive) { archive(size, checksum); }
};

struct Header {
  std::uint32_t format = 0;
  std::array<Section, section_names.size()> sections{};

  template <class Archive> void fields(Archive& archive) { archive(format, sections); }
};

fs::path checkpoint_folder(const fs::path& results) { return results / "checkpoints"; }

[[noreturn]] void unusable(const fs::path& file, const std::string& why) {
  throw Error(Fault::input_output, file.string(), why, "", error_code::no_checkpoint);
}

std::string bytes_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    unusable(file, "is no file of a checkpoint");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    unusable(file, "cannot be read");
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad())
    unusable(file, "cannot be read to its end");
  return bytes;
}

/// Size of a header with its checksum.
std::size_t size_of_header() { return archived(Header{}).size() + sizeof(std::uint32_t); }

Header read_header(const fs::path& file, std::string_view bytes) {
  if (!bytes.starts_with(beginning))
    unusable(file, "is not a checkpoint of billet, or its beginning is damaged");
  if (bytes.size() < beginning.size() + size_of_header())
    unusable(file, "is damaged: it ends within its header");
  const std::string_view content =
      bytes.substr(beginning.size(), size_of_header() - sizeof(std::uint32_t));
  Header header;
  std::uint32_t sum = 0;
  ArchiveReader(bytes.substr(beginning.size(), size_of_header()))(header, sum);
  if (sum != checksum(content))
    unusable(file, "is damaged: its header does not agree with its checksum");
  if (header.format != layout)
    unusable(file,
             fmt::format("has format {}, this version reads format {}", header.format, layout));
  return header;
}

using Changes = std::map<std::string, std::string>;

/// Every value of a table by its dotted key, of a list by number.
void flatten(const Node& node, const std::string& key, Changes& out) {
  if (const Table* const table = node.as<Table>()) {
    for (const Entry& entry : table->entries)
      flatten(entry.node, key.empty() ? entry.key : key + "." + entry.key, out);
  } else if (const List* const list = node.as<List>()) {
    for (std::size_t i = 0; i < list->size(); ++i)
      flatten((*list)[i], fmt::format("{}[{}]", key, i + 1), out);
  } else {
    out[key] = shown(node);
  }
}

/// The number of a stage in a key such as stage[3].end; 0: it is none of one.
std::size_t stage_in(const std::string& key) {
  constexpr std::string_view prefix = "stage[";
  return key.starts_with(prefix) ? std::stoul(key.substr(prefix.size())) : 0;
}

bool may_change(const std::string& key, std::size_t stage) {
  if (key == "title" || key == "time.end" || key == "solver.threads" ||
      key.starts_with("output.") || key.starts_with("stop."))
    return true;
  const std::size_t number = stage_in(key);
  return number > stage + 1 || (number == stage + 1 && key.ends_with("].end"));
}

} // namespace

std::string scene_fingerprint(const process::Scene& scene) {
  ArchiveWriter archive;
  archive(scene.part.mesh, scene.part.contact_faces);
  for (const process::Support& support : scene.part.supports)
    archive(support.nodes, support.component);
  const Box part = box_of(scene.part.mesh.points);
  for (const contact::Tool& tool : scene.tools) {
    const geometry::DisplayMesh drawn =
        tool.surface->display(part, scene.part.mesh.dimension() == 2);
    archive(drawn.points, drawn.lines, drawn.triangles);
  }
  return fmt::format("{:08x}", checksum(archive.bytes()));
}

void write_checkpoint(const fs::path& results, const Checkpoint& checkpoint) {
  const std::string about = archived(checkpoint);
  const std::array<std::string_view, section_names.size()> contents{
      about, checkpoint.content, checkpoint.run, checkpoint.results};
  Header header;
  header.format = layout;
  for (std::size_t i = 0; i < contents.size(); ++i)
    header.sections[i] = {contents[i].size(), checksum(contents[i])};
  std::string bytes(beginning);
  const std::string head = archived(header);
  bytes += head + archived(checksum(head));
  for (const std::string_view content : contents)
    bytes += content;
  make_folder(checkpoint_folder(results));
  write_file(checkpoint_folder(results) / fmt::format("{:08d}{}", checkpoint.increment, ending),
             bytes, Durable::yes);
  const std::vector<fs::path> all = checkpoints_of(results);
  std::error_code error; // one too many does no harm
  for (std::size_t i = most_kept; i < all.size(); ++i)
    fs::remove(all[i], error);
}

Checkpoint read_checkpoint(const fs::path& file) {
  const std::string bytes = bytes_of(file);
  const Header header = read_header(file, bytes);
  std::string_view left = std::string_view(bytes).substr(beginning.size() + size_of_header());
  std::array<std::string_view, section_names.size()> contents;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const Section& section = header.sections[i];
    if (section.size > left.size())
      unusable(file, fmt::format("is damaged: it ends within its section '{}'", section_names[i]));
    contents[i] = left.substr(0, section.size);
    left.remove_prefix(section.size);
    if (checksum(contents[i]) != section.checksum)
      unusable(file, fmt::format("is damaged: its section '{}' does not agree with its checksum",
                                 section_names[i]));
  }
  if (!left.empty())
    unusable(file, "is damaged: something follows its end");
  Checkpoint checkpoint;
  ArchiveReader about(contents[0]);
  about(checkpoint);
  checkpoint.content = contents[1];
  checkpoint.run = contents[2];
  checkpoint.results = contents[3];
  return checkpoint;
}

std::vector<fs::path> checkpoints_of(const fs::path& results) {
  constexpr std::size_t most_digits = 10; // no number of an increment has more
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(checkpoint_folder(results), error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ending &&
        name.find_first_not_of("0123456789") == name.size() - ending.size() &&
        name.size() - ending.size() <= most_digits)
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::stoull(a.stem().string()) > std::stoull(b.stem().string());
  });
  return files;
}

void remove_checkpoints_after(const fs::path& results, int increment) {
  std::error_code error;
  for (const fs::path& file : checkpoints_of(results))
    if (std::stoll(file.stem().string()) > increment)
      fs::remove(file, error);
}

FoundCheckpoint latest_checkpoint(const fs::path& results, std::optional<double> time) {
  std::vector<std::string> notes;
  constexpr double rounding = 1e-9;
  std::optional<double> earliest;
  for (const fs::path& file : checkpoints_of(results)) {
    try {
      Checkpoint checkpoint = read_checkpoint(file);
      if (!time || checkpoint.time <= *time * (1.0 + rounding))
        return {file, std::move(checkpoint), std::move(notes)};
      earliest = checkpoint.time;
    } catch (const Error& error) {
      notes.push_back(error.complaints().front().place + ": " + error.complaints().front().message);
    }
  }
  std::string why = fs::exists(results) ? "has no checkpoint to go on from"
                                        : "no such folder; there is nothing to go on from";
  if (earliest)
    why = fmt::format("has no checkpoint at time {:.6g} or before; the first is at {:.6g}", *time,
                      *earliest);
  for (const std::string& note : notes)
    why += "; " + note;
  throw Error(Fault::input_output, results.string(), why,
              "run it from the start, without --resume or --from", error_code::no_checkpoint);
}

std::vector<std::string>
changes_of_case(const std::string& before, const std::string& now, std::size_t stage) {
  Changes was, is;
  flatten(parse_document(before, "stored case"), "", was);
  flatten(parse_document(now, "case"), "", is);
  std::vector<std::string> lines;
  const auto value = [](const Changes& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("absent") : found->second;
  };
  Changes all = was;
  all.insert(is.begin(), is.end());
  for (const auto& [key, ignored] : all)
    if (value(was, key) != value(is, key) && !may_change(key, stage))
      lines.push_back(fmt::format("{} was {}, is {}", key, value(was, key), value(is, key)));
  return lines;
}

} // namespace billet::io
