// What a report needs of a case, from the text of case.resolved.toml.
//
// The text is read as this program writes it, key by key; meshes and dies that it names need not be
// there any more, and keys of other versions do no harm.

#pragma once

#include "io/case/case.h"

#include <optional>
#include <string>
#include <vector>

namespace billet::report {

struct CaseFacts {
  std::string title;
  io::UnitSystem units;
  std::optional<io::Analysis> analysis;
  std::optional<double> end; ///< of the run [s]
  bool tools_turn = false;
  std::vector<std::pair<std::string, std::string>> measures; ///< name and kind
};

[[nodiscard]] CaseFacts case_facts(const std::string& resolved);

/// Whether an axis of tables and pictures in space is meant; true where nothing is known.
[[nodiscard]] inline bool is_solid(const CaseFacts& facts) {
  return !facts.analysis || *facts.analysis == io::Analysis::solid;
}

} // namespace billet::report
