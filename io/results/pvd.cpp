#include "io/results/pvd.h"

#include "geometry/base/error.h"
#include "geometry/base/index.h"
#include "io/mesh/vtu_content.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

namespace billet::io {

namespace {

PvdEntry entry_of(vtkXMLDataElement& element, const std::string& place) {
  const auto text = [&](const char* name) {
    const char* const value = element.GetAttribute(name);
    return std::string(value == nullptr ? "" : value);
  };
  PvdEntry entry{.time = 0.0, .part = text("name"), .file = text("file")};
  const std::string time = text("timestep");
  const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), entry.time);
  if (error != std::errc() || end != time.data() + time.size() || entry.file.empty())
    throw Error(Fault::input_output, place, "an entry has no time or no file",
                "the list was not written by this program", error_code::results_unreadable);
  return entry;
}

} // namespace

std::string xml_encoded(const std::string& text) {
  constexpr int special_entities = 1;
  std::ostringstream result;
  vtkXMLUtilities::EncodeString(text.c_str(), VTK_ENCODING_UTF_8, result, VTK_ENCODING_UTF_8,
                                special_entities);
  return result.str();
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  std::map<std::string, std::size_t> parts;
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                     "  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    const std::size_t part = parts.try_emplace(entry.part, parts.size()).first->second;
    text += fmt::format(
        "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
        entry.time, part, xml_encoded(entry.part), xml_encoded(entry.file.generic_string()));
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
  const CapturedMessages messages;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromStream(stream));
  vtkXMLDataElement* const collection =
      root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr)
    throw Error(Fault::input_output, path.string(), "is not a list of frames",
                "the list was not written by this program", error_code::results_unreadable);
  std::vector<PvdEntry> entries;
  entries.reserve(idx(collection->GetNumberOfNestedElements()));
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i)
    entries.push_back(entry_of(*collection->GetNestedElement(i), path.string()));
  return entries;
}

} // namespace billet::io
