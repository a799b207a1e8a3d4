// A problem with a closed form, and the list of all of them.

#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "study/verify/case_bench.h"
#include "study/verify/figure.h"

namespace billet::study {

struct Problem {
  std::string_view name;   ///< as the user names it
  std::string_view shows;  ///< what is wrong if it fails, in a few words
  std::string_view source; ///< of the references: equation, author, year
  /// Runs the problem's cases.
  /// @throws Error where a case cannot be run
  std::vector<Figure> (*figures)(const CaseBench& bench);
};

/// All problems, in the order of the table.
[[nodiscard]] std::span<const Problem> all_problems();

} // namespace billet::study
