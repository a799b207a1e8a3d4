// Charts of a study: quantities over what was varied, the trade, the extrapolation.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/conduct.h"

namespace billet::study {

/// Words for billet-render.
struct Picture {
  std::vector<std::string> arguments;
};

/// Writes the tables of the charts into FOLDER/charts.
[[nodiscard]] std::vector<Picture>
pictures_of(const Study& study, const Conducted& result, const std::filesystem::path& folder);

} // namespace billet::study
