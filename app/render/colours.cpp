#include "app/render/colours.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace billet::render {

namespace {

/// Least and largest number.
std::array<double, 2> extremes(std::span<const double> values) {
  std::array<double, 2> range{HUGE_VAL, -HUGE_VAL};
  for (const double value : values)
    if (std::isfinite(value))
      range = {std::min(range[0], value), std::max(range[1], value)};
  return range[0] <= range[1] ? range : std::array{0.0, 0.0};
}

/// A range that has a length.
std::array<double, 2> opened(std::array<double, 2> range) {
  if (!(range[1] > range[0]))
    range[1] = range[0] + std::max(1e-9, 1e-6 * std::abs(range[0]));
  return range;
}

/// The colour at a share of the scale, 0 to 1.
std::array<double, 3> viridis(double share) {
  constexpr std::array<std::array<double, 3>, 9> table{{{0.267, 0.005, 0.329},
                                                        {0.278, 0.175, 0.483},
                                                        {0.230, 0.322, 0.546},
                                                        {0.173, 0.449, 0.558},
                                                        {0.128, 0.567, 0.551},
                                                        {0.158, 0.684, 0.502},
                                                        {0.369, 0.789, 0.383},
                                                        {0.678, 0.864, 0.190},
                                                        {0.993, 0.906, 0.144}}};
  const double at = share * (table.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), table.size() - 2);
  const double t = at - static_cast<double>(i);
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = (1.0 - t) * table[i][c] + t * table[i + 1][c];
  return colour;
}

} // namespace

std::array<double, 2> usual_range(std::span<const double> values) {
  constexpr double low = 0.02, high = 0.98;
  std::vector<double> sorted;
  bool zeros = false;
  for (const double value : values) {
    zeros = zeros || value == 0.0;
    if (value != 0.0 && std::isfinite(value))
      sorted.push_back(value);
  }
  if (sorted.empty())
    return {0.0, 0.0};
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(sorted.size() - 1)))];
  };
  std::array<double, 2> range{at(low), at(high)};
  if (zeros)
    range = {std::min(range[0], 0.0), std::max(range[1], 0.0)};
  return range;
}

ColourRange colour_range(std::span<const double> values,
                         const std::optional<std::array<double, 2>>& asked) {
  return {opened(asked ? *asked : usual_range(values)), extremes(values), asked.has_value()};
}

vtkNew<vtkLookupTable> colour_map(const std::array<double, 2>& range,
                                  const std::optional<int>& bands) {
  constexpr int smooth = 256;
  const int n = bands.value_or(smooth);
  vtkNew<vtkLookupTable> map;
  map->SetNumberOfTableValues(n);
  map->SetTableRange(range[0], range[1]);
  for (int i = 0; i < n; ++i) {
    const std::array<double, 3> colour = viridis(static_cast<double>(i) / (n - 1));
    map->SetTableValue(i, colour[0], colour[1], colour[2]);
  }
  map->SetNanColor(0.82, 0.82, 0.82, 1.0);
  return map;
}

} // namespace billet::render
