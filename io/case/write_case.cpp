#include "io/case/read_case.h"
#include "io/case/setting_words.h"
#include "io/case/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::io {

namespace {

template <class Value>
void add_if(TomlTable& table, std::string_view key, const std::optional<Value>& value) {
  if (value)
    table.add(key, toml_text(*value));
}

std::string support_text(const Support& support, int size) {
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  std::vector<std::string> fix;
  TomlTable move;
  bool moves = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    if (support.fix[i])
      fix.emplace_back(names[i]);
    add_if(move, names[i], support.move[i]);
    moves = moves || support.move[i];
  }
  TomlTable table;
  if (!support.name.empty())
    table.add("name", toml_text(std::string_view(support.name)));
  table.add("where", toml_text(support.where));
  if (!fix.empty())
    table.add("fix", toml_text(fix));
  if (moves)
    table.add("move", move.on_one_line());
  return table.on_lines();
}

void write_load(TomlTable& table, const PressureLoad& load, int /*size*/) {
  table.add("pressure", toml_text(load.pressure));
}

void write_load(TomlTable& table, const TractionLoad& load, int size) {
  table.add("traction", toml_text(load.traction, size)).add("amplitude", toml_text(load.amplitude));
}

void write_load(TomlTable& table, const BodyForce& load, int size) {
  table.add("body_force", toml_text(load.force, size)).add("amplitude", toml_text(load.amplitude));
}

std::string load_text(const Load& load, int size) {
  TomlTable table;
  table.add("where", toml_text(load.where));
  std::visit([&](const auto& kind) { write_load(table, kind, size); }, load.kind);
  return table.on_lines();
}

std::string self_contact_text(const SelfContact& self, int size) {
  if (!self.on || self.friction == Friction{})
    return self.on ? "true" : "false";
  return TomlTable().add("friction", toml_text(self.friction, size)).on_one_line();
}

std::string trapped_text(const Trapped& trapped) {
  TomlTable inside;
  if (const auto* const gas = std::get_if<TrappedGas>(&trapped)) {
    inside.add("pressure", toml_text(gas->pressure)).add("exponent", toml_text(gas->exponent));
    return TomlTable().add("gas", inside.on_one_line()).on_one_line();
  }
  inside.add("bulk_modulus", toml_text(std::get<TrappedLubricant>(trapped).bulk_modulus));
  return TomlTable().add("lubricant", inside.on_one_line()).on_one_line();
}

std::string contact_text(const ContactSettings& contact, int size) {
  TomlTable table;
  if (contact.form)
    table.add("form", word_text(*contact.form, contact_forms));
  table.add("method", word_text(contact.method, contact_methods))
      .add("penalty", toml_text(contact.penalty))
      .add("penalty_tangent", toml_text(contact.penalty_tangent));
  add_if(table, "max_penetration", contact.max_penetration);
  table.add("integrator", word_text(contact.integrator, contact_integrators));
  add_if(table, "substeps", contact.substeps);
  add_if(table, "surface", contact.surface);
  table.add("self", self_contact_text(contact.self, size));
  if (contact.trapped)
    table.add("trapped", trapped_text(*contact.trapped));
  return table.on_lines();
}

std::string time_text(const TimeSettings& time) {
  TomlTable increments;
  add_if(increments, "first", time.increments.first);
  add_if(increments, "min", time.increments.min);
  add_if(increments, "max", time.increments.max);
  increments.add("refine", toml_text(time.increments.refine));
  return TomlTable()
      .add("end", toml_text(time.end))
      .add("increments", increments.on_one_line())
      .on_lines();
}

std::string stage_text(const Stage& stage) {
  TomlTable table;
  table.add("name", toml_text(std::string_view(stage.name))).add("end", toml_text(stage.end));
  add_if(table, "tools", stage.tools);
  return table.add("unload", toml_text(stage.unload)).on_lines();
}

std::string solver_text(const SolverSettings& solver) {
  TomlTable table;
  table.add("linear", word_text(solver.linear, linear_solvers))
      .add("tolerance", toml_text(solver.tolerance));
  add_if(table, "threads", solver.threads);
  return table.add("accuracy", word_text(solver.accuracy, accuracies)).on_lines();
}

std::string remesh_text(const Remesh& remesh) {
  TomlTable when;
  add_if(when, "quality", remesh.quality);
  add_if(when, "interval", remesh.interval);
  add_if(when, "penetration", remesh.penetration);
  add_if(when, "strain", remesh.strain);
  TomlTable size;
  add_if(size, "default", remesh.size_default);
  add_if(size, "min", remesh.size_min);
  add_if(size, "max", remesh.size_max);
  add_if(size, "contact", remesh.size_contact);
  TomlTable table;
  table.add("when", when.on_one_line()).add("size", size.on_one_line());
  if (remesh.element)
    table.add("element", toml_text(std::string_view(*remesh.element)));
  std::vector<std::string> keep;
  for (const std::string& name : remesh.keep)
    keep.push_back("set:" + name);
  if (!keep.empty())
    table.add("keep", toml_text(keep));
  add_if(table, "weld", remesh.weld);
  return table.on_lines();
}

std::string interval_text(const CheckpointInterval& interval) {
  if (!interval.wall_clock)
    return toml_text(interval.length);
  if (std::isinf(interval.length))
    return toml_text(std::string("never"));
  constexpr double minute = 60.0;
  const bool in_minutes = std::fmod(interval.length, minute) == 0.0;
  return toml_text(fmt::format("{} {}", interval.length / (in_minutes ? minute : 1.0),
                               in_minutes ? "min" : "s"));
}

std::string measure_text(const Measure& measure, int size) {
  TomlTable table;
  table.add("name", toml_text(std::string_view(measure.name)))
      .add("kind", word_text(measure.kind, measure_kinds));
  const bool along = measure.kind == MeasureKind::height || measure.kind == MeasureKind::reach;
  if (size == 3 && !along && measure.kind != MeasureKind::filling)
    table.add("point", toml_text(measure.point, size)).add("axis", toml_text(measure.axis, size));
  if (along)
    table.add("direction", toml_text(measure.direction, size));
  if (!measure.tool.empty())
    table.add("tool", toml_text(std::string_view(measure.tool)));
  add_if(table, "touching", measure.touching);
  if (measure.within)
    table.add("within", toml_list({toml_text(measure.within->low, size),
                                   toml_text(measure.within->high, size)}));
  return table.on_lines();
}

std::string stop_text(const StopSettings& stop) {
  TomlTable table;
  table.add("on_full_cavity", toml_text(stop.on_full_cavity))
      .add("on_tools_overloaded", toml_text(stop.on_tools_overloaded))
      .add("on_tools_together", toml_text(stop.on_tools_together));
  add_if(table, "on_lap", stop.on_lap);
  return table.on_lines();
}

std::string output_text(const OutputSettings& output) {
  TomlTable table;
  add_if(table, "every", output.every);
  if (!output.at.empty())
    table.add("at", toml_text(output.at));
  const auto* const set = std::get_if<FieldSet>(&output.fields);
  table.add("fields", set != nullptr
                          ? word_text(*set, field_sets)
                          : toml_text(std::get<std::vector<std::string>>(output.fields)));
  table.add("checkpoint_every", interval_text(output.checkpoint_every));
  return table.on_lines();
}

} // namespace

std::string resolved_toml(const Case& content) {
  const int size = content.dimension();
  TomlTable head;
  head.add("title", toml_text(std::string_view(content.title)))
      .add("units", toml_text(std::string_view(content.units.name)))
      .add("analysis", word_text(content.analysis, analyses));
  add_if(head, "temperature", content.temperature);
  std::string text = head.on_lines();
  const auto section = [&](const std::string& header, const std::string& lines) {
    text += "\n" + header + "\n" + lines;
  };
  section("[workpiece]", toml_text(content.workpiece, size));
  for (const auto& [name, material] : content.materials)
    section("[material." + toml_key(name) + "]", toml_text(material));
  for (const Support& support : content.supports)
    section("[[support]]", support_text(support, size));
  for (const Load& load : content.loads)
    section("[[load]]", load_text(load, size));
  for (const Tool& tool : content.tools)
    section("[[tool]]", toml_text(tool, size));
  section("[contact]", contact_text(content.contact, size));
  section("[time]", time_text(content.time));
  for (const Stage& stage : content.stages)
    section("[[stage]]", stage_text(stage));
  section("[solver]", solver_text(content.solver));
  if (content.remesh)
    section("[remesh]", remesh_text(*content.remesh));
  for (const Measure& measure : content.measures)
    section("[[measure]]", measure_text(measure, size));
  section("[stop]", stop_text(content.stop));
  section("[output]", output_text(content.output));
  return text;
}

} // namespace billet::io
