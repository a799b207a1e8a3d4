// How near a tool comes to the workpiece, before anything is solved.
//
// A tool that is placed too high, moves the wrong way or has too little time never touches, and a
// run says so only at its end. Here every prescribed motion is followed along the workpiece as it
// lies at the start: what is found is true of that; a part that other tools move or stretch may
// come to a tool that does not come to it.
//
// Units   those of the case.

#pragma once

#include "process/scene/scene.h"

#include <cstddef>
#include <optional>
#include <span>

namespace billet::process {

/// A gap between a tool and the workpiece as it lies at the start.
struct ToolGap {
  double time = 0.0; ///< [s]
  double gap = 0.0;  ///< [mm]; < 0: a node lies in the tool
};

/// How near a tool comes while it acts.
struct ToolReach {
  ToolGap first;             ///< when it begins to act
  ToolGap last;              ///< when it has acted
  ToolGap least;             ///< of the times that were looked at
  double way = 0.0;          ///< of any of its points between first and last, at most [mm]
  Vec3 shift = Vec3::Zero(); ///< from first to last, without turns [mm]
  bool touches = false;      ///< it comes to touch
  /// At first it draws back from the nodes that are nearest: a narrow tool that goes in between
  /// nodes is farther from them in the end as well, and does not.
  bool draws_back = false;
  bool has_all_behind = false; ///< it acts from the start and has no node of the part before it
};

/// @return  none: it never acts, or a load drives it and nobody knows where it goes
[[nodiscard]] std::optional<ToolReach> tool_reach(const Scene& scene, std::size_t tool);

/// A tool that pushes the workpiece away: no support holds that way, and no other tool can.
struct LonelyPush {
  std::size_t tool;
  int axis;    ///< along which the workpiece is free
  double sign; ///< of the push along it
};

/// @param reaches  of all tools
[[nodiscard]] std::optional<LonelyPush>
lonely_push(const Scene& scene, std::span<const std::optional<ToolReach>> reaches);

} // namespace billet::process
