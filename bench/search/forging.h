// What the search of a fine die takes of a run in three dimensions.

#pragma once

#include <cstdint>
#include <string>

namespace billet::bench {

/// Presses a quarter of a cylinder into a shallow STL cup and returns a row of the table: cells
/// over the radius, unknowns, processor time, iterations, queries, time of the search and its
/// share.
///
/// @param cells      over the radius
/// @param triangles  of the cup
[[nodiscard]] std::string forge(int cells, std::int64_t triangles);

} // namespace billet::bench
