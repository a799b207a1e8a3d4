// The workpiece's material as a case gives it.

#pragma once

#include "io/case/case.h"
#include "mechanics/materials/j2_hencky.h"

namespace billet::io {

[[nodiscard]] mechanics::Material material_of(const Case& content);

} // namespace billet::io
