// Checks across the parts of a case: names that refer to other parts, times that must fit.

#include "io/case/history_columns.h"
#include "io/case/read_parts.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace billet::io {

namespace {

/// The value of a key of a table, if it is there.
std::optional<At> child(const std::optional<At>& at, std::string_view key) {
  const Table* const table = at ? at->node.as<Table>() : nullptr;
  const Node* const node = table != nullptr ? table->find(key) : nullptr;
  if (node == nullptr)
    return std::nullopt;
  const std::string prefix = at->path.empty() ? "" : at->path + ".";
  return At{*node, prefix + std::string(key), at->context};
}

/// The items of a list, if it is one; an item is called by its name.
std::vector<At> items(const std::optional<At>& at) {
  const List* const list = at ? at->node.as<List>() : nullptr;
  std::vector<At> result;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
    result.push_back({(*list)[i], at->path + "." + item_name((*list)[i], i), at->context});
  return result;
}

const std::string* text_of(const std::optional<At>& at) {
  return at ? at->node.as<std::string>() : nullptr;
}

void refuse_same_names(const At& root, std::string_view key) {
  std::set<std::string> names;
  for (const At& item : items(child(root, key))) {
    const std::optional<At> name = child(item, "name");
    const std::string* const text = text_of(name);
    if (text != nullptr && !names.insert(*text).second)
      name->complain(
          fmt::format("there is a {} \"{}\" already, names must differ", key, printable(*text)));
  }
}

/// A support has columns of its own in history.csv.
void refuse_names_of_tools(const At& root) {
  std::set<std::string> names;
  for (const At& tool : items(child(root, "tool")))
    if (const std::string* const name = text_of(child(tool, "name")))
      names.insert(*name);
  for (const At& support : items(child(root, "support"))) {
    const std::optional<At> name = child(support, "name");
    const std::string* const text = text_of(name);
    if (text != nullptr && names.contains(*text))
      name->complain(
          fmt::format("there is a tool \"{}\" already, names must differ", printable(*text)));
  }
}

void check_material(const At& root, const Case& content) {
  const std::optional<At> at = child(child(root, "workpiece"), "material");
  if (text_of(at) == nullptr || content.materials.empty() ||
      content.materials.contains(*text_of(at)))
    return;
  std::vector<std::string> names;
  for (const auto& [name, material] : content.materials)
    names.push_back(name);
  at->refuse(fmt::format("found {}, but there is no [material.{}]", shown(at->node),
                         printable(*text_of(at))),
             suggestion(*text_of(at), names));
}

/// Whether the flow stress depends on the temperature.
bool asks_temperature(const std::optional<FlowLaw>& flow) {
  if (!flow)
    return false;
  return std::visit(
      [](const auto& law) {
        if constexpr (requires { law.asks_temperature(); })
          return law.asks_temperature();
        else
          return false;
      },
      *flow);
}

/// What Hensel's and Spittel's formula must not be asked.
void check_range(const At& at, const mechanics::HanselSpittel& law, double T) {
  if (law.m9 != 0.0 && T <= 0.0)
    at.complain(fmt::format("T^m9 needs a temperature above 0 degC, the case has {}", T));
  if (law.m3 + law.m8 * T < 0.0)
    at.complain(fmt::format(
        "the flow stress falls with the rate at {} degC: m3 + m8 T = {}, allowed is >= 0", T,
        law.m3 + law.m8 * T));
}

/// The default hardness of a law that gives an initial yield stress at a temperature.
void complete_hardness(Case& content) {
  const auto found = content.materials.find(content.workpiece.material);
  if (found == content.materials.end() || found->second.hardness || !found->second.flow ||
      !content.temperature)
    return;
  const auto* const law = std::get_if<mechanics::JohnsonCook>(&*found->second.flow);
  if (law == nullptr || !(law->T_melt > law->T_room))
    return; // complained about already
  const double T = (*content.temperature - law->T_room) / (law->T_melt - law->T_room);
  const double yield = law->A * (1.0 - std::pow(std::clamp(T, 0.0, 1.0), law->m));
  if (yield > 0.0)
    found->second.hardness = 3.0 * yield;
}

/// The temperature is there for a law that asks for it, and one that it can take.
void check_temperature(const At& root, const Case& content) {
  const auto found = content.materials.find(content.workpiece.material);
  const std::optional<At> material = child(child(root, "material"), content.workpiece.material);
  if (found == content.materials.end() || !material)
    return;
  const bool by_law = asks_temperature(found->second.flow);
  const std::optional<At> own = child(material, by_law ? "flow" : "heating");
  const At& at = own ? *own : *material;
  if (!content.temperature) {
    if (by_law || found->second.heating)
      at.complain(by_law ? "this law needs the temperature of the workpiece"
                         : "heating needs the temperature that the workpiece starts from",
                  "give temperature = ... (degC) at the top of the case");
    return;
  }
  if (found->second.flow)
    if (const auto* const law = std::get_if<mechanics::HanselSpittel>(&*found->second.flow))
      check_range(at, *law, *content.temperature);
}

void check_stage_tools(const At& root) {
  std::vector<std::string> names;
  for (const At& tool : items(child(root, "tool")))
    if (const std::string* const name = text_of(child(tool, "name")))
      names.push_back(*name);
  for (const At& stage : items(child(root, "stage"))) {
    for (const At& tool : items(child(stage, "tools"))) {
      const auto* const name = tool.node.as<std::string>();
      if (name != nullptr && std::find(names.begin(), names.end(), *name) == names.end())
        tool.refuse(fmt::format("found {}, but there is no such tool", shown(tool.node)),
                    suggestion(*name, names));
    }
  }
}

/// Measures name tools that there are, and no column that history.csv has anyway.
void check_measures(const At& root) {
  std::vector<std::string> tools;
  for (const At& tool : items(child(root, "tool")))
    if (const std::string* const name = text_of(child(tool, "name")))
      tools.push_back(*name);
  for (const At& measure : items(child(root, "measure"))) {
    const std::optional<At> tool = child(measure, "tool"), name = child(measure, "name");
    if (const std::string* const text = text_of(tool);
        text != nullptr && std::find(tools.begin(), tools.end(), *text) == tools.end())
      tool->refuse(fmt::format("found {}, but there is no such tool", shown(tool->node)),
                   suggestion(*text, tools));
    if (const std::string* const text = text_of(name);
        text != nullptr &&
        std::find(fixed_columns.begin(), fixed_columns.end(), *text) != fixed_columns.end())
      name->refuse(fmt::format("found {}, which is a column of history.csv already, allowed is "
                               "another name",
                               shown(name->node)));
  }
}

/// Ends of stages must increase from one to the next.
void check_stage_ends(const At& root, const Case& content) {
  const std::vector<At> stages = items(child(root, "stage"));
  if (stages.size() != content.stages.size())
    return; // some are no tables at all
  for (std::size_t i = 1; i < stages.size(); ++i) {
    const double before = content.stages[i - 1].end;
    const std::optional<At> end = child(stages[i], "end");
    if (end && content.stages[i].end > 0.0 && content.stages[i].end <= before)
      end->complain_found(fmt::format("more than the end {} of the stage before", before));
  }
}

/// Whether [time] has a key that it does not know: complained about, and most likely the end.
bool has_foreign_key(const std::optional<At>& time) {
  const Table* const table = time ? time->node.as<Table>() : nullptr;
  return table != nullptr &&
         std::any_of(table->entries.begin(), table->entries.end(), [](const Entry& entry) {
           return entry.key != "end" && entry.key != "increments";
         });
}

/// The end of the run is given by [time] or by the last stage.
void complete_end(const At& root, Case& content) {
  const std::optional<At> time = child(root, "time");
  const std::optional<At> end = child(time, "end");
  if (content.stages.empty()) {
    if (!end && !child(root, "stage") && !has_foreign_key(time))
      (time ? *time : root)
          .context.complaints.add((time ? *time : root).node.place,
                                  "time.end: missing, it must be given", "",
                                  error_code::key_missing);
    return;
  }
  const double last = content.stages.back().end;
  if (end && last > 0.0 && content.time.end > 0.0 && content.time.end != last)
    end->complain_found(fmt::format("the end {} of the last stage, or no end", last));
  content.time.end = last;
}

void check_increments(const At& root, const Case& content) {
  const Increments& given = content.time.increments;
  const std::optional<At> table = child(child(root, "time"), "increments");
  for (const auto& [key, value] : {std::pair("first", given.first), std::pair("min", given.min)})
    if (const std::optional<At> at = child(table, key);
        at && value && content.time.end > 0.0 && *value > content.time.end)
      at->complain_found(fmt::format("no more than the end {}", content.time.end));
}

void check_frame_times(const At& root, const Case& content) {
  const std::vector<At> times = items(child(child(root, "output"), "at"));
  if (times.size() != content.output.at.size() || !(content.time.end > 0.0))
    return; // complained about already
  for (std::size_t i = 0; i < times.size(); ++i)
    if (content.output.at[i] > content.time.end)
      times[i].complain_found(fmt::format("no more than the end {}", content.time.end));
}

} // namespace

void check_whole(const At& root, Case& content) {
  refuse_same_names(root, "tool");
  refuse_same_names(root, "support");
  refuse_names_of_tools(root);
  refuse_same_names(root, "stage");
  refuse_same_names(root, "measure");
  check_material(root, content);
  check_temperature(root, content);
  complete_hardness(content);
  check_stage_tools(root);
  check_measures(root);
  check_stage_ends(root, content);
  complete_end(root, content);
  check_increments(root, content);
  check_frame_times(root, content);
}

} // namespace billet::io
