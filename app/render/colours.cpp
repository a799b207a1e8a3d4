#include "app/render/colours.h"

#include "app/render/frame_files.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace billet::render {

namespace {

std::string known_fields(vtkUnstructuredGrid& grid) {
  std::string names;
  for (vtkDataSetAttributes* data : {static_cast<vtkDataSetAttributes*>(grid.GetPointData()),
                                     static_cast<vtkDataSetAttributes*>(grid.GetCellData())})
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      names += (names.empty() ? "" : ", ") + std::string(data->GetArrayName(i));
  return names;
}

/// Names of the components of a vector or of a symmetric tensor, in their order.
std::vector<std::string_view> component_names(int n_components) {
  if (n_components == 3)
    return {"x", "y", "z"};
  if (n_components == 6)
    return {"xx", "yy", "zz", "xy", "yz", "xz"};
  return {};
}

/// The number of a component asked for by its name or its number from 0.
int component(const std::string& field, std::string asked, int n_components) {
  std::transform(asked.begin(), asked.end(), asked.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::vector<std::string_view> names = component_names(n_components);
  if (const auto found = std::find(names.begin(), names.end(), asked); found != names.end())
    return static_cast<int>(found - names.begin());
  int number = -1;
  const auto [end, error] = std::from_chars(asked.data(), asked.data() + asked.size(), number);
  if (error == std::errc() && end == asked.data() + asked.size() && number >= 0 &&
      number < n_components)
    return number;
  if (n_components == 1)
    throw Error(Fault::usage, "--field",
                fmt::format("\"{}\" has no component \"{}\": it is one number", field, asked),
                fmt::format("--field {}", field));
  throw Error(Fault::usage, "--field", fmt::format("\"{}\" has no component \"{}\"", field, asked),
              names.empty() ? fmt::format("it has 0 to {}", n_components - 1)
                            : fmt::format("it has {}", fmt::join(names, ", ")));
}

std::vector<double> values_of(vtkDataArray& array, int component) {
  std::vector<double> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    if (component >= 0) {
      values.push_back(array.GetComponent(i, component));
      continue;
    }
    double sum = 0.0;
    for (int c = 0; c < array.GetNumberOfComponents(); ++c)
      sum += array.GetComponent(i, c) * array.GetComponent(i, c);
    values.push_back(std::sqrt(sum));
  }
  return values;
}

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

ColouredBy coloured_by(vtkUnstructuredGrid& grid, const Options& options) {
  ColouredBy colours;
  colours.name = options.field;
  const std::size_t colon = options.field.find(':');
  colours.array = options.field.substr(0, colon);
  vtkDataArray* array = grid.GetPointData()->GetArray(colours.array.c_str());
  colours.at_points = array != nullptr;
  if (array == nullptr)
    array = grid.GetCellData()->GetArray(colours.array.c_str());
  if (array == nullptr)
    throw Error(Fault::usage, "--field", fmt::format("the results have no \"{}\"", colours.array),
                fmt::format("they have {}", known_fields(grid)));
  if (colon != std::string::npos)
    colours.component =
        component(colours.array, options.field.substr(colon + 1), array->GetNumberOfComponents());
  else if (array->GetNumberOfComponents() == 1)
    colours.component = 0;
  colours.unit = text_in(grid, "unit of " + colours.array);
  const std::vector<double> values = values_of(*array, colours.component);
  colours.all = extremes(values);
  colours.asked = options.range.has_value();
  colours.range = opened(options.range.value_or(usual_range(values)));
  return colours;
}

vtkNew<vtkColorTransferFunction> colour_map(const std::array<double, 2>& range) {
  constexpr std::array<std::array<double, 3>, 9> viridis{{{0.267, 0.005, 0.329},
                                                          {0.278, 0.175, 0.483},
                                                          {0.230, 0.322, 0.546},
                                                          {0.173, 0.449, 0.558},
                                                          {0.128, 0.567, 0.551},
                                                          {0.158, 0.684, 0.502},
                                                          {0.369, 0.789, 0.383},
                                                          {0.678, 0.864, 0.190},
                                                          {0.993, 0.906, 0.144}}};
  vtkNew<vtkColorTransferFunction> map;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    const double t = static_cast<double>(i) / (viridis.size() - 1);
    map->AddRGBPoint(range[0] + t * (range[1] - range[0]), viridis[i][0], viridis[i][1],
                     viridis[i][2]);
  }
  return map;
}

} // namespace billet::render
