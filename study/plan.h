// The rows of a study: which settings are run.

#pragma once

#include <string>
#include <vector>

#include "study/study.h"

namespace billet::study {

/// One run to be made.
struct Row {
  std::vector<std::string> labels;     ///< of the levels, or values drawn, by axis
  std::vector<Assignment> assignments; ///< of all axes
  std::optional<std::filesystem::path> case_file = std::nullopt; ///< in place of the study's

  /// As `--set` takes them.
  [[nodiscard]] std::vector<std::string> overrides() const;
};

/// All combinations, the last axis changing fastest; or as many as the sample has. The same study
/// gives the same rows on every machine.
[[nodiscard]] std::vector<Row> rows_of(const Study& study);

} // namespace billet::study
