// What a billet::Case holds: the text as it was read, what has been changed since, what both say.
//
// Not installed: run.cpp reads the content.

#pragma once

#include "io/case/case.h"
#include "io/case/document.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "billet/case.h"

namespace billet {

/// Something that was changed: "key=value", or a key that was removed.
struct Change {
  std::string text;
  std::vector<std::string> path; ///< parts of the key
  bool erases = false;
};

struct Case::Inside {
  std::string text; ///< of the case file
  std::string name;
  std::filesystem::path folder;
  bool allow_outside = false;
  std::vector<Change> changes = {};
  io::Case content = {}; ///< that text and changes say

  /// Text and changes as a tree; complaints are about changes.
  [[nodiscard]] io::Node tree(io::Complaints& complaints) const;
  /// Reads text and changes.
  /// @throws Error
  [[nodiscard]] io::Case read() const;
  /// Takes changes over, unless they make a case that cannot be read.
  /// @throws Error
  void change(std::vector<Change> additional);
  /// As a case file.
  [[nodiscard]] std::string current_text() const;
};

} // namespace billet
