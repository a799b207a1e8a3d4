#include "app/report/html.h"
#include "app/report/sections.h"
#include "io/case/history_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

double number_in(const ordered_json& object, const char* key) {
  return object.is_object() && object.contains(key) && object[key].is_number()
             ? object[key].get<double>()
             : NAN;
}

std::string vector_of(const ordered_json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_array())
    return "–";
  std::string text;
  for (const ordered_json& value : object[key])
    text += (text.empty() ? "" : ", ") + number(value.is_number() ? value.get<double>() : NAN);
  return "(" + text + ")";
}

std::string headed(const std::string& what, const std::string& unit) {
  return fmt::format("{}<br><small>[{}]</small>", what, escaped(unit));
}

const ordered_json& member(const ordered_json& object, const char* key) {
  static const ordered_json nothing;
  return object.is_object() && object.contains(key) ? object[key] : nothing;
}

/// What a measure is, and in which unit; empty: the case does not say.
std::string words_of_measure(const ResultsFolder& results, const std::string& name) {
  for (const auto& [known, kind] : results.facts.measures)
    if (known == name)
      return kind + (kind == "barrelling" || kind == "filling"
                         ? std::string(" [-]")
                         : " [" + results.units().length + "]");
  return {};
}

/// Of a run that has no summary: last force, largest force and way of each tool from the history.
std::string tools_of_history(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  std::vector<std::vector<std::string>> rows;
  for (const std::string& tool : results.tools()) {
    std::array<std::vector<double>, 6> c;
    const std::array<const char*, 6> names{"force_x",        "force_y",        "force_z",
                                           "displacement_x", "displacement_y", "displacement_z"};
    for (std::size_t i = 0; i < c.size(); ++i)
      c.at(i) = column(results.history, tool + "." + names.at(i));
    double largest = 0.0;
    for (std::size_t i = 0; i < c[5].size(); ++i)
      largest = std::max(largest, Vec3(c[0][i], c[1][i], c[2][i]).norm());
    if (c[5].empty())
      continue;
    const std::size_t end = c[5].size() - 1;
    rows.push_back({escaped(tool), number(Vec3(c[0][end], c[1][end], c[2][end]).norm()),
                    number(largest), number(Vec3(c[3][end], c[4][end], c[5][end]).norm())});
  }
  if (rows.empty())
    return {};
  return section("tools", "Tools",
                 table({"tool", headed("last force", results.of_whole(units.force)),
                        headed("largest force", results.of_whole(units.force)),
                        headed("stroke", units.length)},
                       rows));
}

} // namespace

std::string tools_section(const ResultsFolder& results) {
  const ordered_json& tools = member(results.summary, "tools");
  if (!tools.is_object() || tools.empty())
    return tools_of_history(results);
  const io::UnitSystem units = results.units();
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, tool] : tools.items()) {
    const ordered_json& largest = member(tool, "largest_force");
    rows.push_back({escaped(name), vector_of(tool, "force"), number(number_in(largest, "value")),
                    number(number_in(largest, "time")), vector_of(tool, "torque"),
                    vector_of(tool, "displacement"), number(number_in(tool, "turned"))});
  }
  return section(
      "tools", "Tools",
      table({"tool", headed("last force", results.of_whole(units.force)),
             headed("largest force", results.of_whole(units.force)), headed("at time", units.time),
             headed("torque", results.of_whole(units.force + " " + units.length)),
             headed("displacement", units.length), headed("turned", "rad")},
            rows));
}

std::string wear_section(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  std::vector<std::vector<std::string>> rows;
  const ordered_json& tools = member(results.summary, "tools");
  if (!tools.is_object())
    return {};
  for (const auto& [name, tool] : tools.items()) {
    const ordered_json& wear = member(tool, "wear");
    if (!wear.is_object())
      continue;
    rows.push_back({escaped(name), number(number_in(wear, "volume")),
                    number(number_in(wear, "largest_depth")), vector_of(wear, "at"),
                    number(number_in(wear, "strokes")),
                    number(number_in(wear, "volume_extrapolated")),
                    number(number_in(wear, "largest_depth_extrapolated")),
                    number(number_in(member(wear, "workpiece"), "volume")),
                    number(number_in(member(wear, "workpiece"), "largest_depth"))});
  }
  if (rows.empty())
    return {};
  const std::string volume = results.of_whole(units.length + "³");
  return section(
      "wear", "Wear",
      table({"tool", headed("volume", volume), headed("largest depth", units.length),
             headed("at", units.length), "strokes", headed("volume, all strokes", volume),
             headed("largest depth, all strokes", units.length),
             headed("worn off the part", volume), headed("its depth", units.length)},
            rows));
}

std::string window_section(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  std::string html;
  const std::vector<std::pair<const char*, std::string>> quantities{
      {"pressure", "pressure [" + units.stress + "]"},
      {"sliding_speed", "sliding speed [" + units.length + "/" + units.time + "]"},
      {"sliding_distance", "sliding distance [" + units.length + "]"},
      {"surface_strain", "surface strain [-]"},
      {"surface_strain_rate", "surface strain rate [1/" + units.time + "]"}};
  const auto add = [&](const std::string& name, const ordered_json& window) {
    if (!(number_in(window, "contact_time") > 0.0))
      return;
    std::vector<std::vector<std::string>> rows;
    for (const auto& [key, label] : quantities)
      if (const ordered_json& range = member(window, key); range.is_object())
        rows.push_back({escaped(label), number(number_in(range, "mean")),
                        number(number_in(range, "lowest")), number(number_in(range, "highest")),
                        number(number_in(range, "last_mean"))});
    html += fmt::format("<h3>{}</h3>\n<p>In contact for {} {}, mean area {} {}.</p>\n",
                        escaped(name), number(number_in(window, "contact_time")),
                        escaped(units.time), number(number_in(window, "mean_area")),
                        escaped(results.of_whole(units.length + "²")));
    html += table({"quantity", "mean", "lowest", "highest", "mean at the last contact"}, rows);
  };
  const ordered_json& tools = member(results.summary, "tools");
  if (tools.is_object() && tools.size() > 1)
    add("All contact pairs", member(results.summary, "process_window"));
  if (tools.is_object())
    for (const auto& [name, tool] : tools.items())
      add("Tool " + name, member(tool, "process_window"));
  return html.empty() ? html : section("window", "Process window", html);
}

std::string measures_section(const ResultsFolder& results) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t c = io::fixed_columns.size(); c < results.history.columns.size(); ++c) {
    const std::string& name = results.history.columns[c];
    const std::vector<double> values = results.history.numbers(c);
    if (name.find('.') != std::string::npos || values.empty())
      continue;
    double least = NAN, most = NAN;
    for (const double value : values) {
      least = std::fmin(least, value);
      most = std::fmax(most, value);
    }
    rows.push_back({escaped(name), escaped(words_of_measure(results, name)), number(values.front()),
                    number(values.back()), number(least), number(most)});
  }
  if (rows.empty())
    return {};
  return section("measures", "Measures and filling",
                 table({"measure", "of", "first", "last", "least", "largest"}, rows));
}

std::string laps_section(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  std::string html;
  std::vector<std::vector<std::string>> rows;
  for (const ordered_json& lap : member(results.summary, "laps"))
    rows.push_back({escaped(lap.value("state", "")), vector_of(lap, "at"),
                    number(number_in(lap, "since")), number(number_in(lap, "depth")),
                    number(number_in(lap, "area"))});
  if (!rows.empty())
    html += table({"lap", headed("at", units.length), headed("since", units.time),
                   headed("depth", units.length), headed("area", units.length + "²")},
                  rows);
  rows.clear();
  for (const ordered_json& place : member(member(results.summary, "self_contact"), "places"))
    rows.push_back({"contact of the part with itself", vector_of(place, "at"),
                    number(number_in(place, "since")), number(number_in(place, "area")),
                    number(number_in(place, "mean_pressure"))});
  if (!rows.empty())
    html += table({"place", headed("at", units.length), headed("since", units.time),
                   headed("area", units.length + "²"), headed("mean pressure", units.stress)},
                  rows);
  rows.clear();
  for (const ordered_json& wall : member(results.summary, "met_walls"))
    rows.push_back({escaped(wall.value("wall", "")), number(number_in(wall, "since")),
                    vector_of(wall, "from"), vector_of(wall, "to")});
  if (!rows.empty())
    html += table({"metal came to", headed("since", units.time), headed("from", units.length),
                   headed("to", units.length)},
                  rows);
  return html.empty() ? html : section("laps", "Laps and walls that have met", html);
}

std::string blows_section(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  const std::string energy = results.of_whole(units.force + " " + units.length);
  std::vector<std::vector<std::string>> rows;
  for (const ordered_json& blow : member(results.summary, "blows"))
    rows.push_back({escaped(blow.value("tool", "")), number(number_in(blow, "begun")),
                    number(number_in(blow, "time")), number(number_in(blow, "energy")),
                    number(number_in(blow, "energy_used")), number(number_in(blow, "energy_left")),
                    number(number_in(blow, "stroke")), number(number_in(blow, "end_speed"))});
  if (rows.empty())
    return {};
  return section(
      "blows", "Blows",
      table({"tool", headed("from", units.time), headed("to", units.time), headed("energy", energy),
             headed("used", energy), headed("left", energy), headed("stroke", units.length),
             headed("end speed", units.length + "/" + units.time)},
            rows));
}

} // namespace billet::report
