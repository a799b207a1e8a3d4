// Contact, time, solver, remeshing and output.

#include "io/case/accuracy_preset.h"
#include "io/case/one_kind.h"
#include "io/case/read_parts.h"
#include "io/case/setting_words.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

namespace billet::io {

namespace {

/// as_word for a given list, to be handed to TableReader.
template <const auto& words>
constexpr auto as_one_of = [](const At& at) { return as_word(at, words); };

std::optional<Increments> as_increments(const At& at) {
  TableReader table(at);
  Increments increments;
  table.optional("first", increments.first, as_number, positive_time);
  table.optional("min", increments.min, as_number, positive_time);
  table.optional("max", increments.max, as_number, positive_time);
  table.optional("refine", increments.refine, as_number, positive_number);
  table.finish();
  const auto check = [&](std::string_view key, const std::optional<double>& low,
                         const std::optional<double>& high, std::string_view above) {
    if (low && high && *low > *high)
      table.find(key)->complain_found(fmt::format("no more than {} = {}", above, *high));
  };
  check("min", increments.min, increments.first, "first");
  check("min", increments.min, increments.max, "max");
  check("first", increments.first, increments.max, "max");
  return increments;
}

void read_remesh_when(TableReader& table, Remesh& remesh) {
  std::optional<TableReader> when = table.find_table("when");
  if (!when)
    return;
  when->optional("quality", remesh.quality, as_number, fraction_number);
  when->optional("interval", remesh.interval, as_number, positive_time);
  when->optional("penetration", remesh.penetration, as_number, positive_length);
  when->optional("strain", remesh.strain, as_number, positive_number);
  when->finish();
}

void read_remesh_size(TableReader& table, Remesh& remesh) {
  std::optional<TableReader> size = table.find_table("size");
  if (!size)
    return;
  size->optional("default", remesh.size_default, as_number, positive_length);
  size->optional("min", remesh.size_min, as_number, positive_length);
  size->optional("max", remesh.size_max, as_number, positive_length);
  size->optional("contact", remesh.size_contact, as_number, positive_length);
  size->finish();
  const auto check = [&](std::string_view key, const std::optional<double>& low,
                         const std::optional<double>& high, std::string_view above) {
    if (low && high && *low > *high)
      size->find(key)->complain_found(fmt::format("no more than {} = {}", above, *high));
  };
  check("min", remesh.size_min, remesh.size_max, "max");
  check("min", remesh.size_min, remesh.size_default, "default");
  check("min", remesh.size_min, remesh.size_contact, "contact");
  check("default", remesh.size_default, remesh.size_max, "max");
}

/// "set:NAME" without "set:".
std::optional<std::vector<std::string>> as_set_names(const At& at) {
  const std::optional<std::vector<std::string>> texts = as_texts(at);
  if (!texts)
    return std::nullopt;
  std::vector<std::string> names;
  for (const std::string& text : *texts) {
    if (!text.starts_with("set:") || text.size() == 4) {
      at.refuse(fmt::format("found \"{}\", allowed is \"set:NAME\"", printable(text)));
      return std::nullopt;
    }
    names.push_back(text.substr(4));
  }
  return names;
}

std::vector<std::string> field_names() {
  return {"displacement",
          "velocity",
          "von_mises",
          "stress",
          "plastic_strain",
          "contact_pressure",
          "plastic_strain_rate",
          "temperature",
          "friction_stress",
          "gap",
          "lap_depth",
          "contact_status",
          "sliding_distance",
          "wear_depth",
          "wear_depth_extrapolated",
          "element_quality"};
}

std::optional<std::variant<FieldSet, std::vector<std::string>>> as_fields(const At& at) {
  if (!at.is_a<List>())
    return as_word(at, field_sets);
  const List* const list = at.list(1);
  std::vector<std::string> fields;
  if (list->empty())
    at.complain_found("\"default\", \"all\" or a list of at least one field");
  for (std::size_t i = 0; i < list->size(); ++i)
    if (const auto index = as_word_index(at.item((*list)[i], i), field_names()))
      fields.push_back(field_names()[*index]);
  return fields;
}

std::optional<std::vector<double>> as_times(const At& at) {
  std::optional<std::vector<double>> times = as_numbers(at, not_negative_time);
  for (std::size_t i = 1; times && i < times->size(); ++i) {
    if ((*times)[i] <= (*times)[i - 1]) {
      at.refuse(fmt::format("found {} after {}, allowed are increasing times", (*times)[i],
                            (*times)[i - 1]));
      return std::nullopt;
    }
  }
  return times;
}

constexpr Quantity process_time{"a time of the process", {0, 0, 1}, "s", false};

/// A number is a time of the process, a text with a unit one of the wall clock.
std::optional<CheckpointInterval> as_checkpoint_interval(const At& at) {
  if (at.expect(
          NumberShape{process_time, positive},
          TextShape{"a time of the wall clock, or never", R"(^(never|[0-9.eE+-]+ *(s|min|h))$)"}))
    return CheckpointInterval{};
  const std::string* const text = at.node.as<std::string>();
  if (text == nullptr) {
    const std::optional<double> time = as_number(at, positive_time);
    return time ? std::optional(CheckpointInterval{*time, false}) : std::nullopt;
  }
  if (*text == "never")
    return CheckpointInterval{HUGE_VAL, true};
  constexpr std::array<std::pair<std::string_view, double>, 3> units{
      {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}}};
  double value = 0.0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text->data() + text->size() - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const auto& [name, seconds] : units)
    if (error == std::errc{} && unit == name && value > 0.0 && std::isfinite(value))
      return CheckpointInterval{value * seconds, true};
  at.complain_found("a time of the process (a number), a time of the wall clock such as "
                    "\"10 min\" (s, min, h), or \"never\"");
  return std::nullopt;
}

/// true, false, or a table with the friction.
std::optional<SelfContact> as_self_contact(const At& at) {
  SelfContact self;
  if (at.is_a<bool>()) {
    self.on = as_flag(at).value_or(true);
    return self;
  }
  if (!at.is_table()) {
    at.complain_found(
        "true, false, or a table such as { friction = { law = \"coulomb\", mu = 0.1 } }");
    return std::nullopt;
  }
  TableReader table(at);
  table.optional("friction", self.friction, as_friction);
  if (self.friction.tensor)
    table.find("friction")
        ->complain("contact of the workpiece with itself has isotropic friction: "
                   "a tensor needs the directions of a tool");
  table.finish();
  return self;
}

std::optional<Trapped> read_gas(TableReader& /*table*/, const At& at) {
  TableReader inner(at);
  TrappedGas gas;
  inner.required("pressure", gas.pressure, as_number, positive_stress);
  inner.optional("exponent", gas.exponent, as_number,
                 Number{quantity::number, {.low = 1.0, .high = 2.0}});
  inner.finish();
  return gas;
}

std::optional<Trapped> read_lubricant(TableReader& /*table*/, const At& at) {
  TableReader inner(at);
  TrappedLubricant lubricant;
  inner.required("bulk_modulus", lubricant.bulk_modulus, as_number, positive_stress);
  inner.finish();
  return lubricant;
}

std::optional<Trapped> as_trapped(const At& at) {
  constexpr std::array kinds{Kind<Trapped>{"gas", Scenes::plane, read_gas},
                             Kind<Trapped>{"lubricant", Scenes::plane, read_lubricant}};
  return read_one_kind<Trapped>(at, kinds);
}

} // namespace

std::optional<ContactSettings> as_contact(const At& at) {
  TableReader table(at);
  ContactSettings contact;
  table.optional("form", contact.form, as_one_of<contact_forms>);
  table.optional("method", contact.method, as_one_of<contact_methods>);
  table.optional("penalty", contact.penalty, as_number, positive_number);
  table.optional("penalty_tangent", contact.penalty_tangent, as_number, positive_number);
  table.optional("max_penetration", contact.max_penetration, as_number, positive_length);
  table.optional("integrator", contact.integrator, as_one_of<contact_integrators>);
  table.optional("substeps", contact.substeps, as_count);
  if (contact.substeps && contact.integrator != ContactIntegrator::midpoint)
    table.find("substeps")->complain("only integrator = \"midpoint\" has sub-increments");
  table.optional("surface", contact.surface, as_where);
  table.optional("self", contact.self, as_self_contact);
  table.optional("trapped", contact.trapped, as_trapped);
  table.finish();
  return contact;
}

std::optional<TimeSettings> as_time(const At& at) {
  TableReader table(at);
  TimeSettings time;
  table.optional("end", time.end, as_number, positive_time);
  table.optional("increments", time.increments, as_increments);
  table.finish();
  return time;
}

/// Tools that act in a stage.
std::optional<std::vector<std::string>> as_tools(const At& at) {
  const List* const list = at.list(1);
  if (list != nullptr && list->empty()) {
    at.refuse("found an empty list, allowed is a list of at least one tool",
              "leave the key out, and all act; unload = true lets all of them leave");
    return std::nullopt;
  }
  return as_texts(at);
}

std::optional<Stage> as_stage(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Stage stage;
  table.required("name", stage.name, as_name);
  table.required("end", stage.end, as_number, positive_time);
  table.optional("tools", stage.tools, as_tools);
  table.optional("unload", stage.unload, as_flag);
  if (stage.unload && stage.tools)
    table.find("tools")->complain("no tools act in a stage with unload = true: all of them leave");
  table.finish();
  return stage;
}

std::optional<SolverSettings> as_solver(const At& at) {
  TableReader table(at);
  SolverSettings solver;
  table.optional("linear", solver.linear, as_one_of<linear_solvers>);
  table.optional("threads", solver.threads, as_count);
  if (const std::optional<At> at_flag = table.find("reproducible"))
    at_flag->complain("results are the same to the bit for any number of threads, always",
                      "take the line out");
  table.optional("accuracy", solver.accuracy, as_one_of<accuracies>);
  std::optional<double> tolerance; // its default is that of the accuracy
  table.optional("tolerance", tolerance, as_number,
                 Number{quantity::number, {0.0, 1.0, true, true}});
  solver.tolerance = tolerance.value_or(preset_of(solver.accuracy).tolerance);
  table.finish();
  return solver;
}

std::optional<Remesh> as_remesh(const At& at) {
  TableReader table(at);
  Remesh remesh;
  read_remesh_when(table, remesh);
  read_remesh_size(table, remesh);
  table.optional("element", remesh.element, as_element);
  table.optional("keep", remesh.keep, as_set_names);
  table.optional("weld", remesh.weld, as_flag);
  table.finish();
  return remesh;
}

std::optional<StopSettings> as_stop(const At& at) {
  TableReader table(at);
  StopSettings stop;
  table.optional("on_full_cavity", stop.on_full_cavity, as_flag);
  table.optional("on_tools_overloaded", stop.on_tools_overloaded, as_flag);
  table.optional("on_lap", stop.on_lap, as_number, positive_length);
  table.optional("on_tools_together", stop.on_tools_together, as_flag);
  table.finish();
  return stop;
}

std::optional<OutputSettings> as_output(const At& at) {
  TableReader table(at);
  OutputSettings output;
  table.optional("every", output.every, as_number, positive_time);
  table.optional("at", output.at, as_times);
  table.optional("fields", output.fields, as_fields);
  table.optional("checkpoint_every", output.checkpoint_every, as_checkpoint_interval);
  table.finish();
  return output;
}

} // namespace billet::io
