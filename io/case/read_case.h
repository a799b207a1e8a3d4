// Reads a case file: TOML text and the user's overrides to a validated Case, and back to text.
//
// Everything that is wrong with a file is found and reported together, with its line and column.
// What is read: docs/guide/case-file.md.

#pragma once

#include "io/case/case.h"
#include "io/case/shape.h"

#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {

class Complaints;
struct Node;

struct ReadOptions {
  bool allow_outside = false; ///< files outside the case's folder may be named
};

/// Reads and validates a case file.
///
/// @param overrides  "key=value": a dotted key and a TOML value, or text that stands for a string;
///                   a tool or a stage is named by its name, another list item by its index
/// @throws Error with Fault::case_file and all complaints
[[nodiscard]] Case read_case(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {},
                             const ReadOptions& options = {});

/// The same for a text in memory.
///
/// @param name       what places in messages begin with
/// @param directory  what paths in the text are relative to
[[nodiscard]] Case read_case_text(const std::string& text,
                                  const std::string& name,
                                  const std::filesystem::path& directory,
                                  const std::vector<std::string>& overrides = {},
                                  const ReadOptions& options = {});

/// The same for a tree of that text, with its complaints so far.
[[nodiscard]] Case read_case_tree(const Node& tree,
                                  Complaints& complaints,
                                  const std::filesystem::path& directory,
                                  const ReadOptions& options = {});

/// The text of a case file.
/// @throws Error with Fault::case_file if there is none that could be read
[[nodiscard]] std::string case_file_text(const std::filesystem::path& file);

/// What may stand in a case file: the reader's own answer. What depends on the analysis, such as
/// the number of entries of a vector, is there for all of them.
[[nodiscard]] Shape case_shape();

/// The case as a case file with every default filled in: reading it gives the same case.
[[nodiscard]] std::string resolved_toml(const Case& content);

} // namespace billet::io
