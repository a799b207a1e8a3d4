// Forces of the workpiece on the supports that have a name.

#pragma once

#include "geometry/base/vector.h"
#include "process/state/run.h"

#include <string>
#include <vector>

namespace billet::process {

struct SupportForce {
  std::string name;
  Vec3 force; ///< of the workpiece on the support [N]; in plane strain per length
};

/// Of each named support, in the order of the case. Where two supports hold a node in the same
/// direction the first one takes its force; a plane of symmetry takes that of metal that has come
/// to lie on it.
[[nodiscard]] std::vector<SupportForce> support_forces(const Run& run);

} // namespace billet::process
