#include "app/report/frame_view.h"

#include "app/report/frame_encoder.h"
#include "geometry/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

/// More of them nobody looks at one by one.
constexpr std::size_t most_frames = 120;

/// What is tried, one after the other, and the least number of frames that each is worth.
struct Plan {
  Detail detail;
  std::size_t least_frames;
};
constexpr std::array plans{Plan{{true, true}, 12}, Plan{{false, true}, 8}, Plan{{false, false}, 1}};

/// As many of the frames, spread evenly, the first and the last among them.
std::vector<io::FrameFiles> spread(const std::vector<io::FrameFiles>& frames, std::size_t n) {
  if (n >= frames.size())
    return frames;
  if (n <= 1)
    return {frames.back()};
  std::vector<io::FrameFiles> chosen;
  for (std::size_t i = 0; i < n; ++i)
    chosen.push_back(frames[(i * (frames.size() - 1) + (n - 1) / 2) / (n - 1)]);
  return chosen;
}

struct Encoded {
  FrameEncoder encoder;
  std::size_t n_taken = 0; ///< frames that fit
  std::vector<std::string> complaints;
};

/// Encodes frames as long as there is room.
Encoded encode(const std::vector<io::FrameFiles>& frames, Detail detail, std::size_t most_bytes) {
  Encoded result{FrameEncoder(detail), 0, {}};
  for (const io::FrameFiles& frame : frames) {
    try {
      result.encoder.add(frame);
    } catch (const Error& wrong) {
      result.complaints.emplace_back(wrong.what());
      continue;
    }
    if (result.encoder.size() > most_bytes)
      return result;
    ++result.n_taken;
  }
  return result;
}

/// With fewer frames from try to try; none: not even the least number of them fits.
std::optional<Encoded>
fitted(const std::vector<io::FrameFiles>& frames, const Plan& plan, std::size_t most_bytes) {
  const std::size_t least = std::min(plan.least_frames, frames.size());
  for (std::size_t n = std::min(frames.size(), most_frames); n >= least && n > 0;) {
    Encoded tried = encode(spread(frames, n), plan.detail, most_bytes);
    if (tried.n_taken + tried.complaints.size() == std::min(n, frames.size()))
      return tried;
    constexpr double caution = 0.9; // later frames may be larger
    const auto fit = static_cast<std::size_t>(caution * static_cast<double>(tried.n_taken));
    n = n == least ? 0 : std::max(std::min(fit, n - 1), least);
  }
  return std::nullopt;
}

std::vector<std::string> notes_on(const Encoded& encoded,
                                  const Plan& plan,
                                  const ResultsFolder& results,
                                  std::size_t n_frames) {
  std::vector<std::string> notes = encoded.complaints;
  if (encoded.n_taken + encoded.complaints.size() < n_frames)
    notes.push_back(
        fmt::format("{} of {} frames are in this page, evenly chosen.", encoded.n_taken, n_frames));
  if (is_solid(results.facts) && !plan.detail.volume)
    notes.emplace_back("The inside of the part is left out for its size: a section shows the "
                       "surface cut open.");
  if (!plan.detail.all_fields)
    notes.emplace_back("Only the fields asked for most are in this page; billet render and "
                       "ParaView show the others.");
  for (const auto& [tool, triangles] : encoded.encoder.tools().thinned())
    notes.push_back(
        fmt::format("Tool {} of {} triangles is drawn coarser than it is.", tool, triangles));
  notes.emplace_back("Values are stored in 4095 steps of the range that a field has in a frame, "
                     "coordinates in 65534.");
  return notes;
}

} // namespace

FrameView frame_view(const ResultsFolder& results, std::size_t most_bytes) {
  FrameView view;
  std::vector<io::FrameFiles> frames;
  try {
    frames = io::frames_in(results.path);
  } catch (const Error& wrong) {
    view.notes.emplace_back(wrong.what());
  }
  if (frames.empty())
    return view;
  for (const Plan& plan : plans) {
    const std::optional<Encoded> encoded = fitted(frames, plan, most_bytes);
    if (!encoded)
      continue;
    view.notes = notes_on(*encoded, plan, results, frames.size());
    if (encoded->n_taken == 0)
      return view;
    view.scene = encoded->encoder.scene();
    view.blobs = encoded->encoder.blobs();
    view.scene["length"] = results.units().length;
    view.scene["time"] = results.units().time;
    view.scene["axisymmetric"] = results.facts.analysis == io::Analysis::axisymmetric;
    view.scene["symmetry"] = ordered_json::array();
    for (const io::SymmetryPlane& plane : encoded->encoder.symmetry())
      view.scene["symmetry"].push_back({{"axis", plane.axis}, {"value", plane.value}});
    return view;
  }
  view.notes.emplace_back("The mesh is too large for this page; billet render and ParaView show "
                          "the frames.");
  return view;
}

} // namespace billet::report
