// Which field a picture shows, and its values: one number a node or cell. VTK in a header: only for
// sources of this folder.

#pragma once

#include "app/render/options.h"
#include "app/render/results.h"

#include <vtkDataSet.h>

#include <string>
#include <vector>

namespace billet::render {

/// What is drawn in colour.
struct Shown {
  bool plain = false; ///< nothing is: the part is grey
  Place on = Place::workpiece;
  bool at_points = true; ///< false: at cells
  bool touched = false;  ///< on tools: values that the part has where it touches them
  std::string array;
  int component = -1; ///< -1: the length of a vector, the norm of a tensor
  std::string name;   ///< as it was asked for: "stress:xx"
  std::string unit;   ///< "MPa"; empty: none

  static constexpr const char* values = "shown"; ///< the array that `add_values` makes
};

/// @throws Error  (Fault::usage) for a field or a component that is not there, with those that are
[[nodiscard]] Shown find_shown(const Frame& frame, const SceneOptions& options);

/// A point field with three components, of the workpiece.
/// @throws Error  (Fault::usage) for one that is not there, with those that are
void require_vectors(const Frame& frame, const std::string& name);

/// Puts the values that are shown into an array of the data, points or cells, if these have them.
void add_values(vtkDataSet& data, const Shown& shown);

/// All values of a frame, of a part or of all tools.
[[nodiscard]] std::vector<double> values_of(const Frame& frame, const Shown& shown);

} // namespace billet::render
