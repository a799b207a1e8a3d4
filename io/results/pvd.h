// The list of frames ParaView opens: DIR/<case>.pvd.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {

/// One file of one part at one time.
struct PvdEntry {
  double time;                ///< [s]
  std::string part;           ///< "workpiece", the name of a tool, ...
  std::filesystem::path file; ///< relative to the folder of the .pvd

  template <class Archive> void fields(Archive& archive) {
    std::string name = file.string();
    archive(time, part, name);
    file = name;
  }
};

/// A text as the value of an attribute of an XML file.
[[nodiscard]] std::string xml_encoded(const std::string& text);

/// Rewrites the list, all at once; parts are numbered in the order of their first appearance.
/// @throws Error  (Fault::input_output)
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

/// Reads a list that `write_pvd` wrote (to go on with it after a checkpoint).
/// @throws Error  (Fault::input_output) if it cannot be read
[[nodiscard]] std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

} // namespace billet::io
