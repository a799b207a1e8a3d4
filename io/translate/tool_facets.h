// Triangles of a tool: the STL that a case names, and how far they are off a curved surface.

#pragma once

#include "geometry/base/vector.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace billet::io {

using Facet = std::array<Vec3, 3>; ///< corners, counter-clockwise seen from the free side

/// An ASCII STL.
[[nodiscard]] std::string stl_text(const std::string& name, const std::vector<Facet>& facets);

/// Value of `surface` of a case.
/// @param feature_angle  below which the triangles are curved [degrees]; 0: they stay flat
[[nodiscard]] std::string
stl_surface(const std::string& file, const std::string& unit, double feature_angle);

/// Largest distance between the triangles and the curved ones that take their place; none: they are
/// no sound surface.
[[nodiscard]] std::optional<double> curving_of(const std::vector<Facet>& facets,
                                               double feature_angle);

} // namespace billet::io
