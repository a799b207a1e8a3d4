// The one line that a terminal shows of a run that is going on.

#pragma once

#include "io/case/case.h"
#include "process/loop/process.h"

#include <string>

namespace billet::app {

/// "[=======       ]  48 %  increment 25  punch 1.58 mm 152 kN  2 min left": the share of the time
/// of the case; stroke and force of the first tool that travels, else the force on the first of
/// all; and how long the rest takes if it takes as long as what is done. Cut off where the line
/// ends.
[[nodiscard]] std::string progress_bar(const process::Run& run,
                                       const process::IncrementReport& report,
                                       const io::UnitSystem& units,
                                       int columns);

/// "12 s", "3 min", "2 h 05 min", from seconds.
[[nodiscard]] std::string duration(double seconds);

/// Of the terminal on a stream, by default standard error; 80 where it does not say.
[[nodiscard]] int terminal_columns(int stream = 2);

} // namespace billet::app
