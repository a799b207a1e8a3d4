// The axis of a chart, linear or logarithmic, with ticks at round numbers.

#pragma once

#include <string>
#include <vector>

namespace billet::render {

struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 1.0; ///< between ticks: 1, 2 or 5 times a power of ten; logarithmic: decades, a
                     ///< third for 1, 2 and 5 times each power
  bool logarithmic = false;

  [[nodiscard]] std::vector<double> ticks() const;
  /// A tick as it is written, those of a linear axis with as many digits behind the point.
  [[nodiscard]] std::string label(double tick) const;
  /// Where a value lies between the ends, 0 to 1.
  [[nodiscard]] double share(double value) const;
};

/// The shortest axis from tick to tick that holds zero and the values.
[[nodiscard]] Axis axis_through_zero(double least, double most, int most_steps);

/// The shortest one that holds the values.
[[nodiscard]] Axis axis_of(double least, double most, int most_steps);

/// The shortest logarithmic one that holds the values: from power of ten to power of ten, within
/// two decades from 1, 2 or 5 times such a power.
/// @pre 0 < least <= most
[[nodiscard]] Axis logarithmic_axis(double least, double most, int most_steps);

} // namespace billet::render
