#include "app/render/option_values.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace billet::render {

namespace {

/// The value that a word stands for.
template <class T>
T one_of(const std::string& text, const std::map<std::string, T>& words, std::string_view what) {
  if (const auto found = words.find(text); found != words.end())
    return found->second;
  std::vector<std::string> known;
  for (const auto& [word, value] : words)
    known.push_back(word);
  throw Error(Fault::usage, "", fmt::format("{} cannot be \"{}\"", what, text),
              io::suggestion(text, known));
}

/// x=3.5, x<3.5, x>3.5
CutPlane cut_plane(const std::string& text) {
  const std::size_t sign = text.find_first_of("=<>");
  if (sign != 1)
    fail_usage(fmt::format("\"{}\" is not a plane: x=3.5, y=0 or z=-2 is one", text));
  CutPlane plane;
  plane.plane = {axis(text.substr(0, 1)), number(text.substr(2))};
  plane.keep = text[1] == '=' ? 0 : text[1] == '<' ? -1 : 1;
  return plane;
}

} // namespace

void fail_usage(const std::string& message) {
  throw Error(Fault::usage, "", message, "billet render --help lists what can be asked for");
}

double number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail_usage(fmt::format("\"{}\" is not a number", text));
  return value;
}

int count(const std::string& text, int least, int most, const std::string& what) {
  const double value = number(text);
  if (!(value >= least && value <= most) || value != std::floor(value))
    fail_usage(fmt::format("\"{}\" is not a number of {} from {} to {}", text, what, least, most));
  return static_cast<int>(value);
}

double positive(const std::string& text, const std::string& what) {
  const double value = number(text);
  if (!(value > 0.0))
    fail_usage(fmt::format("{} of {} should be above zero", what, text));
  return value;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::array<double, 2> pair(const std::string& text, char separator) {
  const std::vector<std::string> parts = split(text, separator);
  if (parts.size() != 2)
    fail_usage(fmt::format("\"{}\" should be two numbers with '{}' between", text, separator));
  return {number(parts[0]), number(parts[1])};
}

std::array<int, 2> picture_size(const std::string& text) {
  const std::array<double, 2> size = pair(text, 'x');
  for (const double length : size)
    if (!(length >= 16.0 && length <= 16384.0))
      fail_usage(fmt::format(
          "a picture of {} pixels cannot be drawn: width and height are 16 to 16384", text));
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

Series series(const std::string& text, bool points) {
  std::vector<std::string> parts = split(text, ':');
  if (parts.size() < 3 || parts.size() > 4)
    fail_usage(fmt::format("\"{}\" should be FILE.csv:X-COLUMN:Y-COLUMN[:LABEL]", text));
  if (parts.size() == 3)
    parts.push_back(parts[2]);
  return {parts[0], parts[1], parts[2], parts[3], points};
}

Columns columns(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 2 || parts[0].empty() || parts[1].empty())
    fail_usage(fmt::format("\"{}\" should be X:Y or X:Y,Y2: columns of history.csv", text));
  return {parts[0], split(parts[1], ',')};
}

int axis(const std::string& text) {
  const std::size_t found = text.size() == 1 ? axis_names.find(text[0]) : std::string_view::npos;
  if (found == std::string_view::npos)
    fail_usage(fmt::format("\"{}\" is not an axis: x, y or z is", text));
  return static_cast<int>(found);
}

Cut cut(const std::string& text) {
  Cut planes;
  for (const std::string& part : split(text, ','))
    planes.push_back(cut_plane(part));
  return planes;
}

void take_direction(View& view, const std::string& text) {
  const bool back = text.starts_with('-');
  if (text == "iso") {
    view.from = View::From::iso;
  } else if (const std::string name = text.substr(back ? 1 : 0);
             name.size() == 1 && axis_names.find(name[0]) != std::string_view::npos) {
    view.from = View::From::axis;
    view.axis = (back ? -1.0 : 1.0) * Vec3::Unit(axis(name));
  } else {
    if (text.find(',') == std::string::npos)
      fail_usage(fmt::format("\"{}\" is not a view: x, -x, y, -y, z, -z, iso or AZIMUTH,ELEVATION "
                             "in degrees is",
                             text));
    const std::array<double, 2> angles = pair(text, ',');
    if (std::abs(angles[1]) > 90.0)
      fail_usage(
          fmt::format("the elevation of the view, {:g}, should be from -90 to 90", angles[1]));
    view.from = View::From::angles;
    view.azimuth = angles[0];
    view.elevation = angles[1];
  }
}

Vec3 place(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 2 && parts.size() != 3)
    fail_usage(fmt::format("\"{}\" is not a place: X,Y,Z is, in the plane X,Y", text));
  return {number(parts[0]), number(parts[1]), parts.size() == 3 ? number(parts[2]) : 0.0};
}

std::vector<AskedTime> times(const std::string& text) {
  std::vector<AskedTime> result;
  for (const std::string& part : split(text, ','))
    result.push_back(part == "last" ? AskedTime() : AskedTime(number(part)));
  constexpr std::size_t most = 6;
  if (result.size() > most)
    fail_usage(fmt::format("no more than {} pictures stand next to each other", most));
  return result;
}

Mirror mirror(const std::string& text) {
  Mirror result;
  if (text.find('=') != std::string::npos) {
    result.planes = Mirror::Planes::given;
    for (const std::string& part : split(text, ',')) {
      const CutPlane plane = cut_plane(part);
      if (plane.keep != 0)
        fail_usage(fmt::format("\"{}\" is not a plane of symmetry: x=0 is one", part));
      result.given.push_back(plane.plane);
    }
    return result;
  }
  result.planes = Mirror::Planes::known;
  for (const char letter : text)
    if (letter != ',')
      result.axes.push_back(axis(std::string(1, letter)));
  return result;
}

FrameSlice slice(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() > 3)
    fail_usage(fmt::format("\"{}\" should be A:B:STEP: frames A to B, counted from 0", text));
  constexpr int most = 1000000;
  FrameSlice slice;
  if (!parts[0].empty())
    slice.first = count(parts[0], 0, most, "a frame");
  if (parts.size() > 1 && !parts[1].empty())
    slice.last = count(parts[1], 0, most, "a frame");
  if (parts.size() > 2 && !parts[2].empty())
    slice.step = count(parts[2], 1, most, "frames");
  if (parts.size() == 1)
    slice.last = slice.first;
  if (slice.last < slice.first)
    fail_usage(fmt::format("\"{}\" has its last frame before its first", text));
  return slice;
}

ToolStyle tool_style(const std::string& text) {
  return one_of<ToolStyle>(text,
                           {{"glass", ToolStyle::glass},
                            {"solid", ToolStyle::solid},
                            {"outline", ToolStyle::outline},
                            {"none", ToolStyle::none}},
                           "--tools");
}

Place place_of_field(const std::string& text) {
  return one_of<Place>(
      text, {{"workpiece", Place::workpiece}, {"contact", Place::contact}, {"tools", Place::tools}},
      "--on");
}

std::string field_name(const std::string& text) {
  static const std::map<std::string, std::string> short_names{
      {"pressure", "contact_pressure"}, {"friction", "friction_stress"},
      {"slip", "sliding_distance"},     {"wear", "wear_depth"},
      {"strain", "plastic_strain"},     {"strain_rate", "plastic_strain_rate"},
      {"mises", "von_mises"},           {"status", "contact_status"},
      {"quality", "element_quality"},   {"lap", "lap_depth"}};
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto found = short_names.find(text.substr(0, colon));
  return found == short_names.end() ? text : found->second + text.substr(colon);
}

} // namespace billet::render
