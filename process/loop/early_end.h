// Where forming is over before the time of a case is: what follows would tell nothing of a process.
//
// Theory: docs/theory/process.md (P.43), (P.44).

#pragma once

#include "process/reports/run_reports.h"
#include "process/state/run.h"

namespace billet::process {

/// Whether the increment that has been accepted is the last, as far as the case asks to end there:
/// the cavity is full, tools press harder than tools can, two of them lie on each other but for a
/// film of metal, or a lap is too deep.
[[nodiscard]] EndedBy early_end(const Run& run, const IncrementReport& report);

/// The same after an increment that cannot be solved: the last good one is taken for the end where
/// tools press harder than tools can.
[[nodiscard]] EndedBy end_after_failure(const Run& run);

/// Whether a run has ended in a way that its case still asks for: not if it was resumed to go on.
[[nodiscard]] bool has_ended(const Run& run);

} // namespace billet::process
