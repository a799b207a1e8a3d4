// Tools that meet each other, known before anything is solved.
//
// Rigid tools do not feel each other: an upper die that comes down too far goes through the lower
// one without a word, and the workpiece is caught between. So every pair is followed along its
// prescribed motion, for as long as both act. Much of what overlaps is meant: half-spaces that form
// the corner of a container, a punch that just fits its bore. Told are pairs that are apart and
// come to overlap, and bounded tools that overlap from the start.
//
// Theory: docs/theory/process.md (P.8).

#pragma once

#include "process/scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace billet::process {

/// Two tools that overlap.
struct ToolMeeting {
  std::size_t first;         ///< of the scene's tools
  std::size_t second;        ///< of the scene's tools, > first
  double time;               ///< at which they meet, or begin to act together [s]
  bool from_start;           ///< they overlap when they begin to act together
  double depth;              ///< there and then, from the start only [mm]
  Vec3 place = Vec3::Zero(); ///< in space [mm]
};

/// The first meeting of every pair, in the order of the pairs. Tools driven by a load are looked at
/// where they start, for nobody knows where they go.
///
/// @param scene  with its tools brought to touch
[[nodiscard]] std::vector<ToolMeeting> tool_meetings(const Scene& scene);

/// Pairs that overlap where loads have taken them and did not when they began to act.
///
/// @param poses  of all tools at the time
[[nodiscard]] std::vector<ToolMeeting>
overlaps_by_loads(const Scene& scene, double time, std::span<const geometry::Pose> poses);

} // namespace billet::process
