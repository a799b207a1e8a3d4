#include "io/case/one_kind.h"
#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <array>

namespace billet::io {

namespace {

std::optional<PlaceRotation> as_place_rotation(const At& at) {
  TableReader table(at);
  PlaceRotation rotation;
  table.optional("point", rotation.point, as_vector, any_length);
  if (at.context.in_space())
    table.required("axis", rotation.axis, as_axis);
  else
    table.optional("axis", rotation.axis, as_axis);
  table.required("degrees", rotation.degrees, as_number, Number{quantity::angle, any_value});
  table.finish();
  return rotation;
}

std::optional<std::array<double, 2>> as_active(const At& at) {
  const List* const list = as_list(at, 2, "2 times [from, to]");
  if (list == nullptr)
    return std::nullopt;
  const auto from = as_number(at.item((*list)[0], 0), {quantity::duration, any_value});
  const auto to = as_number(at.item((*list)[1], 1), {quantity::duration, any_value});
  if (!from || !to)
    return std::nullopt;
  if (*from < *to)
    return std::array{*from, *to};
  at.refuse(fmt::format("found {} to {}, allowed is from < to", *from, *to));
  return std::nullopt;
}

std::optional<Wear> as_wear(const At& at) {
  constexpr std::array laws{Word<int>{"archard", 0}};
  TableReader table(at);
  Wear wear;
  int law = 0;
  table.required("law", law, [&](const At& word) { return as_word(word, laws); });
  table.required("K", wear.K, as_number, not_negative_number);
  table.required("hardness", wear.hardness, as_number, positive_stress);
  table.optional("K_workpiece", wear.K_workpiece, as_number, not_negative_number);
  table.optional("strokes", wear.strokes, as_number, Number{quantity::number, Bounds{1.0}});
  table.finish();
  return wear;
}

/// A tool that is to be brought to touch needs a translation to follow.
void check_touch(TableReader& table, const Tool& tool) {
  if (tool.touch && !tool.motion.translation && (tool.motion.rotation || !table.find("motion")))
    table.find("touch")->refuse(
        "found true, but the tool has no velocity, displacement, force or press to follow");
}

/// A blow begins with a stage, not at a time within one.
void check_active(TableReader& table, const Tool& tool) {
  const auto* const press =
      tool.motion.translation ? std::get_if<PressMotion>(&*tool.motion.translation) : nullptr;
  if (tool.active && press != nullptr && !std::holds_alternative<CrankMotion>(*press))
    table.find("active")->complain(
        "a press that strikes acts by stages, allowed is to name it in the tools of a [[stage]]");
}

} // namespace

std::optional<Place> as_place(const At& at) {
  TableReader table(at);
  Place place;
  table.optional("translate", place.translate, as_vector, any_length);
  table.optional("rotate", place.rotate, as_place_rotation);
  table.finish();
  return place;
}

std::optional<Tool> as_tool(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Tool tool;
  tool.said_at = at.place();
  table.required("name", tool.name, as_name);
  table.required("surface", tool.surface, as_tool_surface);
  table.optional("place", tool.place, as_place);
  table.optional("motion", tool.motion, as_tool_motion);
  table.optional("touch", tool.touch, as_flag);
  table.optional("friction", tool.friction, as_friction);
  table.optional("wear", tool.wear, as_wear);
  table.optional("active", tool.active, as_active);
  check_touch(table, tool);
  check_active(table, tool);
  table.finish();
  return tool;
}

} // namespace billet::io
