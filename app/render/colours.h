// The range of colours, and the colours. VTK in a header: only for sources of this folder.
//
// Without a range that is asked for, colours span the 2nd to the 98th percentile of the values at
// nodes (or cells) of all frames that are shown, so that one of them does not take the colours from
// all the others. Zeros stand for "nothing here" (no contact, no plastic strain): they do not
// count, and are in the range.

#pragma once

#include "app/render/shown.h"

#include <vtkLookupTable.h>
#include <vtkNew.h>

#include <array>
#include <optional>
#include <span>
#include <string>

namespace billet::render {

struct ColourRange {
  std::array<double, 2> colours{0.0, 1.0};
  std::array<double, 2> all{0.0, 0.0}; ///< least and largest value
  bool asked = false;                  ///< the range was

  /// Which part of the values the colours span: "2 to 98 %".
  [[nodiscard]] std::string span() const { return asked ? "as asked" : "2 to 98 %"; }
};

[[nodiscard]] ColourRange colour_range(std::span<const double> values,
                                       const std::optional<std::array<double, 2>>& asked);

/// The range of colours for values; not a number: left out.
[[nodiscard]] std::array<double, 2> usual_range(std::span<const double> values);

/// The colours of "viridis": even steps look even, in print and to the colour-blind. Grey where
/// there is no number.
/// @param bands  how many; empty: as many as the eye tells apart
[[nodiscard]] vtkNew<vtkLookupTable> colour_map(const std::array<double, 2>& range,
                                                const std::optional<int>& bands);

} // namespace billet::render
