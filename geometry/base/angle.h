// Angles: radians within the code, degrees where a user states or reads them.

#pragma once

#include <numbers>

namespace billet {

inline constexpr double degree = std::numbers::pi / 180.0; ///< [rad]

} // namespace billet
