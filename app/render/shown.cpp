#include "app/render/shown.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/text/text.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace billet::render {

namespace {

void add_names(vtkDataSetAttributes& data, std::vector<std::string>& names) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = data.GetArray(i);
        array != nullptr && array->GetName() != nullptr &&
        std::find(names.begin(), names.end(), array->GetName()) == names.end() &&
        std::string_view(array->GetName()) != Shown::values)
      names.emplace_back(array->GetName());
}

/// The fields of a frame where they may be shown.
std::vector<std::string> known_fields(const Frame& frame, const std::optional<Place>& on) {
  std::vector<std::string> names;
  if (!on || *on != Place::contact) {
    add_names(*frame.workpiece->GetPointData(), names);
    if (!on || *on == Place::workpiece)
      add_names(*frame.workpiece->GetCellData(), names);
  }
  if (frame.contact != nullptr && (!on || *on == Place::contact))
    add_names(*frame.contact->GetCellData(), names);
  if (!on || *on == Place::tools)
    for (const auto& [name, tool] : frame.tools)
      add_names(*tool->GetCellData(), names);
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
int component(const std::string& field, const std::string& name, int n_components) {
  const std::string asked = io::in_small_letters(name);
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

vtkDataArray* array_of(vtkDataSet& data, const std::string& name, bool at_points) {
  return at_points ? data.GetPointData()->GetArray(name.c_str())
                   : data.GetCellData()->GetArray(name.c_str());
}

/// Looks for the field in one place; null: it is not there.
vtkDataArray* look_for(const Frame& frame, Place on, Shown& shown) {
  shown.on = on;
  vtkDataArray* found = nullptr;
  shown.at_points = on == Place::workpiece;
  if (on == Place::contact)
    return frame.contact == nullptr ? nullptr : array_of(*frame.contact, shown.array, false);
  if (on == Place::tools) {
    for (const auto& [name, tool] : frame.tools)
      if (vtkDataArray* const array = array_of(*tool, shown.array, false);
          found == nullptr && array != nullptr)
        found = array;
    if (found != nullptr)
      return found;
    shown.at_points = shown.touched = true;
  }
  found = array_of(*frame.workpiece, shown.array, true);
  if (found == nullptr && on == Place::workpiece) {
    shown.at_points = false;
    found = array_of(*frame.workpiece, shown.array, false);
  }
  return found;
}

/// The unit of a field, from whichever part of the frame has it.
std::string unit_of(const Frame& frame, const std::string& field) {
  const std::string name = "unit of " + field;
  std::string unit = text_in(*frame.workpiece, name);
  if (unit.empty() && frame.contact != nullptr)
    unit = text_in(*frame.contact, name);
  for (const auto& [tool, surface] : frame.tools)
    if (unit.empty())
      unit = text_in(*surface, name);
  return unit == "1" ? "" : unit;
}

[[noreturn]] void not_there(const Frame& frame,
                            const std::string& option,
                            const std::string& field,
                            const std::optional<Place>& on) {
  const std::vector<std::string> known = known_fields(frame, on);
  std::string remedy = io::suggestion(field, known);
  const std::string list = fmt::format("they have {}", fmt::join(known, ", "));
  remedy = remedy.starts_with("did you mean") ? remedy + " " + list : list;
  constexpr std::array names{"the workpiece has", "the contact faces have", "the tools have"};
  const char* const who = on ? names[static_cast<std::size_t>(*on)] : "the results have";
  throw Error(Fault::usage, option, fmt::format("{} no \"{}\"", who, field),
              known.empty() ? "" : remedy);
}

double value(vtkDataArray& array, vtkIdType tuple, int component) {
  if (component >= 0)
    return array.GetComponent(tuple, component);
  double sum = 0.0;
  for (int c = 0; c < array.GetNumberOfComponents(); ++c)
    sum += array.GetComponent(tuple, c) * array.GetComponent(tuple, c);
  return std::sqrt(sum);
}

void append(vtkDataSet* data, const Shown& shown, std::vector<double>& values) {
  vtkDataArray* const array =
      data == nullptr ? nullptr : array_of(*data, shown.array, shown.at_points);
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.push_back(value(*array, i, shown.component));
}

} // namespace

Shown find_shown(const Frame& frame, const SceneOptions& options) {
  Shown shown;
  shown.name = options.field;
  if (options.field == "none") {
    shown.plain = true;
    return shown;
  }
  const std::size_t colon = options.field.find(':');
  shown.array = options.field.substr(0, colon);
  vtkDataArray* array = nullptr;
  if (options.on)
    array = look_for(frame, *options.on, shown);
  else
    for (const Place on : {Place::workpiece, Place::contact, Place::tools})
      if (array == nullptr)
        array = look_for(frame, on, shown);
  if (array == nullptr)
    not_there(frame, "--field", shown.array, options.on);
  if (colon != std::string::npos)
    shown.component =
        component(shown.array, options.field.substr(colon + 1), array->GetNumberOfComponents());
  else if (array->GetNumberOfComponents() == 1)
    shown.component = 0;
  shown.unit = unit_of(frame, shown.array);
  return shown;
}

void require_vectors(const Frame& frame, const std::string& name) {
  vtkDataArray* const array = array_of(*frame.workpiece, name, true);
  if (array == nullptr)
    not_there(frame, "--arrows", name, Place::workpiece);
  if (array->GetNumberOfComponents() != 3)
    throw Error(Fault::usage, "--arrows", fmt::format("\"{}\" is not a vector", name),
                "velocity, displacement and friction are");
}

void add_values(vtkDataSet& data, const Shown& shown) {
  vtkDataArray* const array = shown.plain ? nullptr : array_of(data, shown.array, shown.at_points);
  if (array == nullptr)
    return;
  const vtkNew<vtkDoubleArray> values;
  values->SetName(Shown::values);
  values->SetNumberOfTuples(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    values->SetValue(i, value(*array, i, shown.component));
  if (shown.at_points)
    data.GetPointData()->AddArray(values);
  else
    data.GetCellData()->AddArray(values);
}

std::vector<double> values_of(const Frame& frame, const Shown& shown) {
  std::vector<double> values;
  if (shown.plain)
    return values;
  if (shown.on == Place::contact)
    append(frame.contact, shown, values);
  else if (shown.on == Place::tools && !shown.touched)
    for (const auto& [name, tool] : frame.tools)
      append(tool, shown, values);
  else
    append(frame.workpiece, shown, values);
  return values;
}

} // namespace billet::render
