#include "geometry/surface_check.h"

#include "geometry/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace billet::geometry {

void require_point(const Vec3& point, std::string_view what) {
  if (!point.allFinite())
    throw Error(Fault::geometry, "",
                fmt::format("{} is ({}, {}, {}); every coordinate must be a finite number", what,
                            point.x(), point.y(), point.z()));
}

void require_direction(const Vec3& direction, std::string_view what) {
  if (!direction.allFinite() || direction.cwiseAbs().maxCoeff() == 0.0)
    throw Error(Fault::geometry, "",
                fmt::format("{} is ({}, {}, {}); a direction must be finite and not zero", what,
                            direction.x(), direction.y(), direction.z()));
}

void require_between(double value, double lower, double upper, std::string_view what) {
  if (std::isfinite(value) && value > lower && value < upper)
    return;
  throw Error(Fault::geometry, "",
              std::isfinite(upper)
                  ? fmt::format("{} is {}; it must be between {} and {}", what, value, lower, upper)
                  : fmt::format("{} is {}; it must be greater than {}", what, value, lower));
}

} // namespace billet::geometry
