#include "io/results/pvd.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"
#include "io/results/xml_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

namespace billet::io {

namespace {

/// Value of an attribute of a line; empty if it is not there.
std::string attribute(const std::string& line, const std::string& name) {
  const std::string opening = " " + name + "=\"";
  const std::size_t at = line.find(opening);
  if (at == std::string::npos)
    return {};
  const std::size_t first = at + opening.size();
  return xml_unescaped(std::string_view(line).substr(first, line.find('"', first) - first));
}

} // namespace

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  std::map<std::string, std::size_t> parts;
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                     "  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    const std::size_t part = parts.try_emplace(entry.part, parts.size()).first->second;
    text += fmt::format(
        "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
        entry.time, part, xml_escaped(entry.part), xml_escaped(entry.file.generic_string()));
  }
  text += "  </Collection>\n</VTKFile>\n";
  write_file(path, text);
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream stream(path);
  if (!stream)
    throw Error(Fault::input_output, path.string(),
                fmt::format("cannot be read: {}", std::strerror(errno)));
  std::vector<PvdEntry> entries;
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.find("<DataSet ") == std::string::npos)
      continue;
    PvdEntry entry{.time = 0.0, .part = attribute(line, "name"), .file = attribute(line, "file")};
    const std::string time = attribute(line, "timestep");
    const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), entry.time);
    if (error != std::errc() || end != time.data() + time.size() || entry.file.empty())
      throw Error(Fault::input_output, fmt::format("{}:{}", path.string(), line_number),
                  "the entry has no time or no file", "the list was not written by this program");
    entries.push_back(std::move(entry));
  }
  return entries;
}

} // namespace billet::io
