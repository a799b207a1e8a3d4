// Slips: what is legal in a case and hardly ever meant.
//
// A modulus in GPa where MPa are asked for, a punch that never arrives, one element over the
// height: the run would go on and its figures would be wrong, or right for another job. Each slip
// is looked for by a small function of its own, which gives the number and the remedy; limits are
// so wide that what is reported is worth a look. Nothing is stopped.
//
// Numbers with a dimension are compared in fixed units, whatever the units of the case.
// Guide: docs/guide/case-file.md, "Slips that are warned of".

#pragma once

#include "io/case/case.h"
#include "process/loop/process.h"

#include <string>
#include <vector>

namespace billet::io {

/// What the numbers of a case alone tell: materials, friction, angles. Each begins with
/// "warning: ".
[[nodiscard]] std::vector<std::string> number_slips(const Case& content);

/// Tools that go through each other: legal, for they do not feel it, and hardly ever meant.
///
/// @param scene  with its tools brought to touch
[[nodiscard]] std::vector<std::string> meeting_slips(const process::Scene& scene,
                                                     const UnitSystem& units);

/// What the scene tells: size of the part, tools that do not arrive, free motions, elements.
///
/// @param process  of that case, before it has run
[[nodiscard]] std::vector<std::string> scene_slips(const Case& content, const process::Run& run);

} // namespace billet::io
