// What a picture is coloured by: a field or one of its components, and the range of its colours.
// VTK in a header: only for sources of this folder.
//
// Without a range that is asked for, colours span the 2nd to the 98th percentile of the values at
// nodes (or cells), so that one of them does not take the colours from all the others. Zeros stand
// for "nothing here" (no contact, no plastic strain): they do not count, and are in the range.

#pragma once

#include "app/render/options.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <span>
#include <string>

namespace billet::render {

/// What is drawn in colour.
struct ColouredBy {
  bool at_points = true; ///< false: at cells
  std::string array;
  int component = -1; ///< -1: the length of a vector, the norm of a tensor
  std::string name;   ///< as it was asked for: "stress:xx"
  std::string unit;   ///< "MPa"; empty: none
  bool asked = false; ///< the range was
  std::array<double, 2> range{0.0, 1.0};
  std::array<double, 2> all{0.0, 0.0}; ///< least and largest value of the frame

  /// Which part of the values the colours span: "2 to 98 %".
  [[nodiscard]] std::string span() const { return asked ? "as asked" : "2 to 98 %"; }
};

/// @throws Error  (Fault::usage) for a field or a component that is not there
[[nodiscard]] ColouredBy coloured_by(vtkUnstructuredGrid& grid, const Options& options);

/// The range of colours for values; not a number: left out.
[[nodiscard]] std::array<double, 2> usual_range(std::span<const double> values);

/// The colours of "viridis": even steps look even, in print and to the colour-blind.
[[nodiscard]] vtkNew<vtkColorTransferFunction> colour_map(const std::array<double, 2>& range);

} // namespace billet::render
