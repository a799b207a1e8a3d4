// Settings of one file that set the same key of the case: only the last of them would count.

#pragma once

#include "io/case/table_reader.h"

#include <filesystem>
#include <string>
#include <vector>

#include "study/study.h"

namespace billet::study {

/// Something that sets keys of the case.
struct Setter {
  std::string what;              ///< in messages, "axis 'm'"
  std::vector<std::string> keys; ///< dotted
};

/// Keys that levels set, each once.
[[nodiscard]] std::vector<std::string> keys_of(const std::vector<Level>& levels);

/// Complains of a setter whose key one after it sets again, or sets a table around it. A part of a
/// table that was set before may be set: a law, then its coefficient.
///
/// @param case_file  tells which items of lists are meant by name and by index; where it cannot be
///                   read, they are compared as they are written
/// @param setters    in the order in which they are applied
void refuse_overruled(const io::At& root,
                      const std::filesystem::path& case_file,
                      const std::vector<Setter>& setters);

} // namespace billet::study
