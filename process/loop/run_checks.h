// Checks that the result of a run must pass to be of use.
//
// A warning says what to look at; a failed check says that forces and shape are not those of the
// process. A run that reaches its end but fails one ends with a status of its own. Theory:
// docs/theory/process.md (P.42).

#pragma once

#include <string>
#include <vector>

namespace billet::process {

struct Run;

/// A check that a run has not passed.
struct FailedCheck {
  std::string name; ///< as in summary.json, such as "energy-balance"
  std::string what; ///< what was found, what is allowed, what may help
};

/// Those of a run, judged where it is now. In the order of their names in the guide; empty: the
/// result can be used.
[[nodiscard]] std::vector<FailedCheck> failed_checks(const Run& run);

} // namespace billet::process
