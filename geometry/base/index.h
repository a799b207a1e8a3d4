// Numbers of points, cells and sides.

#pragma once

#include <cstddef>
#include <cstdint>

namespace billet {

/// A number of a point, a cell or a degree of freedom as the subscript of a container.
[[nodiscard]] constexpr std::size_t idx(std::int32_t i) { return static_cast<std::size_t>(i); }

} // namespace billet
