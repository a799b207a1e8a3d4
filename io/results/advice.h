// What may help a run that could not go on: a line for each cause that its last tries show.
//
// A cause is known from what was tried (points that went to and fro, elements inside out, loads
// that nothing answered) and from what the case asks for; the remedy is a change of the case file.

#pragma once

#include "io/case/case.h"
#include "process/loop/process.h"

#include <string>
#include <vector>

namespace billet::io {

/// Causes and their remedies, the likeliest first; the last line is of use for any.
[[nodiscard]] std::vector<std::string>
advice(const Case& content, const process::Run& run, const process::PostMortem& post);

} // namespace billet::io
