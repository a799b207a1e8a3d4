// The page of `billet report`: one HTML file that asks for nothing else.
//
// Text, tables and curves are in the file as they are shown; the bundle of `web/` draws the frames
// and makes the curves answer to the mouse. Without the bundle the page has no view of the frames.

#pragma once

#include "app/report/results_folder.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace billet::report {

/// What `web/` is bundled to.
struct Bundle {
  std::string script, style, licences;
};

/// The bundle in share/billet of where the program lies; none: it was not built.
[[nodiscard]] std::optional<Bundle> find_bundle(const std::filesystem::path& program);

struct PageSettings {
  std::optional<Bundle> bundle;
  std::optional<int> reload_after;     ///< the page asks for itself again [s]
  std::size_t most_bytes = 10'000'000; ///< of the page
};

[[nodiscard]] std::string page_of(const ResultsFolder& results, const PageSettings& settings);

} // namespace billet::report
