// Limits of floating-point numbers that geometry compares with.

#pragma once

#include <limits>

namespace billet {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double epsilon = std::numeric_limits<double>::epsilon(); ///< of 1

} // namespace billet
