// Frames of a run for the view of the page: meshes, places, fields and tools, within a size.
//
// What does not fit is left out, in this order: frames, down to a number that still shows the
// course; the inside of parts in space, so that cuts are hollow; fields but the most asked for;
// frames again. `notes` says what was.

#pragma once

#include "app/report/results_folder.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace billet::report {

struct FrameView {
  nlohmann::ordered_json scene;   ///< what `web/src/scene.js` draws; null: there are no frames
  std::vector<std::string> blobs; ///< in the order of their numbers in `scene`
  std::vector<std::string> notes; ///< what a reader should know about what is not shown
};

/// @param most_bytes  of all blobs together
[[nodiscard]] FrameView frame_view(const ResultsFolder& results, std::size_t most_bytes);

} // namespace billet::report
