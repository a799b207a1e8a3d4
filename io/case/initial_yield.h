// The stress at which the metal of a case begins to flow.

#pragma once

#include "io/case/case_workpiece.h"

namespace billet::io {

/// The yield stress at no plastic strain [MPa]; 0: the law gives none of its own, or only with the
/// temperature.
[[nodiscard]] double initial_yield(const FlowLaw& flow);

} // namespace billet::io
