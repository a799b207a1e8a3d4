// Columns of history.csv over another one, of one or several results.

#pragma once

#include "app/render/curve.h"
#include "app/render/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace billet::render {

/// The curves; axes have the units of the columns.
/// @param results  folders of runs
/// @throws Error  for tables that cannot be read, and columns that are not there
[[nodiscard]] Chart columns_of(const std::vector<std::filesystem::path>& results,
                               const std::vector<Columns>& columns);

} // namespace billet::render
