#include "process/reports/lap.h"

#include <fmt/format.h>

namespace billet::process {

Lap lap(const geometry::ClosedFold& fold) {
  return {Vec3(fold.at.x(), fold.at.y(), 0.0),
          fmt::format("({:.6g}, {:.6g})", fold.at.x(), fold.at.y()), fold.depth(), false};
}

Lap lap(const geometry::ClosedCrease& crease) {
  return {crease.at,
          fmt::format("({:.6g}, {:.6g}, {:.6g})", crease.at.x(), crease.at.y(), crease.at.z()),
          crease.depth, false};
}

} // namespace billet::process
