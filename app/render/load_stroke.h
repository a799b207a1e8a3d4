// What an engineer asks for first: the force of each tool over its stroke.

#pragma once

#include "app/render/curve.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace billet::render {

/// Force over stroke of every tool that travels, from the start of the run on: the way along the
/// direction in which the tool has gone farthest, the force of the workpiece against it. Where no
/// tool travels, the magnitudes of all forces over time. In kN and mm where that reads better.
///
/// @param results  folders of runs, which may still be going on; of several, curves are named after
///                 them as well
/// @throws Error  (Fault::input_output); (Fault::usage) where they measure different things
[[nodiscard]] Chart load_stroke(const std::vector<std::filesystem::path>& results);

/// How results are called among others: the name of their folder.
[[nodiscard]] std::string name_of(const std::filesystem::path& results);

/// The way of the tool that travels farthest, after each increment, from (0, 0) on; empty: there is
/// no history.csv, or no tool that travels.
/// @returns time [s] and way along the direction of its longest way [mm]
[[nodiscard]] std::vector<std::pair<double, double>>
longest_way(const std::filesystem::path& results);

/// What lengths, forces and times of results are measured in, and their title.
struct CaseUnits {
  std::string length, force, time, title;
  bool per_thickness = false; ///< forces in plane strain
};
[[nodiscard]] CaseUnits units_of(const std::filesystem::path& results);

} // namespace billet::render
